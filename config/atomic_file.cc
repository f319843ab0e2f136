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
#include <list>
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

constexpr std::string_view kTemporaryStart = ".hexcal-";
constexpr std::string_view kTemporaryEnd = ".tmp";

std::string RandomName(const std::string& target) {
  std::uint64_t number = 0;
  if (Retry([&] { return getrandom(&number, sizeof number, 0); }) != sizeof number)
    Fail(target, "drawing a random name", errno);
  return fmt::format("{}{:016x}{}", kTemporaryStart, number, kTemporaryEnd);
}

// The umask can only be read by setting it: to a strict one, so that a file that another thread
// creates in between is never too open; one thread at a time, so that it is set back.
mode_t OrdinaryMode() {
  static std::mutex mutex;
  const std::lock_guard<std::mutex> lock(mutex);
  const mode_t mask = umask(077);
  umask(mask);
  return static_cast<mode_t>(0666 & ~mask);
}

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

// A new file beside the target, which nobody can guess or read; removed unless it takes the
// target's place.
AtomicFile::AtomicFile(const std::string& path) : path_(path) {
  constexpr int kTries = 100;
  for (int i = 0; i < kTries && descriptor_ < 0; ++i) {
    temporary_ = FolderOf(path) + "/" + RandomName(path);
    descriptor_ = Retry(
        [&] { return open(temporary_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0600); });
    if (descriptor_ < 0 && errno != EEXIST) break;
  }
  if (descriptor_ < 0) Fail(path_, "creating a temporary file beside it", errno);
}

AtomicFile::~AtomicFile() {
  if (descriptor_ >= 0) close(descriptor_);
  if (!renamed_) unlink(temporary_.c_str());
}

void AtomicFile::Write(std::string_view content) {
  while (!content.empty()) {
    const ssize_t count = Retry([&] { return write(descriptor_, content.data(), content.size()); });
    if (count < 0) Fail(path_, "writing", errno);
    content.remove_prefix(static_cast<std::size_t>(count));
  }
}

void AtomicFile::Finish() {
  if (fchmod(descriptor_, OrdinaryMode()) != 0) Fail(path_, "setting its mode", errno);
  if (Retry([&] { return fsync(descriptor_); }) != 0) Fail(path_, "fsync", errno);
  const int descriptor = descriptor_;
  descriptor_ = -1;  // closed, whatever close says
  if (close(descriptor) != 0 && errno != EINTR) Fail(path_, "closing", errno);
  finished_ = true;
}

void AtomicFile::Commit() {
  if (!finished_) Finish();
  if (rename(temporary_.c_str(), path_.c_str()) != 0) Fail(path_, "rename to it", errno);
  renamed_ = true;
  SyncFolder(path_);
}

void WriteFileAtomically(const std::string& path, std::string_view content) {
  AtomicFile file(path);
  file.Write(content);
  file.Commit();
}

void WriteFilesAtomically(const std::vector<std::pair<std::string, std::string>>& files) {
  std::list<AtomicFile> written;
  for (const auto& [path, content] : files) {
    AtomicFile& file = written.emplace_back(path);
    file.Write(content);
    file.Finish();
  }
  for (auto file = written.rbegin(); file != written.rend(); ++file) file->Commit();
}

void RemoveLeftTemporaries(const std::string& folder) {
  std::error_code ignored;
  for (const auto& entry : std::filesystem::directory_iterator(folder, ignored)) {
    const std::string name = entry.path().filename().string();
    const bool is_temporary =
        name.size() == kTemporaryStart.size() + 16 + kTemporaryEnd.size() &&
        name.compare(0, kTemporaryStart.size(), kTemporaryStart) == 0 &&
        name.compare(name.size() - kTemporaryEnd.size(), std::string::npos, kTemporaryEnd) == 0;
    if (is_temporary) std::filesystem::remove(entry.path(), ignored);
  }
}

void MakeFolder(const std::string& path) {
  std::error_code error;
  std::filesystem::create_directories(path, error);
  if (!error && !std::filesystem::is_directory(path, error) && !error)
    error = std::make_error_code(std::errc::not_a_directory);
  if (error) Fail(path, "making the folder", error.value());
}

}  // namespace hexcal
