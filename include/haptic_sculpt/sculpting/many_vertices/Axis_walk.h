// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/sculpting/Move_report.h>
#include <haptic_sculpt/sculpting/axis_moves/Axis_move.h>
#include <haptic_sculpt/sculpting/edits/Sculptor_access.h>
#include <haptic_sculpt/sculpting/many_vertices/Moving_vertex.h>
#include <haptic_sculpt/surface/vertex_coordinates.h>

namespace haptic_sculpt::internal {

/// Brings many vertices towards their targets by axis moves: all along x, then along y, then along z. Whole ways first;
/// where too many are held back all is taken back and tried by half (doc/proofs/many_vertices.md).
///
/// Each coordinate of a vertex only comes nearer to that of its target.
template <class Sculptor>
class Axis_walk {
public:
  using Mesh = typename Sculptor::Mesh_type;
  using Moving = Moving_vertex<Mesh>;

  /// \param report counts a motion for each vertex of a move along one axis, and pairs; tells where one was not made
  /// because of a limit
  /// \param run who shares the work of a move
  Axis_walk(Sculptor& sculptor, const std::vector<Moving>& vertices, const Move_parameters& parameters,
            Move_report& report, const Part_runner& run)
      : guarded_(Sculptor_access::guarded(sculptor))
      , vertices_(vertices)
      , parameters_(parameters)
      , report_(report)
      , run_(run)
      , pairs_(parameters.pair_limit.value_or(0), report.pairs) {}

  /// Ends, too, where a move would be more motions than may be made: single drags may go on with what is left of these.
  /// \return false where it was cancelled
  bool run() {
    look_around(); // no coordinate leaves the interval from where it is to its target
    const double asked = sum_left();
    // Steps that are taken back would use up what few motions there are.
    const bool takes_steps = parameters_.drags_singly && parameters_.drag_limit / work_of_steps >= vertices_.size();
    double way = takes_steps ? 0 : 1, step = 1;
    std::size_t before = vertices_.size(); // this many were held back in the step twice as long
    while (way < 1 && goes_on_) {
      const double next = std::fmin(1, way + step);
      const Edit_trial<Guarded> trial(guarded_); // steps taken back are no edits
      const std::size_t held = step_to(next, vertices_.size() / 4);
      if (!goes_on_)
        break;
      if (held <= few()) {
        way = next, before = vertices_.size();
        step *= 2;
        continue;
      }
      take_back();
      do
        step /= 2;
      while (way + step >= next); // the same once more
      if (step < worth_trying && (step < least_step || 2 * held > before))
        break;
      before = held;
    }
    // The rest of the way with holding back, in steps: whole ways along one axis after the other lead round corners.
    if (takes_steps)
      for (double share = way + held_step; goes_on_ && share < 1; share += held_step) {
        look_around();
        step_to(share, vertices_.size());
      }
    for (double left = sum_left(); goes_on_ && left > least_left * asked;) {
      look_around(); // fewer may be behind
      step_to(1, vertices_.size());
      const double gone = left - sum_left();
      if (!parameters_.drags_singly || !(gone > least_gain * left))
        break;
      left -= gone;
    }
    return !report_.cancelled;
  }

  /// Whether a move was not made because it would have decided more pairs than it may.
  bool is_out_of_pairs() const { return is_out_of_pairs_; }

private:
  /// Steps of this share of the way are tried whatever comes of it; shorter ones, to the least, only while half as long
  /// a step at least halves the number held back: that is so in twists, and not in noise.
  static constexpr double worth_trying = 1.0 / 16, least_step = 1.0 / 256;
  /// Of steps in which as many as need be are held back. With 1/8 none of 36 motions that jam ended more than 4.4 % of
  /// the way short of single drags, with 1/4 and 1/2 some ended 12 and 8 % short; with 1/16 all take longer.
  static constexpr double held_step = 1.0 / 8;
  /// Steps are tried where this many motions a vertex may be made.
  static constexpr std::size_t work_of_steps = 16;
  /// Another pass to the end is made while the last has gained more than this share of what was left, and more than
  /// least_left is.
  static constexpr double least_gain = 0.01;

