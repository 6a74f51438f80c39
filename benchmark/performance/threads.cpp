// SPDX-License-Identifier: GPL-3.0-or-later
// Time by the clock of axis moves of all vertices and of validation, with one thread after the other number of threads
// in turn, and whether each number makes the same bits.
#include "Benchmark_program.h"
#include "meshes/generated_meshes.h"
#include "quantile.h"

#include <haptic_sculpt/sculpting.h>
#include <haptic_sculpt/surface.h>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#ifdef CGAL_LINKED_WITH_TBB
#include <tbb/global_control.h>
#include <tbb/task_arena.h>
#endif

#include <chrono>
#include <cstdio>
#include <random>

namespace {

using namespace haptic_sculpt;
using Mesh = meshes::Mesh;
using Vertex_index = Mesh::Vertex_index;
using Json = nlohmann::ordered_json;
using Ways = std::vector<std::pair<Vertex_index, double>>;

constexpr int other_bits = 10;

template <class Function>
double seconds_of(const Function& function) {
  const auto begin = std::chrono::steady_clock::now();
  function();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

struct Times {
  double shift = 0, held_back = 0, validation = 0; ///< the median of the moves, a move of whose ways most are shortened
  std::vector<Mesh::Point> points;                 ///< at the end
};

/// The same motions each time.
template <class Tag>
Times times_of(Mesh mesh, std::uint64_t seed, int moves) {
  Sculptor<Mesh> sculptor(mesh, parameters::known_valid(true));
  sculptor.set_history_limit(History_limit::off());
  double edge = 0;
  for (const auto e : mesh.edges())
    edge += std::sqrt(CGAL::squared_distance(mesh.point(mesh.vertex(e, 0)), mesh.point(mesh.vertex(e, 1))));
  edge /= static_cast<double>(mesh.number_of_edges());
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> number(-1, 1);
  std::vector<double> shifts;
  const auto shift = [&](int axis, double length) {
    Ways ways;
    for (const Vertex_index v : mesh.vertices())
      ways.emplace_back(v, mesh.point(v)[axis] + length * edge * number(random));
    return seconds_of([&] { sculptor.shift<Tag>(axis, ways); });
  };
  shift(0, 0.05); // looks at all faces for the first time
  for (int k = 0; k < moves; ++k)
    shifts.push_back(shift(k % 3, 0.05));
  Times times;
  times.shift = benchmark::quantile(shifts, 0.5);
  auto targets = mesh.add_property_map<Vertex_index, Mesh::Point>("v:targets").first;
  for (const Vertex_index v : mesh.vertices()) {
    const double x = number(random), y = number(random), z = number(random);
    targets[v] = mesh.point(v) + 2 * edge * meshes::Kernel::Vector_3(x, y, z);
  }
  times.held_back =
      seconds_of([&] { move_vertices<Tag>(sculptor, mesh.vertices(), targets, Move_parameters().drags(false)); });
  bool is_valid = false;
  times.validation = seconds_of([&] { is_valid = validate<Tag>(mesh).is_valid(); });
  if (is_valid)
    times.points.assign(mesh.points().begin(), mesh.points().end());
  return times;
}

} // namespace

int main(int argc, char** argv) {
  std::string file;
  int level = 7, moves = 6;
  std::vector<int> threads{1, 2};
  std::uint64_t seed = 1;
  CLI::App app("Times axis moves of all vertices and validation with several threads. Exit: 10 another number of "
               "threads makes other bits, or the mesh is not valid at the end.");
  app.add_option("--mesh", file, "OFF, OBJ or PLY; hills on a sphere where none is given");
  app.add_option("--level", level, "of the hills: 20 * 4^level triangles")
      ->check(CLI::Range(2, 9))
      ->capture_default_str();
  app.add_option("--moves", moves, "the median of this many is taken")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  app.add_option("--threads", threads, "numbers of threads, e.g. 1,2,4")
      ->delimiter(',')
      ->check(CLI::Range(1, 1024))
      ->capture_default_str();
  app.add_option("--seed", seed, "of the motions")->capture_default_str();
  benchmark::Benchmark_program program("threads", app, "number of threads");
  return program.run(argc, argv, [&](benchmark::Promises& promises) -> Json {
    const Mesh mesh = file.empty()
                          ? meshes::to_mesh(meshes::bumpy_sphere(level, 0.2, 0.01, static_cast<std::uint32_t>(seed)))
                          : benchmark::read_given([&] { return read_surface<Mesh>(file); });
    std::printf("%zu triangles, seed %llu; seconds by the clock\n%-8s %10s %10s %10s %10s\n",
                std::size_t{mesh.number_of_faces()}, static_cast<unsigned long long>(seed), "threads", "shift",
                "held back", "validate", "same bits");
    const Times alone = times_of<CGAL::Sequential_tag>(mesh, seed, moves);
    Json rows = Json::array();
    std::size_t asked = program.shard.is_first(); // whether it is valid at the end: all shards see that
    std::size_t broken = program.shard.is_first() && alone.points.empty();
    const auto tell = [&](int count, const Times& times) {
      const bool is_same = times.points == alone.points;
      asked += count > 0, broken += !is_same; // without threads it is what is compared with
      std::printf("%-8s %10.3f %10.3f %10.3f %10s\n", count == 0 ? "none" : std::to_string(count).c_str(), times.shift,
                  times.held_back, times.validation, is_same ? "yes" : "NO");
      rows.push_back({{"unit", program.shard.next_unit() - 1},
                      {"threads", count},
                      {"shift_s", times.shift},
                      {"held_back_s", times.held_back},
                      {"validate_s", times.validation},
                      {"same_bits", is_same}});
    };
    if (program.shard.takes_next())
      tell(0, alone);
#ifdef CGAL_LINKED_WITH_TBB
    for (const int count : threads) {
      if (!program.shard.takes_next())
        continue;
      const tbb::global_control most(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(count));
      tbb::task_arena arena(count);
      Times times;
      arena.execute([&] { times = times_of<CGAL::Parallel_tag>(mesh, seed, moves); });
      tell(count, times);
    }
#else
  std::printf("compiled without oneTBB: nothing is shared\n");
#endif
    promises.add(other_bits, "any number of threads makes the same bits, of a mesh that is valid at the end", asked,
                 broken);
    return {{"triangles", mesh.number_of_faces()}, {"seed", seed}, {"rows", rows}};
  });
}
