// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef HAPTIC_SCULPT_SURFACE_QUERY_UP_TO_H
#define HAPTIC_SCULPT_SURFACE_QUERY_UP_TO_H

#include <haptic_sculpt/surface/broad_phase/Swept_star_3.h>

#include <type_traits>
#include <utility>

namespace haptic_sculpt {
namespace internal {

/// Whether a broad phase has `query(star, faces, most)`, which may give up (doc/broad_phase.md).
template <class Broad_phase, class Faces, class = void>
struct Gives_up : std::false_type {};

template <class Broad_phase, class Faces>
struct Gives_up<Broad_phase, Faces,
                std::void_t<decltype(std::declval<Broad_phase&>().query(
                    std::declval<const Swept_star_3&>(), std::declval<Faces&>(), std::size_t()))>> : std::true_type {};

/// Asks for up to so many faces. Returns false where there are more, or to find them all would cost more; `faces` is of
/// no use then. \pre faces is empty
template <class Broad_phase, class Faces>
bool query_up_to(Broad_phase& broad_phase, const Swept_star_3& star, std::size_t most, Faces& faces) {
  if constexpr (Gives_up<Broad_phase, Faces>::value) {
    return broad_phase.query(star, faces, most);
  } else {
    broad_phase.query(star, faces);
    return faces.size() <= most;
  }
}

} // namespace internal
} // namespace haptic_sculpt

#endif
