// SPDX-License-Identifier: BSD-3-Clause
#include "config/input_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <system_error>

#include "config/input_error.h"

namespace hexcal {
namespace {

[[noreturn]] void Refuse(const std::string& path, std::string_view found) {
  throw InputError(FileLocation(path), found, "a file that can be read");
}

[[noreturn]] void RefuseUnreadable(const std::string& path, int error) {
  Refuse(path,
         fmt::format("a file that cannot be read ({})", std::generic_category().message(error)));
}

[[noreturn]] void RefuseLarge(const std::string& path, std::int64_t max_bytes) {
  throw InputError(FileLocation(path),
                   "a file that is too large",
                   fmt::format("at most {} MiB", max_bytes / (1 << 20)));
}

}  // namespace

InputFile::InputFile(const std::string& path, std::int64_t max_bytes)
    : path_(path), max_bytes_(max_bytes), descriptor_(open(path.c_str(), O_RDONLY | O_CLOEXEC)) {
  if (descriptor_ < 0) {
    if (errno == ENOENT || errno == ENOTDIR) Refuse(path, "no file");
    RefuseUnreadable(path, errno);
  }
  struct stat status = {};
  if (fstat(descriptor_, &status) == 0 && !S_ISDIR(status.st_mode) && status.st_size <= max_bytes)
    return;
  close(descriptor_);
  if (S_ISDIR(status.st_mode)) Refuse(path, "no file but a folder");
  RefuseLarge(path, max_bytes);
}

InputFile::~InputFile() { close(descriptor_); }

std::size_t InputFile::Read(char* to, std::size_t size) {
  ssize_t count = 0;
  do {
    count = read(descriptor_, to, size);
  } while (count < 0 && errno == EINTR);
  if (count < 0) RefuseUnreadable(path_, errno);
  bytes_read_ += count;
  if (bytes_read_ > max_bytes_) RefuseLarge(path_, max_bytes_);
  return static_cast<std::size_t>(count);
}

std::string ReadTextFile(const std::string& path, std::int64_t max_bytes) {
  InputFile file(path, max_bytes);
  std::string text;
  std::size_t size = 0;
  do {
    constexpr std::size_t kChunk = 1 << 16;
    text.resize(size + std::max(kChunk, size / 2));
    const std::size_t count = file.Read(text.data() + size, text.size() - size);
    if (count == 0) break;
    size += count;
  } while (true);
  text.resize(size);
  return text;
}

}  // namespace hexcal
