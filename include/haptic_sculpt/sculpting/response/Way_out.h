// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef HAPTIC_SCULPT_SCULPTING_WAY_OUT_H
#define HAPTIC_SCULPT_SCULPTING_WAY_OUT_H

#include <haptic_sculpt/sculpting/response/Slide_walk.h>

namespace haptic_sculpt {
namespace internal {

/// Half-spaces forbid more than facets do: at a corner that is neither convex nor concave there may be a way on
/// although the planes meet. Looks for one where a walk has settled (doc/proofs/slide.md, "The way out").
template <class Mesh>
class Way_out {
public:
  using Walk = Slide_walk<Mesh>;

  /// This many legs are tried to show that a way out of a mixed corner is one.
  static constexpr int trial_legs = 4;
  /// At most this many ways out of one place are tried.
  static constexpr int most_trials = 64;

  /// Something has changed: where none was found there may be one now.
  void forget() { sought_ = false; }

  /// Takes a way if it brings the vertex nearer by more than what clearances can feign. Returns whether there was one.
  template <class Guard>
  bool take(Walk& walk, Guard& guard, const Vector& target, int most_legs) {
    walk_ = &walk;
    most_legs_ = most_legs;
    const Slide_lengths lengths = walk_->lengths(); // trials may change those of the walk
    const Vector pull = walk_->pull_to(target);
    if (walk_->facets.empty() || length(pull) <= lengths.shortest_pull())
      return false;
    // A target is nearer by as much as it has moved at most: below what clearances can feign the answer is the same as
    // before.
    if (sought_ && length(minus(walk_->x, sought_at_)) <= lengths.settled() &&
        length(minus(target, sought_for_)) <= 4 * lengths.clearance)
      return false;
    if (!may_lead_on(guard))
      return false;
    const auto held = walk_->nearest(pull, 1);
    const auto without_clearance = walk_->nearest(pull, 0);
    const double gain =
        std::fmax(8 * lengths.clearance, without_clearance.exists ? 4 * length(without_clearance.displacement) : 0);
    int trials = 0;
    guard.work().search_at(walk_->x);
    if (!guard.work().is_resumed())
      seen_ = walk_->facets;
    const auto brings_nearer = [&](const Vector& first_aim) {
      ++trials;
      trial_.forget_progress();
      if (first_aim != target) {
        trial_.go(guard, first_aim,
                  std::min(trial_.legs() + 1, most_legs_)); // one leg: on from there it must not climb
        trial_.forget_progress();
      }
      const bool is_nearer =
          trial_.go_instead_of(*walk_, guard, target, std::min(walk_->legs() + trial_legs, most_legs_), gain);
      for (const auto& facet : trial_.facets)
        remember(facet);
      return is_nearer;
    };
    const bool all_legs_were_left = walk_->legs() + trial_legs <= most_legs;
    if (leave_contacts(guard, held, target, brings_nearer) || leave_walls(guard, target, brings_nearer) ||
        follow_features(guard, pull, target, trials, brings_nearer) ||
        look_about(guard, pull, target, gain, brings_nearer)) {
      sought_ = false;
      return true;
    }
    sought_ = all_legs_were_left && !guard.is_spent();
    sought_at_ = walk_->x;
    sought_for_ = target;
    return false;
  }

private:
  Walk* walk_ = nullptr; ///< set in take()
  int most_legs_ = 0;
  Walk trial_;
  typename Walk::Facets seen_; ///< all that was met meanwhile
  bool sought_ = false;
  Vector sought_at_{}, sought_for_{}; ///< where no way was found, and to which target

  /// Two faces form a convex edge, round which a way may lead, where one falls off from the other's plane by more than
  /// this: a smaller angle, of 1e-12 radians, is none that a clearance or a rounded normal can tell from a seam.
  static constexpr double least_slope = 0x1p-40;

  /// The same for planes of contacts that do not share an edge: a thousandth of a radian.
  static constexpr double least_rise = 0x1p-10;

