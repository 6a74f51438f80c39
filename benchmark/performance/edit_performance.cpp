// SPDX-License-Identifier: GPL-3.0-or-later
// Time of each edit, its undo and redo, against the size of the mesh and against the valence; memory of a step that can
// be undone.
#include "Benchmark_program.h"
#include "Query_timer.h"
#include "meshes/generated_meshes.h"
#include "quantile.h"

#include <haptic_sculpt/sculpting.h>
#include <haptic_sculpt/surface.h>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <cstdio>
#include <cstdlib>
#include <functional>
#include <iostream>

namespace {

using namespace haptic_sculpt;
using Mesh = meshes::Mesh;
using Point_3 = meshes::Point_3;
using Vertex_index = Mesh::Vertex_index;
using Edited = Edit_result<Mesh>;
using Json = nlohmann::ordered_json;
using benchmark::Query_timer;

struct Options {
  std::uint64_t seed = 1;
  std::size_t samples = 2000, largest = 2000000, largest_valence = 1024;
  bool reserve = false;
};

/// Times in nanoseconds of one kind of edit.
struct Times {
  std::vector<double> edit, undo, redo;
  std::size_t refused = 0;
  double bytes_per_step = 0;
};

Json summary(std::vector<double> times) {
  const auto at = [&times](double share) { return benchmark::quantile(times, share); };
  return {{"samples", times.size()}, {"p50", at(0.5)}, {"p99", at(0.99)}, {"p999", at(0.999)}, {"max", at(1)}};
}

/// Makes edits one after another, each somewhere else, then undoes all of them and redoes all of them, so that neither
/// finds its part of the mesh in the cache because it has just been there. Repeats that until there are enough times.
class Bench {
public:
  Bench(const Mesh& mesh, const Query_timer& timer, const Options& options)
    : mesh_(with_room(mesh, options.reserve)), sculptor_(mesh_), timer_(timer), random_(options.seed) {}

  using Make_edit = std::function<bool()>; ///< false: refused

  Times measure(std::size_t samples, std::size_t edits_in_a_row, const Make_edit& make) {
    Times times;
    for (std::size_t tries = 0; times.edit.size() < samples && tries < 4 * samples;) {
      std::size_t done = 0;
      for (std::size_t i = 0; i < edits_in_a_row && times.edit.size() < samples; ++i, ++tries) {
        duration_ = -1;
        if (make()) {
          times.edit.push_back(duration_);
          ++done;
        } else {
          ++times.refused;
        }
      }
      if (done != 0)
        times.bytes_per_step = static_cast<double>(sculptor_.history().bytes()) /
                               static_cast<double>(sculptor_.history().number_of_undo_steps());
      for (std::size_t i = 0; i < done; ++i)
        times.undo.push_back(time([&] { sculptor_.undo(); }));
      for (std::size_t i = 0; i < done; ++i)
        times.redo.push_back(time([&] { sculptor_.redo(); }));
      for (std::size_t i = 0; i < done; ++i)
        sculptor_.undo();
    }
    return times;
  }

  bool insert_on_face(Mesh::Face_index f) {
    const auto h = mesh_.halfedge(f);
    const Point_3 p = CGAL::centroid(mesh_.point(mesh_.source(h)), mesh_.point(mesh_.target(h)),
                                     mesh_.point(mesh_.target(mesh_.next(h))));
    return timed([&] { return static_cast<bool>(sculptor_.insert_on_face(f, p)); });
  }
  bool insert_on_edge(Mesh::Edge_index e) {
    const Point_3 p = CGAL::midpoint(mesh_.point(mesh_.vertex(e, 0)), mesh_.point(mesh_.vertex(e, 1)));
    return timed([&] { return static_cast<bool>(sculptor_.insert_on_edge(e, p)); });
  }
  bool remove(Vertex_index v) {
    return timed([&] { return static_cast<bool>(sculptor_.remove(v)); });
  }
  bool collapse(Mesh::Halfedge_index h) {
    return timed([&] { return static_cast<bool>(sculptor_.collapse(h)); });
  }
  bool flip(Mesh::Edge_index e) {
    return timed([&] { return static_cast<bool>(sculptor_.flip(e)); });
  }
  /// By a tenth of an edge, outward and sideways.
  bool drag(Vertex_index v) {
    const auto h = mesh_.halfedge(v);
    const Point_3 p = mesh_.point(v), q = mesh_.point(mesh_.source(h)), target = p + 0.1 * (p - q);
    return timed([&] { return sculptor_.grab(v).drag_to(target).position != p; });
  }

