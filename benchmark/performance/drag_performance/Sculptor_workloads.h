// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "drag_performance/Latencies.h"
#include "drag_performance/Random_motions.h"
#include "drag_performance/workload_meshes.h"

#include "sculpting/clearances.h"

#include <haptic_sculpt/sculpting.h>

namespace haptic_sculpt::benchmark {

/// Whole drags of a Sculptor, with all they do: deciding, stopping with its proof, sliding, updating, watching, noting
/// for undo. Each workload leaves the mesh as it was, untimed.
template <class Broad_phase>
class Sculptor_workloads {
public:
  using Sculptor_type = Sculptor<Mesh, Broad_phase>;
  using Result = Drag_result<Mesh>;

  /// Times the constructor of the broad phase too.
  Sculptor_workloads(std::string structure, const Workload_mesh& scene, std::uint64_t seed, Response response)
    : structure_(std::move(structure)), name_(scene.name), mesh_(scene.mesh), edge_(scene.edge), seed_(seed),
      sculptor_(mesh_, parameters::response(response)), response_(response) {}

  Sculptor_type& sculptor() { return sculptor_; }
  const Mesh& mesh() const { return mesh_; }

  /// Another random vertex each time: taken, dragged by `step` edges in a random direction, and let go.
  void new_vertex(Json& rows, std::size_t count, double step) {
    Random_motions random(seed_);
    Latencies grabs, drags, releases, firsts;
    Errors errors;
    for (std::size_t k = 0; k < count; ++k) {
      const Vertex_index v = random.vertex(mesh_);
      const Point_3 target = to_point(internal::advanced(place(v), step * edge_, random.direction()));
      auto grab = grabs.measure([&] { return sculptor_.grab(v); });
      const Result result = timed_drag(grab, target, drags);
      releases.measure([&] { grab.release(); });
      firsts.add_nanoseconds(grabs.last() + drags.last());
      errors.note(result, sculptor_, exact_);
      take_back();
    }
    add_row(rows, "new vertex", step, firsts, errors);
    add_row(rows, "new vertex: grab alone", step, grabs, {});
    add_row(rows, "new vertex: first drag alone", step, drags, {});
    add_row(rows, "new vertex: release (refit)", step, releases, {});
  }

  /// The second and further steps of drags that lead smoothly away from the surface.
  void in_a_drag(Json& rows, std::size_t count, double step, std::size_t steps_per_drag) {
    Random_motions random(seed_ + 1);
    Latencies steps;
    Errors errors;
    while (steps.size() < count) {
      const Vertex_index v = random.vertex(mesh_);
      Smooth_way way(random, normal_at(mesh_, v));
      auto grab = sculptor_.grab(v);
      for (std::size_t i = 0; i < steps_per_drag; ++i) {
        const Point_3 target = to_point(internal::advanced(place(v), step * edge_, way.next()));
        if (i == 0)
          grab.drag_to(target);
        else
          errors.note(timed_drag(grab, target, steps), sculptor_, exact_);
      }
      take_back();
    }
    add_row(rows, "in a drag", step, steps, errors);
  }

  /// From the first vertices of the mesh inwards in steps until something is met, then `slides` steps on, mostly along
  /// it.
  void contact(Json& rows, std::size_t count, double step, std::size_t slides) {
    Random_motions random(seed_ + 2);
    Latencies approaches, meetings, after;
    Errors met, held;
    for (std::size_t k = 0; k < count; ++k) {
      const Vertex_index v = random.vertex(mesh_);
      const Vector inwards = internal::scaled(normal_at(mesh_, v), -1);
      Smooth_way way(random, random.direction());
      auto grab = sculptor_.grab(v);
      bool is_met = false;
      for (int i = 0; i < 200 && !is_met; ++i) {
        const Point_3 target = to_point(internal::advanced(place(v), step * edge_, inwards));
        Latencies one;
        const Result result = timed_drag(grab, target, one);
        is_met = !result.contacts.empty() || !result.reached;
        (is_met ? meetings : approaches).add_nanoseconds(one.last());
        if (is_met)
          met.note(result, sculptor_, exact_);
      }
      // Pressed in by half a step, and a step along.
      for (std::size_t i = 0; i < slides && is_met; ++i) {
        const Vector pressed = internal::advanced(place(v), 0.5 * step * edge_, inwards);
        const Vector across = internal::advanced(way.next(), 0, inwards);
        const Vector along = internal::normalized(internal::advanced(across, -internal::dot(across, inwards), inwards));
        const Point_3 target = to_point(internal::advanced(pressed, step * edge_, along));
        held.note(timed_drag(grab, target, after), sculptor_, exact_);
      }
      take_back();
    }
    add_row(rows, "push until contact: free steps", step, approaches, {});
    add_row(rows, "push until contact: the step that meets", step, meetings, met);
    add_row(rows, response_ == Response::slide ? "slide in contact" : "pressed in contact", step, after, held);
  }

  /// One push of `reach` edges in a random direction.
  void long_push(Json& rows, std::size_t count, double reach) {
    Random_motions random(seed_ + 3);
    Latencies drags, whole;
    Errors errors;
    for (std::size_t k = 0; k < count; ++k) {
      const Vertex_index v = random.vertex(mesh_);
      const Point_3 target = to_point(internal::advanced(place(v), reach * edge_, random.direction()));
      Latencies grabbed;
      auto grab = grabbed.measure([&] { return sculptor_.grab(v); });
      errors.note(timed_drag(grab, target, drags), sculptor_, exact_);
      whole.add_nanoseconds(grabbed.last() + drags.last());
      take_back();
    }
    add_row(rows, "push", reach, drags, errors);
    add_row(rows, "push with its grab", reach, whole, {});
  }

