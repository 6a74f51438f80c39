// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef HAPTIC_SCULPT_SCULPTING_SLIDE_RESPONSE_H
#define HAPTIC_SCULPT_SCULPTING_SLIDE_RESPONSE_H

#include <haptic_sculpt/sculpting/Drag_result.h>
#include <haptic_sculpt/sculpting/Slide_walk.h>

namespace haptic_sculpt {

/// The default response: a blocked vertex slides along what blocks it to a point nearest to its target (RULES 4, doc/slide.md).
///
/// Carries its contacts from one drag of a grab to the next. Allocates nothing.
template <class Mesh>
class Slide_response {
public:
  using Coordinates = internal::Coordinates;
  using Vector = internal::Vector;

  /// One drag makes at most so many legs. Rough terrain leaves 0.6 % of drags unfinished with 16 and none with 32 (RULES 4).
  static constexpr int most_legs = 32;
  /// So many legs are tried to show that a way out of a mixed corner is one.
  static constexpr int trial_legs = 4;
  /// At most so many ways out of one place are tried.
  static constexpr int most_trials = 64;
  /// A walk that has made so many legs begins to leap, every few legs.
  static constexpr int legs_before_leaps = 6, legs_between_leaps = 2;
  /// Steps shorter than this part of the distance from the target turn round a corner; to repeat them leads nowhere.
  static constexpr double least_step = 0x1p-16;

  /// The contacts no longer hold: the vertex was let go, or something else moved it.
  void forget() {
    walk_.facets.clear();
    sought_ = false;
  }

  /// Goes from source towards target. Returns where the vertex is then; every leg on the way there is proven free. Fills in
  /// contacts, legs, stop error and `end`.
  template <class Guard>
  Coordinates move(Guard& guard, const Coordinates& source, const Coordinates& target, const internal::Slide_lengths& lengths,
                   Drag_result<Mesh>& result) {
    using internal::Walk_end;
    if (walk_.x != source)
      forget();
    walk_.begin(source);
    Walk_end end;
    Vector before = source;
    int until = legs_before_leaps;
    for (;;) {
      end = walk_.go(guard, target, lengths, std::min(until, most_legs));
      if (end == Walk_end::reached || walk_.legs >= most_legs)
        break;
      if (end == Walk_end::limit) {
        if (until > legs_before_leaps)
          leap(guard, before, target, lengths);
        before = walk_.x;
        until = walk_.legs + legs_between_leaps;
      } else if (!escape(guard, target, lengths))
        break;
    }
    if (end != Walk_end::reached && walk_.legs >= most_legs)
      end = Walk_end::limit;
    walk_.forget([&](const auto& facet) { return facet.is_over(lengths.lifted()); });
    report(end, source, result);
    walk_.forget([](const auto& facet) { return facet.is_wall(); });
    return walk_.x;
  }

private:
  using Walk = internal::Slide_walk<Mesh>;
  using Facets = typename Walk::Facets;

  Walk walk_, trial_;
  Facets seen_; ///< all that was met while a way out was sought
  bool sought_ = false;
  Vector sought_at_{}, sought_for_{}; ///< where no way out was found, and to which target