  /// Whether there may be a way past a border of some contact. Where all contacts near one are faces and each goes over
  /// to another of them, rising or flat, there is none: a concave edge or corner, all of which is known. Where other
  /// contacts rise across all borders, and J is near no corner, it is likely one, and looking beyond their planes
  /// tells.
  template <class Guard>
  bool may_lead_on(Guard& guard) const {
    bool is_doubtful = false;
    for (const auto& facet : walk_->facets) {
      if (facet.is_wall())
        return true;
      int open = 0;
      for (int k = 0; k < facet.borders(); ++k)
        if (facet.beyond_border(k, walk_->x) > -walk_->lengths().border() && !is_closed(facet, k))
          if (!does_rise(facet.outward(k)) || ++open > 1)
            return true;
      is_doubtful = is_doubtful || open > 0;
    }
    return is_doubtful && sees_beyond_a_contact(guard);
  }

  bool does_rise(const Vector& way) const {
    for (const auto& facet : walk_->facets)
      if (dot(facet.normal(), way) < -least_rise)
        return true;
    return false;
  }

  /// Whether a place beyond the plane of a contact is free to be reached: along other contacts past its border, or in
  /// any of many directions.
  template <class Guard>
  bool sees_beyond_a_contact(Guard& guard) const {
    const auto is_free = [&](const Vector& direction) {
      return guard.is_free(walk_->x, advanced(walk_->x, walk_->lengths().lifted(), direction), walk_->delta());
    };
    for (const auto& facet : walk_->facets)
      for (int k = 0; k < facet.borders(); ++k)
        for (const auto& other : walk_->facets) {
          const Vector& out = facet.outward(k);
          if (&other == &facet || facet.beyond_border(k, walk_->x) <= -walk_->lengths().border())
            continue;
          const Vector along = normalized(advanced(out, -dot(out, other.normal()), other.normal()));
          if (dot(facet.normal(), along) < -least_rise && is_free(along))
            return true;
        }
    constexpr double beyond = -0.25; // by a clearance at least, over 8 clearances from one above it
    for (const Vector& direction : directions())
      for (const auto& facet : walk_->facets)
        if (dot(facet.normal(), direction) < beyond) {
          if (is_free(direction))
            return true;
          break;
        }
    return false;
  }

  bool is_closed(const Facet<Mesh>& facet, int border) const {
    for (const auto& other : walk_->facets)
      if (&other != &facet && facet.shares_border(border, other) &&
          dot(other.normal(), facet.outward(border)) < least_slope)
        return true;
    return false;
  }

  /// Tries to go without some of the contacts that hold.
  template <class Guard, class Brings_nearer>
  bool leave_contacts(Guard& guard, const Nearest_permitted& held, const Vector& target,
                      const Brings_nearer& brings_nearer) {
    const unsigned subsets = 1u << (held.exists ? held.number_active : 0);
    for (unsigned subset = 1; subset < subsets; ++subset) {
      if (!guard.work().is_due())
        continue;
      trial_ = *walk_;
      trial_.forget([&](const auto& facet) {
        for (int i = 0; i < held.number_active; ++i)
          if ((subset >> i & 1) != 0 && Walk::is_alike(facet.normal(), walk_->facets[held.active[i]].normal()))
            return true;
        return false;
      });
      if (brings_nearer(target))
        return true;
    }
    return false;
  }

  /// A flat impact blocks the way in one plane only: tries both sides of that plane.
  template <class Guard, class Brings_nearer>
  bool leave_walls(Guard& guard, const Vector& target, const Brings_nearer& brings_nearer) {
    const Slide_lengths lengths = walk_->lengths();
    for (const auto& facet : walk_->facets)
      for (const double height : {4 * lengths.clearance, -4 * lengths.clearance}) {
        if (!facet.is_wall() || walk_->legs() >= most_legs_)
          break;
        if (!guard.work().is_due())
          continue;
        const Vector beside = advanced(walk_->x, height, facet.normal_of_wall());
        if (beside == walk_->x || !guard.is_free(walk_->x, beside, walk_->delta()))
          continue;
        trial_.begin_at(*walk_);
        trial_.step_to(beside);
        if (brings_nearer(target))
          return true;
      }
    return false;
  }

