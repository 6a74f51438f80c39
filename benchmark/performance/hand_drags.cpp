// SPDX-License-Identifier: GPL-3.0-or-later
// CPU time of single drags when a hand moves a probe, or a grabbed vertex, fast over a fine mesh: with and without a
// bound on the work of a drag, and how far the bounded drag is then from the unbounded one.
#include "Benchmark_program.h"
#include "meshes/generated_meshes.h"
#include "quantile.h"

#include <haptic_sculpt/sculpting.h>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <time.h>

#include <cstdio>
#include <cstdlib>
#include <fstream>

namespace {

using namespace haptic_sculpt;
using Mesh = meshes::Mesh;
using Point_3 = meshes::Point_3;
using Vertex_index = Mesh::Vertex_index;
using Json = nlohmann::ordered_json;

struct Options {
  int level = 8;
  double radius = 30, speed = 300, rate = 1000, depth = 2; ///< mm, mm/s, Hz, mm
  std::size_t drags = 100000, ticks_per_grab = 250, work = 0, runs = 1;
  std::uint64_t seed = 1;
};

double cpu_microseconds() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) * 1e6 + static_cast<double>(t.tv_nsec) * 1e-3;
}

Json quantiles(std::vector<double> values) {
  const auto at = [&values](double q) { return benchmark::quantile(values, q); };
  return {{"count", values.size()}, {"p50", at(0.5)},      {"p99", at(0.99)},
          {"p999", at(0.999)},      {"p9999", at(0.9999)}, {"max", at(1)}};
}

/// Where the hand is: it goes round the object along great circles whose axis turns slowly, `height` above its mean
/// radius.
class Hand_path {
public:
  Hand_path(const Options& options, double height)
      : height_(options.radius + height)
      , step_(options.speed / options.rate / options.radius)
      , tick_(options.seed * 1000) {}

  Point_3 next() {
    const double angle = step_ * static_cast<double>(tick_), turn = 0.0137 * angle;
    ++tick_;
    const double x = std::cos(angle), y = std::sin(angle) * std::cos(turn), z = std::sin(angle) * std::sin(turn);
    return Point_3(height_ * x, height_ * y, height_ * z);
  }

private:
  double height_, step_;
  std::uint64_t tick_;
};

double distance(const Point_3& a, const Point_3& b) { return std::sqrt(CGAL::squared_distance(a, b)); }

/// A mesh with its Sculptor, and one hand in it.
class Bench {
public:
  Bench(const Mesh& mesh, std::size_t work)
      : mesh_(mesh), sculptor_(mesh_, work != 0 ? parameters::work_limit(work) : Sculptor_parameters()) {}

  const Mesh& mesh() const { return mesh_; }

  /// Puts the probe where a hand comes from: outside of the object, over its place.
  void bring_probe_to(const Point_3& hand) {
    probe_.emplace(sculptor_.probe(CGAL::ORIGIN + 1.25 * (hand - CGAL::ORIGIN)));
    if (!*probe_)
      throw Error("the probe has no room over the hand");
  }
  void take(Vertex_index v) {
    stroke_.emplace(sculptor_.stroke());
    held_.emplace(sculptor_.grab(v));
  }
  void take_back() {
    if (std::exchange(probe_, std::nullopt))
      return; // it has changed nothing
    held_.reset();
    stroke_.reset();
    sculptor_.undo();
  }

  Drag_result<Mesh> drag(const Point_3& target) {
    const double start = cpu_microseconds();
    auto result = probe_ ? probe_->drag_to(target) : held_->drag_to(target);
    times.push_back(cpu_microseconds() - start);
    work.push_back(static_cast<double>(result.work));
    limited += result.end == Drag_end::work_limit ? 1 : 0;
    return result;
  }

  std::vector<double> times, work;
  std::size_t limited = 0;

private:
  Mesh mesh_;
  Sculptor<Mesh> sculptor_;
  std::optional<Stroke<Sculptor<Mesh>>> stroke_;
  std::optional<Grab<Sculptor<Mesh>>> held_;
  std::optional<Probe<Sculptor<Mesh>>> probe_;
};

/// The vertex nearest to the hand, where it begins.
Vertex_index nearest_vertex(const Mesh& mesh, const Point_3& p) {
  Vertex_index best;
  for (const Vertex_index v : mesh.vertices())
    if (!best.is_valid() || CGAL::squared_distance(mesh.point(v), p) < CGAL::squared_distance(mesh.point(best), p))
      best = v;
  return best;
}

/// What one run measured of one kind of drags.
struct Measured {
  std::vector<double> free_times, bounded_times, free_work, bounded_work, apart, apart_later;
  std::size_t limited = 0;

  /// Keeps the least time of each drag, which a run of the same bits took: the rest is the machine's.
  void take_least_times(const Measured& other) {
    const auto take = [](std::vector<double>& times, const std::vector<double>& others) {
      for (std::size_t i = 0; i < times.size(); ++i)
        times[i] = std::fmin(times[i], others[i]);
    };
    take(free_times, other.free_times), take(bounded_times, other.bounded_times);
  }
  /// Whether both made the same drags.
  bool is_like(const Measured& other) const {
    return free_work == other.free_work && bounded_work == other.bounded_work && apart == other.apart;
  }
};

