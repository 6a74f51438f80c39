// SPDX-License-Identifier: GPL-3.0-or-later
// CGAL's functions alone and under the guard: self-intersections, share of the way, quality, time.
#include "Benchmark_program.h"
#include "guard_for_cgal/Comparison.h"
#include "meshes/thin_walls.h"

#include <CLI/CLI.hpp>

#include <cstdio>
#include <filesystem>
#include <iostream>

using namespace haptic_sculpt;
using namespace haptic_sculpt::benchmark;

namespace {

constexpr int not_kept = 10;

struct Options : Settings {
  std::string folder, large;
  std::size_t largest = 120000;
  bool no_generated = false, no_functions = false, no_remeshing = false, no_large = false, quick = false;
};

std::vector<Named_mesh> generated(const Options& options) {
  std::vector<Named_mesh> meshes = {
      {"hidden cavity", meshes::to_mesh(meshes::hidden_cavity())},
      {"wavy plate", meshes::to_mesh(meshes::wavy_plate(16, 0.1, 0.5, 0.2, options.seed))}};
  if (!options.quick) {
    meshes.push_back({"hollow ball", meshes::to_mesh(meshes::hollow_ball(3, 0.012, options.seed))});
    meshes.push_back({"Swiss cheese", meshes::to_mesh(meshes::swiss_cheese(2, 0.01, 2, options.seed))});
  }
  return meshes;
}

/// Meshes that are refused, or too large, are named and left out.
std::vector<Named_mesh> of_folder(const Options& options) {
  std::vector<std::filesystem::path> paths;
  for (const auto& entry : std::filesystem::directory_iterator(options.folder))
    if (const auto extension = entry.path().extension();
        extension == ".off" || extension == ".obj" || extension == ".ply" || extension == ".stl")
      paths.push_back(entry.path());
  std::sort(paths.begin(), paths.end());
  std::vector<Named_mesh> meshes;
  for (const auto& path : paths) {
    std::error_code none; // what has no size is no file, which reading it says
    if (const auto size = std::filesystem::file_size(path, none); !none && size > 64 * options.largest) {
      std::fprintf(stderr, "%s: left out, it is too large (--largest)\n", path.filename().c_str());
      continue;
    }
    try {
      meshes.push_back({path.stem().string(), read_surface<Mesh>(path.string())});
    } catch (const Error& error) {
      std::fprintf(stderr, "%s: left out: %s\n", path.filename().c_str(), error.what());
    }
  }
  return meshes;
}

void print(const Comparison& c) {
  char share[16] = "";
  if (c.share)
    std::snprintf(share, sizeof share, "%.1f", 100 * *c.share);
  std::printf("| %s | %s | %s | %zu | %zu | %s | %.2g / %.2g | %.1f / %.1f | %.2f / %.2f | %.3f | %.1f%s |\n",
              c.mesh.c_str(), c.function.c_str(), c.way.c_str(), c.plain.pairs, c.guarded.pairs, share,
              c.plain.least_angle, c.guarded.least_angle, c.plain.mean_least_angle, c.guarded.mean_least_angle,
              c.plain.hausdorff, c.guarded.hausdorff, c.guarded.seconds, c.guarded.seconds / c.plain.seconds,
              c.out_of_work ? " out of drags" : "");
  std::fflush(stdout);
}

} // namespace

int main(int argc, char** argv) {
  CLI::App app("CGAL's functions alone and under the guard: self-intersecting pairs, share of the way, quality, time. "
               "Exit: 10 a guarded run ends without a valid mesh, is not undone to the bit, or does not arrive.");
  Options options;
  app.add_option("--meshes", options.folder, "A folder of .off, .obj, .ply, .stl; beside the generated ones")
      ->check(CLI::ExistingDirectory);
  app.add_option("--largest", options.largest, "Leave out files of about more triangles than this")
      ->capture_default_str();
  app.add_option("--large", options.large,
                 "The mesh of which every vertex moves by a tenth of an edge; generated where none is given")
      ->check(CLI::ExistingFile);
  app.add_option("--iterations", options.iterations, "Of remeshing")->capture_default_str();
  app.add_option("--seed", options.seed, "Of generated meshes, perturbations and directions")->capture_default_str();
  app.add_option("--only", options.only, "Only functions whose names have this in them");
  app.add_option("--drags-a-vertex", options.drags_a_vertex,
                 "At most, where results are targets; rows that ended so are marked")
      ->check(CLI::Range(0.0, 1e9));
  app.add_flag("--no-generated", options.no_generated, "Leave out the generated meshes");
  app.add_flag("--no-functions", options.no_functions, "Leave out the functions that move points");
  app.add_flag("--no-remeshing", options.no_remeshing, "Leave out remeshing");
  app.add_flag("--no-large", options.no_large, "Leave out the large mesh");
  app.add_flag("--quick", options.quick, "Small meshes only");
  Benchmark_program program("guard_for_cgal", app, "mesh, its functions and its remeshing apart");
  return program.run(argc, argv, [&](Promises& promises) {
    std::printf(
        "seed %u\n\n| mesh | function | way | pairs alone | pairs guarded | %% of the way | least angle alone / "
        "guarded | mean least angle "
        "alone / guarded | Hausdorff alone / guarded | s guarded | time ratio "
        "|\n|---|---|---|---|---|---|---|---|---|---|---|\n",
        options.seed);
    std::vector<Named_mesh> scenes;
    if (!options.no_generated)
      scenes = generated(options);
    if (!options.folder.empty())
      for (Named_mesh& scene : of_folder(options))
        scenes.push_back(std::move(scene));
    Json report = {{"seed", options.seed}, {"comparisons", Json::array()}};
    std::size_t asked = 0, broken = 0;
    for (const Named_mesh& scene : scenes) {
      std::size_t unit = 0;
      const auto tell = [&](const Comparison& c) {
        print(c);
        Json row = {{"unit", unit}};
        row.update(to_json(c));
        report["comparisons"].push_back(row);
        ++asked, broken += !c.is_kept();
        program.write_so_far(report); // after every row: a run over large meshes takes hours
      };
      const auto takes_next = [&] { return unit = program.shard.next_unit(), program.shard.takes_next(); };
      try {
        if (!has_areas(scene.mesh))
          std::fprintf(stderr,
                       "%s: areas too large or too small for CGAL's functions; remeshed under the guard alone\n",
                       scene.name.c_str());
        else if (!options.no_functions && takes_next())
          compare_functions(scene, options, tell);
        if (!options.no_remeshing && takes_next())
          compare_remeshing(scene, options, tell);
      } catch (const Invalid_surface& error) {
        std::fprintf(stderr, "%s: left out: %s\n", scene.name.c_str(), error.what());
      }
    }
    if (!options.no_large && program.shard.takes_next()) {
      const std::size_t cells = options.quick ? 40 : 516; // 2 x 2 x 516^2 = 1,065,024 triangles
      Mesh large = options.large.empty() ? meshes::to_mesh(meshes::torus(2 * cells, cells))
                                         : read_given([&] { return read_surface<Mesh>(options.large); });
      report["large"] = move_all_by_a_tenth(std::move(large), options.seed);
      std::cout << "\nevery vertex by a tenth of an edge: " << report["large"].dump() << '\n';
      ++asked, broken += report["large"]["self_intersects"].get<bool>();
    }
    promises.add(not_kept,
                 "a guarded run ends with a valid mesh, is undone and redone to the bit, and a right angle arrives",
                 asked, broken);
    return report;
  });
}
