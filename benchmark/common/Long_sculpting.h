// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "sculpting/response/Recording_guard.h"
#include "sculpting/clearances.h"
#include "sculpting/result_contradiction.h"
#include "sculpting/response/local_minimum.h"

#include <nlohmann/json.hpp>

#include <chrono>

namespace haptic_sculpt::benchmark {

/// What came of many edits of one mesh.
struct Long_tally {
  std::size_t drags = 0, reached = 0, held = 0, at_leg_limit = 0, without_progress = 0, edits_asked = 0, edits_done = 0;
  std::size_t validations = 0, invalid = 0, minima_asked = 0, minima_missed = 0, contradictions = 0;
  std::size_t legs_checked = 0, legs_crossing = 0, ways_unproven = 0;
  std::vector<std::size_t> legs = std::vector<std::size_t>(33);
  double nanoseconds = 0;

  nlohmann::ordered_json json() const {
    return {{"drags", drags},
            {"reached", reached},
            {"held", held},
            {"at_leg_limit", at_leg_limit},
            {"without_progress", without_progress},
            {"edits_asked", edits_asked},
            {"edits_done", edits_done},
            {"validations", validations},
            {"invalid", invalid},
            {"minima_asked", minima_asked},
            {"minima_missed", minima_missed},
            {"contradictions", contradictions},
            {"legs_checked", legs_checked},
            {"legs_crossing", legs_crossing},
            {"ways_unproven", ways_unproven},
            {"legs", legs},
            {"mean_ns", drags > 0 ? nanoseconds / static_cast<double>(drags) : 0}};
  }
};

/// Sculpts one mesh for long: vertices slide about as a hand would drag them, with creations, removals, undo and redo
/// between.
class Long_sculpting {
public:
  using Mesh = meshes::Mesh;
  using Point_3 = meshes::Point_3;
  using Vector_3 = meshes::Kernel::Vector_3;
  using Vertex_index = Mesh::Vertex_index;

  Long_sculpting(const Mesh& mesh, std::uint64_t seed)
      : mesh_(mesh), sculptor_(mesh_, parameters::response(Response::slide)), random_(seed) {}

  /// \param validate_every drags between two validations, \param check_every drags between two checks of a local
  /// minimum
  Long_tally run(std::size_t drags, std::size_t validate_every, std::size_t check_every) {
    while (tally_.drags < drags) {
      if (random_() % 2 == 0)
        edit();
      const Vertex_index v = any_vertex();
      auto grab = sculptor_.grab(v);
      for (std::size_t i = 1 + random_() % 10; i > 0 && tally_.drags < drags; --i) {
        const Point_3 to = target(v);
        if (!CGAL::is_finite(to.x()) || !CGAL::is_finite(to.y()) || !CGAL::is_finite(to.z()))
          continue; // beyond the largest doubles
        drag(grab, v, to, tally_.drags % check_every == 0);
        if (tally_.drags % validate_every == 0)
          validate_now();
      }
    }
    validate_now();
    return tally_;
  }

private:
  Mesh mesh_;
  Sculptor<Mesh> sculptor_;
  test::Random random_;
  Long_tally tally_;

  Vertex_index any_vertex() {
    for (;;) {
      const Vertex_index v(static_cast<Mesh::size_type>(random_() % mesh_.num_vertices()));
      if (!mesh_.is_removed(v))
        return v;
    }
  }
  Vertex_index neighbour(Vertex_index v) {
    auto h = mesh_.halfedge(v);
    for (std::size_t turns = random_() % 8; turns > 0; --turns)
      h = mesh_.opposite(mesh_.next(h));
    return mesh_.source(h);
  }

  Point_3 target(Vertex_index v) {
    const Point_3 p = mesh_.point(v), a = mesh_.point(neighbour(v)), b = mesh_.point(neighbour(v));
    const double edge = std::sqrt(CGAL::squared_distance(p, a));
    switch (random_() % 8) {
    case 0: case 1: return p + 0.1 * edge * test::uniform_direction(random_);
    case 2: return p + edge * test::uniform_direction(random_);
    case 3: return p + 4 * edge * test::uniform_direction(random_);
    case 4: return p + test::uniform(random_, 0, 2) * (CGAL::midpoint(a, b) - p); // into its own link
    case 5: return p + test::uniform(random_, -1, 2) * (a - p);                    // flat: along its own edge
    case 6: return mesh_.point(neighbour(neighbour(v)));
    default: { const Point_3 q = mesh_.point(any_vertex()); return p + test::uniform(random_, 0, 0.2) * (q - p); }
    }
  }

