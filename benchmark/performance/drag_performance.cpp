// SPDX-License-Identifier: GPL-3.0-or-later
// What a drag costs: against the size of the mesh, the valence, and what others do. See doc/results/drags.md.
#include "Benchmark_program.h"
#include "drag_performance/run_structures.h"

#include <CLI/CLI.hpp>

#include <iostream>
#include <map>
#if defined(__linux__)
#include <sched.h>
#endif

namespace {

using namespace haptic_sculpt::benchmark;

/// Runs on one core from now on, so that caches and time stamps are one core's. Returns whether that was possible.
bool pin_to(int core) {
#if defined(__linux__)
  cpu_set_t cores;
  CPU_ZERO(&cores);
  CPU_SET(core, &cores);
  return sched_setaffinity(0, sizeof cores, &cores) == 0;
#else
  (void)core;
  return false;
#endif
}

void print(const Json& row) {
  std::cout << row.value("structure", "") << ", " << row.value("triangles", 0) << " triangles, "
            << row.value("mesh", "")
            << (row.contains("valence") ? ", valence " + std::to_string(row["valence"].get<int>()) : "") << ", "
            << row.value("workload", "") << ", " << row.value("step_edges", 0.0) << ' ' << row.value("response", "")
            << ": ";
  for (const char* key : {"median_ns", "mean_ns", "p99_ns", "p999_ns", "max_ns"})
    if (row.contains(key))
      std::cout << key << ' ' << std::lround(row[key].get<double>()) << "  ";
  for (const char* key : {"blocked", "exact_signs_per_drag", "stop_error_max_clearances", "missed", "wrong_alarms",
                          "tree_seconds", "sculptor_seconds_with_validation", "tree_bytes_per_triangle",
                          "sculptor_bytes_per_triangle", "per_drag", "ns_a_line_when_each_tells_the_next",
                          "ns_a_line_when_all_are_known", "reads_in_a_row", "lines_in_all", "floor_ns"})
    if (row.contains(key))
      std::cout << key << ' ' << row[key] << "  ";
  std::cout << std::endl;
}

/// The slopes of log median over log valence, by least squares, from valence 16 on.
Json fits_of_valences(const Json& rows) {
  struct Sums {
    double n = 0, x = 0, y = 0, xx = 0, xy = 0;
  };
  std::map<std::pair<std::string, std::string>, Sums> all;
  for (const Json& row : rows) {
    if (!row.contains("valence") || row["valence"] < 16 || !row.contains("median_ns") || !(row["median_ns"] > 0))
      continue;
    Sums& sums = all[{row["mesh"], row["workload"]}];
    const double x = std::log(row["valence"].get<double>()), y = std::log(row["median_ns"].get<double>());
    sums.n += 1, sums.x += x, sums.y += y, sums.xx += x * x, sums.xy += x * y;
  }
  Json fits = Json::array();
  for (const auto& [key, sums] : all)
    if (sums.n > 1)
      fits.push_back({{"mesh", key.first},
                      {"workload", key.second},
                      {"exponent", (sums.n * sums.xy - sums.x * sums.y) / (sums.n * sums.xx - sums.x * sums.x)}});
  return fits;
}

/// Runs one part, a unit of a share, and prints what it has found.
template <class Run>
void run(Shard& shard, Json& rows, const Run& part) {
  const std::size_t before = rows.size(), unit = shard.next_unit();
  if (shard.takes_next())
    part();
  for (std::size_t i = before; i < rows.size(); ++i) {
    print(rows[i]);
    rows[i]["unit"] = unit;
  }
}

} // namespace

int main(int argument_count, char** arguments) {
  CLI::App app(
      "What a drag costs against the size of the mesh and the valence, beside other structures in the same run");
  std::string parts = "tfpmovn";
  std::vector<std::size_t> sizes = {1000, 10000, 100000, 1000000, 5000000};
  std::vector<std::size_t> valences = {3, 4, 6, 8, 12, 16, 24, 32, 64, 128, 256, 512, 1000};
  Effort effort;
  int core = 1;
  std::size_t largest_peer = 1000000;
  bool quick = false;
  app.add_option("--seed", effort.seed, "of the random vertices and directions");
  app.add_option("--sizes", sizes, "numbers of triangles")
      ->delimiter(',')
      ->check(CLI::Range(std::size_t{100}, std::size_t{1} << 30));
  app.add_option("--valences", valences, "of the apex of a fan; none below 3")->delimiter(',');
  app.add_option("--drags", effort.drags, "timed operations a workload")->check(positive_number);
  app.add_option("--peer-drags", effort.peer_drags, "the same, at most, for other structures")->check(positive_number);
  app.add_option("--largest-peer", largest_peer, "other structures, and the phases, get no larger mesh");
  app.add_option("--core", core, "the core to stay on; -1: any");
  app.add_option("--parts", parts,
                 "t: the box tree; f: finding and placing; p: its phases; m: memory, the floor of a new vertex; o: "
                 "other broad phases; v: valence; n: end states by CGAL");
  app.add_flag("--quick", quick, "small meshes and few drags: shows that everything runs");
  Benchmark_program program("drag_performance", app, "part and size");
  return program.run(argument_count, arguments, [&](Promises&) -> Json {
    if (parts.empty() || parts.find_first_not_of("tfpmovn") != std::string::npos)
      throw Wrong_use("--parts has letters of t, f, p, m, o, v and n, not '" + parts + "'");
    Shard& shard = program.shard;
    if (quick) {
      sizes = {1000, 4000};
      valences = {3, 16, 64};
      effort.drags = 200, effort.peer_drags = 50, effort.slow = 1;
    }
    const bool is_pinned = core >= 0 && pin_to(core);
    timer(); // calibrates itself now, not within the first measurement
    const auto wanted = [&](char part) { return parts.find(part) != std::string::npos; };
    Json rows = Json::array(), phases = Json::array();
    for (const std::size_t triangles : sizes) {
      if (wanted('t'))
        run(shard, rows, [&] { run_box_tree(rows, triangles, effort); });
      if (wanted('f'))
        run(shard, rows, [&] { run_finding(rows, triangles, effort); });
      if (wanted('p') && triangles <= largest_peer)
        run(shard, phases, [&] { run_phases(phases, triangles, effort); });
      if (triangles > largest_peer)
        continue;
      if (wanted('m'))
        run(shard, rows, [&] { run_memory(rows, triangles, effort); });
      if (wanted('o')) {
        run(shard, rows, [&] { run_brute_force(rows, triangles, effort); });
        run(shard, rows, [&] { run_six_lists(rows, triangles, effort); });
        run(shard, rows, [&] { run_rtree(rows, triangles, effort); });
      }
      if (wanted('n'))
        run(shard, rows, [&] { run_end_states(rows, triangles, effort); });
    }
    if (wanted('v'))
      run(shard, rows, [&] { run_valences(rows, valences, effort); });
    const Json fits = fits_of_valences(rows);
    for (const Json& fit : fits)
      std::cout << fit.dump() << '\n';
    return {{"seed", effort.seed},
            {"pinned_to_core", is_pinned ? Json(core) : Json(nullptr)},
            {"timer_resolution_ns", timer().resolution()},
            {"timer_overhead_ns", timer().overhead()},
            {"valence_fits", fits},
            {"rows", rows},
            {"phases", phases}};
  });
}
