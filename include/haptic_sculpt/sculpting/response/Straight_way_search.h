// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/sculpting/response/Search_round.h>
#include <haptic_sculpt/sculpting/response/Slide_walk.h>

namespace haptic_sculpt::internal {

/// Where a walk has ended, no plane is taken at its word any more: looks for a free straight way that leads nearer to
/// the target, by deciding motions (doc/proofs/slide.md, "The search for straight ways").
///
/// Near J what is free is bounded by planes: those of contacts, and those through J that graze the border of a facet,
/// past which there is no obstacle. Of all directions in which it is free the best is that of the target, or that as
/// seen along one of these planes, or a line in which two of them meet. So these are tried, and what is in the way
/// tells of further planes.
template <class Mesh>
class Straight_way_search {
public:
  using Walk = Slide_walk<Mesh>;

  /// A walk that follows such a way makes at most this many legs.
  static constexpr int trial_legs = 8;

  /// Something has changed: where none was found there may be one now.
  void forget() { memory_.forget(); }

  /// Whether the search has found nothing, or there was no need for one: as far as is known J is at a nearest point.
  bool is_settled() const { return is_settled_; }

  /// Goes such ways, each followed by a walk, as long as there are any. Returns whether there was one.
  template <class Guard>
  bool take(Walk& walk, Guard& guard, Search_round& round, const Vector& target, int most_legs) {
    bool any = false;
    is_settled_ = false;
    for (int times = 0; times < most_times && walk.legs() < most_legs && !is_settled_; ++times) {
      round.search_at(walk.x, target, walk.lengths());
      is_settled_ = walk.x == target || is_certain(walk, target) || memory_.holds(walk.x, target, walk.lengths());
      if (is_settled_)
        break;
      if (!look(walk, guard, round, target)) {
        if (guard.is_spent())
          break;
        is_settled_ = true;
        round.note(memory_);
        if (walk.facets.empty())
          take_contacts(walk);
        break;
      }
      any = true;
      trial_.begin_at(walk);
      trial_.step_to(best_);
      trial_.forget_progress();
      walk = trial_;
      trial_.go_instead_of(walk, guard, target, std::min(trial_.legs() + trial_legs, most_legs), 0);
    }
    return any;
  }

private:
  using Search = Search_round::Search;

  static constexpr int most_times = 16;
  /// More planes than these are not combined with each other.
  static constexpr std::size_t most_planes = 16;
  /// In clearances: borders nearer than this are looked past, and what stops a way nearer than this is near.
  static constexpr double near = 1024;
  static constexpr int most_lengths = 8;
  static constexpr double next_length = 0.25;
  /// As the cosine of an angle: a way that is stopped by a plane which it follows is stopped by rounding.
  static constexpr double parallel = 0x1p-30;

  Walk trial_;
  Vector x_{}, pull_{}, best_{};
  Slide_lengths lengths_{}; ///< at x
  Drag_rules rules_;
  double distance_ = 0, gain_ = 0;
  boost::container::static_vector<Vector, most_planes> normals_;
  boost::container::static_vector<Vector, 4> curved_;        ///< of the delta rule's surfaces
  boost::container::static_vector<Contact_3<Mesh>, 16> met_; ///< near J
  Search_memory memory_;
  bool is_settled_ = false;

  /// Whether what holds J are facets with J so far inside of them, or at borders over which another one goes on as
  /// high, that no way leads round them. Not where its clearances alone hold it, so that it could go far if it kept
  /// none: in a gap that closes by less than a clearance on a long way.
  static bool is_certain(const Walk& walk, const Vector& target) {
    const Slide_lengths& lengths = walk.lengths();
    const Nearest_permitted held = walk.nearest(walk.pull_to(target), 0);
    if (!held.exists || held.is_squeezed || held.number_active == 0 || length(held.displacement) > lengths.lifted())
      return false;
    const auto is_solid = [&](const Facet<Mesh>& facet) {
      if (facet.contact().is_flat || facet.is_over(Slide_lengths::clearances_of_lift))
        return false;
      for (int k = 0; k < facet.borders(); ++k)
        if (facet.beyond_border(k, walk.x) > -near * lengths.clearance && !walk.is_closed(facet, k))
          return false;
      return true;
    };
    for (int i = 0; i < held.number_active; ++i) {
      const Vector& normal = walk.facets[held.active[static_cast<std::size_t>(i)]].normal();
      if (std::none_of(walk.facets.begin(), walk.facets.end(), [&](const Facet<Mesh>& facet) {
            return Walk::is_alike(facet.normal(), normal) && is_solid(facet);
          }))
        return false;
    }
    return true;
  }

