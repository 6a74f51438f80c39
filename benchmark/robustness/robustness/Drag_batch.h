// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Drag_tally.h"
#include "Random_places.h"
#include "sculpting/clearances.h"
#include "sculpting/result_contradiction.h"

#include <haptic_sculpt/surface.h>

#include <chrono>
#include <filesystem>
#include <sstream>

namespace haptic_sculpt::robustness {

/// One batch of drags, each batch on a fresh copy of the mesh.
class Drag_batch {
public:
  /// \param mesh has to outlive it
  Drag_batch(const Mesh& mesh, Response response, std::uint64_t seed, std::size_t validate_every)
      : input_(mesh)
      , response_(response)
      , mesh_(mesh)
      , sculptor_(mesh_, parameters::response(response))
      , places_(mesh_, seed)
      , validate_every_(validate_every) {}

  /// Single drags, many of them degenerate.
  Drag_tally run_odd_drags(std::size_t drags) {
    // Short steps first: once the mesh is crumpled by long pushes, most vertices are in contact and held with reason.
    while (tally_.drags < drags / 3) {
      const Vertex_index v = places_.vertex();
      drag(v, places_.short_step(v), Kind::short_random);
    }
    while (tally_.drags < drags) {
      const Vertex_index v = places_.vertex();
      if (places_.below(500) == 0) { // the same contact again and again
        const Point_3 target = places_.through(v);
        for (int push = 0; push < 100 && tally_.drags < drags; ++push)
          drag(v, target, Kind::other);
        continue;
      }
      const std::size_t kind = places_.below(9);
      if (kind < 2)
        drag(v, places_.short_step(v), Kind::other);
      else if (kind < 4)
        drag(v, places_.through(v), Kind::through);
      else
        drag(v, places_.odd_target(v), Kind::other);
    }
    return finish();
  }

  /// As a hand drags: a vertex is held for a hundred short steps in a slowly turning direction, contacts carried along.
  Drag_tally run_strokes(std::size_t drags) {
    while (tally_.drags < drags) {
      const Vertex_index v = places_.vertex();
      auto grab = sculptor_.grab(v);
      Point_3 hand = mesh_.point(v);
      Vector_3 step = 0.1 * places_.edge_length(v) * places_.number() * places_.direction();
      for (int i = 0; i < 100 && tally_.drags < drags; ++i) {
        const double length = std::sqrt(step.squared_length());
        step = step + 0.1 * length * places_.direction();
        hand = hand + step;
        drag(grab, v, hand, Kind::other);
      }
      grabs_end_at_.push_back(made_.size());
    }
    return finish();
  }

  /// NAME.off and NAME.script, a script for `sculpt` that makes the same drags. \throw Error
  void write(const std::filesystem::path& folder, const std::string& name) const {
    std::ostringstream script;
    script << std::hexfloat << "response " << name_of(response_) << '\n';
    auto end = grabs_end_at_.begin();
    for (std::size_t i = 0; i < made_.size(); ++i) {
      const auto& [v, target] = made_[i];
      script << "drag " << static_cast<std::size_t>(v) << ' ' << target.x() << ' ' << target.y() << ' ' << target.z()
             << '\n';
      if (end != grabs_end_at_.end() && *end == i + 1)
        script << "release\n", ++end;
    }
    std::filesystem::create_directories(folder);
    write_surface(folder / (name + ".off"), input_);
    replace_file(folder / (name + ".script"), script.str());
  }

private:
  enum class Kind { short_random, through, other };

  const Mesh& input_;
  Response response_;
  std::vector<std::pair<Vertex_index, Point_3>> made_;
  std::vector<std::size_t> grabs_end_at_; ///< how many drags had been made when the vertex was let go
  Mesh mesh_;
  Sculptor<Mesh> sculptor_;
  Random_places places_;
  std::size_t validate_every_;
  Drag_tally tally_;

  void drag(Vertex_index v, const Point_3& target, Kind kind) {
    auto grab = sculptor_.grab(v);
    drag(grab, v, target, kind);
    grabs_end_at_.push_back(made_.size());
  }

  void drag(Grab<Sculptor<Mesh>>& grab, Vertex_index v, const Point_3& target, Kind kind) {
    made_.emplace_back(v, target);
    const Point_3 start = mesh_.point(v);
    const auto begin = std::chrono::steady_clock::now();
    const Drag_result<Mesh> result = grab.drag_to(target);
    const double taken = std::chrono::duration<double, std::nano>(std::chrono::steady_clock::now() - begin).count();
    tally_.nanoseconds += taken;
    tally_.longest = std::max(tally_.longest, taken);
    ++tally_.drags;
    tally_.contradictions += result.position != mesh_.point(v) || test::contradiction(result, start, target) != nullptr;
    ++(result.reached ? tally_.reached : tally_.blocked);
    const double error = result.stop_error / test::clearance_kept(sculptor_, result);
    const bool determined = result.contacts.size() == 1 && !result.contacts[0].is_flat;
    if (kind == Kind::short_random) {
      ++tally_.short_asked;
      tally_.short_arrived += result.reached;
    }
    if (kind == Kind::through && start != target) {
      ++tally_.through_asked;
      if (!result.reached && mesh_.point(v) == start) {
        ++tally_.through_stayed;
        tally_.through_lazy += determined && error > 2;
      }
    }
    if (determined) {
      tally_.slow_stops += error > 2;
      tally_.largest_stop_error = std::max(tally_.largest_stop_error, error);
    }
    if (validate_every_ != 0 && tally_.drags % validate_every_ == 0)
      check();
  }

  Drag_tally finish() {
    check();
    try {
      sculptor_.check_unchanged();
    } catch (const Mesh_changed&) {
      ++tally_.changed;
    }
    return tally_;
  }

  void check() {
    ++tally_.validations;
    tally_.invalid += !validate(mesh_).is_valid();
  }
};

} // namespace haptic_sculpt::robustness
