// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/sculpting/Move_report.h>
#include <haptic_sculpt/sculpting/Rigid_move_report.h>
#include <haptic_sculpt/sculpting/axis_moves/Axis_move.h>
#include <haptic_sculpt/sculpting/edits/Sculptor_access.h>
#include <haptic_sculpt/sculpting/many_vertices/Moving_vertex.h>
#include <haptic_sculpt/sculpting/many_vertices/Rigid_way.h>

#include <algorithm>
#include <exception>

namespace haptic_sculpt::internal {

/// Moves vertices as one, in steps that are made by all or by none, each along x, then y, then z, to places worked out
/// from where all were at the start: so what is rounded does not add up. A step that is broken off is taken back, and
/// leaves nothing in the history.
template <class Sculptor>
class Rigid_mover {
public:
  using Mesh = typename Sculptor::Mesh_type;
  using Moving = Moving_vertex<Mesh>;

  /// \param report filled in by run() \param run who shares the work of a step
  Rigid_mover(Sculptor& sculptor, const std::vector<Moving>& vertices, const Rigid_way& way,
              const Move_parameters& parameters, Rigid_move_report<Mesh>& report, const Part_runner& run)
      : guarded_(Sculptor_access::guarded(sculptor))
      , vertices_(vertices)
      , way_(way)
      , parameters_(parameters)
      , report_(report)
      , run_(run)
      , budget_(parameters.pair_limit.value_or(0), report.pairs)
      , pairs_(parameters.pair_limit ? &budget_ : nullptr) {}

  /// Step after step, half as long after one that is blocked and twice as long after one that is not.
  void run() {
    double step = 1;
    while (report_.share < 1) {
      const double next = std::fmin(1, report_.share + step);
      if (make_step(next, step == least_step))
        report_.share = next, step *= 2;
      else if (step == least_step || is_ended())
        return;
      else
        do
          step /= 2;
        while (step > least_step && report_.share + step >= next); // the same once more
    }
  }

private:
  static constexpr double least_step = 1.0 / 1024;

  using Guarded = std::decay_t<decltype(Sculptor_access::guarded(std::declval<Sculptor&>()))>;

  Guarded& guarded_;
  const std::vector<Moving>& vertices_;
  const Rigid_way& way_;
  const Move_parameters& parameters_;
  Rigid_move_report<Mesh>& report_;
  Part_runner run_;
  Pair_budget budget_;
  Pair_budget* pairs_; ///< the budget, or null where there is none

  bool is_ended() const { return report_.cancelled || report_.out_of_work; }

  Coordinates place(const Moving& v, double share) const {
    return share == 1 ? v.target : plus(v.source, way_.at(share, minus(v.target, v.source)));
  }

  /// \param names_contacts whether the report is to tell what is in the way
  bool make_step(double share, bool names_contacts) {
    Vertex_targets<Mesh> places;
    places.reserve(vertices_.size());
    for (const Moving& v : vertices_) {
      places.emplace_back(v.vertex, place(v, share));
      if (!is_in_range(places.back().second))
        return false; // an arc may lead farther out than both of its ends are
    }
    guarded_.look_around(places);
    const Edit_trial<Guarded> trial(guarded_);
    try {
      bool is_free = true;
      for (int axis = 0; axis < 3 && is_free; ++axis)
        is_free = move_along(axis, places, share, names_contacts);
      if (!is_free)
        take_back();
      return is_free;
    } catch (...) { // the visitor's, the progress function's, or memory's
      if (!are_at(places))
        take_back_silently();
      throw;
    }
  }

  bool are_at(const Vertex_targets<Mesh>& places) const {
    return std::all_of(places.begin(), places.end(), [this](const auto& place) {
      return vertex_coordinates(guarded_.mesh(), place.first) == place.second;
    });
  }

  bool move_along(int axis, const Vertex_targets<Mesh>& places, double share, bool names_contacts) {
    Axis_ways<Mesh> ways;
    for (const auto& [v, to] : places)
      if (vertex_coordinates(guarded_.mesh(), v)[axis] != to[axis])
        ways.emplace_back(v, to[axis]);
    if (ways.empty())
      return true;
    if (may_move(ways.size(), share) && guarded_.shift(axis, ways, 0, run_, pairs_))
      return true;
    report_.out_of_work |= !is_ended() && guarded_.axis_move().is_too_much();
    if (names_contacts && !is_ended())
      name_contacts(axis, ways);
    return false;
  }

  /// What was made of the step. Where the visitor throws, the rest goes back all the same, and it hears no more of it.
  /// \throw what was thrown last
  void take_back() {
    std::exception_ptr thrown;
    for (std::size_t left = guarded_.tried_shifts(); left != 0; --left)
      try {
        guarded_.take_back_tried_shift(run_);
      } catch (...) {
        thrown = std::current_exception();
        if (guarded_.tried_shifts() == left)
          break; // not the visitor's: as it is now it stays
        guarded_.tell_visitor(false);
      }
    guarded_.tell_visitor(true);
    if (thrown)
      std::rethrow_exception(thrown);
  }
  void take_back_silently() noexcept {
    try {
      take_back();
    } catch (...) { // what came first goes on
    }
  }

  bool may_move(std::size_t vertices, double share) {
    report_.out_of_work = vertices > parameters_.drag_limit - report_.drags;
    report_.cancelled = !report_.out_of_work && parameters_.progress_function &&
                        !ask(guarded_, parameters_.progress_function,
                             Move_progress{vertices_.size(), number_behind(share), report_.drags, share});
    if (is_ended())
      return false;
    report_.drags += vertices;
    return true;
  }

  /// Vertices that are not where the step is to bring them.
  std::size_t number_behind(double share) const {
    return static_cast<std::size_t>(std::count_if(vertices_.begin(), vertices_.end(), [&](const Moving& v) {
      return vertex_coordinates(guarded_.mesh(), v.vertex) != place(v, share);
    }));
  }

  void name_contacts(int axis, const Axis_ways<Mesh>& ways) {
    const auto& obstacles = guarded_.obstacles_to(axis, ways, run_, pairs_);
    report_.out_of_work = guarded_.axis_move().is_too_much();
    if (report_.out_of_work)
      return;
    for (const Axis_obstacle& obstacle : obstacles) {
      Blocking_pair<Mesh> pair{static_cast<Blocking_kind>(obstacle.kind), {}};
      for (int k = 0; k < obstacle.size(); ++k)
        pair.vertices[k] = typename Mesh::Vertex_index(obstacle.vertices[k]);
      report_.contacts.push_back(pair);
    }
  }
};

} // namespace haptic_sculpt::internal
