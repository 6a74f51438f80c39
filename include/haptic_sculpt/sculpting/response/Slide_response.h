// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef HAPTIC_SCULPT_SCULPTING_SLIDE_RESPONSE_H
#define HAPTIC_SCULPT_SCULPTING_SLIDE_RESPONSE_H

#include <haptic_sculpt/sculpting/Drag_result.h>
#include <haptic_sculpt/sculpting/response/Free_ways.h>
#include <haptic_sculpt/sculpting/response/Unmet_planes.h>
#include <haptic_sculpt/sculpting/response/Way_out.h>
#include <haptic_sculpt/sculpting/response/is_farther.h>

namespace haptic_sculpt {

/// The default response: a blocked vertex slides along what blocks it to a point nearest to its target
/// (doc/slide.md).
///
/// Carries its contacts from one drag of a grab to the next. Allocates nothing.
template <class Mesh>
class Slide_response {
public:
  using Coordinates = internal::Coordinates;
  using Vector = internal::Vector;

  /// A walk makes at most so many legs.
  static constexpr int most_legs = internal::Slide_path::most_legs;
  /// When the drag has ended, straight ways are tried where it has made more legs than `few_legs`, bent ones too where
  /// more than `many_legs` are left: one step of a hand shall make no more than so many, and a slide over a plane cut
  /// into triangles no more than three beside the first (doc/slide.md, "The path made shorter").
  static constexpr int few_legs = 4, many_legs = 8;
  /// What bending has left may be bent again, so often.
  static constexpr int most_bendings = 4;
  /// So often a path that has come to as many is made anew with fewer.
  static constexpr int most_shortenings = 8;
  /// A walk that has made so many legs begins to leap, every few legs.
  static constexpr int legs_before_leaps = 6, legs_between_leaps = 2;
  /// Steps shorter than this part of the distance from the target turn round a corner; to repeat them leads nowhere.
  static constexpr double least_step = 0x1p-16;

  /// The contacts no longer hold: the vertex was let go, or something else moved it.
  void forget() {
    walk_.facets.clear();
    way_out_.forget();
    free_ways_.forget();
    unmet_planes_.forget();
  }

  /// Goes from source towards target. Returns where the vertex is then; every leg on the way there is proven free.
  /// Fills in contacts, legs, stop error and `end`.
  template <class Guard>
  Coordinates move(Guard& guard, const Coordinates& source, const Coordinates& target, const Drag_rules& rules,
                   Drag_result<Mesh>& result) {
    using internal::Walk_end;
    if (walk_.x != source)
      forget();
    walk_.begin(source, rules);
    unmet_planes_.begin();
    Walk_end end;
    const auto is_free = [&](const Vector& a, const Vector& b) { return guard.is_free(a, b, rules.delta); };
    Vector before = source, at_last_shortening = source;
    int until = legs_before_leaps, shortenings = 0;
    for (;;) {
      end = walk_.go(guard, target, std::min(until, most_legs));
      // A target that is beyond reach brings forth legs each longer than the last, far from all that is to be seen: no
      // search for ways that are better there.
      const bool is_beyond_reach = walk_.is_beyond_reach(target);
      if (end == Walk_end::reached || (is_beyond_reach && (end != Walk_end::limit || walk_.legs() >= most_legs)))
        break;
      if (is_beyond_reach) {
        until = most_legs;
        continue;
      }
      bool creeps = false;
      if (walk_.legs() + internal::Way_out<Mesh>::trial_legs > most_legs && shortenings < most_shortenings) {
        ++shortenings;
        walk_.path.shorten(target, is_free, Ways::straight_and_bent);
        if (leap_far(guard, at_last_shortening, target))
          until = 0;
        else
          creeps = end == Walk_end::limit &&
                   internal::nearer_by(target, at_last_shortening, walk_.x) < walk_.lengths().lifted();
        at_last_shortening = walk_.x;
      }
      if (walk_.legs() >= most_legs)
        break;
      if (creeps) {
        end = Walk_end::stuck;
        if (!way_out_.take(walk_, guard, target, most_legs))
          break;
      } else if (end == Walk_end::limit) {
        if (until > legs_before_leaps)
          leap(guard, before, target);
        before = walk_.x;
        until = walk_.legs() + legs_between_leaps;
      } else if (!unmet_planes_.take(walk_, guard, target) &&
                 !way_out_.take(walk_, guard, target, most_legs))
        break;
    }
    if (end != Walk_end::reached && !walk_.is_beyond_reach(target)) {
      if (walk_.legs() + internal::Free_ways<Mesh>::trial_legs > most_legs)
        walk_.path.shorten(target, is_free, Ways::straight_and_bent);
      free_ways_.take(walk_, guard, target, most_legs);
      end = walk_.x == target         ? Walk_end::reached
            : free_ways_.is_settled() ? Walk_end::settled
                                      : Walk_end::stuck;
    }
    if (end != Walk_end::reached && walk_.legs() >= most_legs)
      end = Walk_end::limit;
    // To keep a clearance from what was nearer J may have gone back: then it had better stay.
    if (end != Walk_end::reached && internal::is_farther(target, walk_.x, source))
      walk_.return_to(source);
    make_shorter(target, is_free);
    walk_.forget([](const auto& facet) { return facet.is_over(internal::Slide_lengths::clearances_of_lift); });
    report(end, source, result);
    walk_.forget([](const auto& facet) { return facet.is_wall(); });
    return walk_.x;
  }

private:
  using Walk = internal::Slide_walk<Mesh>;
  using Ways = internal::Slide_path::Ways;

