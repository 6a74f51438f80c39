// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <boost/property_map/property_map.hpp>

#include <type_traits>
#include <utility>

namespace haptic_sculpt::internal {

/// Whether a visitor has `face_replaces(created, dead)`, or `edge_replaces`.
template <class Visitor, class Face_index, class = void>
struct Hears_of_faces : std::false_type {};
template <class Visitor, class Face_index>
struct Hears_of_faces<Visitor, Face_index,
                      std::void_t<decltype(std::declval<Visitor&>().face_replaces(Face_index(), Face_index()))>>
    : std::true_type {};
template <class Visitor, class Edge_index, class = void>
struct Hears_of_edges : std::false_type {};
template <class Visitor, class Edge_index>
struct Hears_of_edges<Visitor, Edge_index,
                      std::void_t<decltype(std::declval<Visitor&>().edge_replaces(Edge_index(), Edge_index()))>>
    : std::true_type {};

/// As a property map: the value of an element is its descriptor, so what a new element is given is what it comes from,
/// and the visitor hears of it.
template <class Visitor, class Key>
struct Lineage_map {
  using key_type = Key;
  using value_type = Key;
  using reference = Key;
  using category = boost::read_write_property_map_tag;

  Visitor* visitor;

  friend Key get(const Lineage_map&, Key key) { return key; }
  friend void put(const Lineage_map& map, Key created, Key dead) {
    if constexpr (Hears_of_faces<Visitor, Key>::value)
      map.visitor->face_replaces(created, dead);
    else
      map.visitor->edge_replaces(created, dead);
  }
};

} // namespace haptic_sculpt::internal
