// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/sculpting/many_vertices/Scaled_points.h>
#include <haptic_sculpt/surface/connectivity/Face_corners.h>
#include <haptic_sculpt/surface/repair/nearest_point_tree.h>

#include <cmath>
#include <deque>

namespace haptic_sculpt::internal {

/// A copy of the faces of a range, in the unit of the points, to which points are projected through CGAL's AABB trees,
/// one a patch.
///
/// A point that has been projected before is near its last place: the triangle it was on bounds the search from the
/// start, so no search tree over the vertices is needed.
template <class Mesh>
class Input_surface {
public:
  using Kernel = typename CGAL::Kernel_traits<typename Mesh::Point>::Kernel;
  using Point = typename Kernel::Point_3;
  using Triangle = typename Kernel::Triangle_3;
  using Face_index = typename Mesh::Face_index;
  using Place = std::uint32_t; ///< of a triangle

  /// \param faces in the order of their patches
  template <class Patches>
  Input_surface(const Mesh& mesh, const Scaled_points<Mesh>& points, const std::vector<Face_index>& faces,
                const Patches& patches)
      : begins_(patches.size() + 1, 0), trees_(patches.size()) {
    triangles_.reserve(faces.size());
    for (const Face_index f : faces) {
      const auto corners = corners_of_face(mesh, f);
      triangles_.emplace_back(point(points(corners[0])), point(points(corners[1])), point(points(corners[2])));
      begins_[static_cast<std::size_t>(patches(f)) + 1] = static_cast<Place>(triangles_.size());
    }
    for (std::size_t i = 0; i < trees_.size(); ++i) {
      trees_[i].rebuild(triangles_.begin() + begins_[i], triangles_.begin() + begins_[i + 1]);
      trees_[i].do_not_accelerate_distance_queries();
    }
  }
  Input_surface(const Input_surface&) = delete;
  Input_surface& operator=(const Input_surface&) = delete;

  /// The nearest point of a patch. \param place in: a triangle that is near, any will do; out: the one that the point
  /// is on
  Coordinates project(const Coordinates& p, std::size_t patch, Place& place) const {
    // CGAL's trees end the process by what is no point; who moves a vertex there refuses it.
    if (!(std::isfinite(p[0]) && std::isfinite(p[1]) && std::isfinite(p[2])))
      return p;
    if (place < begins_[patch] || place >= begins_[patch + 1])
      place = begins_[patch];
    const Point hint = Nearest_point_of_triangle<Kernel>()(triangles_[place], point(p));
    const auto nearest = trees_[patch].closest_point_and_primitive(point(p), {hint, triangles_.begin() + place});
    place = static_cast<Place>(nearest.second - triangles_.begin());
    return coordinates(nearest.first);
  }

private:
  using Triangles = std::vector<Triangle>;
  using Iterator = typename Triangles::const_iterator;
  using Tree = Nearest_point_tree<Kernel, Iterator>;

  Triangles triangles_;
  std::vector<Place> begins_; ///< of each patch, and the end
  std::deque<Tree> trees_;    ///< by patch

  static Point point(const Coordinates& p) { return {p[0], p[1], p[2]}; }
};

} // namespace haptic_sculpt::internal
