// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

/// \file
/// Counts how often each thread asks for memory, in `allocations_so_far`. To be included by one source file of a
/// program.

#include <cstdlib>
#include <new>

namespace {
thread_local std::size_t allocations_so_far = 0;

void* counted(std::size_t size) noexcept {
  ++allocations_so_far;
  return std::malloc(size != 0 ? size : 1);
}
} // namespace

// Not inlined, or g++ sees free() meet operator new and warns. The array forms call these.
__attribute__((noinline)) void* operator new(std::size_t size) {
  if (void* p = counted(size))
    return p;
  throw std::bad_alloc();
}
// AddressSanitizer has one of its own, whose memory the operator delete here must not be given.
__attribute__((noinline)) void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  return counted(size);
}
__attribute__((noinline)) void* operator new(std::size_t size, std::align_val_t alignment) {
  ++allocations_so_far;
  const auto a = static_cast<std::size_t>(alignment);
  if (void* p = std::aligned_alloc(a, (size + a - 1) / a * a))
    return p;
  throw std::bad_alloc();
}
__attribute__((noinline)) void operator delete(void* p) noexcept {
  std::free(p);
}
__attribute__((noinline)) void operator delete(void* p, std::size_t) noexcept {
  std::free(p);
}
__attribute__((noinline)) void operator delete(void* p, std::align_val_t) noexcept {
  std::free(p);
}
__attribute__((noinline)) void operator delete(void* p, std::size_t, std::align_val_t) noexcept {
  std::free(p);
}