  template <class Guard>
  bool look(const Walk& walk, Guard& guard, Search_round& round, const Vector& target) {
    x_ = walk.x;
    pull_ = walk.pull_to(target);
    distance_ = length(pull_);
    lengths_ = walk.lengths();
    rules_ = walk.rules();
    if (!round.is_resumed(Search::straight_ways)) {
      normals_.clear();
      curved_.clear();
      met_.clear();
    }
    const double least = gain_ = lengths_.lifted();
    if (distance_ <= lengths_.shortest_pull())
      return false;
    for (const auto& facet : walk.facets)
      see(facet.contact());
    const auto try_if_due = [&](Search search, const Vector& way) {
      if (round.is_due(search, guard.work()))
        try_way(guard, way);
    };
    try_if_due(Search::straight_ways, pull_);
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        for (int signs = 0; signs < 4 && i != j; ++signs) {
          Vector v{};
          v[static_cast<std::size_t>(i)] = 1;
          v[static_cast<std::size_t>(j)] = (signs & 1) != 0 ? -2 : 2;
          v[static_cast<std::size_t>(3 - i - j)] = (signs & 2) != 0 ? -3 : 3;
          try_if_due(Search::straight_ways, v);
        }
    for (std::size_t i = 0; i < normals_.size(); ++i) { // normals_ grows on the way
      const Vector n = normals_[i];
      try_if_due(Search::straight_ways, advanced(pull_, -dot(pull_, n), n));
      for (std::size_t j = 0; j < i; ++j)
        try_if_due(Search::straight_ways, cross(n, normals_[j]));
    }
    // What curves towards J lets it go only on ways that rise over the tangent plane.
    const Vector pull = scaled(pull_, unit_of(distance_)); // as in gain_at()
    // curved_ grows on the way, too.
    for (std::size_t i = 0; i < curved_.size(); ++i)
      for (std::size_t j = 0; j <= i; ++j) {
        const Vector n = curved_[i], m = curved_[j];
        const Vector way = i == j ? advanced(pull, -dot(pull, n), n) : cross(n, m);
        for (double slope = 0x1p-2; slope > 0x1p-24; slope /= 8)
          try_if_due(Search::rising_ways,
                     advanced(dot(way, pull) < 0 ? scaled(way, -1) : way, slope * length(way), plus(n, m)));
      }
    return gain_ > least;
  }

  /// J rests where it has come by a way that was found here: what holds it is what it has met on the others.
  void take_contacts(Walk& walk) const {
    for (const auto& contact : met_)
      walk.meet(contact, walk.x);
    const double resolution = walk.lengths().resolution;
    walk.forget([&](const Facet<Mesh>& facet) {
      return facet.is_over(Slide_lengths::clearances_of_lift) || facet.is_past(walk.x, resolution);
    });
  }

  double gain_at(const Vector& y) const {
    const Vector step = minus(y, x_);
    const double left = length(minus(pull_, step));
    const double unit = unit_of(distance_); // else the product of two lengths might leave the range
    return dot(scaled(step, unit), minus(scaled(pull_, 2), step)) / ((distance_ + left) * unit);
  }

  template <class Guard>
  bool take_if_free(Guard& guard, const Vector& y) {
    if (y == x_ || !(gain_at(y) > gain_) || !guard.is_free(x_, y, rules_.delta))
      return false;
    best_ = y;
    gain_ = gain_at(y);
    return true;
  }

