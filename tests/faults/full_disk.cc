// SPDX-License-Identifier: BSD-3-Clause
// Loaded before a program (LD_PRELOAD): from the HEXCAL_FULL_AFTER-th call on that a full disk may
// refuse, each of them fails with ENOSPC. At the end the number of such calls is left in the file
// HEXCAL_CALLS. Descriptors of what is no regular file (terminals, pipes) are let through.
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <stdarg.h>
#include <sys/stat.h>
#include <sys/uio.h>
#include <unistd.h>

#include <atomic>
#include <cstdio>
#include <cstdlib>

namespace {

std::atomic<long> calls{0};

long FullAfter() {
  static const long after = [] {
    const char* text = std::getenv("HEXCAL_FULL_AFTER");
    return text != nullptr ? std::atol(text) : 1'000'000'000L;
  }();
  return after;
}

bool IsFull() {
  if (++calls < FullAfter()) return false;
  errno = ENOSPC;
  return true;
}

bool IsFile(int descriptor) {
  struct stat status = {};
  return fstat(descriptor, &status) == 0 && S_ISREG(status.st_mode);
}

template <typename Function>
Function Next(const char* name) {
  return reinterpret_cast<Function>(dlsym(RTLD_NEXT, name));
}

__attribute__((destructor)) void LeaveCount() {
  const char* path = std::getenv("HEXCAL_CALLS");
  if (path == nullptr) return;
  const long count = calls;
  const int descriptor =
      Next<int (*)(const char*, int, mode_t)>("open")(path, O_WRONLY | O_CREAT | O_TRUNC, 0600);
  char text[32];
  const int size = std::snprintf(text, sizeof text, "%ld", count);
  if (Next<ssize_t (*)(int, const void*, size_t)>("write")(
          descriptor, text, static_cast<std::size_t>(size)) != size)
    _exit(99);
  close(descriptor);
}

}  // namespace

extern "C" {

ssize_t write(int descriptor, const void* bytes, size_t size) {
  if (IsFile(descriptor) && IsFull()) return -1;
  return Next<ssize_t (*)(int, const void*, size_t)>("write")(descriptor, bytes, size);
}

ssize_t pwrite64(int descriptor, const void* bytes, size_t size, off64_t at) {
  if (IsFile(descriptor) && IsFull()) return -1;
  return Next<ssize_t (*)(int, const void*, size_t, off64_t)>("pwrite64")(
      descriptor, bytes, size, at);
}

ssize_t writev(int descriptor, const struct iovec* parts, int count) {
  if (IsFile(descriptor) && IsFull()) return -1;
  return Next<ssize_t (*)(int, const struct iovec*, int)>("writev")(descriptor, parts, count);
}

int fsync(int descriptor) {
  if (IsFile(descriptor) && IsFull()) return -1;
  return Next<int (*)(int)>("fsync")(descriptor);
}

int fdatasync(int descriptor) {
  if (IsFile(descriptor) && IsFull()) return -1;
  return Next<int (*)(int)>("fdatasync")(descriptor);
}

int mkdir(const char* path, mode_t mode) {
  if (IsFull()) return -1;
  return Next<int (*)(const char*, mode_t)>("mkdir")(path, mode);
}

// A new file needs a place in its folder.
int open(const char* path, int flags, ...) {
  va_list rest;
  va_start(rest, flags);
  const mode_t mode = (flags & O_CREAT) != 0 ? va_arg(rest, mode_t) : 0;
  va_end(rest);
  if ((flags & O_CREAT) != 0 && access(path, F_OK) != 0 && IsFull()) return -1;
  return Next<int (*)(const char*, int, mode_t)>("open")(path, flags, mode);
}

int open64(const char* path, int flags, ...) {
  va_list rest;
  va_start(rest, flags);
  const mode_t mode = (flags & O_CREAT) != 0 ? va_arg(rest, mode_t) : 0;
  va_end(rest);
  if ((flags & O_CREAT) != 0 && access(path, F_OK) != 0 && IsFull()) return -1;
  return Next<int (*)(const char*, int, mode_t)>("open64")(path, flags, mode);
}

}  // extern "C"