  /// Half-spaces forbid more than facets do: at a corner that is neither convex nor concave there may be a way on although the
  /// planes meet. Looks for one, and takes it if it brings the vertex nearer by more than what clearances can feign.
  template <class Guard>
  bool escape(Guard& guard, const Vector& target, const internal::Slide_lengths& lengths) {
    const Vector pull = internal::minus(target, walk_.x);
    const double distance = internal::length(pull);
    if (walk_.facets.empty() || distance <= lengths.shortest_pull())
      return false;
    // A target is nearer by as much as it has moved at most: below what clearances can feign the answer is the same as before.
    if (sought_ && internal::length(internal::minus(walk_.x, sought_at_)) <= lengths.settled() &&
        internal::length(internal::minus(target, sought_for_)) <= 4 * lengths.clearance)
      return false;
    if (!may_lead_on(guard, lengths))
      return false;
    const auto held = walk_.nearest(pull, distance, lengths.clearance, lengths);
    const auto without_clearance = walk_.nearest(pull, distance, 0, lengths);
    const double gain = std::fmax(8 * lengths.clearance,
                                  without_clearance.exists ? 4 * internal::length(without_clearance.displacement) : 0);
    int trials = 0;
    seen_ = walk_.facets;
    const auto brings_nearer = [&](const Vector& first_aim) {
      ++trials;
      trial_.forget_progress();
      if (first_aim != target) {
        trial_.go(guard, first_aim, lengths, std::min(trial_.legs + 1, most_legs)); // one leg: on from there it must not climb
        trial_.forget_progress();
      }
      trial_.go(guard, target, lengths, std::min(walk_.legs + trial_legs, most_legs));
      for (const auto& facet : trial_.facets)
        remember(facet);
      if (internal::length(internal::minus(target, trial_.x)) >= distance - gain)
        return false;
      walk_ = trial_;
      return true;
    };
    const bool all_legs_were_left = walk_.legs + trial_legs <= most_legs;
    if (leave_contacts(held, target, brings_nearer) || leave_walls(guard, target, lengths, brings_nearer) ||
        follow_features(guard, pull, target, lengths, trials, brings_nearer) ||
        look_about(guard, pull, target, lengths, gain, brings_nearer)) {
      sought_ = false;
      return true;
    }
    sought_ = all_legs_were_left;
    sought_at_ = walk_.x;
    sought_for_ = target;
    return false;
  }

  /// Two faces form a convex edge, round which a way may lead, where one falls off from the other's plane by more than this:
  /// a smaller angle, of 1e-12 radians, is none that a clearance or a rounded normal can tell from a seam.
  static constexpr double least_slope = 0x1p-40;

  /// The same for planes of contacts that do not share an edge: a thousandth of a radian.
  static constexpr double least_rise = 0x1p-10;

  /// Whether there may be a way past a border of some contact. Where all contacts near one are faces and each goes over to another
  /// of them, rising or flat, there is none: a concave edge or corner, all of which is known. Where other contacts rise across
  /// all borders, and J is near no corner, it is likely one, and looking beyond their planes tells.
  template <class Guard>
  bool may_lead_on(Guard& guard, const internal::Slide_lengths& lengths) const {
    bool is_doubtful = false;
    for (const auto& facet : walk_.facets) {
      if (facet.is_wall())
        return true;
      int open = 0;
      for (int k = 0; k < facet.borders(); ++k)
        if (facet.beyond_border(k, walk_.x) > -lengths.border() && !is_closed(facet, k))
          if (!does_rise(facet.outward(k)) || ++open > 1)
            return true;
      is_doubtful = is_doubtful || open > 0;
    }
    return is_doubtful && sees_beyond_a_contact(guard, lengths);
  }

  bool does_rise(const Vector& way) const {
    for (const auto& facet : walk_.facets)
      if (internal::dot(facet.normal(), way) < -least_rise)
        return true;
    return false;
  }

  /// Whether a place beyond the plane of a contact is free to be reached: along other contacts past its border, or in any of many
  /// directions.
  template <class Guard>
  bool sees_beyond_a_contact(Guard& guard, const internal::Slide_lengths& lengths) const {
    const auto is_free = [&](const Vector& direction) {
      return guard.is_free(walk_.x, internal::advanced(walk_.x, lengths.lifted(), direction), lengths.delta);
    };
    for (const auto& facet : walk_.facets)
      for (int k = 0; k < facet.borders(); ++k)
        for (const auto& other : walk_.facets) {
          const Vector& out = facet.outward(k);
          if (&other == &facet || facet.beyond_border(k, walk_.x) <= -lengths.border())
            continue;
          const Vector along = internal::normalized(internal::advanced(out, -internal::dot(out, other.normal()), other.normal()));
          if (internal::dot(facet.normal(), along) < -least_rise && is_free(along))
            return true;
        }
    constexpr double beyond = -0.25; // by a clearance at least, over 8 clearances from one above it
    for (const Vector& direction : directions())
      for (const auto& facet : walk_.facets)
        if (internal::dot(facet.normal(), direction) < beyond) {
          if (is_free(direction))
            return true;
          break;
        }
    return false;
  }

