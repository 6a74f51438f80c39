// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef HAPTIC_SCULPT_SCULPTING_LEADING_ORDER_H
#define HAPTIC_SCULPT_SCULPTING_LEADING_ORDER_H

#include <haptic_sculpt/sculpting/geometry/separation.h>
#include <haptic_sculpt/sculpting/geometry/stop.h>
#include <haptic_sculpt/sculpting/many_vertices/Moving_vertex.h>
#include <haptic_sculpt/surface/broad_phase/spatial_order.h>
#include <haptic_sculpt/surface/vertex_coordinates.h>

#include <array>
#include <optional>

namespace haptic_sculpt {
namespace internal {

/// Between two points; where squares would leave the range of doubles, in another unit.
inline double distance(const Coordinates& p, const Coordinates& q) {
  const Vector d = minus(p, q);
  const double square = quick_dot(d, d);
  if (square > 0x1p-900 && square < 0x1p900)
    return std::sqrt(square);
  const double unit = unit_of(quick_magnitude(d));
  const Vector e = scaled(d, unit);
  return std::sqrt(quick_dot(e, e)) / unit;
}

/// Whether no way is longer than a quarter of an edge at its vertex: then the order matters little.
template <class Mesh>
bool are_ways_short(const Mesh& mesh, const std::vector<Moving_vertex<Mesh>>& vertices) {
  for (const Moving_vertex<Mesh>& v : vertices)
    if (4 * distance(v.source, v.target) >
        distance(v.source, vertex_coordinates(mesh, mesh.source(mesh.halfedge(v.vertex)))))
      return false;
  return true;
}

/// Puts them in an order in which successive ones are near each other, in memory of the broad phase too. Cost: n log n.
template <class Mesh>
void order_in_space(std::vector<Moving_vertex<Mesh>>& vertices) {
  std::vector<Face_middle> places(vertices.size());
  const Box_scale scale([&vertices](const auto& visit) {
    for (const Moving_vertex<Mesh>& v : vertices)
      visit(v.source);
  });
  for (std::size_t k = 0; k < vertices.size(); ++k) {
    for (int i = 0; i < 3; ++i)
      places[k].middle[i] = static_cast<float>(vertices[k].source[i] * scale.factor());
    places[k].face = static_cast<std::uint32_t>(k);
  }
  std::size_t capacity = Box_node::width;
  while (capacity < places.size())
    capacity *= Box_node::width;
  order_in_space(places.data(), places.data() + places.size(), capacity);
  std::vector<Moving_vertex<Mesh>> ordered;
  ordered.reserve(vertices.size());
  for (const Face_middle& place : places)
    ordered.push_back(vertices[place.face]);
  vertices = std::move(ordered);
}

/// Of three corners that go on by `way` together, the one that is between the others as seen along it, if that has to
/// go before both or after both: the face lies along the way, and would turn over in its own plane.
struct Corner_between {
  int corner;    ///< 0, 1 or 2
  bool is_ahead; ///< of the line through the others, so that it goes first; else last
};
inline std::optional<Corner_between> corner_between(const std::array<Coordinates, 3>& p, const Vector& way) {
  /// Square of the sine of the angle between face and motion from which on the face is stretched rather than turned
  /// over; the exact value matters little (doc/many_vertices.md).
  constexpr double steep = 0.5;
  Vector sides[3] = {Vector{}, minus(p[1], p[0]), minus(p[2], p[0])};
  // Of the sixth degree in them, and the third in the way: each in a unit of its own.
  const double unit = unit_of(larger(quick_magnitude(sides[1]), quick_magnitude(sides[2])));
  for (Vector& side : sides)
    side = scaled(side, unit);
  const Vector d = scaled(way, unit_of(quick_magnitude(way)));
  const Vector normal = quick_cross(sides[1], sides[2]);
  const double slope = quick_dot(normal, d);
  if (slope * slope > steep * quick_dot(normal, normal) * quick_dot(d, d))
    return std::nullopt;
  const Vector sideways = quick_cross(normal, d);
  double across[3], along[3];
  for (int i = 0; i < 3; ++i)
    across[i] = quick_dot(sides[i], sideways), along[i] = quick_dot(sides[i], d);
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    const double width = across[k] - across[j], from_j = across[i] - across[j], to_k = across[k] - across[i];
    if (width == 0 || from_j * to_k < 0)
      continue;
    return Corner_between{i, ((along[i] - along[j]) * width - (along[k] - along[j]) * from_j) * width > 0};
  }
  return std::nullopt;
}

/// An order in which those go first that would else be in the way of others, as their indices: of the corners of a
/// face that lies along the motion, the one between goes before the others if it is ahead of them, else after them.
///
/// A topological order by depth-first search, so that it stays local; a cycle is broken where the search began it.
/// \param vertices each once: first those that are to go first where the faces leave it open. Cost: the sum of the
/// valences.
template <class Mesh>
std::vector<std::uint32_t> leaders_first(const Mesh& mesh, const std::vector<Moving_vertex<Mesh>>& vertices) {
  using Vertex_index = typename Mesh::Vertex_index;
  constexpr std::uint32_t none = ~std::uint32_t{0};
  std::vector<std::uint32_t> place(mesh.num_vertices(), none);
  for (std::size_t k = 0; k < vertices.size(); ++k)
    place[static_cast<std::size_t>(vertices[k].vertex)] = static_cast<std::uint32_t>(k);
  std::vector<char> is_met(vertices.size(), 0);

  /// One that is not met yet and has to go before the target of h, by the face of h.
  const auto leader = [&](typename Mesh::Halfedge_index h) {
    const std::array<Vertex_index, 3> v = {mesh.target(h), mesh.source(h), mesh.target(mesh.next(h))};
    std::array<std::uint32_t, 3> at;
    std::array<Coordinates, 3> p;
    Vector d{};
    for (int i = 0; i < 3; ++i) {
      at[i] = place[static_cast<std::size_t>(v[i])];
      p[i] = at[i] != none ? vertices[at[i]].source : vertex_coordinates(mesh, v[i]);
      if (at[i] != none)
        d = plus(d, minus(vertices[at[i]].target, p[i]));
    }
    const auto between = corner_between(p, d);
    for (int i = 1; i < 3; ++i)
      if (between && between->corner == (between->is_ahead ? i : 0) && at[i] != none && !is_met[at[i]])
        return at[i];
    return none;
  };
  struct Visit {
    std::uint32_t at;
    typename Mesh::Halfedge_index first, next; ///< next to be looked at; null when all have been
  };
  std::vector<Visit> stack;
  std::vector<std::uint32_t> ordered;
  ordered.reserve(vertices.size());
  const auto meet = [&](std::uint32_t k) {
    is_met[k] = 1;
    const Vertex_index v = vertices[k].vertex;
    const auto first = mesh.halfedge(v);
    stack.push_back({k, first, first});
  };
  for (std::uint32_t seed = 0; seed < vertices.size(); ++seed) {
    if (is_met[seed])
      continue;
    meet(seed);
    while (!stack.empty()) {
      Visit& visit = stack.back();
      if (visit.next == Mesh::null_halfedge()) {
        ordered.push_back(visit.at);
        stack.pop_back();
      } else if (const std::uint32_t k = leader(visit.next); k != none) {
        meet(k); // invalidates `visit`; the face may name another one
      } else {
        visit.next = mesh.opposite(mesh.next(visit.next));
        if (visit.next == visit.first)
          visit.next = Mesh::null_halfedge();
      }
    }
  }
  return ordered;
}

} // namespace internal
} // namespace haptic_sculpt

#endif
