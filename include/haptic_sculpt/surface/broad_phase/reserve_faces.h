// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef HAPTIC_SCULPT_SURFACE_RESERVE_FACES_H
#define HAPTIC_SCULPT_SURFACE_RESERVE_FACES_H

#include <cstddef>
#include <type_traits>
#include <utility>

namespace haptic_sculpt {
namespace internal {

/// Whether a broad phase has `reserve(faces, insertions)`, which makes room for so many faces in all, and for so many
/// that are inserted (doc/broad_phase.md).
template <class Broad_phase, class = void>
struct Reserves_faces : std::false_type {};

template <class Broad_phase>
struct Reserves_faces<Broad_phase,
                      std::void_t<decltype(std::declval<Broad_phase&>().reserve(std::size_t(), std::size_t()))>>
    : std::true_type {};

template <class Broad_phase>
void reserve_faces(Broad_phase& broad_phase, std::size_t faces, std::size_t insertions) {
  if constexpr (Reserves_faces<Broad_phase>::value)
    broad_phase.reserve(faces, insertions);
}

} // namespace internal
} // namespace haptic_sculpt

#endif
