// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Batch_bits.h"
#include "Batch_script.h"
#include "Random_places.h"
#include "batches.h"
#include "sculpting/clearances.h"
#include "sculpting/result_contradiction.h"

#include <chrono>

namespace haptic_sculpt::robustness {

/// One batch of drags, each batch on a fresh copy of the mesh.
template <class Broad_phase>
class Drag_batch {
public:
  /// \throw Invalid_parameter where the clearance does not serve
  Drag_batch(const Mesh& mesh, const Batch& batch)
      : batch_(batch), mesh_(mesh), sculptor_(mesh_, batch.parameters()), places_(mesh_, batch.seed) {}

  Batch_made<Drag_tally> run(Keep keep) {
    bool has_outgrown_clearance = false;
    try {
      if (batch_.is_of_a_hand)
        run_strokes(batch_.count);
      else
        run_odd_drags(batch_.count);
    } catch (const Invalid_parameter&) {
      if (!batch_.clearance)
        throw;
      has_outgrown_clearance = true;
    }
    if (!batch_.has_only_bits)
      finish();
    bits_.add(mesh_);
    const bool is_kept = keep == Keep::all || tally_.is_any_promise_broken();
    return {tally_, bits_.value(), is_kept ? script_.text(batch_.opening()) : std::string(),
            keep == Keep::all ? mesh_ : Mesh(), has_outgrown_clearance};
  }

private:
  using Sculptor_type = Sculptor<Mesh, Broad_phase>;
  enum class Kind { short_random, through, other };

  Batch batch_;
  Batch_script script_;
  Batch_bits bits_;
  Mesh mesh_;
  Sculptor_type sculptor_;
  Random_places places_;
  Drag_tally tally_;

  /// Single drags, many of them degenerate.
  void run_odd_drags(std::size_t drags) {
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
  }

  /// As a hand drags: a vertex is held for a hundred short steps in a slowly turning direction, contacts carried along.
  void run_strokes(std::size_t drags) {
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
      script_.add("release");
    }
  }

  void drag(Vertex_index v, const Point_3& target, Kind kind) {
    auto grab = sculptor_.grab(v);
    drag(grab, v, target, kind);
    script_.add("release");
  }

  void drag(Grab<Sculptor_type>& grab, Vertex_index v, const Point_3& target, Kind kind) {
    script_.add("drag", {sculptor_.id(v)}, target);
    const Point_3 start = mesh_.point(v);
    const auto begin = std::chrono::steady_clock::now();
    const Drag_result<Mesh> result = grab.drag_to(target);
    const double taken = std::chrono::duration<double, std::nano>(std::chrono::steady_clock::now() - begin).count();
    tally_.nanoseconds += taken;
    tally_.longest = std::max(tally_.longest, taken);
    ++tally_.drags;
    bits_.add(result);
    tally_.contradictions += result.position != mesh_.point(v) || test::contradiction(result, start, target) != nullptr;
    ++(result.reached ? tally_.reached : tally_.blocked);
    const double clearance = test::clearance_kept(sculptor_, result), error = result.stop_error / clearance;
    const bool determined = result.contacts.size() == 1 && !result.contacts[0].is_flat;
    if (kind == Kind::short_random) {
      ++tally_.short_asked;
      tally_.short_arrived += result.reached;
    }
    if (kind == Kind::through && start != target) {
      ++tally_.through_asked;
      if (!result.reached && mesh_.point(v) == start) {
        ++tally_.through_stayed;
        tally_.through_unexplained += result.contacts.empty();
        if (determined && error > 2) {
          ++tally_.through_lazy;
          script_.stays_farther_than(2 * clearance);
        }
      }
    }
    if (determined) {
      tally_.slow_stops += error > 2;
      tally_.largest_stop_error = std::max(tally_.largest_stop_error, error);
    }
    if (batch_.validate_every != 0 && tally_.drags % batch_.validate_every == 0 && !batch_.has_only_bits)
      check();
  }

  void finish() {
    check();
    try {
      sculptor_.check_unchanged();
    } catch (const Mesh_changed&) {
      ++tally_.changed;
    }
  }

  void check() {
    ++tally_.validations;
    tally_.invalid += !validate(mesh_).is_valid();
  }
};

} // namespace haptic_sculpt::robustness
