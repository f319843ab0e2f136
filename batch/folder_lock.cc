// SPDX-License-Identifier: BSD-3-Clause
#include "batch/folder_lock.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "config/input_error.h"

namespace hexcal {
namespace {

[[noreturn]] void Fail(const std::string& path) {
  throw OutputError(fmt::format("{}: locking failed: {}", path, std::strerror(errno)));
}

// Whoever had it alone may have removed the file meanwhile: then the lock is on nothing.
bool IsStillThere(int descriptor, const std::string& path) {
  struct stat held = {}, there = {};
  return fstat(descriptor, &held) == 0 && stat(path.c_str(), &there) == 0 &&
         held.st_ino == there.st_ino && held.st_dev == there.st_dev;
}

}  // namespace

FolderLock::FolderLock(const std::string& folder, Kind kind)
    : path_(folder + "/.hexcal-lock"), kind_(kind) {
  while (!Try(kind)) {
  }
}

// True: locked, or somebody else has it.
bool FolderLock::Try(Kind kind) {
  const int descriptor = open(path_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  if (descriptor < 0) Fail(path_);
  const int operation = kind == Kind::kShared ? LOCK_SH : LOCK_EX | LOCK_NB;
  int locked = 0;
  do {
    locked = flock(descriptor, operation);
  } while (locked != 0 && errno == EINTR);
  if (locked == 0 && IsStillThere(descriptor, path_)) {
    descriptor_ = descriptor;
    return true;
  }
  const int error = errno;
  close(descriptor);
  if (locked == 0) return false;
  if (error == EWOULDBLOCK) return true;
  errno = error;
  Fail(path_);
}

FolderLock::~FolderLock() {
  if (descriptor_ < 0) return;
  if (kind_ == Kind::kAlone) unlink(path_.c_str());
  close(descriptor_);
}

}  // namespace hexcal