  /// Steps of a vertex within the exactly flat region around it.
  void in_a_flat_region(Json& rows, std::size_t count, double step, std::size_t steps_per_drag) {
    Random_motions random(seed_ + 4);
    Latencies firsts, steps;
    Errors first_errors, errors;
    for (std::size_t k = 0; steps.size() < count && k < count; ++k) {
      const Vertex_index v = random.vertex(mesh_);
      const Vector normal = normal_at(mesh_, v);
      const int axis = std::abs(normal[0]) > 0.999   ? 0
                       : std::abs(normal[1]) > 0.999 ? 1
                       : std::abs(normal[2]) > 0.999 ? 2
                                                     : -1;
      if (axis < 0)
        continue; // on an edge of the cube
      auto grab = sculptor_.grab(v);
      for (std::size_t i = 0; i < steps_per_drag; ++i) {
        Vector target = internal::advanced(place(v), step * edge_, random.direction());
        target[axis] = place(v)[axis];
        (i == 0 ? first_errors : errors)
            .note(timed_drag(grab, to_point(target), i == 0 ? firsts : steps), sculptor_, exact_);
      }
      take_back();
    }
    add_row(rows, "flat region: first drag", step, firsts, first_errors);
    add_row(rows, "flat region: in a drag", step, steps, errors);
  }

  /// One vertex: first drags up and down by `step`, further ones, and pushes down until it is stopped.
  void apex(Json& rows, Vertex_index v, std::size_t valence, std::size_t count, double step) {
    Latencies firsts, steps, pushes;
    Errors errors;
    const Vector at = place(v);
    Random_motions random(seed_ + 5);
    for (std::size_t k = 0; k < count; ++k) {
      auto grab = sculptor_.grab(v);
      for (std::size_t i = 0; i < 3; ++i) {
        const Point_3 target = to_point(internal::advanced(at, step, random.direction()));
        timed_drag(grab, target, i == 0 ? firsts : steps);
      }
      take_back();
      auto again = sculptor_.grab(v);
      const Point_3 target(at[0] + 0.1 * (random.uniform() - 0.5), at[1] + 0.1 * (random.uniform() - 0.5), -2);
      errors.note(timed_drag(again, target, pushes), sculptor_, exact_);
      take_back();
    }
    for (auto& [workload, times] : {std::pair<const char*, Latencies*>{"valence: first drag", &firsts},
                                    {"valence: in a drag", &steps}, {"valence: push through, stopped", &pushes}}) {
      add_row(rows, workload, step, *times, times == &pushes ? errors : Errors());
      rows.back()["valence"] = valence;
    }
  }

private:
  /// Errors of stops, and how many drags were blocked.
  struct Errors {
    std::size_t drags = 0, blocked = 0, legs = 0;
    std::uint64_t exact = 0; ///< signs that doubles could not decide
    Latencies stop_errors; ///< in clearances; of stops with one contact whose plane is determined
    std::size_t beyond_two = 0;

    void note(const Result& result, const Sculptor_type& sculptor, const std::uint64_t& exact_signs) {
      ++drags;
      exact += exact_signs;
      legs += static_cast<std::size_t>(result.legs);
      if (result.reached)
        return;
      ++blocked;
      if (result.contacts.size() != 1 || result.contacts[0].is_flat)
        return;
      stop_errors.add_nanoseconds(result.stop_error / test::clearance_kept(sculptor, result));
      beyond_two += stop_errors.last() > 2;
    }
  };

  std::string structure_, name_;
  Mesh mesh_;
  double edge_;
  std::uint64_t seed_;
  Sculptor_type sculptor_;
  Response response_;
  std::uint64_t exact_ = 0; ///< of the last timed drag

  std::uint64_t exact_signs() const {
    return sculptor_.filter_counters().failures() - sculptor_.filter_counters().permanent;
  }

  template <class Grab_type>
  Result timed_drag(Grab_type& grab, const Point_3& target, Latencies& times) {
    const std::uint64_t before = exact_signs();
    Result result = times.measure([&] { return grab.drag_to(target); });
    exact_ = exact_signs() - before;
    return result;
  }

  Vector place(Vertex_index v) const { return vertex_coordinates(mesh_, v); }

  void take_back() {
    while (sculptor_.history().number_of_undo_steps() > 0)
      sculptor_.undo();
  }

  void add_row(Json& rows, const std::string& workload, double step, Latencies& times, Errors errors) {
    Json row = {{"structure", structure_},
                {"mesh", name_},
                {"triangles", static_cast<std::size_t>(mesh_.number_of_faces())},
                {"workload", workload},
                {"step_edges", step},
                {"response", name_of(response_)}};
    row.update(times.json());
    if (errors.drags > 0) {
      row["blocked"] = errors.blocked;
      row["mean_legs"] = static_cast<double>(errors.legs) / static_cast<double>(errors.drags);
      row["exact_signs_per_drag"] = static_cast<double>(errors.exact) / static_cast<double>(errors.drags);
    }
    if (errors.stop_errors.size() > 0) {
      const Json e = errors.stop_errors.json();
      row["stop_error_median_clearances"] = e["median_ns"];
      row["stop_error_max_clearances"] = e["max_ns"];
      row["stops_beyond_two_clearances"] = errors.beyond_two;
      row["stops_measured"] = e["count"];
    }
    rows.push_back(std::move(row));
  }
};

} // namespace haptic_sculpt::benchmark
