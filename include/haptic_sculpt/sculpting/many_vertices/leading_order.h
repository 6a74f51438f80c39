// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef HAPTIC_SCULPT_SCULPTING_LEADING_ORDER_H
#define HAPTIC_SCULPT_SCULPTING_LEADING_ORDER_H

#include <haptic_sculpt/sculpting/culling/separation.h>
#include <haptic_sculpt/sculpting/motion/stop.h>
#include <haptic_sculpt/surface/broad_phase/spatial_order.h>

namespace haptic_sculpt {
namespace internal {

/// A vertex and where it is to go.
template <class Mesh>
struct Moving_vertex {
  typename Mesh::Vertex_index vertex;
  Coordinates source, target;
};

/// Between two points; where squares would leave the range of doubles, scaled.
inline double distance(const Coordinates& p, const Coordinates& q) {
  const Vector d = minus(p, q);
  const double square = quick_dot(d, d);
  return square > 0x1p-900 && square < 0x1p900 ? std::sqrt(square) : path_length(p, q);
}

/// Whether no way is longer than a quarter of an edge at its vertex: then the order matters little.
template <class Mesh>
bool are_ways_short(const Mesh& mesh, const std::vector<Moving_vertex<Mesh>>& vertices) {
  for (const Moving_vertex<Mesh>& v : vertices)
    if (mesh.is_isolated(v.vertex) ||
        4 * distance(v.source, v.target) >
            distance(v.source, vertex_coordinates(mesh, mesh.source(mesh.halfedge(v.vertex)))))
      return false;
  return true;
}

/// Puts them in an order in which successive ones are near each other, in memory of the broad phase too. Cost: n log n.
template <class Mesh>
void order_in_space(std::vector<Moving_vertex<Mesh>>& vertices) {
  std::vector<Face_middle> places(vertices.size());
  for (std::size_t k = 0; k < vertices.size(); ++k) {
    for (int i = 0; i < 3; ++i)
      places[k].middle[i] = static_cast<float>(vertices[k].source[i]);
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

/// Puts them in an order in which, of two neighbours v and w, w comes first where it lies ahead: where
/// (w - v) . (d_v + d_w) > 0, d being the ways to the targets. Then v finds the place free that w has left.
///
/// A topological order by depth-first search, so that it stays local; a cycle is broken where the search began it.
/// \param vertices in spatial order, each once. Cost: the sum of the valences.
template <class Mesh>
void order_leaders_first(const Mesh& mesh, std::vector<Moving_vertex<Mesh>>& vertices) {
  using Vertex_index = typename Mesh::Vertex_index;
  constexpr std::uint32_t none = ~std::uint32_t{0};
  std::vector<std::uint32_t> place(mesh.num_vertices(), none);
  for (std::size_t k = 0; k < vertices.size(); ++k)
    place[static_cast<std::size_t>(vertices[k].vertex)] = static_cast<std::uint32_t>(k);

  const auto is_ahead = [&](std::uint32_t w, std::uint32_t v) {
    const Moving_vertex<Mesh>&a = vertices[v], &b = vertices[w];
    return dot(minus(b.source, a.source), plus(minus(a.target, a.source), minus(b.target, b.source))) > 0;
  };
  struct Visit {
    std::uint32_t at;
    typename Mesh::Halfedge_index first, next; ///< next to be looked at; null when all have been
  };
  std::vector<char> is_met(vertices.size(), 0);
  std::vector<Visit> stack;
  std::vector<Moving_vertex<Mesh>> ordered;
  ordered.reserve(vertices.size());
  const auto meet = [&](std::uint32_t k) {
    is_met[k] = 1;
    const Vertex_index v = vertices[k].vertex;
    const auto first = mesh.is_isolated(v) ? Mesh::null_halfedge() : mesh.halfedge(v);
    stack.push_back({k, first, first});
  };
  for (std::uint32_t seed = 0; seed < vertices.size(); ++seed) {
    if (is_met[seed])
      continue;
    meet(seed);
    while (!stack.empty()) {
      Visit& visit = stack.back();
      if (visit.next == Mesh::null_halfedge()) {
        ordered.push_back(vertices[visit.at]);
        stack.pop_back();
        continue;
      }
      const std::uint32_t w = place[static_cast<std::size_t>(mesh.source(visit.next))];
      visit.next = mesh.opposite(mesh.next(visit.next));
      if (visit.next == visit.first)
        visit.next = Mesh::null_halfedge();
      if (w != none && !is_met[w] && is_ahead(w, visit.at))
        meet(w); // invalidates `visit`
    }
  }
  vertices = std::move(ordered);
}

} // namespace internal
} // namespace haptic_sculpt

#endif
