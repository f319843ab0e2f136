// SPDX-License-Identifier: BSD-3-Clause
#include "config/atomic_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/random.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <mutex>
#include <system_error>

#include "config/input_error.h"

namespace hexcal {
namespace {

[[noreturn]] void Fail(const std::string& path, std::string_view step, int error) {
  throw OutputError(
      fmt::format("{}: {} failed: {}", path, step, std::generic_category().message(error)));
}

template <typename Call>
auto Retry(Call&& call) {
  decltype(call()) result;
  do {
    result = call();
  } while (result < 0 && errno == EINTR);
  return result;
}

std::string FolderOf(const std::string& path) {
  const std::filesystem::path folder = std::filesystem::path(path).parent_path();
  return folder.empty() ? "." : folder.string();
}

// A new file beside the target, which nobody can guess or read; removed unless it takes the
// target's place.
class Temporary {
 public:
  explicit Temporary(const std::string& target) : target_(target) {
    constexpr int kTries = 100;
    for (int i = 0; i < kTries && descriptor_ < 0; ++i) {
      name_ = FolderOf(target) + "/" + RandomName();
      descriptor_ =
          Retry([&] { return open(name_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0600); });
      if (descriptor_ < 0 && errno != EEXIST) break;
    }
    if (descriptor_ < 0) Fail(target_, "creating a temporary file beside it", errno);
  }

  ~Temporary() {
    if (descriptor_ >= 0) close(descriptor_);
    if (!renamed_) unlink(name_.c_str());
  }
  Temporary(const Temporary&) = delete;
  Temporary& operator=(const Temporary&) = delete;

  void Write(std::string_view content) {
    while (!content.empty()) {
      const ssize_t count =
          Retry([&] { return write(descriptor_, content.data(), content.size()); });
      if (count < 0) Fail(target_, "writing", errno);
      content.remove_prefix(static_cast<std::size_t>(count));
    }
  }

  void Finish() {
    if (fchmod(descriptor_, OrdinaryMode()) != 0) Fail(target_, "setting its mode", errno);
    if (Retry([&] { return fsync(descriptor_); }) != 0) Fail(target_, "fsync", errno);
    const int descriptor = descriptor_;
    descriptor_ = -1;  // closed, whatever close says
    if (close(descriptor) != 0 && errno != EINTR) Fail(target_, "closing", errno);
  }

  void Rename() {
    if (rename(name_.c_str(), target_.c_str()) != 0) Fail(target_, "rename to it", errno);
    renamed_ = true;
  }

 private:
  std::string RandomName() const {
    std::uint64_t number = 0;
    if (Retry([&] { return getrandom(&number, sizeof number, 0); }) != sizeof number)
      Fail(target_, "drawing a random name", errno);
    return fmt::format(".hexcal-{:016x}.tmp", number);
  }

  // The umask can only be read by setting it: to a strict one, so that a file that another thread
  // creates in between is never too open; one thread at a time, so that it is set back.
  static mode_t OrdinaryMode() {
    static std::mutex mutex;
    const std::lock_guard<std::mutex> lock(mutex);
    const mode_t mask = umask(077);
    umask(mask);
    return static_cast<mode_t>(0666 & ~mask);
  }

  std::string target_;
  std::string name_;
  int descriptor_ = -1;
  bool renamed_ = false;
};

// The name, too, must survive a power failure.
void SyncFolder(const std::string& target) {
  const std::string folder = FolderOf(target);
  const int descriptor =
      Retry([&] { return open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC); });
  if (descriptor < 0) Fail(target, "opening its folder", errno);
  const int result = Retry([&] { return fsync(descriptor); });
  const int error = errno;
  close(descriptor);
  if (result != 0 && error != EINVAL && error != ENOTSUP)  // some file systems cannot
    Fail(target, "fsync of its folder", error);
}

}  // namespace

void WriteFileAtomically(const std::string& path, std::string_view content) {
  Temporary temporary(path);
  temporary.Write(content);
  temporary.Finish();
  temporary.Rename();
  SyncFolder(path);
}

void MakeFolder(const std::string& path) {
  std::error_code error;
  std::filesystem::create_directories(path, error);
  if (!error && !std::filesystem::is_directory(path, error) && !error)
    error = std::make_error_code(std::errc::not_a_directory);
  if (error) Fail(path, "making the folder", error.value());
}

}  // namespace hexcal
