// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/sculpting/move_vertices.h>

#include <type_traits>

namespace haptic_sculpt {
namespace internal {

/// \throw Invalid_parameter where the elements of a copy are not those of the mesh, or are joined otherwise
template <class Mesh>
void check_same_connectivity(const Mesh& copy, const Mesh& mesh) {
  bool is_same = copy.num_vertices() == mesh.num_vertices() && copy.num_halfedges() == mesh.num_halfedges() &&
                 copy.num_faces() == mesh.num_faces() && copy.number_of_vertices() == mesh.number_of_vertices() &&
                 copy.number_of_faces() == mesh.number_of_faces();
  for (const auto h : mesh.halfedges())
    is_same = is_same && !copy.is_removed(h) && copy.target(h) == mesh.target(h) && copy.next(h) == mesh.next(h);
  if (!is_same)
    throw Invalid_parameter(
        "the function given to apply_guarded() has changed connectivity; only points may change: use "
        "isotropic_remeshing(), or the edits of the Sculptor, for that");
}

} // namespace internal

/// Runs a function that moves points, on a copy of the mesh, and brings the vertices as near to what came of it as axis
/// moves and drags do: `apply_guarded(sculptor, [&](auto& mesh, auto map) { ... })`.
///
/// \tparam Concurrency_tag as of move_vertices()
/// \param function `function(mesh, map)`: the copy, whose elements have the descriptors of those of the guarded mesh,
/// and its vertex point map. It may do with them what it likes but change connectivity. What was removed stays in the
/// copy, unused: after removals and remeshing, what counts the living and indexes by descriptors, as
/// CGAL::Surface_mesh_deformation does by default, needs index maps of its own. Where it returns a `bool` that
/// is false, as CGAL::Polygon_mesh_processing::fair() does when it fails, nothing moves.
/// \param left_behind an output iterator for the vertices that are not where the function wants them
/// \return as move_vertices(), of the vertices that the function has moved
///
/// The whole is one step of the history.
/// \throw Invalid_parameter where connectivity has changed; Out_of_range where a point is not finite or too large:
/// nothing has moved; Mesh_changed; and what the function throws. Cost: the function, a copy of the mesh, and
/// move_vertices().
template <class Concurrency_tag = CGAL::Sequential_tag, class Sculptor, class Function,
          class Output_iterator = CGAL::Emptyset_iterator>
Move_report apply_guarded(Sculptor& sculptor, Function&& function,
                          const Move_parameters& parameters = Move_parameters(),
                          Output_iterator left_behind = Output_iterator()) {
  using Mesh = typename Sculptor::Mesh_type;
  sculptor.check_unchanged();
  const Mesh& mesh = sculptor.mesh();
  Mesh copy = mesh;
  const auto map = get(CGAL::vertex_point, copy);
  const auto result_of = [&] { return function(copy, map); };
  auto& guarded = internal::Sculptor_access::guarded(sculptor);
  if constexpr (std::is_same<decltype(function(copy, map)), bool>::value) {
    if (!internal::ask(guarded, result_of))
      return Move_report();
  } else
    internal::ask(guarded, result_of);
  const internal::Rounding_to_nearest rounding; // points that differ by a subnormal number differ
  internal::check_same_connectivity(copy, mesh);
  std::vector<typename Mesh::Vertex_index> moved;
  for (const auto v : mesh.vertices())
    if (vertex_coordinates(copy, v) != vertex_coordinates(mesh, v))
      moved.push_back(v);
  // Not the map that the function was given: what it has put in the place of the copy has another.
  return move_vertices<Concurrency_tag>(sculptor, moved, get(CGAL::vertex_point, copy), parameters, left_behind);
}

} // namespace haptic_sculpt
