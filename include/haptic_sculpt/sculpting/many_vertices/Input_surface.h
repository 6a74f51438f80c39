// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef HAPTIC_SCULPT_SCULPTING_INPUT_SURFACE_H
#define HAPTIC_SCULPT_SCULPTING_INPUT_SURFACE_H

#include <haptic_sculpt/sculpting/many_vertices/triangle_shape.h>
#include <haptic_sculpt/surface/Face_corners.h>
#include <haptic_sculpt/surface/cgal_compatibility.h>

#include <CGAL/AABB_tree.h>
#if CGAL_VERSION_NR >= 1060000000
#include <CGAL/AABB_traits_3.h>
#include <CGAL/AABB_triangle_primitive_3.h>
#else
#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_triangle_primitive.h>
#endif

namespace haptic_sculpt {
namespace internal {

/// A copy of the faces of a mesh, to which points are projected through CGAL's AABB tree.
///
/// A point that has been projected before is near its last place: the triangle it was on bounds the search from the
/// start, so no search tree over the vertices is needed.
template <class Mesh>
class Input_surface {
public:
  using Kernel = typename CGAL::Kernel_traits<typename Mesh::Point>::Kernel;
  using Point = typename Kernel::Point_3;
  using Triangle = typename Kernel::Triangle_3;
  using Place = std::uint32_t; ///< of a triangle

  template <class Faces>
  Input_surface(const Mesh& mesh, const Faces& faces) {
    triangles_.reserve(faces.size());
    for (const auto f : faces) {
      const auto corners = corners_of_face(mesh, f);
      triangles_.emplace_back(mesh.point(corners[0]), mesh.point(corners[1]), mesh.point(corners[2]));
    }
    tree_.rebuild(triangles_.begin(), triangles_.end());
    tree_.do_not_accelerate_distance_queries();
  }
  Input_surface(const Input_surface&) = delete;
  Input_surface& operator=(const Input_surface&) = delete;

  /// The nearest point. \param place in: a triangle that is near, any will do; out: the one that the point is on
  Point project(const Point& p, Place& place) const {
    const Point hint = Kernel().construct_projected_point_3_object()(triangles_[place], p);
    const auto nearest = tree_.closest_point_and_primitive(p, {hint, triangles_.begin() + place});
    place = static_cast<Place>(nearest.second - triangles_.begin());
    return nearest.first;
  }

private:
  using Triangles = std::vector<Triangle>;
  using Iterator = typename Triangles::const_iterator;
#if CGAL_VERSION_NR >= 1060000000
  using Primitive = CGAL::AABB_triangle_primitive_3<Kernel, Iterator>;
  using Tree = CGAL::AABB_tree<CGAL::AABB_traits_3<Kernel, Primitive>>;
#else
  using Primitive = CGAL::AABB_triangle_primitive<Kernel, Iterator>;
  using Tree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>>;
#endif

  Triangles triangles_;
  Tree tree_;
};

} // namespace internal
} // namespace haptic_sculpt

#endif
