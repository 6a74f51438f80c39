// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

/// \file
/// Memory that runs out when asked to: replaces the global operator new. To be included by one source file of a
/// program.

#include <cstdlib>
#include <limits>
#include <new>

namespace haptic_sculpt::test {

/// While one lives, the n-th request of its thread for memory fails, and those after it where it fails for good.
class Failing_allocations {
public:
  Failing_allocations(std::size_t n, bool for_good) {
    left_ = n;
    for_good_ = for_good;
  }
  /// All requests for more than this many bytes fail, and no other.
  explicit Failing_allocations(std::size_t largest) { largest_ = largest; }
  ~Failing_allocations() {
    left_ = 0;
    largest_ = no_limit;
  }
  Failing_allocations(const Failing_allocations&) = delete;
  Failing_allocations& operator=(const Failing_allocations&) = delete;

  static void* allocate(std::size_t size, std::size_t alignment) {
    if (left_ == 1 && for_good_)
      throw std::bad_alloc();
    if (size > largest_ || (left_ != 0 && --left_ == 0))
      throw std::bad_alloc();
    return allocate_always(size, alignment);
  }
  static void* allocate_always(std::size_t size, std::size_t alignment) {
    void* const p = alignment == 0 ? std::malloc(size != 0 ? size : 1)
                                   : std::aligned_alloc(alignment, (size + alignment - 1) / alignment * alignment);
    if (p == nullptr)
      throw std::bad_alloc();
    return p;
  }

private:
  static constexpr std::size_t no_limit = std::numeric_limits<std::size_t>::max();

  static inline thread_local std::size_t largest_ = no_limit;
  static inline thread_local std::size_t left_ = 0; ///< until one fails; 0: none does
  static inline thread_local bool for_good_ = false;
};

} // namespace haptic_sculpt::test

// Not inlined, or g++ sees free() meet operator new and warns. All forms: AddressSanitizer has its own of each, which
// do not call these. Arrays are always given: only CGAL's Mpzf asks for them, which frees what it never had where
// memory runs out in it.
#define HAPTIC_SCULPT_NEW __attribute__((noinline)) void* operator
HAPTIC_SCULPT_NEW new(std::size_t size) { return haptic_sculpt::test::Failing_allocations::allocate(size, 0); }
HAPTIC_SCULPT_NEW new[](std::size_t size) { return haptic_sculpt::test::Failing_allocations::allocate_always(size, 0); }
HAPTIC_SCULPT_NEW new(std::size_t size, std::align_val_t alignment) {
  return haptic_sculpt::test::Failing_allocations::allocate(size, static_cast<std::size_t>(alignment));
}
HAPTIC_SCULPT_NEW new[](std::size_t size, std::align_val_t alignment) {
  return haptic_sculpt::test::Failing_allocations::allocate_always(size, static_cast<std::size_t>(alignment));
}
HAPTIC_SCULPT_NEW new(std::size_t size, const std::nothrow_t&) noexcept {
  try {
    return haptic_sculpt::test::Failing_allocations::allocate(size, 0);
  } catch (const std::bad_alloc&) {
    return nullptr;
  }
}
HAPTIC_SCULPT_NEW new[](std::size_t size, const std::nothrow_t&) noexcept {
  return std::malloc(size != 0 ? size : 1);
}
#undef HAPTIC_SCULPT_NEW
#define HAPTIC_SCULPT_DELETE __attribute__((noinline)) void operator
HAPTIC_SCULPT_DELETE delete(void* p) noexcept { std::free(p); }
HAPTIC_SCULPT_DELETE delete[](void* p) noexcept { std::free(p); }
HAPTIC_SCULPT_DELETE delete(void* p, std::size_t) noexcept { std::free(p); }
HAPTIC_SCULPT_DELETE delete[](void* p, std::size_t) noexcept { std::free(p); }
HAPTIC_SCULPT_DELETE delete(void* p, std::align_val_t) noexcept { std::free(p); }
HAPTIC_SCULPT_DELETE delete[](void* p, std::align_val_t) noexcept { std::free(p); }
HAPTIC_SCULPT_DELETE delete(void* p, std::size_t, std::align_val_t) noexcept { std::free(p); }
HAPTIC_SCULPT_DELETE delete[](void* p, std::size_t, std::align_val_t) noexcept { std::free(p); }
HAPTIC_SCULPT_DELETE delete(void* p, const std::nothrow_t&) noexcept { std::free(p); }
HAPTIC_SCULPT_DELETE delete[](void* p, const std::nothrow_t&) noexcept { std::free(p); }
#undef HAPTIC_SCULPT_DELETE