  template <class Grab>
  void drag(Grab& grab, Vertex_index v, const Point_3& to, bool check) {
    if (check)
      check_legs(v, to);
    const Point_3 from = mesh_.point(v);
    const auto begin = std::chrono::steady_clock::now();
    const auto r = grab.drag_to(to);
    tally_.nanoseconds += std::chrono::duration<double, std::nano>(std::chrono::steady_clock::now() - begin).count();
    ++tally_.drags;
    tally_.reached += r.end == Drag_end::reached;
    tally_.held += r.end == Drag_end::held;
    tally_.at_leg_limit += r.end == Drag_end::leg_limit;
    tally_.without_progress += r.end == Drag_end::no_progress;
    tally_.contradictions += r.position != mesh_.point(v) || r.legs > 32 || test::contradiction(r, from, to) != nullptr;
    ++tally_.legs[std::min<std::size_t>(32, static_cast<std::size_t>(r.legs))];
    if (check && !r.reached) {
      const auto minimum = test::check_local_minimum(test::Surroundings(mesh_, v), mesh_, r, to,
                                                     test::clearance_kept(sculptor_, r), random_);
      if (minimum.asked) {
        ++tally_.minima_asked;
        tally_.minima_missed += minimum.random_gain > 0 || minimum.kkt_residual > 1e-9;
      }
    }
  }

  /// The same drag once more, without moving the vertex: each of its legs is asked of the oracle of the sweeps, of all
  /// pairs.
  void check_legs(Vertex_index v, const Point_3& to) {
    const std::array<double, 3> s = vertex_coordinates(mesh_, v), t = {to.x(), to.y(), to.z()};
    if (s == t)
      return;
    Box_tree_broad_phase<Mesh> broad_phase(mesh_);
    const internal::Face_corners<Mesh> corners(mesh_);
    Filter_counters counters;
    test::Recording_guard<Mesh> guard(mesh_, broad_phase, corners, Exact_sweep_traits<Mesh>(&counters));
    guard.collect(v);
    internal::Responses<Mesh> responses;
    Drag_result<Mesh> result;
    const auto end = responses.move(Response::slide, guard, mesh_, s, t, {}, result);
    const auto legs = guard.way(s, end);
    tally_.ways_unproven += end != s && (legs.empty() || legs.size() > static_cast<std::size_t>(result.legs));
    const test::Surroundings around(mesh_, v);
    for (const auto& [from, on] : legs) {
      ++tally_.legs_checked;
      tally_.legs_crossing +=
          !around.is_free_by_oracle(Point_3(from[0], from[1], from[2]), Point_3(on[0], on[1], on[2]));
    }
  }

  void edit() {
    ++tally_.edits_asked;
    bool done = false;
    switch (random_() % 6) {
    case 0: case 1: {
      const Mesh::Face_index f(static_cast<Mesh::size_type>(random_() % mesh_.num_faces()));
      if (mesh_.is_removed(f))
        return;
      const auto h = mesh_.halfedge(f);
      const Point_3 p = mesh_.point(mesh_.source(h)), q = mesh_.point(mesh_.target(h)),
                    r = mesh_.point(mesh_.target(mesh_.next(h)));
      done = static_cast<bool>(sculptor_.insert_on_face(f, CGAL::centroid(p, q, r)));
      break;
    }
    case 2: {
      const Mesh::Edge_index e(static_cast<Mesh::size_type>(random_() % mesh_.num_edges()));
      if (mesh_.is_removed(e))
        return;
      const auto h = mesh_.halfedge(e);
      done = static_cast<bool>(
          sculptor_.insert_on_edge(e, CGAL::midpoint(mesh_.point(mesh_.source(h)), mesh_.point(mesh_.target(h)))));
      break;
    }
    case 3: done = static_cast<bool>(sculptor_.remove(any_vertex())); break;
    case 4:
      for (std::size_t i = random_() % 10; i > 0; --i)
        done = static_cast<bool>(sculptor_.undo());
      break;
    default: done = static_cast<bool>(sculptor_.redo());
    }
    tally_.edits_done += done;
  }

  void validate_now() {
    ++tally_.validations;
    tally_.invalid += !validate(mesh_).is_valid();
  }
};

} // namespace haptic_sculpt::benchmark
