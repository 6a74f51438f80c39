// SPDX-License-Identifier: GPL-3.0-or-later
// CGAL's edge_collapse beside collapses under the guard, to the same number of edges: time against pairs of faces that
// meet.
#include "Promises.h"
#include "Shard.h"
#include "meshes/generated_meshes.h"
#include "meshes/thin_walls.h"

#include <haptic_sculpt/sculpting.h>
#include <haptic_sculpt/surface.h>

#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Count_ratio_stop_predicate.h>
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

constexpr int not_embedded = 10, cannot_write = 5;

double squared_length(const Mesh& mesh, Mesh::Edge_index e) {
  return CGAL::squared_distance(mesh.point(mesh.vertex(e, 0)), mesh.point(mesh.vertex(e, 1)));
}

/// The shortest first, a quarter of the edges at a time; ends where none of these can go.
void collapse_under_the_guard(Mesh& mesh, std::size_t most_edges) {
  Sculptor<Mesh> sculptor(mesh);
  const auto stroke = sculptor.stroke();
  for (bool goes_on = true; goes_on && mesh.number_of_edges() > most_edges;) {
    std::vector<Mesh::Edge_index> edges(mesh.edges().begin(), mesh.edges().end());
    std::stable_sort(edges.begin(), edges.end(),
                     [&](auto a, auto b) { return squared_length(mesh, a) < squared_length(mesh, b); });
    edges.resize((edges.size() + 3) / 4);
    goes_on = false;
    for (const Mesh::Edge_index e : edges) {
      if (mesh.number_of_edges() <= most_edges)
        break;
      if (!mesh.is_removed(e))
        goes_on |= static_cast<bool>(sculptor.collapse(mesh.halfedge(e)));
    }
  }
}

std::size_t number_of_pairs(const Mesh& mesh) {
  std::vector<std::pair<Mesh::Face_index, Mesh::Face_index>> pairs;
  PMP::self_intersections(mesh, std::back_inserter(pairs));
  return pairs.size();
}

template <class Work>
Json row(const std::string& name, const char* method, const Mesh& input, const Work& work) {
  Mesh mesh = input;
  const std::clock_t begin = std::clock();
  work(mesh);
  const double seconds = static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
  mesh.collect_garbage();
  const std::size_t pairs = number_of_pairs(mesh);
  std::printf("%s: %s: %zu faces, %.3f s, %zu pairs\n", name.c_str(), method,
              static_cast<std::size_t>(mesh.number_of_faces()), seconds, pairs);
  return {{"mesh", name},
          {"method", method},
          {"faces_before", input.number_of_faces()},
          {"faces_left", mesh.number_of_faces()},
          {"seconds", seconds},
          {"pairs", pairs},
          {"valid", validate(mesh).is_valid()}};
}

} // namespace

int main(int argc, char** argv) {
  CLI::App app(
      "CGAL's edge_collapse beside collapses under the guard, the shortest edge first, to the same share of the edges: "
      "time, and pairs of faces that meet. Exit code 10: a guarded mesh is not embedded.");
  std::string file;
  unsigned seed = 1;
  int level = 3;
  double share = 0.2;
  Shard shard;
  app.add_option("--json", file, "Write all figures to this file");
  app.add_option("--seed", seed, "Of the meshes")->capture_default_str();
  app.add_option("--level", level, "Fineness")->check(CLI::Range(1, 8))->capture_default_str();
  app.add_option("--share", share, "Of the edges that is to be left")
      ->check(CLI::Range(0.01, 1.0))
      ->capture_default_str();
  shard.add_option(app, "mesh");
  CLI11_PARSE(app, argc, argv);
  try {
    Json rows = Json::array();
    std::size_t asked = 0, broken = 0;
    const std::vector<std::pair<std::string, Mesh>> inputs = {
      {"hollow ball", meshes::to_mesh(meshes::hollow_ball(level, 0.02, seed))},
      {"wavy plate", meshes::to_mesh(meshes::wavy_plate(std::size_t{4} << level, 0.1, 0.5, 0.2, seed))},
      {"hills", meshes::to_mesh(meshes::bumpy_sphere(level, 0.2, 0.01, seed))},
      {"Swiss cheese", meshes::to_mesh(meshes::swiss_cheese(2, 0.02, std::max(1, level - 1), seed))}};
    for (const auto& [name, mesh] : inputs) {
      const std::size_t unit = shard.next_unit(), before = rows.size();
      if (!shard.takes_next())
        continue;
      const auto most = static_cast<std::size_t>(share * static_cast<double>(mesh.number_of_edges()));
      rows.push_back(row(name, "under the guard", mesh, [most](Mesh& m) { collapse_under_the_guard(m, most); }));
      ++asked, broken += !rows.back()["valid"].get<bool>();
      rows.push_back(row(name, "edge_collapse", mesh,
                         [share](Mesh& m) { SMS::edge_collapse(m, SMS::Count_ratio_stop_predicate<Mesh>(share)); }));
      for (std::size_t k = before; k < rows.size(); ++k)
        rows[k]["unit"] = unit;
    }
    Promises promises;
    promises.add(not_embedded, "a mesh simplified under the guard is embedded", asked, broken);
    if (!file.empty())
      replace_file(file, Json{{"seed", seed},
                              {"shard", shard.text()},
                              {"level", level},
                              {"share", share},
                              {"rows", rows},
                              {"promises", promises.json()},
                              {"exit", promises.exit()}}
                                 .dump(1) +
                             '\n');
    return promises.exit();
  } catch (const Error& error) {
    std::cerr << "simplification: " << error.what() << '\n';
    return cannot_write;
  }
}
