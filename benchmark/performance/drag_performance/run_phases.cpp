// SPDX-License-Identifier: GPL-3.0-or-later
// Where the time of a drag goes. Nothing in the library is timed from within: the same motions are made by a whole
// Sculptor, by its Guarded_star with the stop, and by its Guarded_star deciding only; the differences are the phases.
// Lists of candidates are filled once more by themselves, one star after the other, so that they find the memory as
// cold. Of a slide, the calls of its guard are timed.
#include "drag_performance/Timed_guard.h"
#include "drag_performance/Random_motions.h"
#include "drag_performance/Timed_broad_phase.h"
#include "drag_performance/run_structures.h"

#include <haptic_sculpt/sculpting.h>

namespace haptic_sculpt::benchmark {

namespace {

using Timed = Timed_broad_phase<Mesh>;

/// Motions of one vertex after the other, each straight on from where the last one ended.
struct Drag_of_steps {
  Vertex_index vertex;
  std::vector<Vector> targets;
};

using Drags = std::vector<Drag_of_steps>;

Drags drags_of(const Workload_mesh& scene, std::uint64_t seed, std::size_t count, std::size_t steps, double step,
               bool inwards) {
  Random_motions random(seed);
  Drags drags;
  for (std::size_t k = 0; k < count; ++k) {
    const Vertex_index v = random.vertex(scene.mesh);
    const Vector normal = normal_at(scene.mesh, v);
    Smooth_way way(random, normal);
    Vector at = vertex_coordinates(scene.mesh, v);
    drags.push_back({v, {}});
    for (std::size_t i = 0; i < steps; ++i)
      drags.back().targets.push_back(
          at = internal::advanced(at, step * scene.edge, inwards ? internal::scaled(normal, -1) : way.next()));
  }
  return drags;
}

/// Times of one pass, by what was timed.
struct Pass {
  Latencies grab, motion, asking, updating;
};

/// `is_counted(i, blocked)`: which steps of a drag count.
template <class Is_counted>
Pass by_sculptor(const Workload_mesh& scene, const Drags& drags, const Is_counted& is_counted) {
  Mesh mesh = scene.mesh;
  Sculptor<Mesh, Timed> sculptor(mesh, parameters::response(Response::stop));
  Pass pass;
  for (const Drag_of_steps& drag : drags) {
    Latencies grabbed;
    auto grab = grabbed.measure([&] { return sculptor.grab(drag.vertex); });
    for (std::size_t i = 0; i < drag.targets.size(); ++i) {
      Latencies moved;
      Timed::asking() = 0;
      const bool blocked = !moved.measure([&] { return grab.drag_to(to_point(drag.targets[i])); }).reached;
      if (is_counted(i, blocked)) {
        pass.grab.add_nanoseconds(i == 0 ? grabbed.last() : 0);
        pass.motion.add_nanoseconds(moved.last());
        pass.asking.add_nanoseconds(Timed::asking());
      }
      if (blocked)
        break;
    }
    Timed::updating() = 0;
    grab.release();
    pass.updating.add_nanoseconds(Timed::updating());
    while (sculptor.history().number_of_undo_steps() > 0)
      sculptor.undo();
  }
  return pass;
}

/// What a list of candidates was filled for.
struct Wanted_list {
  const Drag_of_steps* drag;
  Vector source, target;
  Box_3 region; ///< empty: for this motion alone
  bool is_wanted;
};

void fill_lists(const Mesh& mesh, const std::vector<Wanted_list>& wanted, Latencies& times) {
  Box_tree_broad_phase<Mesh> tree(mesh);
  const internal::Face_corners<Mesh> corners(mesh);
  internal::Star<Mesh> star;
  internal::Candidate_list<Mesh> list;
  std::vector<Mesh::Face_index> faces;
  for (const Wanted_list& one : wanted) {
    if (!one.is_wanted) {
      times.add_nanoseconds(0);
      continue;
    }
    star.collect(mesh, one.drag->vertex);
    faces.clear();
    Swept_star_3 swept = star.swept(one.source, one.target);
    if (one.region.lower[0] <= one.region.upper[0]) {
      swept.source = one.region.lower, swept.target = one.region.upper;
      swept.is_box = true;
    }
    tree.query_star(swept, faces);
    times.measure([&] { list.assign(mesh, corners, star, faces, one.region); });
  }
}

/// The same by a Guarded_star alone. \param with_stop false: only decides
/// \param lists gets, for each step that counts, the time to fill its list of candidates; 0 where it was there
template <class Is_counted>
Latencies by_star(const Workload_mesh& scene, const Drags& drags, const Is_counted& is_counted, bool with_stop,
                  Latencies* lists = nullptr) {
  Mesh mesh = scene.mesh;
  Timed broad_phase(mesh);
  const internal::Face_corners<Mesh> corners(mesh);
  Filter_counters counters;
  internal::Guarded_star<Mesh, Timed> guard(mesh, broad_phase, corners, Exact_sweep_traits<Mesh>(&counters));
  Drag_result<Mesh> result;
  Latencies counted;
  std::size_t looks = guard.looks();
  std::vector<Wanted_list> wanted;
  for (const Drag_of_steps& drag : drags) {
    guard.collect(drag.vertex);
    Vector at = vertex_coordinates(mesh, drag.vertex);
    for (std::size_t i = 0; i < drag.targets.size(); ++i) {
      Latencies moved;
      if (with_stop)
        moved.measure([&] { guard.leg(at, drag.targets[i], {}, result); });
      else
        moved.measure([&] { guard.decide(at, drag.targets[i], 0); });
      const bool has_looked = guard.looks() != looks;
      looks = guard.looks();
      const bool blocked = !guard.is_free(at, drag.targets[i], 0);
      if (is_counted(i, blocked))
        counted.add_nanoseconds(moved.last());
      if (lists != nullptr && is_counted(i, blocked))
        wanted.push_back({&drag, at, drag.targets[i], guard.candidate_list().region(), has_looked});
      looks = guard.looks();
      if (blocked)
        break;
      at = drag.targets[i];
    }
  }
  if (lists != nullptr)
    fill_lists(mesh, wanted, *lists);
  return counted;
}

template <class Is_counted>
void add_phases(Json& phases, const Workload_mesh& scene, const char* workload, const Drags& drags,
                const Is_counted& is_counted) {
  Pass whole = by_sculptor(scene, drags, is_counted);
  Latencies lists;
  Latencies leg = by_star(scene, drags, is_counted, true), decision = by_star(scene, drags, is_counted, false, &lists);
  const double grab = whole.grab.mean_of_most(), drag = whole.motion.mean_of_most(),
               broad = whole.asking.mean_of_most();
  phases.push_back({{"mesh", scene.name},
                    {"triangles", static_cast<std::size_t>(scene.mesh.number_of_faces())},
                    {"workload", workload},
                    {"count", leg.size()},
                    {"per_drag",
                     {{"grab_ns", grab},
                      {"broad_ns", broad},
                      {"checklist_ns", lists.mean_of_most()},
                      {"narrow_ns", std::max(0.0, decision.mean_of_most() - broad - lists.mean_of_most())},
                      {"stop_ns", std::max(0.0, leg.mean_of_most() - decision.mean_of_most())},
                      {"watch_and_history_ns", std::max(0.0, drag - leg.mean_of_most())},
                      {"update_at_release_ns", whole.updating.mean_of_most()},
                      {"drag_ns", drag}}}});
}

/// Slides: every vertex is pushed in until it is held, then dragged on along what holds it; only that is timed.
void add_slide_phases(Json& phases, const Workload_mesh& scene, std::uint64_t seed, std::size_t count,
                      std::size_t slides, double step) {
  Mesh mesh = scene.mesh;
  Timed broad_phase(mesh);
  const internal::Face_corners<Mesh> corners(mesh);
  Filter_counters counters;
  internal::Guarded_star<Mesh, Timed> star(mesh, broad_phase, corners, Exact_sweep_traits<Mesh>(&counters));
  Timed_guard<internal::Guarded_star<Mesh, Timed>> guard(star);
  internal::Responses<Mesh> responses;
  Random_motions random(seed);
  Latencies whole, asking, deciding, planes, calls;
  for (std::size_t k = 0; k < count; ++k) {
    const Vertex_index v = random.vertex(mesh);
    const Vector inwards = internal::scaled(normal_at(mesh, v), -1);
    Smooth_way way(random, random.direction());
    star.collect(v);
    responses.forget();
    Vector at = vertex_coordinates(mesh, v);
    bool is_met = false;
    for (std::size_t i = 0; i < 100 + slides; ++i) {
      const Vector across = way.next();
      const Vector along = internal::normalized(internal::advanced(across, -internal::dot(across, inwards), inwards));
      const Vector target = is_met ? internal::advanced(internal::advanced(at, 0.5 * step * scene.edge, inwards),
                                                        step * scene.edge, along)
                                   : internal::advanced(at, step * scene.edge, inwards);
      Drag_result<Mesh> result;
      Latencies one;
      guard.reset();
      Timed::asking() = 0;
      at = one.measure([&] { return responses.move(Response::slide, guard, mesh, at, target, {}, result); });
      if (is_met) {
        whole.add_nanoseconds(one.last());
        asking.add_nanoseconds(Timed::asking());
        deciding.add_nanoseconds(guard.deciding - Timed::asking());
        planes.add_nanoseconds(guard.planes);
        calls.add_nanoseconds(static_cast<double>(guard.motions));
      }
      if (!is_met && !result.contacts.empty())
        is_met = true, i = 100;
      if (!is_met && i == 99)
        break;
    }
  }
  const double rest = whole.mean_of_most() - asking.mean_of_most() - deciding.mean_of_most() - planes.mean_of_most();
  phases.push_back({{"mesh", scene.name},
                    {"triangles", static_cast<std::size_t>(scene.mesh.number_of_faces())},
                    {"workload", "slide in contact, 0.1 edge"},
                    {"count", whole.size()},
                    {"motions_decided", calls.mean_of_most()},
                    {"per_drag",
                     {{"broad_ns", asking.mean_of_most()},
                      {"narrow_ns", deciding.mean_of_most()},
                      {"stop_ns", planes.mean_of_most()},
                      {"response_ns", std::max(0.0, rest)},
                      {"drag_ns", whole.mean_of_most()}}}});
}

} // namespace

void run_phases(Json& phases, std::size_t triangles, const Effort& effort) {
  const Workload_mesh torus = torus_of(triangles), shell = shell_of(triangles);
  const std::uint64_t seed = effort.seed + 10;
  const auto first = [](std::size_t i, bool) { return i == 0; };
  const auto further = [](std::size_t i, bool) { return i > 0; };
  const auto blocked = [](std::size_t, bool is_blocked) { return is_blocked; };
  add_phases(phases, torus, "new vertex, 0.1 edge", drags_of(torus, seed, effort.drags / 4, 1, 0.1, false), first);
  add_phases(phases, torus, "in a drag, 0.01 edge", drags_of(torus, seed, effort.drags / 80, 100, 0.01, false),
             further);
  add_phases(phases, torus, "in a drag, 0.1 edge", drags_of(torus, seed, effort.drags / 40, 40, 0.1, false), further);
  add_phases(phases, shell, "the step that meets", drags_of(shell, seed, effort.drags / 40, 40, 0.1, true), blocked);
  add_slide_phases(phases, shell, seed, effort.drags / 50, 20, 0.1);
  add_phases(phases, torus, "push of 100 edges", drags_of(torus, seed, effort.drags / 10, 1, 100, false), first);
}

} // namespace haptic_sculpt::benchmark