  const Mesh& mesh() const { return mesh_; }
  template <class Index>
  Index any(std::size_t slots) {
    for (;;) {
      const Index i(static_cast<Mesh::size_type>(random_() % slots));
      if (!mesh_.is_removed(i))
        return i;
    }
  }

private:
  Mesh mesh_;
  Sculptor<Mesh> sculptor_;
  const Query_timer& timer_;
  std::mt19937_64 random_;
  double duration_ = 0;

  static Mesh with_room(Mesh mesh, bool reserve) {
    if (reserve)
      mesh.reserve(2 * mesh.num_vertices(), 2 * mesh.num_edges(), 2 * mesh.num_faces());
    return mesh;
  }
  template <class Work>
  double time(const Work& work) {
    const std::uint64_t begin = Query_timer::now();
    work();
    return timer_.nanoseconds(begin, Query_timer::now());
  }
  template <class Work>
  bool timed(const Work& work) {
    bool done = false;
    duration_ = time([&] { done = work(); });
    return done;
  }
};

Json row(const char* name, const Times& times) {
  const Json edit = summary(times.edit), undo = summary(times.undo), redo = summary(times.redo);
  std::printf("  %-15s %9.0f %9.0f %9.0f | %9.0f %9.0f | %9.0f %9.0f | %5.0f\n", name, edit["p50"].get<double>(),
              edit["p99"].get<double>(), edit["max"].get<double>(), undo["p50"].get<double>(),
              undo["p99"].get<double>(), redo["p50"].get<double>(), redo["p99"].get<double>(), times.bytes_per_step);
  std::fflush(stdout);
  Json result = {{"edit", name}, {"ns", edit}, {"undo_ns", undo}, {"redo_ns", redo}, {"refused", times.refused}};
  if (times.bytes_per_step != 0)
    result["bytes_per_undo_step"] = times.bytes_per_step;
  return result;
}

Json against_size(const Options& options, benchmark::Shard& shard, const Query_timer& timer) {
  Json sizes = Json::array();
  for (int level = 3; level < 10; ++level) {
    if (20 * (std::size_t{1} << 2 * level) > options.largest)
      break;
    const std::size_t unit = shard.next_unit();
    if (!shard.takes_next())
      continue;
    const Mesh mesh = meshes::to_mesh(meshes::bumpy_sphere(level, 0.2, 0.02 / (1 << level)));
    std::printf("%zu triangles\n", static_cast<std::size_t>(mesh.number_of_faces()));
    Bench bench(mesh, timer, options);
    const Mesh& m = bench.mesh();
    const std::size_t in_a_row = std::min<std::size_t>(options.samples, mesh.number_of_vertices() / 8);
    const auto run = [&](const Bench::Make_edit& make) { return bench.measure(options.samples, in_a_row, make); };
    Json rows = Json::array();
    rows.push_back(
        row("insert on face", run([&] { return bench.insert_on_face(bench.any<Mesh::Face_index>(m.num_faces())); })));
    rows.push_back(
        row("insert on edge", run([&] { return bench.insert_on_edge(bench.any<Mesh::Edge_index>(m.num_edges())); })));
    rows.push_back(row("remove", run([&] { return bench.remove(bench.any<Vertex_index>(m.num_vertices())); })));
    rows.push_back(
        row("collapse", run([&] { return bench.collapse(m.halfedge(bench.any<Mesh::Edge_index>(m.num_edges()))); })));
    rows.push_back(row("flip", run([&] { return bench.flip(bench.any<Mesh::Edge_index>(m.num_edges())); })));
    rows.push_back(row("drag", run([&] { return bench.drag(bench.any<Vertex_index>(m.num_vertices())); })));
    sizes.push_back({{"unit", unit}, {"triangles", mesh.number_of_faces()}, {"edits", rows}});
  }
  return sizes;
}

Json against_valence(const Options& options, benchmark::Shard& shard, const Query_timer& timer) {
  Json valences = Json::array();
  for (std::size_t valence = 4; valence <= options.largest_valence; valence *= 4) {
    const std::size_t unit = shard.next_unit();
    if (!shard.takes_next())
      continue;
    std::printf("valence %zu\n", valence);
    Bench bench(meshes::to_mesh(meshes::bipyramid(valence)), timer, options);
    const std::size_t samples = std::max<std::size_t>(5, std::min<std::size_t>(options.samples, 20000 / valence));
    // Undo may revive the apex under another index: it is the one that stands on top.
    const auto apex = [&] {
      const auto vertices = bench.mesh().vertices();
      return *std::find_if(vertices.begin(), vertices.end(),
                           [&](Vertex_index v) { return bench.mesh().point(v) == Point_3(0, 0, 1); });
    };
    const auto run = [&](const Bench::Make_edit& make) { return bench.measure(samples, 1, make); };
    Json rows = Json::array();
    rows.push_back(row("insert on face", run([&] { return bench.insert_on_face(Mesh::Face_index(0)); })));
    rows.push_back(row("insert on edge",
                       run([&] { return bench.insert_on_edge(bench.mesh().edge(bench.mesh().halfedge(apex()))); })));
    rows.push_back(row("remove", run([&] { return bench.remove(apex()); })));
    rows.push_back(row("flip", run([&] { return bench.flip(bench.mesh().edge(bench.mesh().halfedge(apex()))); })));
    rows.push_back(row("drag", run([&] { return bench.drag(apex()); })));
    valences.push_back({{"unit", unit}, {"valence", valence}, {"edits", rows}});
  }
  return valences;
}

} // namespace

