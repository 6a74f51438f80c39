// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <functional>
#include <limits>
#include <optional>
#include <utility>

namespace haptic_sculpt {

/// What became of many vertices that were to go to targets. Lengths are in the unit of the coordinates.
struct Move_report {
  std::size_t asked = 0;   ///< vertices, each once
  std::size_t reached = 0; ///< of these, how many are at their targets, as numbers: +0 is -0
  /// How many motions were asked for, of an axis move one for each vertex; to take a step back counts none.
  std::size_t drags = 0;
  std::size_t counted = 0; ///< the same, but a slide counts by its work: what Move_parameters::most_drags() bounds
  std::size_t pairs = 0;   ///< decided, where Move_parameters::most_pairs() bounds them, and no more than that; else 0

  /// How many vertices are not at their targets; left_l2 and left_max tell how far they are from there.
  std::size_t left() const { return asked - reached; }

  double asked_l2 = 0;  ///< sqrt of the sum of the squares of the distances to the targets, before
  double left_l2 = 0;   ///< the same after; never more than asked_l2
  double asked_max = 0; ///< the largest distance before
  double left_max = 0;  ///< the largest distance after; never more than asked_max

  bool cancelled = false;   ///< the progress function asked to stop
  /// `most_drags` or `most_pairs` has ended it, or kept axis moves from being made, and some vertex was still to go on.
  /// A call that has moved nothing moves nothing when it is repeated: give more.
  bool out_of_work = false;
};

/// How far a call that moves many vertices has come.
struct Move_progress {
  std::size_t asked;  ///< vertices
  std::size_t behind; ///< of these, how many are not where they are to be; of a step on the way, where the step ends
  std::size_t drags;  ///< made so far
  double way;         ///< the share of the way that the step under way ends at: 1 unless many stand in each other's way
};

/// The options of move_vertices(), named and chained: `Move_parameters().most_drags(1000000).progress(f)`.
struct Move_parameters {
  std::size_t drag_limit = std::numeric_limits<std::size_t>::max(); ///< most_drags(); at first without limit
  std::optional<std::size_t> pair_limit;                            ///< most_pairs(); unset: not counted

  /// A slide counts as one drag for this many pairs that it decides, or part of them: as many as a drag that is
  /// stopped at its first impact decides, or a little more (doc/use/many_vertices.md).
  static constexpr std::size_t pairs_a_drag = 64;
  std::function<bool(const Move_progress&)> progress_function;      ///< progress(); at first none
  bool takes_steps = true,  ///< steps()
      drags_singly = true, ///< drags()
      slides = true;       ///< slide()

  /// This many drags are made at most, a slide counting by its work (pairs_a_drag); then the call ends as it would if
  /// it had been cancelled: where many stand in each other's way, with all of them on their ways. The report tells what
  /// was left. No clock is asked: the same call does the same again, with any broad phase.
  Move_parameters& most_drags(std::size_t n) {
    drag_limit = n;
    return *this;
  }
  /// This many pairs are decided at most: a bound on the time that does not depend on how many pairs a vertex takes. It
  /// is asked before each round of an axis move, which is made whole or not at all, and goes to each drag as the bound
  /// on its work. Then the call ends with what stood; the same call of move_vertices() goes on, the others begin anew.
  /// Not counted are pairs of faces side by side, which are looked over: n^2 / 2 at a vertex of valence n. Counted,
  /// never timed: the same with any broad phase and any number of threads (doc/use/work.md). Cost: each axis move
  /// searches its pairs twice.
  Move_parameters& most_pairs(std::optional<std::size_t> n) {
    pair_limit = n;
    return *this;
  }
  /// Called before each axis move and every `drags_between_calls` drags, counted in the same way; false ends the call,
  /// with all vertices as near to their targets as they have come. What it throws goes on to the caller; what was done
  /// by then is one step of the history. It may look at the mesh and ask its Sculptor; what would change something
  /// throws Reentrant_call.
  Move_parameters& progress(std::function<bool(const Move_progress&)> function) {
    progress_function = std::move(function);
    return *this;
  }
  static constexpr std::size_t drags_between_calls = 256; ///< counted; the first call is before any drag

  /// Whether all go at once, along one axis after the other, in smaller steps where they stand in each other's way. On
  /// by default; without, each is dragged by itself.
  Move_parameters& steps(bool on) {
    takes_steps = on;
    return *this;
  }
  /// Whether what is held back is brought on by smaller steps, drags of its own and slides. On by default; without,
  /// all go at once along each axis, once and all of their ways, and what is held back stays there, as apply_brush()
  /// does it.
  Move_parameters& drags(bool on) {
    drags_singly = on;
    return *this;
  }
  /// Whether what is left at the end slides along what it may not cross. On by default.
  Move_parameters& slide(bool on) {
    slides = on;
    return *this;
  }
};

} // namespace haptic_sculpt
