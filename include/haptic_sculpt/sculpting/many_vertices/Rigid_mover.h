// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/sculpting/Rigid_move_report.h>
#include <haptic_sculpt/sculpting/axis_moves/shift_all.h>
#include <haptic_sculpt/sculpting/many_vertices/Moving_vertex.h>
#include <haptic_sculpt/sculpting/many_vertices/Rigid_way.h>

namespace haptic_sculpt::internal {

/// Moves vertices as one, in steps that are made by all or by none, each along x, then y, then z, to places worked out
/// from where all were at the start: so what is rounded does not add up.
template <class Sculptor>
class Rigid_mover {
public:
  using Mesh = typename Sculptor::Mesh_type;
  using Moving = Moving_vertex<Mesh>;

  /// \param run who shares the work of a step
  Rigid_mover(Sculptor& sculptor, const std::vector<Moving>& vertices, const Rigid_way& way, const Part_runner& run)
      : guarded_(Sculptor_access::guarded(sculptor)), vertices_(vertices), way_(way), run_(run) {}

  /// Step after step, half as long after one that is blocked and twice as long after one that is not.
  void run(Rigid_move_report<Mesh>& report) {
    double step = 1;
    while (report.share < 1) {
      const double next = std::fmin(1, report.share + step);
      if (make_step(next, step == least_step ? &report.contacts : nullptr))
        report.share = next, step *= 2;
      else if (step == least_step)
        return;
      else
        step /= 2;
    }
  }

private:
  static constexpr double least_step = 1.0 / 1024;

  using Ways = Axis_ways<Mesh>;

  std::decay_t<decltype(Sculptor_access::guarded(std::declval<Sculptor&>()))>& guarded_;
  const std::vector<Moving>& vertices_;
  const Rigid_way& way_;
  Part_runner run_;

  Coordinates place(const Moving& v, double share) const {
    return share == 1 ? v.target : plus(v.source, way_.at(share, minus(v.target, v.source)));
  }

  /// \param contacts where it is not null, told all that is in the way of a step that is not made
  bool make_step(double share, std::vector<Blocking_pair<Mesh>>* contacts) {
    Vertex_targets<Mesh> places;
    places.reserve(vertices_.size());
    for (const Moving& v : vertices_) {
      places.emplace_back(v.vertex, place(v, share));
      if (!is_in_range(places.back().second))
        return false; // an arc may lead farther out than both of its ends are
    }
    guarded_.look_around(places);
    std::vector<std::pair<int, Ways>> made;
    for (int axis = 0; axis < 3; ++axis) {
      Ways ways, before;
      for (const auto& [v, to] : places)
        if (const double at = vertex_coordinates(guarded_.mesh(), v)[axis]; at != to[axis]) {
          ways.emplace_back(v, to[axis]);
          before.emplace_back(v, at);
        }
      if (ways.empty())
        continue;
      if (!guarded_.shift(axis, ways, 0, run_)) {
        if (contacts != nullptr)
          name_contacts(axis, ways, *contacts);
        take_back(made);
        return false;
      }
      made.emplace_back(axis, std::move(before));
    }
    return true;
  }

  void take_back(std::vector<std::pair<int, Ways>>& made) {
    for (; !made.empty(); made.pop_back())
      if (!guarded_.shift(made.back().first, made.back().second, 0, run_))
        throw Mesh_changed("a motion that was free is not when it is taken back");
  }

  void name_contacts(int axis, const Ways& ways, std::vector<Blocking_pair<Mesh>>& contacts) {
    for (const Axis_obstacle& obstacle : guarded_.obstacles_to(axis, ways, run_)) {
      Blocking_pair<Mesh> pair{static_cast<Blocking_kind>(obstacle.kind), {}};
      for (int k = 0; k < obstacle.size(); ++k)
        pair.vertices[k] = typename Mesh::Vertex_index(obstacle.vertices[k]);
      contacts.push_back(pair);
    }
  }
};

} // namespace haptic_sculpt::internal