int main(int argc, char** argv) {
  Options options;
  CLI::App app("Times each edit, its undo and redo at 10^3 to 10^6 triangles, random places of a bumpy sphere, and at "
               "the apex of a bipyramid\n"
               "of growing valence. Edits are made in a row at different places, then all undone, then all redone. "
               "Nanoseconds.");
  app.add_option("--seed", options.seed, "Seed")->capture_default_str();
  app.add_option("--samples", options.samples, "Edits of each kind, by valence fewer, but at least 5")
      ->capture_default_str()
      ->check(benchmark::positive_number);
  app.add_option("--largest", options.largest, "No mesh of more triangles")->capture_default_str();
  app.add_option("--largest-valence", options.largest_valence, "No higher valence")->capture_default_str();
  app.add_flag("--reserve", options.reserve,
               "Reserve room in the mesh first, so that its arrays need not be copied when they are full");
  benchmark::Benchmark_program program("edit_performance", app, "size or valence");
  return program.run(argc, argv, [&](benchmark::Promises&) -> Json {
    const Query_timer timer;
    std::printf("  %-15s %9s %9s %9s | %9s %9s | %9s %9s | bytes\n", "edit", "p50 ns", "p99", "max", "undo p50", "p99",
                "redo p50", "p99");
    const Json sizes = against_size(options, program.shard, timer),
               valences = against_valence(options, program.shard, timer);
    return {{"seed", options.seed},
            {"samples", options.samples},
            {"clock_step_ns", timer.resolution()},
            {"sizes", sizes},
            {"valences", valences}};
  });
}
