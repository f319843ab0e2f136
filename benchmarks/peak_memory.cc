// SPDX-License-Identifier: BSD-3-Clause
#include "peak_memory.h"

#include <malloc.h>

#include <atomic>
#include <cerrno>

extern "C" {
void* __libc_malloc(std::size_t);
void* __libc_calloc(std::size_t, std::size_t);
void* __libc_realloc(void*, std::size_t);
void* __libc_memalign(std::size_t, std::size_t);
void __libc_free(void*);
}

namespace {

std::atomic<bool> is_counting{false};
std::atomic<std::ptrdiff_t> now{0}, most{0};

void* Count(void* p) {
  if (p != nullptr && is_counting.load(std::memory_order_relaxed)) {
    const std::ptrdiff_t size = static_cast<std::ptrdiff_t>(malloc_usable_size(p));
    const std::ptrdiff_t total = now.fetch_add(size, std::memory_order_relaxed) + size;
    std::ptrdiff_t last = most.load(std::memory_order_relaxed);
    while (last < total && !most.compare_exchange_weak(last, total)) {
    }
  }
  return p;
}

void Uncount(void* p) {
  if (p != nullptr && is_counting.load(std::memory_order_relaxed))
    now.fetch_sub(static_cast<std::ptrdiff_t>(malloc_usable_size(p)), std::memory_order_relaxed);
}

}  // namespace

extern "C" {

void* malloc(std::size_t size) { return Count(__libc_malloc(size)); }
void* calloc(std::size_t n, std::size_t size) { return Count(__libc_calloc(n, size)); }
void free(void* p) {
  Uncount(p);
  __libc_free(p);
}
void* realloc(void* p, std::size_t size) {
  Uncount(p);
  return Count(__libc_realloc(p, size));
}
void* memalign(std::size_t alignment, std::size_t size) {
  return Count(__libc_memalign(alignment, size));
}
void* aligned_alloc(std::size_t alignment, std::size_t size) { return memalign(alignment, size); }
int posix_memalign(void** p, std::size_t alignment, std::size_t size) {
  *p = memalign(alignment, size);
  return *p == nullptr ? ENOMEM : 0;
}

}  // extern "C"

namespace hexcal {

std::size_t PeakMemory(const std::function<void()>& work) {
  now = most = 0;
  is_counting = true;
  work();
  is_counting = false;
  return static_cast<std::size_t>(most.load());
}

}  // namespace hexcal
