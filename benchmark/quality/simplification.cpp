// SPDX-License-Identifier: GPL-3.0-or-later
// CGAL's edge_collapse beside decimate(), with the same policies to the same number of edges: time, pairs of faces that
// meet, distance from the input.
#include "Benchmark_program.h"
#include "meshes/generated_meshes.h"
#include "meshes/thin_walls.h"
#include "sculpting/many_vertices/Edge_count_stop.h"

#include <haptic_sculpt/sculpting/decimate.h>
#include <haptic_sculpt/surface.h>

#include <CGAL/Polygon_mesh_processing/distance.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Random.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/GarlandHeckbert_plane_policies.h>
#include <CGAL/Surface_mesh_simplification/edge_collapse.h>

#include <cstdio>
#include <ctime>
#include <iostream>

namespace {

using namespace haptic_sculpt;
using namespace haptic_sculpt::benchmark;
using Mesh = meshes::Mesh;
using Json = nlohmann::ordered_json;
namespace PMP = CGAL::Polygon_mesh_processing;
namespace SMS = CGAL::Surface_mesh_simplification;

constexpr int not_embedded = 10;

std::size_t number_of_pairs(const Mesh& mesh) {
  std::vector<std::pair<Mesh::Face_index, Mesh::Face_index>> pairs;
  PMP::self_intersections(mesh, std::back_inserter(pairs));
  return pairs.size();
}

/// Sampled on both surfaces, 20 points a face of the result on each: rounded, and from below.
double hausdorff_distance(const Mesh& input, const Mesh& result) {
  CGAL::get_default_random() = CGAL::Random(7); // points on faces do not go by `random_seed`
  const auto sampled = CGAL::parameters::random_seed(7).number_of_points_on_faces(
      std::max<std::size_t>(20 * result.number_of_faces(), 200000));
  return PMP::approximate_symmetric_Hausdorff_distance<CGAL::Sequential_tag>(input, result, sampled, sampled);
}

const char* const policies_named[] = {"Lindstrom-Turk", "plane quadrics"};

/// \param simplify is called with the mesh, when to stop, and CGAL's named parameters
template <class Simplify>
Json row(const std::string& name, const char* method, int policies, double share, const Mesh& input,
         const Simplify& simplify) {
  Mesh mesh = input;
  const Edge_count_stop<Mesh> stop(static_cast<std::size_t>(share * static_cast<double>(mesh.number_of_edges())));
  const std::clock_t begin = std::clock();
  if (policies == 0) {
    simplify(mesh, stop, CGAL::parameters::default_values());
  } else {
    SMS::GarlandHeckbert_plane_policies<Mesh, meshes::Kernel> quadrics(mesh);
    simplify(mesh, stop, CGAL::parameters::get_cost(quadrics.get_cost()).get_placement(quadrics.get_placement()));
  }
  const double seconds = static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
  mesh.collect_garbage();
  const std::size_t pairs = number_of_pairs(mesh);
  const double distance = hausdorff_distance(input, mesh);
  std::printf("%s: %s, %s: %zu to %zu faces, %.3f s, %zu pairs, distance %g\n", name.c_str(), policies_named[policies],
              method, static_cast<std::size_t>(input.number_of_faces()),
              static_cast<std::size_t>(mesh.number_of_faces()), seconds, pairs, distance);
  std::fflush(stdout);
  return {{"mesh", name},
          {"method", method},
          {"policies", policies_named[policies]},
          {"faces_before", input.number_of_faces()},
          {"faces_left", mesh.number_of_faces()},
          {"seconds", seconds},
          {"pairs", pairs},
          {"distance", distance},
          {"valid", validate(mesh).is_valid()}};
}

std::vector<std::pair<std::string, Mesh>> generated_meshes(int level, unsigned seed) {
  return {{"hollow ball", meshes::to_mesh(meshes::hollow_ball(level, 0.02, seed))},
          {"wavy plate", meshes::to_mesh(meshes::wavy_plate(std::size_t{4} << level, 0.1, 0.5, 0.2, seed))},
          {"hills", meshes::to_mesh(meshes::bumpy_sphere(level, 0.2, 0.01, seed))},
          {"Swiss cheese", meshes::to_mesh(meshes::swiss_cheese(2, 0.02, std::max(1, level - 1), seed))}};
}

} // namespace

int main(int argc, char** argv) {
  CLI::App app(
      "CGAL's edge_collapse beside decimate(), with the same policies to the same share of the edges: time, pairs "
      "of faces that meet, distance from the input. Exit: 10 a guarded mesh is not embedded.");
  std::vector<std::string> files;
  unsigned seed = 1;
  int level = 3;
  double share = 0.1;
  app.add_option("--meshes", files, "Files of meshes, in place of generated ones");
  app.add_option("--seed", seed, "Of the generated meshes")->capture_default_str();
  app.add_option("--level", level, "Their fineness; below 2 they cross themselves")
      ->check(CLI::Range(2, 8))
      ->capture_default_str();
  app.add_option("--share", share, "Of the edges that is to be left")
      ->check(CLI::Range(0.01, 1.0))
      ->capture_default_str();
  Benchmark_program program("simplification", app, "mesh");
  return program.run(argc, argv, [&](Promises& promises) -> Json {
    std::vector<std::pair<std::string, Mesh>> inputs;
    for (const std::string& path : files)
      inputs.emplace_back(path, read_given([&] { return read_surface<Mesh>(path); }));
    if (files.empty())
      inputs = generated_meshes(level, seed);
    const auto guarded = [](Mesh& mesh, const auto& stop, const auto& np) {
      Sculptor<Mesh> sculptor(mesh);
      decimate(sculptor, stop, np);
    };
    const auto alone = [](Mesh& mesh, const auto& stop, const auto& np) { SMS::edge_collapse(mesh, stop, np); };
    Json rows = Json::array();
    std::size_t asked = 0, broken = 0;
    for (const auto& [name, mesh] : inputs) {
      const std::size_t unit = program.shard.next_unit(), before = rows.size();
      if (!program.shard.takes_next())
        continue;
      for (const int policies : {0, 1}) {
        rows.push_back(row(name, "under the guard", policies, share, mesh, guarded));
        ++asked, broken += !rows.back()["valid"].get<bool>();
        rows.push_back(row(name, "edge_collapse", policies, share, mesh, alone));
      }
      for (std::size_t k = before; k < rows.size(); ++k)
        rows[k]["unit"] = unit;
    }
    promises.add(not_embedded, "a mesh simplified under the guard is embedded", asked, broken);
    return {{"seed", seed}, {"level", level}, {"share", share}, {"rows", rows}};
  });
}