  /// Decides the way up to where it is nearest to the target, or up to what is in the way.
  template <class Guard>
  void try_way(Guard& guard, const Vector& way) {
    Vector direction = normalized(way);
    double along = dot(direction, pull_);
    if (along < 0) {
      along = -along;
      direction = scaled(direction, -1);
    }
    boost::container::static_vector<Vector, 4> followed;
    for (int i = 0; i < most_lengths; ++i, along *= next_length) {
      const Vector y = followed.empty() ? advanced(x_, along, direction)
                                        : nearest_to_planes(advanced(x_, along, direction), followed);
      if (!(gain_at(y) > gain_))
        return;
      const auto decision = guard.decide(x_, y, rules_.delta);
      if (decision.is_free()) {
        best_ = y;
        gain_ = gain_at(y);
        return;
      }
      boost::container::static_vector<Contact_3<Mesh>, most_planes> met;
      const double time = decision.for_each_first_contact([&](const Contact_3<Mesh>& contact, double) {
        if (met.size() < met.capacity())
          met.push_back(contact);
      });
      const std::size_t followed_before = followed.size();
      for (const auto& contact : met) {
        const Vector normal = coordinates(contact.normal);
        if (std::abs(dot(normal, direction)) < parallel && followed.size() < followed.capacity())
          followed.push_back(normal);
        if (time * along > near * lengths_.clearance)
          continue;
        see(contact);
        if (met_.size() < met_.capacity())
          met_.push_back(contact);
      }
      if (take_if_free(guard, point_of_path(x_, y, 0.9375 * time)) ||
          take_if_free(guard, point_of_path(x_, y, 0.5 * time)) || followed.size() == followed_before)
        return;
      if (take_if_free(guard, nearest_to_planes(y, followed)))
        return;
    }
  }

  /// In a gap of a few units in the last place rounding decides on which side of a plane a point is: of those about y
  /// the one that is nearest to the planes through x.
  Vector nearest_to_planes(const Vector& y, const boost::container::static_vector<Vector, 4>& normals) const {
    Vector best = y;
    double least = std::numeric_limits<double>::infinity();
    for (int i = 0; i < 27; ++i) {
      Vector z = y;
      for (int k = 0, digits = i; k < 3; ++k, digits /= 3)
        if (digits % 3 != 0)
          z[static_cast<std::size_t>(k)] =
              std::nextafter(z[static_cast<std::size_t>(k)], digits % 3 == 1 ? -HUGE_VAL : HUGE_VAL);
      const Vector step = minus(z, x_);
      double off = 0;
      for (const Vector& n : normals)
        off += std::abs(dot(n, step));
      if (off < least) {
        least = off;
        best = z;
      }
    }
    return best;
  }

  void see_plane(const Vector& normal) {
    const bool is_new =
        std::none_of(normals_.begin(), normals_.end(), [&](const Vector& n) { return Walk::is_alike(n, normal); });
    if (is_new && normals_.size() < normals_.capacity())
      normals_.push_back(normal);
  }

  /// Takes in the plane of the contact, and those through x that graze the borders of its facet.
  void see(const Contact_3<Mesh>& contact) {
    const Vector normal = coordinates(contact.normal);
    see_plane(normal);
    if (contact.kind == Contact_kind::delta) {
      if (curved_.size() < curved_.capacity() &&
          std::none_of(curved_.begin(), curved_.end(), [&](const Vector& n) { return n == normal; }))
        curved_.push_back(normal);
      return;
    }
    Facet<Mesh> facet(contact, x_);
    const double c = lengths_.clearance;
    if (contact.is_flat) {
      // The planes of all ways that leave the wall's plane by some clearances where they end.
      const Vector side = facet.normal_of_wall();
      for (const double tilt : {4 * c, -4 * c})
        see_plane(normalized(advanced(scaled(side, distance_), -tilt, scaled(pull_, 1 / distance_))));
      return;
    }
    facet.measure(x_, rules_);
    const double height = std::fmax(facet.height(), 0.0), beside = c / 8;
    for (int k = 0; k < facet.borders(); ++k) {
      const double inside = -facet.beyond_border(k, x_);
      if (inside < -2 * c || inside > near * c)
        continue;
      // Seen along the border: from J, `height` over the plane, past a point of the plane right beside the border.
      see_plane(normalized(advanced(scaled(facet.outward(k), height), inside + beside, facet.normal())));
    }
  }
};

} // namespace haptic_sculpt::internal
