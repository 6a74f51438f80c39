// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <CGAL/Surface_mesh.h>
#include <boost/property_map/property_map.hpp>

#include <type_traits>
#include <utility>

namespace haptic_sculpt::internal {

/// The visitor hears of what an element comes from, if it has `face_replaces(created, dead)`, or `edge_replaces`.
template <class Visitor>
auto replaces(Visitor& visitor, CGAL::SM_Face_index created, CGAL::SM_Face_index dead)
    -> decltype(void(visitor.face_replaces(created, dead))) {
  visitor.face_replaces(created, dead);
}
template <class Visitor>
auto replaces(Visitor& visitor, CGAL::SM_Edge_index created, CGAL::SM_Edge_index dead)
    -> decltype(void(visitor.edge_replaces(created, dead))) {
  visitor.edge_replaces(created, dead);
}

template <class Visitor, class Key, class = void>
struct Hears_of : std::false_type {};
template <class Visitor, class Key>
struct Hears_of<Visitor, Key, std::void_t<decltype(replaces(std::declval<Visitor&>(), Key(), Key()))>>
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
  friend void put(const Lineage_map& map, Key created, Key dead) { replaces(*map.visitor, created, dead); }
};

} // namespace haptic_sculpt::internal
