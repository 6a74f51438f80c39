// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/sculpting/many_vertices/Axis_walk.h>
#include <haptic_sculpt/sculpting/many_vertices/Drag_budget.h>
#include <haptic_sculpt/surface/vertex_coordinates.h>

namespace haptic_sculpt::internal {

/// Brings many vertices as near to their targets as axis moves and single drags do (doc/proofs/many_vertices.md).
///
/// No drag ends farther from its target than it began, and in an axis move no coordinate does.
template <class Sculptor>
class Vertices_mover {
public:
  using Mesh = typename Sculptor::Mesh_type;
  using Moving = Moving_vertex<Mesh>;

  /// \param vertices all targets are in range \param report filled in by run()
  Vertices_mover(Sculptor& sculptor, const std::vector<Moving>& vertices, const Move_parameters& parameters,
                 Move_report& report, const Part_runner& run)
      : sculptor_(sculptor)
      , vertices_(vertices)
      , parameters_(parameters)
      , report_(&report)
      , run_(run)
      , budget_(parameters, report)
      , drag_(sculptor.parameters().drag)
      , bound_(drag_.work_limit_pairs) {}

  /// Fills in what the report tells of drags, `cancelled` and `out_of_work`.
  void run() {
    asked_ = sum_left();
    drag_.response(Response::stop).once();
    if (!parameters_.drags_singly || (parameters_.takes_steps && vertices_.size() >= many)) {
      Axis_walk<Sculptor> walk(sculptor_, vertices_, parameters_, *report_, run_);
      // The same call goes on by axis moves: single drags would only crumple what these have brought on together.
      goes_on_ = walk.run() && !(walk.is_out_of_pairs() && sum_left() < asked_);
    }
    if (parameters_.drags_singly)
      finish();
  }

private:
  using Position = std::uint32_t; ///< in vertices_
  using Positions = std::vector<Position>;
  /// From this many on all go at once along one axis after the other.
  static constexpr std::size_t many = 8;
  /// This many passes of slides are made when few are left.
  static constexpr int slide_passes_of_few = 3;
  /// Another pass is made at the end while the last has gained more than this share of what was left, as a sum of
  /// distances, and more than least_left of what was asked is left.
  static constexpr double least_gain = 0.01;

  /// So few of n do not stand in each other's way as a whole: what blocks them is local.
  static std::size_t few(std::size_t n) { return 1 + n / 32; }

  Sculptor& sculptor_;
  const std::vector<Moving>& vertices_;
  const Move_parameters& parameters_;
  Move_report* report_;
  Part_runner run_; ///< who shares the work of axis moves
  Drag_budget budget_;
  Drag_parameters drag_;             ///< of the drags at hand
  std::optional<std::size_t> bound_; ///< on the work of a drag, as the Sculptor has it
  bool goes_on_ = true; ///< neither cancelled nor out of work
  std::size_t behind_ = 0;
  double asked_ = 0; ///< a sum of distances

  Coordinates place(Position k) const { return vertex_coordinates(sculptor_.mesh(), vertices_[k].vertex); }

  Positions all_behind() const {
    Positions behind;
    for (Position k = 0; k < vertices_.size(); ++k)
      if (place(k) != vertices_[k].target)
        behind.push_back(k);
    return behind;
  }

  /// One drag. \return whether the vertex is there
  bool drag(Position k, const Coordinates& p) {
    ++report_->drags;
    const auto v = vertices_[k].vertex;
    const typename Mesh::Point target(p[0], p[1], p[2]);
    if (drag_.response_rule == Response::slide) {
      const auto result = sculptor_.drag(v, target, drag_.work_limit(budget_.work_of_slide(bound_)));
      budget_.count_slide(result.work);
      return told(result);
    }
    const auto result = sculptor_.drag(v, target, drag_.work_limit(budget_.work_of_drag(bound_)));
    budget_.count_drag(result.work);
    return told(result);
  }

  /// One that was cut short may be the last: nobody asks then whether there is room for another.
  bool told(const Drag_result<Mesh>& result) {
    if (result.end == Drag_end::work_limit)
      budget_.has_room();
    return result.reached;
  }

  /// Whether another drag may be made; asks the progress function in its turn.
  bool may_drag() {
    if (!goes_on_)
      return false;
    const bool has_room = budget_.has_room();
    report_->cancelled =
        has_room && parameters_.progress_function && budget_.is_call_due() &&
        !ask(Sculptor_access::guarded(sculptor_), parameters_.progress_function,
             Move_progress{vertices_.size(), behind_, report_->drags, 1});
    return goes_on_ = has_room && !report_->cancelled;
  }

  /// Drags each once.
  void pass(Positions& behind) {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < behind.size(); ++i) {
      const Position k = behind[i];
      behind_ = behind.size() - i + kept;
      if (place(k) == vertices_[k].target)
        continue;
      if (!may_drag()) {
        behind[kept++] = k;
        continue;
      }
      const bool reached = drag(k, vertices_[k].target);
      if (!reached)
        behind[kept++] = k;
    }
    behind.resize(kept);
  }

  double sum_left() const {
    const auto at = [this](const Moving& v) { return vertex_coordinates(sculptor_.mesh(), v.vertex); };
    return sum_of_distances(vertices_, at, report_->asked_max);
  }

  /// Whole ways, stopped and then sliding, until a pass gains little.
  void finish() {
    passes_to_the_end(std::numeric_limits<int>::max());
    if (!parameters_.slides)
      return;
    drag_.response(Response::slide).once(false);
    passes_to_the_end(all_behind().size() <= few(vertices_.size()) ? slide_passes_of_few
                                                                   : std::numeric_limits<int>::max());
  }

  void passes_to_the_end(int most_passes) {
    double left = sum_left();
    for (int i = 0; i < most_passes && goes_on_ && left > least_left * asked_; ++i) {
      Positions behind = all_behind();
      pass(behind);
      const double before = std::exchange(left, sum_left());
      if (!(before - left > least_gain * before))
        return;
    }
  }
};

} // namespace haptic_sculpt::internal
