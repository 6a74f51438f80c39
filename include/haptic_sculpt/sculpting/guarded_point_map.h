// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/sculpting/Sculptor.h>
#include <haptic_sculpt/sculpting/geometry/stop.h>
#include <haptic_sculpt/surface/vertex_coordinates.h>

#include <boost/property_map/property_map.hpp>

#include <memory>

namespace haptic_sculpt {

/// What a guarded point map does with a point to which there is no free way.
enum class Guard_policy : std::uint8_t {
  back_off, ///< the vertex goes 1/2, else 1/4, else 1/8 of the way, else it stays: keeps triangles in shape
  stop,     ///< it goes as far as it can
  slide,    ///< it goes as near as it can
  whole     ///< it stays
};

/// What a guarded point map was asked and did.
struct Guard_counts {
  std::size_t puts = 0;         ///< points written
  std::size_t refused = 0;      ///< of these, those at which the vertex is not: it went a part of the way, or stays
  std::size_t out_of_range = 0; ///< of the refused, those that are no point in range: not a number, say
  double asked = 0;             ///< sum of the distances asked for, those out of range not counted
  double left = 0;              ///< sum of the distances that were left
};

/// A model of `ReadWritePropertyMap` from vertices to points to be passed as `vertex_point_map` to functions that only
/// move points: each `put` is a proven drag. So whatever the function writes, the mesh stays embedded.
///
/// Copies count together. Refers to the Sculptor, which must outlive it. doc/use/many_vertices.md tells which functions
/// of CGAL it serves. To have all that a function does as one step of the history, call it while there is a
/// `Sculptor::stroke()`.
template <class Sculptor>
class Guarded_point_map {
public:
  /// \name What property maps tell
  ///@{

  using key_type = typename Sculptor::Vertex_index;    ///< a vertex of the mesh
  using value_type = typename Sculptor::Point;         ///< its point
  using reference = const value_type&;                 ///< to the point in the mesh, to be read only
  using category = boost::read_write_property_map_tag; ///< put() is a drag
  ///@}

  /// Counts from 0. \param sculptor must outlive this and its copies
  Guarded_point_map(Sculptor& sculptor, Guard_policy policy)
      : sculptor_(&sculptor), policy_(policy), counts_(std::make_shared<Guard_counts>()) {}
  // No move, which would leave a map that has no counts: what is moved is copied.
  Guarded_point_map(const Guarded_point_map&) = default;            ///< which counts with it
  Guarded_point_map& operator=(const Guarded_point_map&) = default; ///< likewise

  /// How many points were written at which their vertices are not.
  std::size_t refused() const { return counts_->refused; }
  const Guard_counts& counts() const { return *counts_; }  ///< of all copies, since reset_counts()
  void reset_counts() const { *counts_ = Guard_counts(); } ///< of all copies, to 0

  /// Where v is now. \pre v is in the mesh
  friend reference get(const Guarded_point_map& map, key_type v) { return map.sculptor_->mesh().point(v); }

  /// Drags v towards p. A point that is not finite or out of range is refused, and counted, whatever the policy.
  /// \throw Unknown_vertex, Mesh_changed: e.g. where the function changes connectivity, too; flips are found where v is
  /// a vertex of what was flipped; Invalid_parameter where the scene has outgrown the clearance, and v may stop or
  /// slide
  friend void put(const Guarded_point_map& map, key_type v, const value_type& p) { map.write(v, p); }

private:
  Sculptor* sculptor_;
  Guard_policy policy_;
  std::shared_ptr<Guard_counts> counts_;

  /// Of the way back_off tries so much, one after the other.
  static constexpr double shares[] = {1, 0.5, 0.25, 0.125};

  void write(key_type v, const value_type& p) const {
    const internal::Rounding_to_nearest rounding;
    internal::check_vertex(sculptor_->mesh(), v);
    const internal::Coordinates target = internal::coordinates(p);
    if (!is_in_range(target)) {
      ++counts_->puts;
      ++counts_->refused;
      ++counts_->out_of_range;
      return;
    }
    const internal::Coordinates source = vertex_coordinates(sculptor_->mesh(), v);
    move(v, source, target);
    ++counts_->puts; // what throws is counted in nothing
    const internal::Coordinates end = vertex_coordinates(sculptor_->mesh(), v);
    counts_->refused += end != target;
    counts_->asked += internal::path_length(source, target);
    counts_->left += internal::path_length(end, target);
  }

  void move(key_type v, const internal::Coordinates& source, const internal::Coordinates& target) const {
    const bool slides = policy_ == Guard_policy::slide;
    Drag_parameters drag = sculptor_->parameters().drag;
    drag.response(slides ? Response::slide : Response::stop).once(!slides);
    if (slides || policy_ == Guard_policy::stop) {
      sculptor_->drag(v, {target[0], target[1], target[2]}, drag);
      return;
    }
    for (const double share : shares) {
      const internal::Coordinates p = share == 1 ? target : internal::point_of_path(source, target, share);
      if (sculptor_->move_if_free(v, {p[0], p[1], p[2]}, drag) || policy_ == Guard_policy::whole)
        return;
    }
  }
};

/// Makes one.
template <class Sculptor>
Guarded_point_map<Sculptor> guarded_point_map(Sculptor& sculptor, Guard_policy policy = Guard_policy::back_off) {
  return Guarded_point_map<Sculptor>(sculptor, policy);
}

} // namespace haptic_sculpt
