// SPDX-License-Identifier: GPL-3.0-or-later
// CPU time of dabs with each brush at random places of a mesh, each of about as many vertices, and the share of the way
// that is gone; the mesh is validated at the end.
#include "Benchmark_program.h"
#include "meshes/generated_meshes.h"
#include "quantile.h"

#include <haptic_sculpt/sculpting.h>
#include <haptic_sculpt/surface.h>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <cstdio>
#include <ctime>
#include <random>

namespace {

using namespace haptic_sculpt;
using Mesh = meshes::Mesh;
using Kernel = meshes::Kernel;
using Vertex_index = Mesh::Vertex_index;
using Json = nlohmann::ordered_json;

constexpr int not_embedded = 10;

double milliseconds() {
  return 1e3 * static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

/// How far from its centre a dab touches as many vertices as asked.
double radius_about(const Mesh& mesh, Vertex_index centre, std::size_t vertices, double guess) {
  Dab_3<Kernel> dab{Brush_kind::grab, mesh.point(centre), guess, 0, {}};
  for (int k = 0; k < 20; ++k) {
    const double touched = static_cast<double>(touched_vertices(mesh, dab, centre).size());
    const double ratio = static_cast<double>(vertices) / touched;
    if (std::abs(ratio - 1) < 0.02)
      break;
    dab.radius *= std::sqrt(std::sqrt(ratio)); // of a surface the root; half of that, lest it swings
  }
  return dab.radius;
}

struct Tally {
  std::vector<double> times, touched;
  double asked = 0, left = 0; // sums of squared distances
};

} // namespace

int main(int argc, char** argv) {
  std::string file;
  int level = 6;
  std::size_t dabs = 1000, vertices = 5000;
  std::uint64_t seed = 1;
  bool drags = false;
  CLI::App app("Times dabs with each brush. Exit: 10 the mesh is not "
               "valid at the end.");
  app.add_option("--mesh", file, "OFF, OBJ or PLY; hills on a sphere where none is given");
  app.add_option("--level", level, "of the hills: 20 * 4^level triangles")
      ->check(CLI::Range(2, 9))
      ->capture_default_str();
  app.add_option("--dabs", dabs, "with each brush")->check(CLI::Range(1, 1000000))->capture_default_str();
  app.add_option("--vertices", vertices, "in a dab, approximately")
      ->check(CLI::Range(8, 10000000))
      ->capture_default_str();
  app.add_option("--seed", seed, "of the places")->capture_default_str();
  app.add_flag("--drags", drags, "what is held back is brought on by smaller steps, drags and slides");
  benchmark::Benchmark_program program("brush_dabs", app, "brush");
  return program.run(argc, argv, [&](benchmark::Promises& promises) -> Json {
    const Mesh start = file.empty()
                           ? meshes::to_mesh(meshes::bumpy_sphere(level, 0.2, 0.01, static_cast<std::uint32_t>(seed)))
                           : benchmark::read_given([&] { return read_surface<Mesh>(file); });
    const auto parameters = Move_parameters().drags(drags);
    std::size_t asked = 0, broken = 0;
    Json rows = Json::array();
    std::printf("%zu triangles, seed %llu; milliseconds of a dab\n%-8s %8s %8s %8s %8s %8s %10s\n",
                std::size_t{start.number_of_faces()}, static_cast<unsigned long long>(seed), "brush", "vertices", "p50",
                "p99", "max", "share", "valid");
    for (const char* const name : {"grab", "inflate", "smooth", "flatten", "pinch"}) {
      const std::size_t unit = program.shard.next_unit();
      if (!program.shard.takes_next())
        continue;
      std::mt19937_64 random(seed * 1000003 + unit);
      Mesh mesh = start;
      Sculptor<Mesh> sculptor(mesh, Sculptor_parameters().known_valid(true));
      Tally tally;
      double radius = 1; // the last is a good guess
      const Brush_kind kind = *brush_kind(name);
      for (std::size_t k = 0; k < dabs; ++k) {
        Vertex_index v(static_cast<std::uint32_t>(random() % mesh.num_vertices()));
        radius = radius_about(mesh, v, vertices, radius);
        // What a hand does in a sixtieth of a second, as the window makes it.
        const double strength = kind == Brush_kind::grab      ? 0.1 * radius
                                : kind == Brush_kind::inflate ? 0.03 * radius
                                : kind == Brush_kind::pinch   ? 0.25
                                                              : 1;
        const std::array<Dab_3<Kernel>, 1> dab{{{kind, mesh.point(v), radius, strength, {}}}};
        const double begin = milliseconds();
        const Move_report report =
            apply_brush(sculptor, dab, boost::static_property_map<double, Vertex_index>(1.0), parameters);
        tally.times.push_back(milliseconds() - begin);
        tally.touched.push_back(static_cast<double>(report.asked));
        tally.asked += report.asked_l2 * report.asked_l2, tally.left += report.left_l2 * report.left_l2;
      }
      const bool is_valid = validate(mesh).is_valid();
      const double share = 1 - std::sqrt(tally.left / tally.asked);
      ++asked, broken += !is_valid;
      rows.push_back({{"unit", unit},
                      {"brush", name},
                      {"dabs", dabs},
                      {"vertices_p50", benchmark::quantile(tally.touched, 0.5)},
                      {"ms_p50", benchmark::quantile(tally.times, 0.5)},
                      {"ms_p99", benchmark::quantile(tally.times, 0.99)},
                      {"ms_max", benchmark::quantile(tally.times, 1)},
                      {"share_of_the_way", share},
                      {"is_valid", is_valid}});
      std::printf("%-8s %8.0f %8.2f %8.2f %8.2f %8.4f %10s\n", name, benchmark::quantile(tally.touched, 0.5),
                  benchmark::quantile(tally.times, 0.5), benchmark::quantile(tally.times, 0.99),
                  benchmark::quantile(tally.times, 1), share, is_valid ? "yes" : "NO");
      std::fflush(stdout);
    }
    promises.add(not_embedded, "a mesh is embedded after all dabs", asked, broken);
    return {{"triangles", start.number_of_faces()}, {"seed", seed}, {"rows", rows}};
  });
}
