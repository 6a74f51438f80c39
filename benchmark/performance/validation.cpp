// SPDX-License-Identifier: GPL-3.0-or-later
// Time of the validity oracle against the size of the mesh, beside CGAL's does_self_intersect, and whether both say the
// same of each mesh as it is and with one vertex pulled through it.
#include "Benchmark_program.h"
#include "meshes/generated_meshes.h"

#include <haptic_sculpt/surface.h>

#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <functional>

namespace {

using namespace haptic_sculpt;
using Mesh = meshes::Mesh;
using meshes::Triangle_list;
using Json = nlohmann::ordered_json;
namespace PMP = CGAL::Polygon_mesh_processing;

constexpr int other_verdict = 10;

/// n tetrahedra at the points of a lattice: as many components as there can be.
Triangle_list lattice_of_tetrahedra(std::size_t n) {
  const auto side = static_cast<std::size_t>(std::ceil(std::cbrt(static_cast<double>(n))));
  Triangle_list list;
  for (std::size_t i = 0; i < n; ++i) {
    Triangle_list one = meshes::tetrahedron(0.5);
    list += one.scale_and_move(1, static_cast<double>(i % side), static_cast<double>(i / side % side),
                               static_cast<double>(i / side / side));
  }
  return list;
}

/// n tetrahedra in a row, all inside of a box: the ray of each meets the box and many others.
Triangle_list row_in_a_box(std::size_t n) {
  Triangle_list list = meshes::box(1, static_cast<double>(n) + 2);
  for (std::size_t i = 0; i < n; ++i) {
    Triangle_list one = meshes::tetrahedron(0.5);
    list += one.turn_inside_out().scale_and_move(1, static_cast<double>(i) + 1, 1, 1);
  }
  return list;
}

/// n cubes one in the other, every second one inside out.
Triangle_list nested_cubes(std::size_t n) {
  Triangle_list list;
  for (std::size_t i = 0; i < n; ++i) {
    const double size = static_cast<double>(2 * (n - i));
    Triangle_list one = meshes::cube().scale_and_move(size, -size / 2, -size / 2, -size / 2);
    list += i % 2 == 0 ? one : one.turn_inside_out();
  }
  return list;
}

struct Family {
  const char* name;
  std::function<Triangle_list(std::size_t)> make; ///< of about as many faces
  std::size_t largest;
};

std::vector<Family> families() {
  return {{"torus",
           [](std::size_t f) {
             const auto n = static_cast<std::size_t>(std::sqrt(f / 4.));
             return meshes::torus(2 * n, n);
           },
           10000000},
          {"two vertices of valence n", [](std::size_t f) { return meshes::bipyramid(f / 2); }, 10000},
          {"lattice of tetrahedra", [](std::size_t f) { return lattice_of_tetrahedra(f / 4); }, 1000000},
          {"row of tetrahedra in a box", [](std::size_t f) { return row_in_a_box(f / 4); }, 200000},
          {"nested cubes", [](std::size_t f) { return nested_cubes(f / 12); }, 200000}};
}

struct Answer {
  bool is_valid;
  double seconds;
};

Answer timed(const std::function<bool()>& ask) {
  const auto begin = std::chrono::steady_clock::now();
  const bool is_valid = ask();
  return {is_valid, std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count()};
}

/// Puts the first vertex behind the one farthest from it, through all that lies between.
void pull_through(Mesh& mesh) {
  const Mesh::Vertex_index v(0);
  Mesh::Vertex_index farthest = v;
  for (const auto w : mesh.vertices())
    if (CGAL::has_larger_distance_to_point(mesh.point(v), mesh.point(w), mesh.point(farthest)))
      farthest = w;
  mesh.point(v) = mesh.point(farthest) + 0.5 * (mesh.point(farthest) - mesh.point(v));
}

} // namespace

int main(int argc, char** argv) {
  std::size_t largest = 100000;
  CLI::App app("Times validate() against the number of triangles, beside CGAL's does_self_intersect, which looks for "
               "intersections alone. Exit: 10 a verdict differs from CGAL's, or "
               "a generated mesh is not valid.");
  app.add_option("--largest", largest, "triangles, from 1,000 on by factors of ten")->capture_default_str();
  benchmark::Benchmark_program program("validation", app, "mesh");
  return program.run(argc, argv, [&](benchmark::Promises& promises) -> Json {
    Json rows = Json::array();
    std::size_t asked = 0, broken = 0;
    std::printf("%-28s %10s %12s %12s %12s\n", "mesh", "triangles", "validate, s", "CGAL, s", "bad: both");
    for (const Family& family : families())
      for (std::size_t faces = 1000; faces <= std::min(largest, family.largest); faces *= 10) {
        const std::size_t unit = program.shard.next_unit();
        if (!program.shard.takes_next())
          continue;
        Mesh mesh = meshes::to_mesh(family.make(faces));
        const Answer ours = timed([&] { return validate(mesh).is_valid(); }),
                     cgal = timed([&] { return !PMP::does_self_intersect(mesh); });
        pull_through(mesh);
        const bool ours_of_bad = validate(mesh).is_valid(), cgal_of_bad = !PMP::does_self_intersect(mesh);
        asked += 2;
        broken += (!ours.is_valid || !cgal.is_valid) + (ours_of_bad != cgal_of_bad);
        std::printf("%-28s %10zu %12.4f %12.4f %12s\n", family.name, std::size_t{mesh.number_of_faces()}, ours.seconds,
                    cgal.seconds,
                    ours_of_bad != cgal_of_bad ? "DIFFER"
                    : ours_of_bad              ? "valid"
                                               : "refused");
        rows.push_back({{"unit", unit},
                        {"mesh", family.name},
                        {"triangles", mesh.number_of_faces()},
                        {"validate_seconds", ours.seconds},
                        {"does_self_intersect_seconds", cgal.seconds},
                        {"pulled_through_is_refused", !ours_of_bad}});
      }
    promises.add(other_verdict, "the validity oracle agrees with CGAL", asked, broken);
    return {{"rows", rows}};
  });
}
