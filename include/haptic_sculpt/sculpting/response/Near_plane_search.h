// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/sculpting/response/Search_round.h>
#include <haptic_sculpt/sculpting/response/Slide_walk.h>

namespace haptic_sculpt::internal {

/// Where a walk has settled, planes may be nearer than a clearance that were never in its way. Looks for them, so that
/// the clearance is kept from those too (doc/proofs/slide.md, "The walk").
template <class Mesh>
class Near_plane_search {
public:
  using Walk = Slide_walk<Mesh>;

  /// So often in one drag what was found may lead on to where more is to be found.
  static constexpr int most_looks = 3;

  /// Something has changed: there may be others now.
  void forget() { memory_.forget(); }
  /// A new drag begins.
  void begin() { looks_ = times_let_go_ = 0; }

  /// Takes in the faces that J meets on ways of a few clearances, and lets contacts go that hold on although J is not
  /// over them. Returns whether the walk may go on now.
  ///
  /// Looks where J rests near its target, for targets are put on vertices, edges and faces; elsewhere only where a drag
  /// has led nowhere, once: few places are so near to a plane by chance, and a look costs as much as some legs.
  template <class Guard>
  bool take(Walk& walk, Guard& guard, Search_round& round, const Vector& target) {
    const Slide_lengths lengths = walk.lengths();
    const Vector pull = minus(target, walk.x);
    const bool is_near = length(pull) <= lengths.shortest_pull();
    bool any = false;
    if (looks_ < most_looks && (is_near || walk.legs() == 0) && !has_looked(walk.x, target, is_near, lengths)) {
      ++looks_;
      walk.forget_what_was_left(); // of what J left it may be over some
      const auto is_due = [&] { return round.is_due(Search_round::Search::near_planes, guard.work()); };
      if (is_due() && is_near)
        any = meet_towards(walk, guard, pull);
      for (int i = 0; i < 3; ++i)
        for (const double way : {reach, -reach}) {
          Vector step{};
          step[i] = way * lengths.clearance;
          any = (is_due() && meet_towards(walk, guard, step)) || any;
        }
      memory_.forget();
      if (!guard.is_spent())
        round.note(memory_);
    }
    if (times_let_go_ < most_looks && walk.let_go()) {
      ++times_let_go_;
      any = true;
    }
    if (any)
      walk.forget_progress();
    return any;
  }

private:
  /// Along an axis a plane rises by 1 in sqrt(3) at least for one of the six ways.
  static constexpr double reach = 4;

  Search_memory memory_;
  int looks_ = 0, times_let_go_ = 0; ///< in this drag

  bool has_looked(const Vector& x, const Vector& target, bool is_near, const Slide_lengths& lengths) const {
    return memory_.is_at(x, lengths) && (!is_near || target == memory_.target());
  }

  template <class Guard>
  static bool meet_towards(Walk& walk, Guard& guard, const Vector& step) {
    const Vector end = plus(walk.x, step);
    if (end == walk.x)
      return false;
    return walk.meet_faces(guard.decide(walk.x, end, walk.delta()));
  }
};

} // namespace haptic_sculpt::internal
