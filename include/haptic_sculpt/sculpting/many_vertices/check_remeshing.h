// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/sculpting/Invalid_parameter.h>
#include <haptic_sculpt/sculpting/many_vertices/Remeshing_state.h>
#include <haptic_sculpt/sculpting/many_vertices/named_parameters.h>

#include <cstdint>
#include <limits>
#include <string>
#include <type_traits>

namespace haptic_sculpt::internal {

/// Refuses what CGAL documents for its isotropic_remeshing(), and ours does not serve.
template <class Named_parameters>
constexpr void check_named_parameters() {
  static_assert(is_not_given<Named_parameters, named::vertex_point_t>,
                "isotropic_remeshing: vertex_point_map is not served: the points are those of the Sculptor's mesh");
  static_assert(is_not_given<Named_parameters, named::geom_traits_t>,
                "isotropic_remeshing: geom_traits is not served: what is decided is decided by the Sculptor's traits");
  static_assert(is_not_given<Named_parameters, named::face_index_t>,
                "isotropic_remeshing: face_index_map is not served: faces have the indices of the mesh");
  static_assert(is_not_given<Named_parameters, named::allow_move_functor_t>,
                "isotropic_remeshing: allow_move_functor is not served: constrain vertices, or use the visitor");
}

/// \throw Out_of_range, Invalid_parameter
inline void check_remeshing(double target_edge_length, const Remeshing_parameters& parameters) {
  check_range("the target edge length", target_edge_length);
  if (!(target_edge_length > 0))
    throw Invalid_parameter("the target edge length must be > 0, not " + number(target_edge_length));
  const double angle = parameters.feature_angle_degrees;
  if (!(angle >= 0 && angle <= 180))
    throw Invalid_parameter("the feature angle must be from 0 to 180 degrees, not " + number(angle));
  const double distance = parameters.most_distance.value_or(0);
  if (!(distance >= 0))
    throw Invalid_parameter("the distance to the input must be >= 0, not " + number(distance));
  if (distance < std::numeric_limits<double>::infinity())
    check_range("the distance to the input", distance);
}

/// Refuses a length for which splits alone would make more faces than wanted, where nothing is in the way of a split.
///
/// An edge of length l becomes at least l / (4/3 L) edges, and a closed surface has two thirds as many faces as edges.
/// No triangle with edges of at most 4/3 L has a larger area than the equilateral one.
/// \param may_split of an edge of the faces. Faces with a long one that may not are left out: those beside it
/// may stay, too \throw Invalid_parameter
template <class Mesh, class May_split>
void check_number_of_faces(const Mesh& mesh, const Scaled_points<Mesh>& points,
                           const std::vector<typename Mesh::Face_index>& faces, const Remeshing_named_parameters& named,
                           double target_edge_length, const Remeshing_parameters& parameters,
                           const May_split& may_split) {
  const double longest = named.target_edge_length * 4 / 3;
  const double largest_area = std::sqrt(3.0) / 4 * longest * longest;
  double area = 0, more_edges = 0;
  for (const auto f : faces) {
    double more = 0;
    bool may_split_all = true;
    for (const auto h : mesh.halfedges_around_face(mesh.halfedge(f))) {
      const double of_edge = length(minus(points(mesh.target(h)), points(mesh.source(h)))) / longest - 1;
      more += larger(0, of_edge) / 2; // each edge is counted at both of its faces
      may_split_all = may_split_all && (!(of_edge > 0) || may_split(mesh.edge(h)));
    }
    if (!may_split_all)
      continue;
    more_edges += more;
    const auto corners = corners_of_face(mesh, f);
    area += length(area_normal(points(corners[0]), points(corners[1]), points(corners[2]))) / 2;
  }
  const double now = static_cast<double>(faces.size()), others = static_cast<double>(mesh.number_of_faces()) - now,
               least = others + larger(area / largest_area, now + more_edges * 2 / 3),
               most = static_cast<double>(parameters.most_number_of_faces);
  if (more_edges <= 0 || least <= most)
    return;
  // Where edges are longer than doubles can tell in the unit, their number is not a number.
  throw Invalid_parameter("the target edge length " + number(target_edge_length) + " is too short: it takes at least " +
                          (std::isfinite(least) ? number(least) : "2^1000") + " faces in all, and " + number(most) +
                          " may be there: give a longer one, or allow for more faces");
}

/// A number of iterations or steps that a caller has given. \throw Invalid_parameter
template <class Count>
unsigned checked_count(const char* name, Count count) {
  static_assert(std::is_integral<Count>::value, "isotropic_remeshing: numbers of iterations and steps are whole");
  constexpr unsigned most = std::numeric_limits<unsigned>::max();
  if (static_cast<std::uintmax_t>(count) > most) // negative ones, too
    throw Invalid_parameter(std::string(name) + " must be from 0 to " + std::to_string(most) + ", not " +
                            std::to_string(count));
  return static_cast<unsigned>(count);
}

} // namespace haptic_sculpt::internal
