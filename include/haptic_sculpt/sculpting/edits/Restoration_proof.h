// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef HAPTIC_SCULPT_SCULPTING_RESTORATION_PROOF_H
#define HAPTIC_SCULPT_SCULPTING_RESTORATION_PROOF_H

#include <haptic_sculpt/collision.h>
#include <haptic_sculpt/collision/arithmetic/axis_sweep.h>
#include <haptic_sculpt/sculpting/Edit_result.h>
#include <haptic_sculpt/sculpting/edits/Edit.h>
#include <haptic_sculpt/sculpting/edits/Vertex_names.h>
#include <haptic_sculpt/surface/Face_corners.h>
#include <haptic_sculpt/surface/broad_phase/Isolated_vertices.h>
#include <haptic_sculpt/surface/star.h>
#include <haptic_sculpt/surface/vertex_coordinates.h>

#include <unordered_map>

namespace haptic_sculpt {
namespace internal {

/// Decides whether a change can be taken back or made again without a face jumping over a probe. Needed only where
/// probes move outside of the history: else a probe is where it was when the change was made.
///
/// Every change replaces faces by others with the same border, and there are tetrahedra that have just these faces for
/// their boundary. A probe that is in none of them, closed, is on the same side of the surface afterwards
/// (doc/probes.md).
template <class Mesh>
class Restoration_proof {
public:
  using Vertex_index = typename Mesh::Vertex_index;
  using Refused = std::optional<Refusal<Mesh>>;

  Restoration_proof(const Mesh& mesh, Isolated_vertices<Mesh>& isolated, Filter_counters& counters)
      : mesh_(&mesh), isolated_(&isolated), counters_(&counters) {}

  /// \param is_back whether the change is to be taken back, not made again
  Refused refuse(const Edit& edit, const Vertex_names<Mesh>& names, bool is_back) {
    if (isolated_->is_empty())
      return std::nullopt;
    link_.clear();
    const auto point = [&](std::size_t name) { return vertex_coordinates(*mesh_, names.vertex(name)); };
    if (edit.kind == Edit_kind::flip) { // one tetrahedron: A, C and the edge B D
      link_ = {point(edit.around[1]), point(edit.around[3])};
      return refuse_swept(point(edit.around[0]), point(edit.around[2]), 1);
    }
    if (edit.kind == Edit_kind::move) {
      star_.collect(*mesh_, names.vertex(edit.vertex));
      link_ = star_.link_points;
      return refuse_swept(is_back ? edit.after : edit.before, is_back ? edit.before : edit.after, link_.size());
    }
    if (edit.kind == Edit_kind::shift)
      return refuse_shift(edit, names, is_back);
    // Between the star of a vertex and the fan of a neighbour, into which it could be drawn.
    if ((edit.kind == Edit_kind::remove) != is_back) {
      star_.collect(*mesh_, names.vertex(edit.vertex));
      link_ = star_.link_points;
      return refuse_swept(point(edit.vertex), point(edit.around[0]), link_.size());
    }
    for (const std::size_t name : edit.around)
      link_.push_back(point(name));
    if (edit.kind == Edit_kind::insert_on_edge) {
      const auto h = mesh_->halfedge(names.vertex(edit.around[0]), names.vertex(edit.around[1]));
      const auto beside = [&](auto g) { return vertex_coordinates(*mesh_, mesh_->target(mesh_->next(g))); };
      link_ = {link_[0], beside(h), link_[1], beside(mesh_->opposite(h))};
    }
    return refuse_swept(edit.kind == Edit_kind::remove ? edit.before : edit.after, link_[0], link_.size());
  }

private:
  const Mesh* mesh_;
  Isolated_vertices<Mesh>* isolated_;
  Filter_counters* counters_;
  Star<Mesh> star_;
  std::vector<Coordinates> link_;
  std::vector<Vertex_index> near_;

  /// Every face that moves against every probe.
  Refused refuse_shift(const Edit& edit, const Vertex_names<Mesh>& names, bool is_back) const {
    const int axis = static_cast<int>(edit.vertex);
    std::unordered_map<std::size_t, double> ends; // by index
    for (std::size_t k = 0; k < edit.around.size(); ++k)
      ends[static_cast<std::size_t>(names.vertex(edit.around[k]))] = edit.ways[k][is_back ? 0 : 1];
    for (const std::size_t name : edit.around)
      for (const auto f : mesh_->faces_around_target(mesh_->halfedge(names.vertex(name)))) {
        std::array<Coordinates, 4> start;
        std::array<double, 4> heights;
        const auto corners = corners_of_face(*mesh_, f);
        for (int i = 0; i < 3; ++i) {
          start[i] = vertex_coordinates(*mesh_, corners[i]);
          const auto end = ends.find(static_cast<std::size_t>(corners[i]));
          heights[i] = end != ends.end() ? end->second : start[i][axis];
        }
        for (const Vertex_index probe : isolated_->all()) {
          start[3] = vertex_coordinates(*mesh_, probe);
          heights[3] = start[3][axis];
          const Axis_motion<4> motion(axis, start, heights);
          if (Axis_sweep<4, Filter_counters>(motion, *counters_).do_vertex_and_face_meet(3, 0, 1, 2))
            return Refusal<Mesh>{Refusal_reason::blocked, {probe}};
        }
      }
    return std::nullopt;
  }

  /// The tetrahedra of a, b and the first so many edges of the closed polygon link_. Those with b for a corner of the
  /// edge are flat, and so parts of the others' boundaries.
  Refused refuse_swept(const Coordinates& a, const Coordinates& b, std::size_t edges) {
    Box_3 box = Box_3(a).include(b);
    for (const Coordinates& p : link_)
      box.include(p);
    near_.clear();
    isolated_->query(box, near_);
    for (const Vertex_index v : near_)
      for (std::size_t i = 0; i < edges; ++i)
        if (face_vertex_verdict(
                Sweep_points{a, b, link_[i], link_[i + 1 < link_.size() ? i + 1 : 0], vertex_coordinates(*mesh_, v)},
                *counters_)
                .hits)
          return Refusal<Mesh>{Refusal_reason::blocked, {v}};
    return std::nullopt;
  }
};

} // namespace internal
} // namespace haptic_sculpt

#endif
