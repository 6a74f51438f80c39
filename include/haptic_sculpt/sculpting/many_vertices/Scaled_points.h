// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/sculpting/many_vertices/triangle_shape.h>
#include <haptic_sculpt/surface/connectivity/Face_corners.h>
#include <haptic_sculpt/surface/connectivity/star.h>
#include <haptic_sculpt/surface/vertex_coordinates.h>

namespace haptic_sculpt::internal {

/// The points of a mesh in a unit of length that is a power of two, so that squares, areas and volumes of what is about
/// that long neither overflow nor vanish. No bit of a coordinate changes by it, unless it becomes subnormal.
///
/// The unit is about a given length, or the largest coordinate where that is less: lengths in the unit are then about
/// one where a remeshing to that length has anything to do, whatever they are outside. Of a length that is 2^100 times
/// shorter than an edge of the range it is 2^-100 of that edge: edges about as short as the length may stay as they
/// are.
template <class Mesh>
class Scaled_points {
public:
  using Vertex_index = typename Mesh::Vertex_index;
  using Edge_index = typename Mesh::Edge_index;
  using Face_index = typename Mesh::Face_index;
  using Point = typename Mesh::Point;

  /// \param range of faces to be remeshed \pre length > 0, and the mesh has a vertex
  Scaled_points(const Mesh& mesh, double length, const std::vector<Face_index>& range) : mesh_(&mesh) {
    double largest = 0;
    for (const Face_index f : range) {
      const auto corners = corners_of_face(mesh, f);
      for (int k = 0; k < 3; ++k)
        length = larger(length, least_share * quick_magnitude(minus(vertex_coordinates(mesh, corners[k]),
                                                                    vertex_coordinates(mesh, corners[(k + 1) % 3]))));
    }
    for (const Vertex_index v : mesh.vertices())
      largest = larger(largest, quick_magnitude(vertex_coordinates(mesh, v)));
    const int exponent = std::ilogb(largest > 0 ? smaller(largest, length) : length);
    const int bounded = std::max(-largest_exponent, std::min(exponent, largest_exponent));
    to_unit_ = std::ldexp(1, -bounded);
    from_unit_ = std::ldexp(1, bounded);
  }

  Coordinates operator()(Vertex_index v) const { return in_unit(vertex_coordinates(*mesh_, v)); }
  /// In squares of the unit.
  double squared_length(Edge_index e) const {
    return quick_squared_distance((*this)(mesh_->vertex(e, 0)), (*this)(mesh_->vertex(e, 1)));
  }
  /// With the points of its link in the unit.
  void collect(Star<Mesh>& star, Vertex_index v) const {
    star.collect(*mesh_, v);
    for (Coordinates& p : star.link_points)
      p = in_unit(p);
  }

  Coordinates in_unit(const Coordinates& p) const { return scaled(p, to_unit_); }
  /// At most `most_length`, so that its cube is a number: nothing in a mesh is as long.
  double in_unit(double length) const { return smaller(length * to_unit_, most_length); }
  /// Back to the mesh.
  Coordinates in_mesh(const Coordinates& p) const { return scaled(p, from_unit_); }

private:
  static constexpr int largest_exponent = 1000; ///< 2^-1000, too, has a reciprocal
  static constexpr double most_length = 0x1p200;
  /// Of an edge, the unit: sixth powers of edges, which measures of shape take, are numbers then.
  static constexpr double least_share = 0x1p-100;

  const Mesh* mesh_;
  double to_unit_, from_unit_;
};

} // namespace haptic_sculpt::internal
