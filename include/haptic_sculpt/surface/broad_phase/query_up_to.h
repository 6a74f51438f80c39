// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef HAPTIC_SCULPT_SURFACE_QUERY_UP_TO_H
#define HAPTIC_SCULPT_SURFACE_QUERY_UP_TO_H

#include <haptic_sculpt/surface/broad_phase/Star_filter.h>
#include <haptic_sculpt/surface/broad_phase/face_box.h>

#include <algorithm>
#include <type_traits>

namespace haptic_sculpt {
namespace internal {

/// Whether a broad phase says that its answers for a star are those of Star_filter, and may give up
/// (doc/broad_phase.md, "Which faces count").
template <class Broad_phase, class = void>
struct Answers_are_filtered : std::false_type {};

template <class Broad_phase>
struct Answers_are_filtered<Broad_phase, std::void_t<decltype(Broad_phase::answers_are_filtered)>>
  : std::bool_constant<Broad_phase::answers_are_filtered> {};

/// Appends the faces whose boxes pass the star's filter, whatever the broad phase: in an order of its own. Returns false
/// where there are more than `most`; `faces` is of no use then. \param scale that of the mesh when the broad phase was
/// made: the box tree has it of its own \pre faces is empty
/// Cost: the query; of other broad phases than the box tree it is that for a box, and all of its answer is read.
template <class Mesh, class Broad_phase>
bool query_up_to(const Mesh& mesh, const Box_scale& scale, Broad_phase& broad_phase, const Swept_star_3& star,
                 std::size_t most, std::vector<typename Mesh::Face_index>& faces) {
  if constexpr (Answers_are_filtered<Broad_phase>::value) {
    return broad_phase.query(star, faces, most);
  } else {
    const Star_filter filter(star, scale);
    broad_phase.query(filter.holding_what_passes(), faces);
    Box_node node; // of one box
    const auto end = std::remove_if(faces.begin(), faces.end(), [&](typename Mesh::Face_index f) {
      node.set(0, scale.around(face_box(mesh, f)));
      return (filter.meeting(node) & 1u) == 0;
    });
    faces.erase(end, faces.end());
    return faces.size() <= most;
  }
}

} // namespace internal
} // namespace haptic_sculpt

#endif
