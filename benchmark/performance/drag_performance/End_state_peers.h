// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "drag_performance/Latencies.h"
#include "drag_performance/Random_motions.h"
#include "drag_performance/workload_meshes.h"

#include <haptic_sculpt/sculpting/first_impact.h>
#include <haptic_sculpt/surface/Aabb_traits.h>

#include <CGAL/AABB_face_graph_triangle_primitive.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>

namespace haptic_sculpt::benchmark {

/// What one would do with CGAL alone: move the vertex, then see whether the surface meets itself. Looks at the end of a
/// motion only, so what happened on the way is missed; how often, is counted against first_impact().
class End_state_peers {
public:
  End_state_peers(const Workload_mesh& scene, std::uint64_t seed)
      : name_(scene.name)
      , mesh_(scene.mesh)
      , edge_(scene.edge)
      , seed_(seed)
      , stale_(mesh_.faces_begin(), mesh_.faces_end(), mesh_) {
    stale_.build();
  }

  void run(Json& rows, std::size_t count, std::size_t slow_count, const std::vector<double>& reaches) {
    for (const double reach : reaches) {
      add_row(rows, "AABB_tree, stale", reach, count, [&](Vertex_index) { return star_meets(stale_); });
      add_row(rows, "AABB_tree, rebuilt", reach, slow_count, [&](Vertex_index) {
        Tree tree(mesh_.faces_begin(), mesh_.faces_end(), mesh_);
        tree.build();
        return star_meets(tree);
      });
      add_row(rows, "does_self_intersect, whole", reach, slow_count,
              [&](Vertex_index) { return CGAL::Polygon_mesh_processing::does_self_intersect(mesh_); });
      add_row(rows, "does_self_intersect, star and what its box meets", reach, std::min(count, 20 * slow_count),
              [&](Vertex_index) { return star_meets_any(); });
    }
  }

private:
  using Kernel = meshes::Kernel;
  using Tree = CGAL::AABB_tree<Aabb_traits<Kernel, CGAL::AABB_face_graph_triangle_primitive<Mesh>>>;
  using Face_index = Mesh::Face_index;

  std::string name_;
  Mesh mesh_;
  double edge_;
  std::uint64_t seed_;
  Tree stale_;
  internal::Star<Mesh> star_;
  std::vector<Face_index> found_;

  /// Random pushes of `reach` edges inwards; `meets(v)` is asked with the vertex moved. Its time includes nothing else.
  template <class Meets>
  void add_row(Json& rows, const std::string& structure, double reach, std::size_t count, const Meets& meets) {
    Random_motions random(seed_);
    Latencies times;
    std::size_t hits = 0, missed = 0, wrong_alarms = 0;
    for (std::size_t k = 0; k < count; ++k) {
      const Vertex_index v = random.vertex(mesh_);
      const Point_3 before = mesh_.point(v);
      const Vector way = internal::advanced(random.direction(), -1.5, normal_at(mesh_, v));
      const Point_3 target =
          to_point(internal::advanced(vertex_coordinates(mesh_, v), reach * edge_, internal::normalized(way)));
      const bool truth = first_impact(mesh_, v, target).has_value();
      star_.collect(mesh_, v);
      mesh_.point(v) = target;
      const bool met = times.measure([&] { return meets(v); });
      mesh_.point(v) = before;
      hits += truth;
      missed += truth && !met;
      wrong_alarms += met && !truth;
    }
    Json row = {{"structure", structure},
                {"mesh", name_},
                {"triangles", static_cast<std::size_t>(mesh_.number_of_faces())},
                {"workload", "is the end of a motion free"},
                {"step_edges", reach}};
    row.update(times.json());
    row["motions_that_hit"] = hits;
    row["missed"] = missed;
    row["wrong_alarms"] = wrong_alarms;
    rows.push_back(std::move(row));
  }

  bool share_a_vertex(Face_index f, Face_index g) const {
    for (const Vertex_index v : mesh_.vertices_around_face(mesh_.halfedge(f)))
      for (const Vertex_index w : mesh_.vertices_around_face(mesh_.halfedge(g)))
        if (v == w)
          return true;
    return false;
  }

  Kernel::Triangle_3 triangle(Face_index f) const {
    const auto c = internal::corners_of_face(mesh_, f);
    return {mesh_.point(c[0]), mesh_.point(c[1]), mesh_.point(c[2])};
  }

  /// Faces of the star against a tree; neighbours meet it anyway and are left out, as whoever does this has to.
  bool star_meets(const Tree& tree) {
    for (const Face_index f : star_.faces) {
      found_.clear();
      tree.all_intersected_primitives(triangle(f), std::back_inserter(found_));
      for (const Face_index g : found_)
        if (!share_a_vertex(f, g))
          return true;
    }
    return false;
  }

  /// does_self_intersect of the star with all faces whose boxes meet its box, found by looking at all.
  bool star_meets_any() {
    Box_3 box;
    for (const Face_index f : star_.faces)
      box.include(face_box(mesh_, f));
    found_.clear();
    for (const Face_index f : mesh_.faces())
      if (do_meet(face_box(mesh_, f), box))
        found_.push_back(f);
    return CGAL::Polygon_mesh_processing::does_self_intersect(found_, mesh_);
  }
};

} // namespace haptic_sculpt::benchmark
