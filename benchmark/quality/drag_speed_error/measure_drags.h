// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Query_timer.h"
#include "drag_speed_error/Drag_script.h"

#include <haptic_sculpt/sculpting/Sculptor.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

namespace haptic_sculpt::benchmark {

using Mesh = CGAL::Surface_mesh<CGAL::Exact_predicates_inexact_constructions_kernel::Point_3>;

/// Whether nothing is touched on the straight way of v to `target`, in rationals.
bool is_way_free(const Mesh& mesh, Mesh::Vertex_index v, const Mesh::Point& target);

inline Mesh mesh_of(const Drag_script& script) {
  Mesh mesh;
  for (const auto& p : script.points)
    mesh.add_vertex(Mesh::Point(p[0], p[1], p[2]));
  const auto vertex = [](std::size_t i) { return Mesh::Vertex_index(static_cast<Mesh::size_type>(i)); };
  for (const auto& f : script.faces)
    mesh.add_face(vertex(f[0]), vertex(f[1]), vertex(f[2]));
  return mesh;
}

/// Makes the drags of a script with a Sculptor of the mesh made by mesh_of().
template <class Sculptor>
Drag_counts measure_drags(const Drag_script& script, Sculptor& sculptor) {
  static const Query_timer timer;
  Mesh judged = sculptor.mesh();
  Drag_counts counts;
  std::optional<typename Sculptor::Grab_type> grab;
  std::vector<Mesh::Point> path;
  for (const Drag_step& step : script.steps) {
    const Mesh::Vertex_index v(static_cast<Mesh::size_type>(step.vertex));
    const Mesh::Point target(step.target[0], step.target[1], step.target[2]), before = judged.point(v);
    if (!grab || grab->vertex() != v)
      grab.emplace(sculptor.grab(v));
    const std::uint64_t begin = Query_timer::now();
    const auto result = grab->drag_to(target, path);
    counts.nanoseconds.push_back(timer.nanoseconds(begin, Query_timer::now()));
    ++counts.drags;
    if (!result.reached) {
      ++counts.blocked;
      counts.wrongly_blocked += is_way_free(judged, v, target);
    }
    bool has_crossed = false;
    for (std::size_t leg = 1; leg < path.size() && !has_crossed; ++leg) {
      has_crossed = !is_way_free(judged, v, path[leg]);
      judged.point(v) = path[leg];
    }
    judged.point(v) = result.position;
    if (!has_crossed)
      continue;
    ++counts.crossed;
    counts.self_intersecting += !validate(judged).is_valid();
    judged.point(v) = before;
    sculptor.undo();
  }
  return counts;
}

} // namespace haptic_sculpt::benchmark
