// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/surface/divide_polygon.h>
#include <haptic_sculpt/surface/repair/Hole_kernel.h>
#include <haptic_sculpt/surface/repair/Trail.h>
#include <haptic_sculpt/surface/repair/Work_mesh.h>
#include <haptic_sculpt/surface/repair/soup_steps.h>
#include <haptic_sculpt/surface/validate.h>
#include <haptic_sculpt/surface/vertex_coordinates.h>

#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polygon_mesh_processing/repair_degeneracies.h>
#include <CGAL/Polygon_mesh_processing/stitch_borders.h>
#include <CGAL/Polygon_mesh_processing/triangulate_hole.h>
#include <CGAL/boost/graph/Euler_operations.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <limits>
#include <set>
#include <vector>

namespace haptic_sculpt::internal {

/// Where the vertices of a mesh were before CGAL changed it. A vertex added later has no mark: a slot used again gets
/// the default value.
class Vertex_marks {
  using Point = Decision_kernel::Point_3;
  static constexpr double none = std::numeric_limits<double>::quiet_NaN();

public:
  explicit Vertex_marks(Work_mesh& mesh)
      : mesh_(mesh),
        before_(mesh.add_property_map<Work_mesh::Vertex_index>("v:repair_before", Point(none, none, none)).first) {
    for (const auto v : mesh.vertices())
      before_[v] = mesh.point(v);
  }
  Vertex_marks(const Vertex_marks&) = delete;
  Vertex_marks& operator=(const Vertex_marks&) = delete;
  ~Vertex_marks() { mesh_.remove_property_map(before_); }

