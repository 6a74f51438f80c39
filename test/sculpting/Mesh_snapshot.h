// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/surface/connectivity/star.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <tuple>
#include <vector>

namespace haptic_sculpt::test {

/// What can be seen of a mesh by numbers that last: the bits of the points by number, and the faces as corner triples
/// that begin with the smallest, in order. Equal if and only if the meshes are, whatever slots Surface_mesh has
/// recycled.
struct Mesh_snapshot {
  using Bits = std::array<std::uint64_t, 3>; ///< not doubles: 0 and -0 are different
  std::vector<std::pair<std::size_t, Bits>> points;
  std::vector<std::array<std::size_t, 3>> faces;

  bool operator==(const Mesh_snapshot& other) const { return points == other.points && faces == other.faces; }
  bool operator!=(const Mesh_snapshot& other) const { return !(*this == other); }

  void add_point(std::size_t number, const std::array<double, 3>& p) {
    Bits bits;
    std::memcpy(bits.data(), p.data(), sizeof bits);
    points.emplace_back(number, bits);
  }
  void add_face(std::array<std::size_t, 3> corners) {
    std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
    faces.push_back(corners);
  }
  void sort() {
    std::sort(points.begin(), points.end());
    std::sort(faces.begin(), faces.end());
  }
};

/// \param number `number(v)` of a vertex
template <class Mesh, class Number>
Mesh_snapshot snapshot_of(const Mesh& mesh, const Number& number) {
  Mesh_snapshot result;
  for (const auto v : mesh.vertices())
    result.add_point(number(v), vertex_coordinates(mesh, v));
  for (const auto f : mesh.faces()) {
    const auto h = mesh.halfedge(f);
    result.add_face({number(mesh.source(h)), number(mesh.target(h)), number(mesh.target(mesh.next(h)))});
  }
  result.sort();
  return result;
}

template <class Sculptor>
Mesh_snapshot snapshot(const Sculptor& sculptor) {
  return snapshot_of(sculptor.mesh(), [&](typename Sculptor::Vertex_index v) { return sculptor.id(v); });
}

} // namespace haptic_sculpt::test