  Walk walk_, trial_;
  internal::Unmet_planes<Mesh> unmet_planes_;
  internal::Way_out<Mesh> way_out_;
  internal::Free_ways<Mesh> free_ways_;

  /// Where finely cut surfaces cost a leg for each facet: tries to go on in free flight as the last legs went, many
  /// times as far, and takes it if that, when J has come down, has brought it nearer than these did.
  template <class Guard>
  void leap(Guard& guard, const Vector& before, const Vector& target) {
    const Vector way = internal::minus(walk_.x, before);
    const double step = internal::length(way), distance = internal::length(internal::minus(target, walk_.x)),
                 gained = internal::nearer_by(target, before, walk_.x);
    if (step < least_step * distance)
      return;
    const Vector up = walk_.mean_normal();
    for (const double times : {64.0, 16.0, 4.0})
      for (const double slope : {0.25, 0.0625, 0.0}) {
        if (times * step > distance || walk_.legs() + 1 >= most_legs)
          break;
        const Vector end = internal::advanced(internal::advanced(walk_.x, times, way), slope * times * step, up);
        if (!guard.is_free(walk_.x, end, walk_.delta()))
          continue;
        trial_ = walk_;
        trial_.forget_progress();
        trial_.facets.clear();
        trial_.step_to(end);
        trial_.go(guard, target, std::min(trial_.legs() + legs_between_leaps - 1, most_legs));
        if (internal::nearer_by(target, walk_.x, trial_.x) > std::fmax(gained, walk_.lengths().lifted())) {
          walk_ = trial_;
          return;
        }
      }
  }

  /// Where not even short leaps have led on: tries flights as far as the target is, and shorter, along the tangent and as
  /// J went, rising more or less, each ended by what it hits, and takes what brings J nearest. Returns whether any did by
  /// more than clearances feign.
  template <class Guard>
  bool leap_far(Guard& guard, const Vector& before, const Vector& target) {
    using namespace internal;
    const Vector pull = walk_.pull_to(target), up = walk_.mean_normal();
    const double distance = length(pull);
    const Walk start = walk_;
    double most = walk_.lengths().lifted();
    for (const Vector& way : {advanced(pull, -dot(pull, up), up), minus(start.x, before)})
      for (const double part : {1.0, 0x1p-2, 0x1p-4, 0x1p-6, 0x1p-8})
        for (const double slope : {1.0, 0x1p-2, 0x1p-4, 0.0}) {
          if (start.legs() + 2 > most_legs)
            return false;
          trial_.begin_at(start);
          const Vector end = advanced(advanced(start.x, part * distance, normalized(way)), slope * part * distance, up);
          for (const Vector& aim : {end, target}) {
            trial_.forget_progress();
            trial_.go(guard, aim, trial_.legs() + 1);
          }
          const double gained = nearer_by(target, start.x, trial_.x);
          if (gained > most) {
            most = gained;
            walk_ = trial_;
          }
        }
    return walk_.x != start.x;
  }

  /// The drag has ended: fewer legs lead to the same place. Ways round nothing but seams are straight.
  template <class Is_free>
  void make_shorter(const Vector& target, const Is_free& is_free) {
    if (walk_.legs() > few_legs)
      walk_.path.shorten(target, is_free, Ways::straight, few_legs);
    for (int i = 0; i < most_bendings && walk_.legs() > many_legs; ++i)
      if (!walk_.path.shorten(target, is_free, Ways::straight_and_bent, few_legs))
        break;
  }

  void report(internal::Walk_end end, const Vector& source, Drag_result<Mesh>& result) const {
    using internal::Walk_end;
    result.legs = walk_.legs();
    const bool has_contacts = !walk_.facets.empty();
    result.end = end == Walk_end::reached                      ? Drag_end::reached
                 : end == Walk_end::limit                      ? Drag_end::leg_limit
                 : end == Walk_end::settled && has_contacts    ? Drag_end::held
                 : walk_.x == source                           ? Drag_end::no_progress
                                                               : Drag_end::stuck;
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
