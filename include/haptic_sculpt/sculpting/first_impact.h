// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/Error.h>
#include <haptic_sculpt/Rounding_to_nearest.h>
#include <haptic_sculpt/sculpting/contact/check_arguments.h>
#include <haptic_sculpt/sculpting/motion/Narrow_phase.h>
#include <haptic_sculpt/surface/broad_phase/Brute_force_broad_phase.h>
#include <haptic_sculpt/surface/vertex_coordinates.h>

#include <algorithm>
#include <string>
#include <vector>

namespace haptic_sculpt {

namespace internal {

/// \throw Error
template <class Mesh>
void check_triangles_about(const Mesh& mesh, typename Mesh::Vertex_index v) {
  for (const auto f : mesh.faces())
    if (mesh.degree(f) != 3)
      throw Error("face " + std::to_string(static_cast<std::size_t>(f)) + " has " + std::to_string(mesh.degree(f)) +
                  " corners: divide it into triangles");
  if (!mesh.is_isolated(v) && mesh.is_border(v))
    throw Error("vertex " + std::to_string(static_cast<std::size_t>(v)) +
                " is on a boundary of the mesh: fill the hole, or ask of another");
  std::vector<typename Mesh::Vertex_index> neighbours;
  if (!mesh.is_isolated(v))
    for (const auto w : mesh.vertices_around_target(mesh.halfedge(v)))
      neighbours.push_back(w);
  std::sort(neighbours.begin(), neighbours.end());
  const auto twice = std::adjacent_find(neighbours.begin(), neighbours.end());
  if (twice != neighbours.end())
    throw Error("vertex " + std::to_string(static_cast<std::size_t>(v)) + " has two edges to vertex " +
                std::to_string(static_cast<std::size_t>(*twice)) + ": flip or divide one, or ask of another");
}

} // namespace internal

/// What vertex `v` would touch first on its straight way to `target` while all else stands still: the impacts that come
/// exactly first, or none when the way is free. Changes nothing.
///
/// A mesh that is closed and embedded stays so up to `target` if and only if the result is empty; otherwise it stays so
/// up to, and not at, the time of the impacts (doc/proofs/exact_sweeps.md, "Completeness"). On other meshes the answer
/// is about the three sweeps only. A vertex without faces touches faces, and nothing touches it: it is no part of the
/// surface. Where `target` is the place of a vertex of faces there is none. \throw Unknown_vertex, Out_of_range; Error
/// if v is on a boundary, or has two edges to one vertex, or a face is no triangle. Cost: reads every face once; the
/// sweeps cost valence times the candidates whose boxes meet the swept star's. \param traits decide the sweeps, a model
/// of SweptCollisionTraits_3: with another than the default the answer is as right as its sweeps are.
template <class Mesh,
          class Traits = Swept_collision_traits_3<typename CGAL::Kernel_traits<typename Mesh::Point>::Kernel>>
Star_impacts<Mesh, typename Traits::Impact_3> first_impacts(const Mesh& mesh, typename Mesh::Vertex_index v,
                                                            const typename Mesh::Point& target,
                                                            const Traits& traits = Traits()) {
  const internal::Rounding_to_nearest rounding;
  internal::check_vertex(mesh, v);
  internal::check_point("the target", target);
  internal::check_points(mesh);
  internal::check_triangles_about(mesh, v);
  const auto source = vertex_coordinates(mesh, v);
  const internal::Coordinates end = internal::coordinates(target);
  internal::Star<Mesh> star;
  star.collect(mesh, v);
  std::vector<typename Mesh::Face_index> candidates;
  const Swept_star_3 swept = star.swept(source, end);
  Brute_force_broad_phase<Mesh>(mesh).query(swept.box(), candidates);
  internal::Candidate_list<Mesh> list;
  list.assign(mesh, [&mesh](auto f) { return internal::corners_of_face(mesh, f); }, star, candidates, swept.box());
  Star_impacts<Mesh, typename Traits::Impact_3> firsts;
  internal::Narrow_phase<Mesh, Traits>(traits).first_impacts(star, list, source, end, firsts);
  return firsts;
}

/// The first of `first_impacts()`, if any: would this motion hit, what, and when. Changes nothing. Same cost and
/// errors.
template <class Mesh,
          class Traits = Swept_collision_traits_3<typename CGAL::Kernel_traits<typename Mesh::Point>::Kernel>>
std::optional<Star_impact<Mesh, typename Traits::Impact_3>>
first_impact(const Mesh& mesh, typename Mesh::Vertex_index v, const typename Mesh::Point& target,
             const Traits& traits = Traits()) {
  const auto firsts = first_impacts(mesh, v, target, traits);
  if (firsts.empty())
    return std::nullopt;
  return firsts.front();
}

} // namespace haptic_sculpt
