// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/sculpting/response/Slide_contacts.h>
#include <haptic_sculpt/sculpting/response/Slide_path.h>

namespace haptic_sculpt::internal {

/// How a walk ended.
enum class Walk_end : std::uint8_t {
  reached, ///< at the target
  settled, ///< at the point nearest to the target that the contacts permit
  stuck,   ///< no representable point on the way there is free
  spent,   ///< as much work as the drag may do
  limit    ///< as many legs as permitted
};

/// A vertex under way, with its contacts: goes in legs, each proven free, to the point nearest to the target that the
/// contacts permit; finds contacts on the way and loses others (doc/proofs/slide.md). Plain data: copied to try a way
/// out.
template <class Mesh>
class Slide_walk : public Slide_contacts<Mesh> {
  using Base = Slide_contacts<Mesh>;
  using Base::lengths_;
  using Base::rules_;

public:
  using Base::facets;
  using Base::forget;
  using Base::forget_what_was_left;
  using Base::is_beyond_reach;
  using Base::is_closed;
  using Base::leave_what_is_past;
  using Base::meet_first;
  using Base::most_facets;
  using Base::nearest;
  using Base::place;
  using Base::place_at;
  using Base::pull_to;
  using Base::x;

  /// Bounds the turns in which no leg is made: each of them learns of a contact or forgets one.
  static constexpr int most_turns = 128;
  /// How often a place near a new contact is sought with growing clearance, and how often at all, as each may meet yet
  /// another contact, before the vertex steps back along its path.
  static constexpr int approaches = 6, most_tries = 24;

  /// So often contacts are forgotten, because J is past them, where it rests or comes no nearer: what is met again
  /// after that is kept, for it is met on the way to the target, far from where J is.
  static constexpr int most_rests = 2;
  /// This many times in a row an approach in a narrow gap may bring less than half as near as the one before: a gap
  /// that closes.
  static constexpr int most_shrinking = 6;

  /// After this many legs none is made that is short and only takes J off a contact just met: the next one, farther,
  /// does that as well.
  static constexpr int legs_before_thrift = 8;

  Slide_path path; ///< made so far, ends at x

  int legs() const { return path.legs(); }

  /// Walks until it ends, or `most_legs` have been made.
  template <class Guard>
  Walk_end go(Guard& guard, const Vector& target, int most_legs) {
    leave_what_is_past(lengths_.resolution);
    for (int turn = 0; turn < most_turns; ++turn) {
      const Vector pull = pull_to(target);
      const bool is_nearer = !nearest_so_far_ || nearer_by(target, *nearest_so_far_, x) > lengths_.clearance;
      if (is_nearer) {
        nearest_so_far_ = x;
        rests_ = 0;
      }
      const Nearest_permitted way = nearest(pull, 1);
      const bool is_to_target = way.exists && way.number_active == 0, is_far = is_to_target && is_beyond_reach(target);
      Vector y = is_to_target && !is_far ? target : place_at(way.displacement);
      if (y == target && x == target)
        return Walk_end::reached;
      if (!way.exists || y == x || (!is_to_target && length(way.displacement) <= lengths_.settled())) {
        if (rests_ >= most_rests)
          return Walk_end::settled;
        ++rests_;
        if (!leave_what_is_past(lengths_.clearance))
          return Walk_end::settled;
        continue;
      }
      if (legs() >= most_legs)
        return Walk_end::limit;
      auto decision = guard.decide(x, y, rules_.delta);
      // What is near has been decided first, by numbers of about one size. Where it ends has been rounded, so it may be
      // blocked where the whole way is free.
      if (is_far) {
        if (decision.is_free() || guard.is_free(x, target, rules_.delta))
          y = target;
        decision = guard.decide(x, y, rules_.delta);
      }
      if (!decision.is_free()) {
        if (guard.is_spent())
          return Walk_end::spent;
        const int legs_before = legs();
        const Vector before = x;
        if (!approach(guard, decision, y, target))
          return guard.is_spent() ? Walk_end::spent : Walk_end::stuck;
        if (legs() == legs_before)
          continue;
        // What is past is kept: over a flat groove a new contact is met c / tan(angle) behind the border of the last
        // one.
        forget_what_is_over();
        const double gain = nearer_by(target, before, x);
        shrinking_ = way.is_squeezed && gain < last_gain_ / 2 ? shrinking_ + 1 : 0;
        last_gain_ = gain;
        if (shrinking_ >= most_shrinking)
          return Walk_end::stuck;
        continue;
      }
      // Where the faces round a vertex are one plane but for rounding, J would otherwise leave each of them for the
      // next.
      const bool is_short = largest_magnitude(minus(y, x)) <= lengths_.border();
      step_to(y);
      if (is_to_target)
        return Walk_end::reached;
      if (is_short || rests_ >= most_rests)
        forget_what_is_over();
      else if (leave_what_is_past(lengths_.resolution) && !is_nearer)
        ++rests_; // to and fro over an edge
    }
    return legs() >= most_legs ? Walk_end::limit : Walk_end::stuck;
  }

