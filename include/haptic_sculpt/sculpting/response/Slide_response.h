// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/sculpting/Drag_result.h>
#include <haptic_sculpt/sculpting/response/Straight_way_search.h>
#include <haptic_sculpt/sculpting/response/Near_plane_search.h>
#include <haptic_sculpt/sculpting/response/Corner_search.h>
#include <haptic_sculpt/sculpting/response/is_farther.h>

namespace haptic_sculpt::internal {

/// The default response: a blocked vertex slides along what blocks it to a point nearest to its target
/// (doc/proofs/slide.md).
///
/// Carries its contacts from one drag of a grab to the next. Allocates nothing.
template <class Mesh>
class Slide_response {
public:
  /// A walk makes at most this many legs.
  static constexpr int most_legs = Slide_path::most_legs;
  /// When the drag has ended, straight ways are tried where it has made more legs than `few_legs`, bent ones too where
  /// more than `many_legs` are left: one step of a hand shall make no more than this many, and a slide over a plane cut
  /// into triangles no more than three beside the first (doc/proofs/slide.md, "The path made shorter").
  static constexpr int few_legs = 4, many_legs = 8;
  /// What bending has left may be bent again, so often.
  static constexpr int most_bendings = 4;
  /// So often a path that has come to as many is made anew with fewer.
  static constexpr int most_shortenings = 8;

  /// The contacts no longer hold: the vertex was let go, or something else moved it.
  void forget() {
    walk_.facets.clear();
    corner_search_.forget();
    straight_way_search_.forget();
    near_plane_search_.forget();
    round_.forget();
    part_ = 1;
  }

  /// Goes from source towards target. Returns where the vertex is then; every leg on the way there is proven free.
  /// Fills in contacts, legs, stop error and `end`.
  template <class Guard>
  Coordinates move(Guard& guard, const Coordinates& source, const Coordinates& target, const Drag_rules& rules,
                   Drag_result<Mesh>& result) {
    if (walk_.x != source)
      forget();
    if (!guard.work().is_bounded()) // what a drag with a bound has left
      part_ = 1;
    const Vector aim = part_ < 1 ? advanced(source, part_, minus(target, source)) : target;
    walk_.begin(source, rules);
    round_.begin(guard.work().is_bounded());
    near_plane_search_.begin();
    Walk_end end;
    const auto is_free = [&](const Vector& a, const Vector& b) { return guard.is_free(a, b, rules.delta); };
    Vector at_last_shortening = source;
    int shortenings = 0;
    for (;;) {
      end = walk_.go(guard, aim, most_legs);
      // A target that is beyond reach brings forth legs each longer than the last, far from all that is to be seen: no
      // search for ways that are better there.
      if (guard.is_spent() || end == Walk_end::reached || walk_.is_beyond_reach(aim))
        break;
      bool creeps = false;
      if (walk_.legs() + Corner_search<Mesh>::trial_legs > most_legs && shortenings < most_shortenings) {
        ++shortenings;
        walk_.path.shorten(aim, is_free, Ways::straight_and_bent);
        creeps = end == Walk_end::limit && nearer_by(aim, at_last_shortening, walk_.x) < walk_.lengths().lifted();
        at_last_shortening = walk_.x;
      }
      if (walk_.legs() >= most_legs)
        break;
      if (creeps)
        end = Walk_end::stuck;
      else if (end == Walk_end::limit)
        continue;
      round_.search_at(walk_.x, aim, walk_.lengths());
      if (!creeps && near_plane_search_.take(walk_, guard, round_, aim))
        continue;
      if (!corner_search_.take(walk_, guard, round_, aim, most_legs))
        break;
    }
    if (end != Walk_end::reached && !walk_.is_beyond_reach(aim) && !guard.is_spent()) {
      if (walk_.legs() + Straight_way_search<Mesh>::trial_legs > most_legs)
        walk_.path.shorten(aim, is_free, Ways::straight_and_bent);
      straight_way_search_.take(walk_, guard, round_, aim, most_legs);
      end = walk_.x == aim                      ? Walk_end::reached
            : straight_way_search_.is_settled() ? Walk_end::settled
                                                : Walk_end::stuck;
    }
    round_.end(guard.work());
    if (is_cut_short(guard, end, target))
      end = Walk_end::spent;
    else if (end == Walk_end::settled && round_.has_left_out())
      end = Walk_end::stuck;
    else if (end != Walk_end::reached && walk_.legs() >= most_legs)
      end = Walk_end::limit;
    // To keep a clearance from what was nearer J may have gone back: then it had better stay.
    if (end != Walk_end::reached && is_farther(target, walk_.x, source))
      walk_.return_to(source);
    if (end != Walk_end::reached && end != Walk_end::spent && walk_.x == source && walk_.is_beyond_reach(target))
      return stop_instead(guard, source, target, rules, result);
    make_shorter(target, is_free);
    walk_.forget([](const auto& facet) { return facet.is_over(Slide_lengths::clearances_of_lift); });
    report(end, result);
    walk_.forget([](const auto& facet) { return facet.is_wall(); });
    return walk_.x;
  }