  using Ways = Axis_ways<Mesh>;
  using Guarded = std::decay_t<decltype(Sculptor_access::guarded(std::declval<Sculptor&>()))>;

  Guarded& guarded_;
  const std::vector<Moving>& vertices_;
  const Move_parameters& parameters_;
  Move_report& report_;
  Part_runner run_;
  Pair_budget pairs_; ///< where they are bounded
  bool is_out_of_pairs_ = false;
  bool goes_on_ = true;                    ///< neither cancelled nor without room for another move

  /// This many may be held back in a step.
  std::size_t few() const { return 1 + vertices_.size() / 32; }

  Coordinates place(const Moving& v) const { return vertex_coordinates(guarded_.mesh(), v.vertex); }

  void look_around() {
    Vertex_targets<Mesh> behind;
    behind.reserve(vertices_.size());
    for (const Moving& v : vertices_)
      if (place(v) != v.target)
        behind.emplace_back(v.vertex, v.target);
    guarded_.look_around(behind);
  }

  /// Where the vertex is to be along an axis: where it is, unless the point of its way is nearer to the target.
  double aim(const Moving& v, const Coordinates& from, double share, int axis) const {
    const double target = v.target[axis];
    const double p = share == 1 ? target : std::fma(share, target - v.source[axis], v.source[axis]);
    return std::abs(p - target) < std::abs(from[axis] - target) ? p : from[axis];
  }

  /// Along all axes, with at most this many held back by each move. \return how many are held back, in all at the end,
  /// or all where a move was given up
  std::size_t step_to(double share, std::size_t most) {
    for (int axis = 0; axis < 3; ++axis) {
      Ways ways;
      ways.reserve(vertices_.size());
      for (const Moving& v : vertices_)
        if (const Coordinates from = place(v); aim(v, from, share, axis) != from[axis])
          ways.emplace_back(v.vertex, aim(v, from, share, axis));
      if (ways.empty())
        continue;
      if (!may_move(ways.size(), share))
        return vertices_.size();
      if (!guarded_.shift(axis, ways, most, run_, parameters_.pair_limit ? &pairs_ : nullptr)) {
        is_out_of_pairs_ = guarded_.axis_move().is_too_much();
        if (is_out_of_pairs_)
          end_out_of_work();
        return vertices_.size();
      }
    }
    return number_behind(share);
  }

  /// Vertices that are not where the step is to bring them.
  std::size_t number_behind(double share) const {
    std::size_t behind = 0;
    for (const Moving& v : vertices_) {
      const Coordinates at = place(v);
      behind += aim(v, at, share, 0) != at[0] || aim(v, at, share, 1) != at[1] || aim(v, at, share, 2) != at[2];
    }
    return behind;
  }

  /// The step that was made.
  void take_back() {
    while (guarded_.tried_shifts() != 0)
      guarded_.take_back_tried_shift(run_);
  }

  /// \return false
  bool end_out_of_work() {
    report_.out_of_work = true;
    return goes_on_ = false;
  }

  bool may_move(std::size_t vertices, double share) {
    if (vertices > parameters_.drag_limit - std::min(report_.counted, parameters_.drag_limit))
      return end_out_of_work();
    if (parameters_.progress_function &&
        !ask(guarded_, parameters_.progress_function,
             Move_progress{vertices_.size(), number_behind(share), report_.drags, share})) {
      report_.cancelled = true;
      return goes_on_ = false;
    }
    report_.drags += vertices;
    report_.counted += vertices;
    return true;
  }

  double sum_left() const {
    return sum_of_distances(
        vertices_, [this](const Moving& v) { return place(v); }, report_.asked_max);
  }
};

} // namespace haptic_sculpt::internal
