// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/surface/validity/Face_soup.h>

#include <CGAL/Kd_tree.h>
#include <CGAL/Orthogonal_k_neighbor_search.h>
#include <CGAL/Search_traits_3.h>
#include <CGAL/Search_traits_adapter.h>
#include <CGAL/property_map.h>

#include <algorithm>
#include <cmath>

namespace haptic_sculpt::internal {

/// Each point of `to` gets the values of the first point of `from` at its place; one that has moved, of the nearest.
/// Distances are rounded, in a unit of the size of `to`: squares of small ones would be 0. \pre all points are finite
inline void copy_attributes(const Face_soup& from, Face_soup& to) {
  if (from.attributes.empty() || from.points.empty())
    return;
  using Entry = std::pair<Face_soup::Point_3, std::size_t>;
  using Traits = CGAL::Search_traits_adapter<Entry, CGAL::First_of_pair_property_map<Entry>,
                                             CGAL::Search_traits_3<Decision_kernel>>;
  double largest = 0;
  for (const auto& p : to.points)
    largest = std::max({largest, std::fabs(p[0]), std::fabs(p[1]), std::fabs(p[2])});
  const int exponent = largest > 0 ? std::ilogb(largest) : 0;
  const auto in_unit = [exponent](const Face_soup::Point_3& p) {
    const auto one = [exponent](double x) { // squares stay in range; nothing that far is nearest
      return std::clamp(std::ldexp(x, -exponent), -0x1p200, 0x1p200);
    };
    return Face_soup::Point_3(one(p[0]), one(p[1]), one(p[2]));
  };
  const auto first_of_each_place = [](std::vector<Entry>& entries) {
    std::sort(entries.begin(), entries.end());
    const auto is_one_place = [](const Entry& a, const Entry& b) { return a.first == b.first; };
    entries.erase(std::unique(entries.begin(), entries.end(), is_one_place), entries.end());
  };
  std::vector<Entry> places, entries;
  for (std::size_t v = 0; v < from.points.size(); ++v)
    places.emplace_back(from.points[v], v);
  first_of_each_place(places);
  for (const Entry& place : places)
    entries.emplace_back(in_unit(place.first), place.second);
  first_of_each_place(entries); // CGAL's tree is as deep as points are equal
  CGAL::Kd_tree<Traits> tree(entries.begin(), entries.end());
  const auto source_of = [&](const Face_soup::Point_3& p) {
    const auto place = std::lower_bound(places.begin(), places.end(), Entry(p, 0));
    if (place != places.end() && place->first == p)
      return place->second;
    return CGAL::Orthogonal_k_neighbor_search<Traits>(tree, in_unit(p), 1).begin()->first.second;
  };
  to.attributes = from.attributes;
  for (Vertex_attribute& attribute : to.attributes)
    attribute.values.assign(to.points.size(), 0);
  for (std::size_t v = 0; v < to.points.size(); ++v) {
    const std::size_t source = source_of(to.points[v]);
    for (std::size_t k = 0; k < to.attributes.size(); ++k)
      to.attributes[k].values[v] = from.attributes[k].values[source];
  }
}

} // namespace haptic_sculpt::internal
