// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef HAPTIC_SCULPT_HAPTIC_RENDERING_MAKING_EDITS_H
#define HAPTIC_SCULPT_HAPTIC_RENDERING_MAKING_EDITS_H

#include <haptic_sculpt/haptic_rendering/exchange/Edit_journal.h>
#include <haptic_sculpt/haptic_rendering/finding_and_placing.h>

/// \file
/// Edits of a tool, as entries of a journal say them.

namespace haptic_sculpt {
namespace internal {

/// \param wanted with `Sculptor::name()`s \pre its kind is an edit of elements, an undo or a redo
template <class Sculptor>
typename Sculptor::Edited make_edit(Sculptor& sculptor, const Journal_entry& wanted) {
  using Kind = Journal_entry::Kind;
  const auto& v = wanted.vertices;
  const typename Sculptor::Point p(wanted.point[0], wanted.point[1], wanted.point[2]);
  switch (wanted.kind) {
  case Kind::undo:
    return sculptor.undo();
  case Kind::redo:
    return sculptor.redo();
  case Kind::insert_on_face:
    return sculptor.insert_on_face(sculptor.face_of(v[0], v[1], v[2]), p);
  case Kind::insert_on_edge:
    return sculptor.insert_on_edge(sculptor.edge_of(v[0], v[1]), p);
  case Kind::flip:
    return sculptor.flip(sculptor.edge_of(v[0], v[1]));
  case Kind::collapse: {
    const auto& mesh = sculptor.mesh();
    const auto e = sculptor.edge_of(v[0], v[1]);
    const auto h = e.is_valid() ? mesh.halfedge(e) : typename Sculptor::Halfedge_index();
    return sculptor.collapse(!h.is_valid() || mesh.source(h) == sculptor.vertex(v[0]) ? h : mesh.opposite(h));
  }
  default:
    return sculptor.remove(sculptor.vertex(v[0]));
  }
}

/// Nearer to an edge than this share of the face's altitude, a vertex is created on the edge: on the face it would
/// leave a sliver.
constexpr double edge_share = 0.05;

/// A creation at p on the face of three corners, or on an edge of it that is near.
template <class Sculptor>
Journal_entry creation_at(const Sculptor& sculptor, const std::array<typename Sculptor::Vertex_index, 3>& face,
                          const Eigen::Vector3d& p) {
  Journal_entry wanted;
  wanted.kind = Journal_entry::Kind::insert_on_face;
  wanted.vertices = {sculptor.name(face[0]), sculptor.name(face[1]), sculptor.name(face[2])};
  wanted.point = {p[0], p[1], p[2]};
  const auto place_of = [&](int i) { return vector_of(sculptor.mesh().point(face[i])); };
  const Eigen::Vector3d corners[3] = {place_of(0), place_of(1), place_of(2)};
  const Eigen::Vector3d normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
  for (int i = 0; i < 3; ++i) {
    const Eigen::Vector3d &a = corners[(i + 1) % 3], &b = corners[(i + 2) % 3];
    if ((b - a).cross(p - a).dot(normal) < edge_share * normal.squaredNorm()) {
      wanted.kind = Journal_entry::Kind::insert_on_edge;
      wanted.vertices = {wanted.vertices[(i + 1) % 3], wanted.vertices[(i + 2) % 3], 0};
      break;
    }
  }
  return wanted;
}

} // namespace internal
} // namespace haptic_sculpt

#endif
