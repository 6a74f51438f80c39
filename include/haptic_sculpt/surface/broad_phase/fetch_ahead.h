// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef HAPTIC_SCULPT_SURFACE_FETCH_AHEAD_H
#define HAPTIC_SCULPT_SURFACE_FETCH_AHEAD_H

#include <haptic_sculpt/surface/broad_phase/Box_3.h>

#include <type_traits>
#include <utility>

namespace haptic_sculpt {
namespace internal {

/// Whether a broad phase wants to be told where it will be asked next: whether it has `fetch_ahead(box)`, which begins to
/// fetch from memory what a query about the box will read, and `fetch_on()`, which goes on with that. Nothing depends on
/// either but the time (doc/broad_phase.md).
template <class Broad_phase, class = void>
struct Fetches_ahead : std::false_type {};

template <class Broad_phase>
struct Fetches_ahead<Broad_phase, std::void_t<decltype(std::declval<Broad_phase&>().fetch_ahead(std::declval<const Box_3&>())),
                                              decltype(std::declval<Broad_phase&>().fetch_on())>> : std::true_type {};

template <class Broad_phase>
void fetch_ahead(Broad_phase& broad_phase, const Box_3& box) {
  if constexpr (Fetches_ahead<Broad_phase>::value)
    broad_phase.fetch_ahead(box);
}

template <class Broad_phase>
void fetch_on(Broad_phase& broad_phase) {
  if constexpr (Fetches_ahead<Broad_phase>::value)
    broad_phase.fetch_on();
}

} // namespace internal
} // namespace haptic_sculpt

#endif