  /// The paper's vertex rule (3.2.2 c): from a little off, tries every face and every edge that was met here.
  template <class Guard, class Brings_nearer>
  bool follow_features(Guard& guard, const Vector& pull, const Vector& target, const int& trials,
                       const Brings_nearer& brings_nearer) {
    const Slide_lengths lengths = walk_->lengths();
    const Vector lifted = off_the_contacts(guard);
    const double beside = lengths.border() / 4;
    const auto start = [&] {
      trial_.begin_at(*walk_);
      if (lifted != walk_->x && trial_.legs() < most_legs_)
        trial_.step_to(lifted);
    };
    // seen_ grows on the way.
    for (std::size_t i = 0; i < seen_.size() && trials < most_trials; ++i) {
      if (guard.work().is_due()) {
        start();
        trial_.facets.push_back(seen_[i]);
        trial_.place(trial_.x);
        if (brings_nearer(target))
          return true;
      }
      for (int k = 0; k < seen_[i].borders() && trials < most_trials; ++k) {
        if (seen_[i].beyond_border(k, walk_->x) < -lengths.border() || !guard.work().is_due())
          continue;
        // Past the border, where it may be only a clearance to free space.
        start();
        const Vector past = advanced(trial_.x, beside, seen_[i].outward(k));
        if (trial_.legs() < most_legs_ && guard.is_free(trial_.x, past, walk_->delta())) {
          trial_.step_to(past);
          if (brings_nearer(target))
            return true;
        }
        const Vector along = seen_[i].along_border(k);
        start();
        if (brings_nearer(advanced(trial_.x, dot(pull, along), along)))
          return true;
      }
      for (std::size_t j = 0; j < i && trials < most_trials; ++j) {
        if (!guard.work().is_due())
          continue;
        start();
        trial_.facets.push_back(seen_[i]);
        trial_.facets.push_back(seen_[j]);
        trial_.place(trial_.x);
        if (brings_nearer(target))
          return true;
      }
    }
    return false;
  }

  /// The last way out, which takes nothing for granted: looks in many directions, none of them along an axis, close by
  /// and less so.
  template <class Guard, class Brings_nearer>
  bool look_about(Guard& guard, const Vector& pull, const Vector& target, double gain,
                  const Brings_nearer& brings_nearer) {
    const Slide_lengths lengths = walk_->lengths();
    const double distance = length(pull);
    for (const Vector& direction : directions()) {
      if (dot(direction, pull) < 0)
        continue;
      for (const double reach : {lengths.lifted(), std::sqrt(lengths.lifted() / distance) * distance}) {
        const Vector end = advanced(walk_->x, reach, direction);
        if (!guard.work().is_due() || walk_->legs() >= most_legs_ || end == walk_->x ||
            nearer_by(target, walk_->x, end) < -gain || !guard.is_free(walk_->x, end, walk_->delta()))
          continue;
        trial_.begin_at(*walk_);
        trial_.step_to(end);
        if (brings_nearer(target))
          return true;
      }
    }
    return false;
  }

  /// (1, 2, 3) with all orders and signs, of length 1: about evenly spread over the sphere, and the same bits
  /// everywhere.
  static const std::array<Vector, 48>& directions() {
    static const std::array<Vector, 48> all = [] {
      std::array<Vector, 48> vectors;
      std::size_t number = 0;
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
          for (int signs = 0; signs < 8 && i != j; ++signs) {
            Vector v{};
            v[i] = 1, v[j] = 2, v[3 - i - j] = 3;
            for (int k = 0; k < 3; ++k)
              v[k] = (signs >> k & 1) != 0 ? -v[k] : v[k];
            vectors[number++] = normalized(v);
          }
      return vectors;
    }();
    return all;
  }

  /// A free point a few clearances from the vertex along the mean normal of its contacts, or where it is.
  template <class Guard>
  Vector off_the_contacts(Guard& guard) const {
    const Vector up = walk_->mean_normal();
    for (const double height : {4.0, 1.0}) {
      const Vector off = advanced(walk_->x, height * walk_->lengths().clearance, up);
      if (off != walk_->x && guard.is_free(walk_->x, off, walk_->delta()))
        return off;
    }
    return walk_->x;
  }

  void remember(const Facet<Mesh>& facet) {
    for (const auto& other : seen_)
      if (facet.is_wall() || other.is_of(facet.contact()))
        return;
    if (seen_.size() < seen_.capacity())
      seen_.push_back(facet);
  }
};

} // namespace internal
} // namespace haptic_sculpt

#endif
