// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef HAPTIC_SCULPT_SCULPTING_APPLY_BRUSH_H
#define HAPTIC_SCULPT_SCULPTING_APPLY_BRUSH_H

#include <haptic_sculpt/sculpting/brushes/brush_targets.h>
#include <haptic_sculpt/sculpting/move_vertices.h>

#include <algorithm>

namespace haptic_sculpt {
namespace internal {

/// Where several dabs want vertices, each worked out from the mesh as it is; of one that several touch, their ways together.
template <class Sculptor, class Dabs, class Mask_map>
auto brush_motions(Sculptor& sculptor, const Dabs& dabs, const Mask_map& mask) {
  using Mesh = typename Sculptor::Mesh_type;
  using Vector_3 = typename CGAL::Kernel_traits<typename Mesh::Point>::Kernel::Vector_3;
  const Mesh& mesh = sculptor.mesh();
  std::vector<std::pair<typename Mesh::Vertex_index, Vector_3>> ways;
  for (const auto& dab : dabs) {
    if (!(dab.radius > 0))
      throw Invalid_parameter("the radius of a brush must be more than 0, not " + number(dab.radius));
    const auto nearest = sculptor.nearest_vertex(dab.centre, dab.radius);
    if (!nearest.is_valid())
      continue;
    const auto vertices = touched_vertices(mesh, dab, nearest);
    const auto own = brush_ways(vertices, mesh, dab, mask);
    for (std::size_t k = 0; k < vertices.size(); ++k)
      ways.emplace_back(vertices[k], own[k]);
  }
  std::stable_sort(ways.begin(), ways.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  std::size_t count = 0;
  for (std::size_t k = 0; k < ways.size(); ++k)
    if (count != 0 && ways[count - 1].first == ways[k].first)
      ways[count - 1].second = ways[count - 1].second + ways[k].second;
    else
      ways[count++] = ways[k];
  ways.resize(count);
  return ways;
}

} // namespace internal

/// Dabs with brushes, all at once: each vertex goes by the sum of what they want, as far as it is free on the way. One batch,
/// one step of the history. So a dab and its mirror image (mirrored()) are one, and neither comes first.
///
/// \param dabs a range of Brush_dab; those that touch nothing count for nothing
/// \param mask a readable map from vertices to how much they take part, from 0 to 1
/// \param parameters by default vertices that are in the way of others stop, and go on with the next dab:
/// `Move_parameters().steps(false).slide(false)`
/// \return as move_vertices(); `asked` is 0 where nothing is in reach
/// \throw Invalid_parameter, Out_of_range: nothing has moved; Mesh_changed. Cost: some microseconds a vertex.
template <class Sculptor, class Dabs, class Mask_map>
Move_report apply_brush(Sculptor& sculptor, const Dabs& dabs, const Mask_map& mask,
                        const Move_parameters& parameters = Move_parameters().steps(false).slide(false)) {
  using Mesh = typename Sculptor::Mesh_type;
  const internal::Rounding_to_nearest rounding;
  const auto ways = internal::brush_motions(sculptor, dabs, mask);
  std::vector<typename Mesh::Vertex_index> vertices;
  for (const auto& way : ways)
    vertices.push_back(way.first);
  std::size_t next = 0;
  return internal::move_to_targets(
      sculptor, vertices, [&](auto v) { return sculptor.mesh().point(v) + ways[next++].second; }, parameters, CGAL::Emptyset_iterator());
}

/// The same without a mask, of a single dab.
template <class Sculptor, class Kernel>
Move_report apply_brush(Sculptor& sculptor, const Brush_dab<Kernel>& dab) {
  return apply_brush(sculptor, std::array<Brush_dab<Kernel>, 1>{dab},
                     boost::static_property_map<double, typename Sculptor::Vertex_index>(1.0));
}

} // namespace haptic_sculpt

#endif