  /// Makes a leg. \pre it is free, and legs() < Slide_path::most_legs
  void step_to(const Vector& place_reached) {
    place(place_reached);
    path.add(place_reached);
  }

  /// Goes to where another walk is, without its contacts.
  void begin_at(const Slide_walk& other) {
    facets.clear();
    path = other.path;
    rules_ = other.rules_;
    place(other.x);
  }

  /// A trial from where `kept` is: walks on to the target, and takes its place where that has brought it nearer by more
  /// than `least`. Returns whether it has.
  template <class Guard>
  bool go_instead_of(Slide_walk& kept, Guard& guard, const Vector& target, int most_legs, double least) {
    go(guard, target, most_legs);
    if (!(nearer_by(target, kept.x, x) > least))
      return false;
    kept = *this;
    return true;
  }

  /// A new drag begins: what was left in the last one may be met and left again.
  void begin(const Vector& source, const Drag_rules& rules) {
    rules_ = rules;
    path = Slide_path(source);
    forget_what_was_left();
    forget_progress();
    place(source);
  }

  /// Takes all legs back.
  void return_to(const Vector& source) {
    path = Slide_path(source);
    place(source);
  }

  /// Another target, or another way to it.
  void forget_progress() {
    nearest_so_far_.reset();
    last_gain_ = 0;
    rests_ = shrinking_ = 0;
  }

private:
  std::optional<Vector> nearest_so_far_; ///< to the target
  double last_gain_ = 0;                 ///< of the last approach
  int rests_ = 0, shrinking_ = 0;

  /// Round a corner that is flat to within some clearances J would leave and meet the same contacts again and again.
  void forget_what_is_over() {
    const double clearances =
        rests_ < most_rests ? Slide_lengths::clearances_of_lift : Slide_lengths::clearances_of_retreat;
    forget([clearances](const Facet<Mesh>& f) { return f.is_over(clearances); });
  }

  /// The way from x to y has just been found blocked: goes to the free point nearest to the impact that is c off all
  /// contacts, the new one included. Returns whether anything was gained, in place or in knowledge.
  template <class Guard, class Decision>
  bool approach(Guard& guard, const Decision& blocked, const Vector& y, const Vector& target) {
    double steepest = 0;
    bool any_new = false;
    const double time = meet_first(blocked, y, steepest, any_new);
    const Vector to_impact = scaled(minus(y, x), time);
    bool met = any_new;
    double clearances = 1;
    int tries = 0;
    for (int attempt = 0; attempt < approaches && tries < most_tries; ++tries) {
      const Nearest_permitted near = nearest(to_impact, clearances);
      const Vector z = place_at(near.displacement);
      if (!near.exists || z == x || -nearer_by(target, x, z) > lengths_.retreat())
        break;
      const auto decision = guard.decide(x, z, rules_.delta);
      if (decision.is_free()) {
        const bool is_short = largest_magnitude(minus(z, x)) <= lengths_.border();
        if (!(met && is_short && legs() >= legs_before_thrift && facets.size() < most_facets))
          step_to(z);
        return true;
      }
      bool new_here = false;
      meet_first(decision, z, steepest, new_here);
      met = met || new_here;
      if (new_here)
        continue;
      clearances *= 2;
      ++attempt;
    }
    if (met && facets.size() < most_facets)
      return true;
    // In a gap that closes slowly a whole clearance is not to be had; half the way then is.
    const double back = std::fmin(setback(lengths_.clearance, steepest), time * path_length(x, y) / 2);
    const Vector z = stop_before(x, y, time, back, [&](const Vector& q) { return guard.is_free(x, q, rules_.delta); });
    if (z == x)
      return false;
    step_to(z);
    return true;
  }
};

} // namespace haptic_sculpt::internal
