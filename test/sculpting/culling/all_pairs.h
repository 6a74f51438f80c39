// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "sculpting/Random_scene.h"

#include <map>
#include <set>

namespace haptic_sculpt::test {

/// What stands still around a star: some triangles of a mesh and the vertices of the link. Asks the exact sweeps about
/// all pairs of a moving and a still feature, none left out for any reason but a common vertex, in loops straight from
/// the statement.
struct All_pairs {
  using Coordinates = internal::Coordinates;
  using Points = internal::Sweep_points;
  using Verdict = internal::Sweep_verdict;

  const internal::Star<Mesh>& star;
  std::vector<std::array<Vertex_index, 3>> faces;
  std::set<std::array<Vertex_index, 2>> edges;
  std::map<Vertex_index, Coordinates> vertices;

  All_pairs(const Mesh& mesh, const internal::Star<Mesh>& star,
            const std::vector<std::array<Vertex_index, 3>>& triangles)
      : star(star) {
    for (const Vertex_index v : star.link)
      vertices[v] = vertex_coordinates(mesh, v);
    for (const auto& f : triangles) {
      if (star.valence() != 0 && std::find(f.begin(), f.end(), star.centre) != f.end())
        continue;
      faces.push_back(f);
      for (int i = 0; i < 3; ++i) {
        vertices[f[i]] = vertex_coordinates(mesh, f[i]);
        edges.insert({std::min(f[i], f[(i + 1) % 3]), std::max(f[i], f[(i + 1) % 3])});
      }
    }
  }

  /// Calls `hit(feature, vertices, points, verdict)` for all pairs that meet.
  template <class Hit>
  void for_each_hit(const Coordinates& source, const Coordinates& target, const Hit& hit) const {
    if (source == target && star.valence() != 0)
      return; // what stands still touches nothing new
    No_filter_counters uncounted;
    for (const auto& f : faces) {
      const Points points = {source, target, at(f[0]), at(f[1]), at(f[2])};
      const Verdict verdict = internal::vertex_face_verdict(points, uncounted);
      if (verdict.hits)
        hit(Impact_feature::vertex_face, f, points, verdict);
    }
    for (std::size_t i = 0; i < star.valence(); ++i) {
      for_each_edge_hit(source, target, i, [&](const auto& edge, const Points& points, const Verdict& verdict) {
        hit(Impact_feature::edge_edge, {star.link[i], edge[0], edge[1]}, points, verdict);
      });
      for_each_vertex_hit(source, target, i, [&](Vertex_index v, const Points& points, const Verdict& verdict) {
        hit(Impact_feature::face_vertex, {star.link[i], star.link[star.next(i)], v}, points, verdict);
      });
    }
  }
  template <class Hit>
  void for_each_edge_hit(const Coordinates& source, const Coordinates& target, std::size_t i, const Hit& hit) const {
    No_filter_counters uncounted;
    for (const auto& edge : edges) {
      if (edge[0] == star.link[i] || edge[1] == star.link[i])
        continue;
      const Points points = {source, target, star.link_points[i], at(edge[0]), at(edge[1])};
      const Verdict verdict = internal::edge_edge_verdict(points, uncounted);
      if (verdict.hits)
        hit(edge, points, verdict);
    }
  }
  template <class Hit>
  void for_each_vertex_hit(const Coordinates& source, const Coordinates& target, std::size_t i, const Hit& hit) const {
    No_filter_counters uncounted;
    const std::size_t j = star.next(i);
    for (const auto& [v, point] : vertices) {
      if (v == star.link[i] || v == star.link[j])
        continue;
      const Points points = {source, target, star.link_points[i], star.link_points[j], point};
      const Verdict verdict = internal::face_vertex_verdict(points, uncounted);
      if (verdict.hits)
        hit(v, points, verdict);
    }
  }

  Star_impacts<Mesh> first_impacts(const Coordinates& source, const Coordinates& target) const {
    Star_impacts<Mesh> firsts;
    No_filter_counters uncounted;
    for_each_hit(source, target,
                 [&](Impact_feature feature, const std::array<Vertex_index, 3>& v, const Points& points,
                     const Verdict& verdict) {
                   const int order = firsts.empty()
                                         ? -1
                                         : internal::compare_times(points, verdict, firsts[0].impact().coordinates(),
                                                                   firsts[0].impact().verdict(), uncounted);
                   if (order < 0)
                     firsts.clear();
                   if (order <= 0)
                     firsts.emplace_back(v, typename Exact_sweep_traits<Mesh>::Impact_3(feature, points, verdict));
                 });
    std::sort(firsts.begin(), firsts.end());
    return firsts;
  }

  /// What stands in the way of a collapse into the link's vertex `pivot`: of the first edge, else face, that meets
  /// anything.
  std::vector<Vertex_index> in_the_way(const Coordinates& centre, std::size_t pivot) const {
    const std::size_t n = star.valence();
    const Coordinates& target = star.link_points[pivot];
    const Vertex_index apex = star.link[pivot];
    std::set<std::vector<Vertex_index>> found;
    for (std::size_t i = 0; i < n && found.empty(); ++i)
      if (i != pivot && star.next(i) != pivot && star.next(pivot) != i)
        for_each_edge_hit(centre, target, i, [&](const auto& edge, const Points&, const Verdict&) {
          if (edge[0] != apex && edge[1] != apex)
            found.insert({edge[0], edge[1]});
        });
    for (std::size_t i = 0; i < n && found.empty(); ++i)
      if (i != pivot && star.next(i) != pivot)
        for_each_vertex_hit(centre, target, i, [&](Vertex_index v, const Points&, const Verdict&) {
          if (v != apex)
            found.insert({v});
        });
    return found.empty() ? std::vector<Vertex_index>() : *found.begin();
  }

  /// Whether the list has each face, edge and vertex once, and the link's vertices first, in their order.
  bool are_in(const internal::Candidate_list<Mesh>& list) const {
    bool are_same = list.vertices().size() == vertices.size() && list.edges().size() == edges.size() &&
                    list.faces().size() == faces.size();
    const auto index = [&](std::uint32_t position) { return list.vertices()[position].index; };
    for (std::size_t i = 0; are_same && i < star.valence(); ++i)
      are_same = list.vertices()[i].index == star.link[i];
    auto left = vertices;
    for (const auto& vertex : list.vertices()) {
      const auto found = left.find(vertex.index);
      are_same = are_same && found != left.end() && found->second == vertex.point;
      left.erase(vertex.index);
    }
    auto edges_left = edges;
    for (const auto& [a, b] : list.edges())
      are_same = are_same && edges_left.erase({std::min(index(a), index(b)), std::max(index(a), index(b))}) == 1;
    for (std::size_t f = 0; are_same && f < faces.size(); ++f)
      for (int i = 0; i < 3; ++i)
        are_same = are_same && index(list.faces()[f].vertices[i]) == faces[f][i];
    return are_same;
  }

private:
  const Coordinates& at(Vertex_index v) const { return vertices.at(v); }
};

inline bool same(const Star_impacts<Mesh>& a, const Star_impacts<Mesh>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const auto& x, const auto& y) {
    return x.feature() == y.feature() && x.vertices() == y.vertices() &&
           compare_time(x.impact(), y.impact()) == CGAL::EQUAL;
  });
}

} // namespace haptic_sculpt::test