  /// Appends the way of each vertex that was there and is.
  void append_moves(std::vector<Trail::Move>& moves) const {
    for (const auto v : mesh_.vertices())
      if (const Point& before = before_[v]; before.x() == before.x())
        moves.emplace_back(before, mesh_.point(v));
  }

private:
  Work_mesh& mesh_;
  Work_mesh::Property_map<Work_mesh::Vertex_index, Point> before_;
};

/// \pre the soup is a 2-manifold with or without boundary
inline Work_mesh work_mesh(const Polygon_soup& soup) {
  Work_mesh mesh;
  CGAL::Polygon_mesh_processing::polygon_soup_to_polygon_mesh(soup.points, soup.faces, mesh);
  return mesh;
}

/// Divides a face by edges between its corners: corners of one triangle only are cut off, one after the other.
/// \return whether it could. Cost: that of divided_polygon()
inline bool divide_face(Work_mesh& mesh, Work_mesh::Face_index f) {
  struct Corner {
    Work_mesh::Halfedge_index into;    ///< of what is left of the face
    std::size_t number = 0, which = 0; ///< of the triangles at it that are left; their indices, by exclusive or
  };
  std::vector<Corner> corners;
  std::vector<std::array<double, 3>> places;
  for (const auto h : CGAL::halfedges_around_face(mesh.halfedge(f), mesh)) {
    corners.push_back({h});
    places.push_back(vertex_coordinates(mesh, target(h, mesh)));
  }
  const auto triangles = divided_polygon(places);
  if (!triangles)
    return false;
  for (std::size_t t = 0; t < triangles->size(); ++t)
    for (const std::size_t corner : (*triangles)[t])
      ++corners[corner].number, corners[corner].which ^= t;
  std::vector<std::size_t> tips;
  for (std::size_t i = 0; i < corners.size(); ++i)
    if (corners[i].number == 1)
      tips.push_back(i);
  for (std::size_t left = triangles->size(); left > 1; --left) {
    const std::size_t tip = tips.back(), t = corners[tip].which;
    const Corners_of_triangle& triangle = (*triangles)[t];
    tips.pop_back();
    const auto at = static_cast<std::size_t>(std::find(triangle.begin(), triangle.end(), tip) - triangle.begin());
    Corner &before = corners[triangle[(at + 2) % 3]], &after = corners[triangle[(at + 1) % 3]];
    after.into = CGAL::Euler::split_face(before.into, after.into, mesh);
    for (const std::size_t corner : triangle) {
      corners[corner].which ^= t;
      if (--corners[corner].number == 1)
        tips.push_back(corner);
    }
  }
  return true;
}

/// A polygon that is simple along no axis stays.
inline Repair_step divide_faces(Work_mesh& mesh) {
  std::vector<Work_mesh::Face_index> polygons;
  for (const auto f : mesh.faces())
    if (!CGAL::is_triangle(mesh.halfedge(f), mesh))
      polygons.push_back(f);
  std::size_t divided = 0;
  for (const auto f : polygons)
    divided += divide_face(mesh, f);
  return {Repair_kind::divide_faces,
          {{"faces divided into triangles", divided}, {"polygons left", polygons.size() - divided}}, 0, {}};
}

inline Repair_step stitch_edges(Work_mesh& mesh) {
  const std::size_t stitched = CGAL::Polygon_mesh_processing::stitch_borders(mesh);
  return {Repair_kind::stitch_edges, {{"pairs of open edges stitched", stitched}}, 0, {}};
}

inline Repair_step remove_degenerate(Work_mesh& mesh) {
  std::size_t flat = 0;
  for (const auto f : mesh.faces())
    flat += CGAL::Polygon_mesh_processing::is_degenerate_triangle_face(f, mesh);
  if (flat > 0)
    CGAL::Polygon_mesh_processing::remove_degenerate_faces(mesh);
  return {Repair_kind::remove_degenerate_faces, {{"degenerate faces", flat}}, 0, {}};
}

/// CGAL looks for the triangles of a hole among those of a Delaunay triangulation, and where these do not do among all
/// there are, in the cube of the number of its edges: only of holes up to this many, which takes about 3 s.
constexpr std::size_t most_edges_of_all_triangles = 500;

inline void close_hole(Work_mesh& mesh, Work_mesh::Halfedge_index h) {
  const auto parameters =
      CGAL::parameters::geom_traits(Hole_kernel())
          .do_not_use_cubic_algorithm(CGAL::halfedges_around_face(h, mesh).size() > most_edges_of_all_triangles);
#if CGAL_VERSION_NR >= 1050600000
  CGAL::Polygon_mesh_processing::triangulate_hole(mesh, h, parameters);
#else
  std::vector<Work_mesh::Face_index> faces;
  CGAL::Polygon_mesh_processing::triangulate_hole(mesh, h, std::back_inserter(faces), parameters);
#endif
}

/// Whether its border passes a vertex twice. CGAL finds no triangles for it, and says so on the screen.
inline bool is_pinched(const Work_mesh& mesh, Work_mesh::Halfedge_index hole) {
  std::set<Work_mesh::Vertex_index> passed;
  for (const auto v : CGAL::vertices_around_face(hole, mesh))
    if (!passed.insert(v).second)
      return true;
  return false;
}

/// A half-edge of each hole. CGAL's function is not where it was since 6.2, and warns.
inline std::vector<Work_mesh::Halfedge_index> holes_of(const Work_mesh& mesh) {
  std::vector<Work_mesh::Halfedge_index> holes;
  std::vector<bool> is_met(mesh.num_halfedges(), false);
  for (const auto h : mesh.halfedges())
    if (mesh.is_border(h) && !is_met[h]) {
      holes.push_back(h);
      for (const auto g : CGAL::halfedges_around_face(h, mesh))
        is_met[g] = true;
    }
  return holes;
}

/// A hole that CGAL finds no triangles for stays.
inline Repair_step close_holes(Work_mesh& mesh, std::size_t most_edges) {
  std::size_t closed = 0, left = 0;
  const std::size_t faces = mesh.number_of_faces();
  for (const auto h : holes_of(mesh)) {
    if (CGAL::halfedges_around_face(h, mesh).size() <= most_edges && !is_pinched(mesh, h))
      close_hole(mesh, h);
    ++(mesh.is_border(h) ? left : closed);
  }
  return {Repair_kind::close_holes,
          {{"holes closed", closed}, {"triangles added", mesh.number_of_faces() - faces}, {"holes left", left}}, 0, {}};
}

} // namespace haptic_sculpt::internal