  bool is_closed(const internal::Facet<Mesh>& facet, int border) const {
    for (const auto& other : walk_.facets)
      if (&other != &facet && facet.shares_border(border, other) &&
          internal::dot(other.normal(), facet.outward(border)) < least_slope)
        return true;
    return false;
  }

  /// Tries to go without some of the contacts that hold.
  template <class Brings_nearer>
  bool leave_contacts(const internal::Nearest_permitted& held, const Vector& target, const Brings_nearer& brings_nearer) {
    const unsigned subsets = 1u << (held.exists ? held.number_active : 0);
    for (unsigned subset = 1; subset < subsets; ++subset) {
      trial_ = walk_;
      trial_.forget([&](const auto& facet) {
        for (int i = 0; i < held.number_active; ++i)
          if ((subset >> i & 1) != 0 && Walk::is_alike(facet.normal(), walk_.facets[held.active[i]].normal()))
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
  bool leave_walls(Guard& guard, const Vector& target, const internal::Slide_lengths& lengths, const Brings_nearer& brings_nearer) {
    for (const auto& facet : walk_.facets)
      for (const double height : {4 * lengths.clearance, -4 * lengths.clearance}) {
        if (!facet.is_wall() || walk_.legs >= most_legs)
          break;
        const Vector beside = internal::advanced(walk_.x, height, facet.normal_of_wall());
        if (beside == walk_.x || !guard.is_free(walk_.x, beside, lengths.delta))
          continue;
        trial_.facets.clear();
        trial_.x = beside;
        trial_.legs = walk_.legs + 1;
        if (brings_nearer(target))
          return true;
      }
    return false;
  }

  /// The paper's vertex rule (3.2.2 c): from a little off, tries every face and every edge that was met here.
  template <class Guard, class Brings_nearer>
  bool follow_features(Guard& guard, const Vector& pull, const Vector& target, const internal::Slide_lengths& lengths,
                       const int& trials, const Brings_nearer& brings_nearer) {
    const Vector lifted = off_the_contacts(guard, lengths);
    const double beside = lengths.border() / 4;
    const auto start = [&] {
      trial_.facets.clear();
      trial_.legs = walk_.legs;
      trial_.x = walk_.x;
      if (lifted != walk_.x && trial_.legs < most_legs)
        trial_.x = lifted, ++trial_.legs;
    };
    // seen_ grows on the way.
    for (std::size_t i = 0; i < seen_.size() && trials < most_trials; ++i) {
      start();
      trial_.facets.push_back(seen_[i]);
      trial_.place(trial_.x);
      if (brings_nearer(target))
        return true;
      for (int k = 0; k < seen_[i].borders() && trials < most_trials; ++k) {
        if (seen_[i].beyond_border(k, walk_.x) < -lengths.border())
          continue;
        // Past the border, where it may be only a clearance to free space.
        start();
        const Vector past = internal::advanced(trial_.x, beside, seen_[i].outward(k));
        if (trial_.legs < most_legs && guard.is_free(trial_.x, past, lengths.delta)) {
          trial_.x = past, ++trial_.legs;
          if (brings_nearer(target))
            return true;
        }
        const Vector along = seen_[i].along_border(k);
        start();
        if (brings_nearer(internal::advanced(trial_.x, internal::dot(pull, along), along)))
          return true;
      }
      for (std::size_t j = 0; j < i && trials < most_trials; ++j) {
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

  /// Where finely cut surfaces cost a leg for each facet: tries to go on in free flight as the last legs went, many times as far, and
  /// takes it if that, when J has come down, has brought it nearer than these did.
  template <class Guard>
  void leap(Guard& guard, const Vector& before, const Vector& target, const internal::Slide_lengths& lengths) {
    const Vector way = internal::minus(walk_.x, before);
    const double step = internal::length(way), distance = internal::length(internal::minus(target, walk_.x)),
                 gained = internal::length(internal::minus(target, before)) - distance;
    if (step < least_step * distance)
      return;
    const Vector up = mean_normal();
    for (const double times : {64.0, 16.0, 4.0})
      for (const double slope : {0.25, 0.0625, 0.0}) {
        if (times * step > distance || walk_.legs + 1 >= most_legs)
          break;
        const Vector end = internal::advanced(internal::advanced(walk_.x, times, way), slope * times * step, up);
        if (!guard.is_free(walk_.x, end, lengths.delta))
          continue;
        trial_ = walk_;
        trial_.forget_progress();
        trial_.facets.clear();
        trial_.x = end;
        ++trial_.legs;
        trial_.go(guard, target, lengths, std::min(trial_.legs + legs_between_leaps - 1, most_legs));
        if (internal::length(internal::minus(target, trial_.x)) < distance - std::fmax(gained, lengths.lifted())) {
          walk_ = trial_;
          return;
        }
      }
  }

  /// The last way out, which takes nothing for granted: looks in many directions, none of them along an axis, close by and less so.
  template <class Guard, class Brings_nearer>
  bool look_about(Guard& guard, const Vector& pull, const Vector& target, const internal::Slide_lengths& lengths, double gain,
                  const Brings_nearer& brings_nearer) {
    const double distance = internal::length(pull);
    for (const Vector& direction : directions()) {
      if (internal::dot(direction, pull) < 0)
        continue;
      for (const double reach : {lengths.lifted(), std::sqrt(lengths.lifted() * distance)}) {
        const Vector end = internal::advanced(walk_.x, reach, direction);
        if (walk_.legs >= most_legs || end == walk_.x ||
            internal::length(internal::minus(target, end)) > distance + gain || !guard.is_free(walk_.x, end, lengths.delta))
          continue;
        trial_.facets.clear();
        trial_.x = end;
        trial_.legs = walk_.legs + 1;
        if (brings_nearer(target))
          return true;
      }
    }
    return false;
  }

  /// (1, 2, 3) with all orders and signs, of length 1: about evenly spread over the sphere, and the same bits everywhere.
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
            vectors[number++] = internal::normalized(v);
          }
      return vectors;
    }();
    return all;
  }

  Vector mean_normal() const {
    Vector sum{};
    for (const auto& facet : walk_.facets)
      sum = internal::plus(sum, facet.normal());
    return internal::normalized(sum);
  }

  /// A free point a few clearances from the vertex along the mean normal of its contacts, or where it is.
  template <class Guard>
  Vector off_the_contacts(Guard& guard, const internal::Slide_lengths& lengths) const {
    const Vector up = mean_normal();
    for (const double height : {4.0, 1.0}) {
      const Vector off = internal::advanced(walk_.x, height * lengths.clearance, up);
      if (off != walk_.x && guard.is_free(walk_.x, off, lengths.delta))
        return off;
    }
    return walk_.x;
  }

  void remember(const internal::Facet<Mesh>& facet) {
    for (const auto& other : seen_)
      if (facet.is_wall() || other.is_of(facet.contact()))
        return;
    if (seen_.size() < seen_.capacity())
      seen_.push_back(facet);
  }

  void report(internal::Walk_end end, const Vector& source, Drag_result<Mesh>& result) const {
    using internal::Walk_end;
    result.legs = walk_.legs;
    result.end = end == Walk_end::reached  ? Drag_end::reached
                 : end == Walk_end::limit  ? Drag_end::leg_limit
                 : end == Walk_end::stuck && walk_.x == source ? Drag_end::no_progress
                                                               : Drag_end::held;
    result.stop_error = result.stop_error_along_path = 0;
    if (end == Walk_end::reached)
      return;
    double lowest = std::numeric_limits<double>::infinity();
    for (const auto& facet : walk_.facets) {
      result.contacts.push_back(facet.contact());
      lowest = std::fmin(lowest, std::fmax(0.0, facet.height()));
    }
    result.stop_error = std::isfinite(lowest) ? lowest : 0;
  }
};

} // namespace haptic_sculpt

#endif
