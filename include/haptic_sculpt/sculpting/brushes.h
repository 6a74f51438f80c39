// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/sculpting/brushes/brush_targets.h>
#include <haptic_sculpt/sculpting/move_vertices.h>

#include <algorithm>

namespace haptic_sculpt {
namespace internal {

/// \throw Invalid_parameter
template <class Mesh, class Kernel>
void check_strength(const Mesh& mesh, const Dab_3<Kernel>& dab, typename Mesh::Vertex_index nearest) {
  const double largest = largest_strength(mesh, dab, nearest);
  if (!(std::abs(dab.strength) <= largest))
    throw Invalid_parameter("the strength " + number(dab.strength) + " of a dab is of no use: give at most " +
                            number(largest) + ", 2^53 times what it is measured in");
}

} // namespace internal

/// Makes dabs with a brush, all at once: each vertex that is touched goes where the dabs want it, the sum of what they
/// want if it is touched by several, as far as nothing is in its way. No surface passes through a surface.
///
/// \tparam Concurrency_tag as of move_vertices()
/// \param dabs a range of Dab_3 of the kernel of the mesh's points: one, or one and what mirrored() makes of it
/// \param mask a readable property map from vertices to how much they take part, from 0 to 1
/// \param parameters as of move_vertices(). By default whole ways are tried, and what is held back stays there, neither
/// dragged by itself nor sliding: the next dab brings it on
/// \return what became of the vertices touched; none are asked where no vertex is within the radius
///
/// One step of the history. \throw Out_of_range where a dab wants a vertex out of range, or its radius or direction
/// is; Invalid_parameter where a radius is not >= 0, a direction 0, a strength more than largest_strength(), or the
/// mask not from 0 to 1: nothing has moved; Mesh_changed, std::bad_alloc: what has moved by then stays so. Cost: some
/// microseconds for each vertex touched.
template <class Concurrency_tag = CGAL::Sequential_tag, class Sculptor, class Dab_range,
          class Mask_map = boost::static_property_map<double, typename Sculptor::Vertex_index>>
Move_report apply_brush(Sculptor& sculptor, const Dab_range& dabs, const Mask_map& mask = Mask_map(1.0),
                        const Move_parameters& parameters = Move_parameters().drags(false)) {
  using Vertex_index = typename Sculptor::Vertex_index;
  using Point = typename Sculptor::Point;
  const internal::Rounding_to_nearest rounding;
  const auto& mesh = sculptor.mesh();
  using Vector = decltype(std::declval<Point>() - std::declval<Point>());
  std::vector<std::pair<Vertex_index, Vector>> wanted;
  for (const auto& dab : dabs) {
    internal::check_dab(dab);
    if (const Vertex_index nearest = sculptor.nearest_vertex(dab.centre, dab.radius); nearest.is_valid()) {
      internal::check_strength(mesh, dab, nearest);
      const bool inside_out = dab.kind == Brush_kind::inflate && sculptor.is_inside_out(nearest);
      const auto asking = internal::Sculptor_access::guarded(sculptor).asking(); // the mask
      internal::for_each_brush_way(touched_vertices(mesh, dab, nearest), mesh, dab, mask, inside_out,
                                   [&](Vertex_index v, const Vector& way) { wanted.emplace_back(v, way); });
    }
  }
  std::stable_sort(wanted.begin(), wanted.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<Vertex_index> vertices;
  std::vector<Vector> ways; // sums, and rounded to places once: those of a dab and its mirror image are 0 between them
  for (const auto& [v, way] : wanted)
    if (!vertices.empty() && vertices.back() == v)
      ways.back() = ways.back() + way;
    else
      vertices.push_back(v), ways.push_back(way);
  return internal::move_to_targets(
      sculptor, vertices,
      [&, k = std::size_t{0}](Vertex_index v) mutable { return internal::gone(mesh.point(v), ways[k++]); }, parameters,
      CGAL::Emptyset_iterator(), Part_runner::by<Concurrency_tag>());
}

} // namespace haptic_sculpt