  /// The way of the last move.
  const internal::Slide_path& path() const { return walk_.path; }

private:
  using Walk = Slide_walk<Mesh>;
  using Ways = Slide_path::Ways;

  Walk walk_;
  Near_plane_search<Mesh> near_plane_search_;
  Corner_search<Mesh> corner_search_;
  Straight_way_search<Mesh> straight_way_search_;
  Search_round round_;
  double part_ = 1; ///< of the way to the target, so much is asked for

  /// A decision that costs more than the bound alone is tried on a shorter way next time, past fewer candidates.
  static constexpr double shorter = 0.25, shortest_part = 0x1p-20;

  /// Whether the bound on the work has kept the walk from its end, or the search from being one for this target.
  template <class Guard>
  bool is_cut_short(const Guard& guard, Walk_end end, const Vector& target) {
    const bool is_short = part_ < 1;
    if (!guard.is_spent())
      part_ = std::fmin(1.0, part_ / shorter);
    else if (walk_.legs() == 0 && !round_.is_searching())
      part_ = std::fmax(shortest_part, part_ * shorter);
    if (walk_.x == target)
      return false;
    if (guard.is_spent() || is_short)
      return true;
    if (end != Walk_end::settled)
      return false;
    // Nothing is known to hold a vertex without contacts: no force may stand for what a trial left out might have met.
    return !round_.is_for_its_target() || (round_.has_left_out() && walk_.facets.empty());
  }

  /// Towards a target that is beyond reach the walk may have led nowhere: then a slide does no less than a stop does.
  template <class Guard>
  Coordinates stop_instead(Guard& guard, const Coordinates& source, const Coordinates& target, const Drag_rules& rules,
                           Drag_result<Mesh>& result) {
    walk_.return_to(source); // it may have gone and come back
    walk_.facets.clear();
    const Coordinates end = guard.leg(source, target, rules, result);
    if (end != source)
      walk_.step_to(end);
    result.legs = walk_.legs();
    result.end = guard.is_spent() ? Drag_end::work_limit : Drag_end::stuck;
    return end;
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

  void report(Walk_end end, Drag_result<Mesh>& result) const {
    result.legs = walk_.legs();
    const bool has_contacts = !walk_.facets.empty();
    result.end = end == Walk_end::reached                   ? Drag_end::reached
                 : end == Walk_end::spent                   ? Drag_end::work_limit
                 : end == Walk_end::limit                   ? Drag_end::leg_limit
                 : end == Walk_end::settled && has_contacts ? Drag_end::held
                                                            : Drag_end::stuck;
    result.stop_error = result.stop_error_along_path = 0;
    if (end == Walk_end::reached)
      return;
    constexpr double none = std::numeric_limits<double>::infinity();
    double lowest = none, of_walls = none;
    for (const auto& facet : walk_.facets) {
      result.contacts.push_back(facet.contact());
      double& least = facet.is_wall() ? of_walls : lowest;
      least = std::fmin(least, facet.distance());
    }
    result.stop_error = lowest < none ? lowest : of_walls < none ? of_walls : 0;
  }
};

} // namespace haptic_sculpt::internal
