// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/Rounding_to_nearest.h>

#include <CGAL/tags.h>

#include <algorithm>
#include <cstddef>
#include <type_traits>

#ifdef CGAL_LINKED_WITH_TBB
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>
#endif
#ifdef __SANITIZE_THREAD__
#include <atomic>
#endif

namespace haptic_sculpt {
namespace internal {

/// Says to ThreadSanitizer what oneTBB, which is compiled without it, puts in order: a task is begun before its parts,
/// and ended after them. Of the parts among each other it says nothing. Without the sanitizer it is nothing.
class Told_order {
public:
#ifdef __SANITIZE_THREAD__
  Told_order() { begun_.store(1, std::memory_order_release); }
  ~Told_order() { ended_.load(std::memory_order_acquire); }
  template <class Part>
  void operator()(const Part& part) {
    begun_.load(std::memory_order_acquire);
    part();
    ended_.fetch_add(1, std::memory_order_release);
  }

private:
  std::atomic<int> begun_{0}, ended_{0};
#else
  template <class Part>
  void operator()(const Part& part) {
    part();
  }
#endif
};

} // namespace internal

/// Runs the parts of a task that do not touch each other: one after the other, or several at a time.
///
/// How is chosen when the program runs, so that both ways run the same code, and nothing is compiled twice. Where a
/// task is cut into parts never depends on the number of threads: so its result does not either.
class Part_runner {
public:
  Part_runner() = default; ///< one after the other
  bool is_shared() const { return run_ != nullptr; } ///< by threads

  /// \tparam Concurrency_tag `CGAL::Sequential_tag`, `CGAL::Parallel_tag` (oneTBB) or `CGAL::Parallel_if_available_tag`
  template <class Concurrency_tag>
  static Part_runner by() {
    Part_runner runner;
    if constexpr (std::is_convertible<Concurrency_tag, CGAL::Parallel_tag>::value) {
#ifdef CGAL_LINKED_WITH_TBB
      runner.run_ = [](std::size_t parts, const void* task, void (*part)(const void*, std::size_t)) {
        internal::Told_order in_order;
        // While it waits for the parts of others this thread might take another task of the caller's, which asks for
        // what this one holds: the same Sculptor, in the middle of a decision, or its mutex.
        tbb::this_task_arena::isolate([&] {
          tbb::parallel_for(std::size_t{0}, parts, [&](std::size_t k) {
            const internal::Rounding_to_nearest rounding; // a thread has a mode of its own
            in_order([&] { part(task, k); });
          });
        });
      };
#else
      static_assert(sizeof(Concurrency_tag) == 0,
                    "Parallel_tag needs oneTBB: link CGAL::TBB_support, or use Parallel_if_available_tag");
#endif
    }
    return runner;
  }

  /// Calls `part(k)` for k = 0, ..., parts - 1. An exception ends it, and goes on to the caller.
  template <class Part>
  void operator()(std::size_t parts, const Part& part) const {
    if (run_ != nullptr && parts > 1)
      return run_(parts, &part, [](const void* task, std::size_t k) { (*static_cast<const Part*>(task))(k); });
    for (std::size_t k = 0; k < parts; ++k)
      part(k);
  }

  /// Calls `part(first, end)` for ranges of this size, the last one perhaps shorter, that are 0, ..., n - 1 together.
  template <class Part>
  void in_ranges(std::size_t n, std::size_t size, const Part& part) const {
    operator()((n + size - 1) / size, [&](std::size_t k) { part(k * size, std::min(n, (k + 1) * size)); });
  }

private:
  void (*run_)(std::size_t, const void*, void (*)(const void*, std::size_t)) = nullptr;
};

} // namespace haptic_sculpt
