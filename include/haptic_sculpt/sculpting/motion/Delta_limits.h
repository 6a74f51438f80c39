// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/sculpting/Contact_3.h>
#include <haptic_sculpt/sculpting/geometry/delta_limit.h>
#include <haptic_sculpt/sculpting/geometry/stop.h>
#include <haptic_sculpt/surface/connectivity/star.h>

namespace haptic_sculpt::internal {

/// Where faces of a star reach the delta rule first in a motion, exactly. Costs nothing where delta is 0.
template <class Mesh>
class Delta_limits {
public:
  void clear() { limits_.clear(); }
  bool empty() const { return limits_.empty(); }
  /// \pre not empty
  const Limit_time& time() const { return limits_[0].time; }

  static bool are_kept(const Star<Mesh>& star, const Coordinates& source, const Coordinates& target, double delta) {
    bool kept = true;
    for_each(star, source, target, delta, [&](const Limit&) { return kept = false; });
    return kept;
  }

  /// Keeps those that come exactly first.
  void find(const Star<Mesh>& star, const Coordinates& source, const Coordinates& target, double delta) {
    limits_.clear();
    for_each(star, source, target, delta, [&](Limit limit) {
      const CGAL::Comparison_result order =
          limits_.empty() ? CGAL::SMALLER : CGAL::compare(limit.time, limits_[0].time);
      if (order == CGAL::SMALLER)
        limits_.clear();
      if (order != CGAL::LARGER)
        limits_.push_back(std::move(limit));
      return true;
    });
  }

  /// Calls `found(contact)` for each; returns when, in double. \pre not empty
  template <class Found>
  double for_each_contact(const Star<Mesh>& star, const Coordinates& source, const Coordinates& target,
                          const Found& found) const {
    const double time = CGAL::to_double(limits_[0].time);
    for (const Limit& limit : limits_)
      found(contact_of(limit, star, point_of_path(source, target, time)));
    return time;
  }

  /// How far J, come from the source to p, is at least from where one of their altitudes is what it may not fall below:
  /// its excess over its slope.
  double least_distance(const Star<Mesh>& star, const Coordinates& source, const Coordinates& p, double delta) const {
    double least = std::numeric_limits<double>::infinity();
    for (const Limit& limit : limits_) {
      const Coordinates &g = star.link_points[limit.face], &i = star.link_points[star.next(limit.face)];
      const double least_altitude = std::fmin(delta, altitude(source, g, i, limit.side));
      least = std::fmin(least, distance_to_altitude(p, g, i, limit.side, least_altitude));
    }
    return least;
  }

private:
  /// The delta rule reached by face i of the star.
  struct Limit {
    std::size_t face;
    Altitude_over side;
    Limit_time time;
  };

  std::vector<Limit> limits_;

  template <class Found>
  static void for_each(const Star<Mesh>& star, const Coordinates& source, const Coordinates& target, double delta,
                       const Found& found) {
    if (delta <= 0)
      return;
    for (std::size_t i = 0; i < star.valence(); ++i)
      for (const Altitude_over side : {Altitude_over::gi, Altitude_over::ji, Altitude_over::jg})
        if (auto time = delta_limit(source, target, star.link_points[i], star.link_points[star.next(i)], delta, side))
          if (!found(Limit{i, side, *std::move(time)}))
            return;
  }

  static Contact_3<Mesh> contact_of(const Limit& limit, const Star<Mesh>& star, const Coordinates& at) {
    const std::size_t next = star.next(limit.face);
    const auto g = star.link[limit.face], i = star.link[next];
    const Coordinates &from = star.link_points[limit.face], &to = star.link_points[next];
    Contact_3<Mesh> contact;
    contact.kind = Contact_kind::delta;
    contact.vertices = {g, i, limit.side == Altitude_over::gi ? star.centre : limit.side == Altitude_over::ji ? g : i};
    const Vector normal = altitude_gradient(at, from, to, limit.side);
    contact.normal = {normal[0], normal[1], normal[2]};
    const auto point = [](const Coordinates& p) { return typename Mesh::Point(p[0], p[1], p[2]); };
    contact.plane = {point(from), point(to), point(to)};
    contact.is_flat = true;
    return contact;
  }
};

} // namespace haptic_sculpt::internal