Measured measure(const Mesh& mesh, const Options& options, const std::string& what, double height) {
  Bench free(mesh, 0), bounded(mesh, options.work);
  Hand_path hand(options, height);
  std::vector<double> apart, apart_later;
  for (std::size_t done = 0; done < options.drags;) {
    const std::size_t ticks = std::min(options.ticks_per_grab, options.drags - done); // the last grab may be shorter
    const Point_3 start = hand.next();
    const Vertex_index v = nearest_vertex(free.mesh(), start);
    for (Bench* bench : {&free, &bounded})
      what == "probe" ? bench->bring_probe_to(start) : bench->take(v);
    std::vector<bool> was_limited;
    for (std::size_t tick = 0; tick < ticks; ++tick) {
      const Point_3 target = hand.next();
      const auto a = free.drag(target);
      if (options.work == 0)
        continue;
      const auto b = bounded.drag(target);
      apart.push_back(distance(a.position, b.position));
      was_limited.push_back(b.end == Drag_end::work_limit);
      if (tick >= 10 && was_limited[tick - 10])
        apart_later.push_back(apart.back());
    }
    for (Bench* bench : {&free, &bounded})
      bench->take_back();
    done += ticks;
    std::fprintf(stderr, "%s: %zu of %zu drags\r", what.c_str(), done, options.drags);
  }
  return {free.times, bounded.times, free.work, bounded.work, apart, apart_later, bounded.limited};
}

Json run(const Mesh& mesh, const Options& options, const std::string& what, double height) {
  Measured m = measure(mesh, options, what, height);
  for (std::size_t i = 1; i < options.runs; ++i) {
    const Measured again = measure(mesh, options, what, height);
    if (!again.is_like(m)) {
      throw Error("two runs with the same seed differ");
    }
    m.take_least_times(again);
  }
  Json row = {
      {"what", what}, {"height_mm", height}, {"cpu_us", quantiles(m.free_times)}, {"work", quantiles(m.free_work)}};
  if (options.work != 0)
    row.update({{"bound", options.work},
                {"bounded_cpu_us", quantiles(m.bounded_times)},
                {"bounded_work", quantiles(m.bounded_work)},
                {"limited", m.limited},
                {"apart_mm", quantiles(m.apart)},
                {"apart_10_drags_later_mm", quantiles(m.apart_later)}});
  std::printf("%s\n", row.dump(2).c_str());
  std::fflush(stdout);
  return row;
}

} // namespace

int main(int argc, char** argv) {
  Options options;
  CLI::App app("CPU time of single drags under a fast hand, with and without a bound on the work of a drag. The object "
               "is a sphere with hills.");
  app.add_option("--level", options.level, "Times the icosahedron is divided: 20 * 4^level triangles")
      ->check(CLI::Range(0, 10))
      ->capture_default_str();
  app.add_option("--speed", options.speed, "Of the hand, mm/s; the object has a radius of 30 mm")
      ->capture_default_str();
  app.add_option("--rate", options.rate, "Drags a second")->check(benchmark::positive_number)->capture_default_str();
  app.add_option("--depth", options.depth, "How deep the hand is under the surface, mm")
      ->check(CLI::Range(-1e6, 1e6))
      ->capture_default_str();
  app.add_option("--drags", options.drags, "Of each kind")->capture_default_str();
  app.add_option("--ticks-per-grab", options.ticks_per_grab, "Drags until the hand lets go, and the mesh is as it was")
      ->check(benchmark::positive_number)
      ->capture_default_str();
  app.add_option("--work", options.work, "The bound; 0: none")->capture_default_str();
  app.add_option("--seed", options.seed, "Where the hand begins")->capture_default_str();
  app.add_option("--runs", options.runs, "Of the same drags; each has its least time")
      ->check(benchmark::positive_number)
      ->capture_default_str();
  benchmark::Benchmark_program program("hand_drags", app, "kind of drags");
  return program.run(argc, argv, [&](benchmark::Promises&) {
    meshes::Triangle_list list = meshes::bumpy_sphere(options.level, 0.05);
    const Mesh mesh = meshes::to_mesh(list.scale_and_move(options.radius, 0, 0, 0));
    Json report = {{"triangles", mesh.number_of_faces()},
                   {"speed_mm_s", options.speed},
                   {"rate_hz", options.rate},
                   {"seed", options.seed},
                   {"runs", options.runs},
                   {"rows", Json::array()}};
    for (const auto& [what, height] : {std::pair("probe", -options.depth), std::pair("vertex inwards", -options.depth),
                                       std::pair("vertex outwards", options.depth)}) {
      const std::size_t unit = program.shard.next_unit();
      if (!program.shard.takes_next())
        continue;
      report["rows"].push_back(run(mesh, options, what, height));
      report["rows"].back()["unit"] = unit;
    }
    return report;
  });
}
