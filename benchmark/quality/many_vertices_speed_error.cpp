// SPDX-License-Identifier: GPL-3.0-or-later
// Many vertices to targets: share of the way against time, by axis moves, one after the other, and all at once with a
// step that is halved until does_self_intersect is content.
#include "Benchmark_program.h"
#include "meshes/generated_meshes.h"
#include "meshes/thin_walls.h"

#include <haptic_sculpt/sculpting.h>
#include <haptic_sculpt/surface.h>

#include <CGAL/Aff_transformation_3.h>
#include <CGAL/Polygon_mesh_processing/compute_normal.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>

#include <algorithm>
#include <cstdio>
#include <ctime>
#include <functional>
#include <iostream>

namespace {

using namespace haptic_sculpt;
using namespace haptic_sculpt::benchmark;
using Mesh = meshes::Mesh;
using Point_3 = meshes::Point_3;
using Vector_3 = meshes::Kernel::Vector_3;
using Vertex_index = Mesh::Vertex_index;
using Json = nlohmann::ordered_json;
namespace PMP = CGAL::Polygon_mesh_processing;

constexpr int not_embedded = 10;
constexpr double finest_step = 1.0 / 128; ///< of the way: the line search gives up below
constexpr int looks = 64;                 ///< times at which a straight motion is looked at

struct Motion {
  std::string name;
  Mesh start;
  std::vector<Point_3> targets; ///< by index
  bool are_targets_embedded = false;
};

double mean_edge(const Mesh& mesh) {
  double sum = 0;
  for (const auto e : mesh.edges())
    sum += std::sqrt(CGAL::squared_distance(mesh.point(mesh.vertex(e, 0)), mesh.point(mesh.vertex(e, 1))));
  return sum / static_cast<double>(mesh.number_of_edges());
}

Motion motion(const std::string& name, const Mesh& mesh, const std::function<Point_3(Vertex_index)>& target) {
  Motion made{name, mesh, {}, false};
  Mesh moved = mesh;
  for (const Vertex_index v : mesh.vertices())
    made.targets.push_back(moved.point(v) = target(v));
  made.are_targets_embedded = validate(moved).is_valid();
  return made;
}

Vector_3 normal(const Mesh& mesh, Vertex_index v) {
  return PMP::compute_vertex_normal(v, mesh);
}

/// Plates 2^-35 apart: every second one is drawn out.
Motion combs(int level) {
  constexpr std::size_t teeth = 16;
  const meshes::Triangle_list list = meshes::comb(teeth, std::size_t{1} << level);
  return motion("combs 2^-35 apart", meshes::to_mesh(list), [&](Vertex_index v) {
    const Point_3& p = list.points[v];
    return v * teeth / list.points.size() % 2 == 1 ? p + Vector_3(0.7, 0.3, 0) : p;
  });
}

/// A ball of 42 vertices that random slides have crumpled goes by ten edges.
Motion crumpled(std::uint64_t seed) {
  Mesh mesh = meshes::to_mesh(meshes::icosphere(1));
  std::mt19937_64 random(seed);
  const auto uniform = [&] { return 2 * (static_cast<double>(random() >> 11) * 0x1p-53) - 1; };
  const double edge = mean_edge(mesh);
  const auto way = [&](double length) {
    const double x = uniform(), y = uniform(), z = uniform();
    return length * Vector_3(x, y, z);
  };
  Sculptor<Mesh> sculptor(mesh, parameters::response(Response::slide));
  for (int slide = 0; slide < 300; ++slide) {
    const Vertex_index v(static_cast<std::uint32_t>(random() % mesh.number_of_vertices()));
    sculptor.grab(v).drag_to(mesh.point(v) + way(edge));
  }
  const Vector_3 all = way(10 * edge);
  return motion("crumpled, by ten edges", mesh, [&](Vertex_index v) { return mesh.point(v) + all; });
}

std::vector<Motion> motions(int level, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  const auto uniform = [&] { return 2 * (static_cast<double>(random() >> 11) * 0x1p-53) - 1; };
  const Mesh hills = meshes::to_mesh(meshes::bumpy_sphere(level, 0.2, 0.01, static_cast<std::uint32_t>(seed)));
  const Mesh balls = meshes::to_mesh(meshes::row_of_spheres(2, level));
  const std::size_t cells = std::size_t{4} << level;
  const Mesh plate = meshes::to_mesh(meshes::wavy_plate(cells, 0.1, 0.5, 0.2, static_cast<std::uint32_t>(seed)));
  const double edge = mean_edge(hills), edge_of_plate = mean_edge(plate);
  const double first = balls.point(Vertex_index(0)).x(), split = [&] {
    double low = first, high = first;
    for (const Point_3& p : balls.points())
      low = std::min(low, p.x()), high = std::max(high, p.x());
    return (low + high) / 2;
  }();
  return {motion("a right angle", hills,
                 [&](Vertex_index v) {
                   const Point_3 p = hills.point(v);
                   return Point_3(-p.y(), p.x(), p.z());
                 }),
          motion("half a twist", hills,
                 [&](Vertex_index v) {
                   const Point_3 p = hills.point(v);
                   const double angle = 1.5707963267948966 * p.z();
                   return Point_3(p.x() * std::cos(angle) - p.y() * std::sin(angle),
                                  p.x() * std::sin(angle) + p.y() * std::cos(angle), p.z());
                 }),
          motion("noise of an edge", hills,
                 [&](Vertex_index v) {
                   const double x = uniform(), y = uniform(), z = uniform();
                   return hills.point(v) + edge * Vector_3(x, y, z);
                 }),
          motion("inflated by five edges", plate,
                 [&](Vertex_index v) { return plate.point(v) + 5 * edge_of_plate * normal(plate, v); }),
          motion("a ball through a ball", balls,
                 [&](Vertex_index v) {
                   const Point_3 p = balls.point(v);
                   return p.x() < split ? p + Vector_3(4 * (split - first) + 4, 0, 0) : p;
                 }),
          combs(level),
          crumpled(seed)};
}

/// Turns and a twist of a mesh about its middle; a translation by ten edges, and a pull by as much, which grows less
/// towards half the diagonal; every vertex by a tenth of an edge and by one; inflation.
std::vector<Motion> motions_of(const Mesh& mesh, std::uint64_t seed) {
  using Transformation = CGAL::Aff_transformation_3<meshes::Kernel>;
  const CGAL::Bbox_3 box = CGAL::bbox_3(mesh.points().begin(), mesh.points().end());
  const Vector_3 middle((box.xmin() + box.xmax()) / 2, (box.ymin() + box.ymax()) / 2, (box.zmin() + box.zmax()) / 2);
  const auto about_middle = [&](const Transformation& turn, Vertex_index v) {
    return turn.transform(mesh.point(v) - middle) + middle;
  };
  const Transformation about_z(0, -1, 0, 1, 0, 0, 0, 0, 1);
  // A right angle about (1, 2, 2) / 3: R = u u^T + [u]x.
  const Transformation generic(1 / 9., -4 / 9., 8 / 9., 8 / 9., 4 / 9., 1 / 9., -4 / 9., 7 / 9., 4 / 9.);
  std::mt19937_64 random(seed);
  const auto uniform = [&] { return 2 * (static_cast<double>(random() >> 11) * 0x1p-53) - 1; };
  const auto by = [&](double length) {
    const double x = uniform(), y = uniform(), z = uniform();
    const Vector_3 way(x, y, z);
    return length / std::sqrt(way.squared_length()) * way;
  };
  const double edge = mean_edge(mesh), height = box.zmax() - box.zmin();
  const Vector_3 diagonal(box.xmax() - box.xmin(), box.ymax() - box.ymin(), height), slanted = edge * Vector_3(3, 5, 8);
  const Point_3 top = *std::max_element(mesh.points().begin(), mesh.points().end(),
                                        [](const Point_3& p, const Point_3& q) { return p.z() < q.z(); });
  const auto weight = [&](const Point_3& p) { // that of a brush
    return std::pow(std::max(0., 1 - 4 * CGAL::squared_distance(p, top) / diagonal.squared_length()), 2);
  };
  return {motion("a right angle about z", mesh, [&](Vertex_index v) { return about_middle(about_z, v); }),
          motion("a right angle about (1, 2, 2)", mesh, [&](Vertex_index v) { return about_middle(generic, v); }),
          motion("half a twist about z", mesh,
                 [&](Vertex_index v) {
                   const double angle = 3.141592653589793 * (mesh.point(v).z() - box.zmin()) / height;
                   const double c = std::cos(angle), d = std::sin(angle);
                   return about_middle(Transformation(c, -d, 0, d, c, 0, 0, 0, 1), v);
                 }),
          motion("a translation by ten edges", mesh, [&](Vertex_index v) { return mesh.point(v) + slanted; }),
          motion("a pull by ten edges", mesh,
                 [&](Vertex_index v) { return mesh.point(v) + weight(mesh.point(v)) * slanted; }),
          motion("every vertex by a tenth of an edge", mesh,
                 [&](Vertex_index v) { return mesh.point(v) + by(0.1 * edge); }),
          motion("noise of one edge", mesh, [&](Vertex_index v) { return mesh.point(v) + by(edge); }),
          motion("inflated by five edges", mesh,
                 [&](Vertex_index v) { return mesh.point(v) + 5 * edge * normal(mesh, v); })};
}

/// 1 where all arrive, from squared distances.
double share_of_the_way(const Motion& m, const Mesh& mesh) {
  double asked = 0, left = 0;
  for (const Vertex_index v : mesh.vertices()) {
    const Point_3& target = m.targets[v];
    asked += CGAL::squared_distance(m.start.point(v), target), left += CGAL::squared_distance(mesh.point(v), target);
  }
  return asked > 0 ? 1 - std::sqrt(left / asked) : 1;
}

/// Of the vertices that have a way to go.
double share_that_arrive(const Motion& m, const Mesh& mesh) {
  std::size_t asked = 0, arrived = 0;
  for (const Vertex_index v : mesh.vertices())
    if (m.start.point(v) != m.targets[v])
      ++asked, arrived += mesh.point(v) == m.targets[v];
  return asked == 0 ? 1 : static_cast<double>(arrived) / static_cast<double>(asked);
}

void move_straight(const Motion& m, Mesh& mesh, double share) {
  for (const Vertex_index v : mesh.vertices())
    mesh.point(v) = share == 1 ? m.targets[v] : m.start.point(v) + share * (m.targets[v] - m.start.point(v));
}

/// What one would do with CGAL alone. \return how far it went
double line_search(const Motion& m, Mesh& mesh) {
  double done = 0, step = 1;
  while (done < 1 && step >= finest_step) {
    const double next = std::min(1.0, done + step);
    move_straight(m, mesh, next);
    if (PMP::does_self_intersect(mesh))
      step /= 2;
    else
      done = next, step *= 2;
  }
  move_straight(m, mesh, done);
  return done;
}

/// Whether the surface met itself on a straight way that ended well: looked at `looks` times.
bool passed_through(const Motion& m, double way) {
  Mesh mesh = m.start;
  for (int k = 1; k < looks; ++k) {
    move_straight(m, mesh, way * k / looks);
    if (PMP::does_self_intersect(mesh))
      return true;
  }
  return false;
}

double seconds_since(std::clock_t begin) {
  return static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
}

Json row(const Motion& m, const char* method, double seconds, const Mesh& mesh, bool has_passed = false) {
  Json result = {{"motion", m.name},
                 {"method", method},
                 {"vertices", mesh.number_of_vertices()},
                 {"seconds", seconds},
                 {"share", share_of_the_way(m, mesh)},
                 {"arrived", share_that_arrive(m, mesh)},
                 {"targets_embedded", m.are_targets_embedded},
                 {"passed_through", has_passed},
                 {"valid", validate(mesh).is_valid()}};
  std::printf("%s: %s: %.3f s, %.1f %% of the way, %.2f %% arrive%s\n", m.name.c_str(), method, seconds,
              100 * result["share"].get<double>(), 100 * result["arrived"].get<double>(),
              has_passed ? ", through itself" : "");
  std::fflush(stdout);
  return result;
}

void measure(const Motion& m, Json& rows) {
  {
    Mesh mesh = m.start, targets = m.start;
    move_straight(m, targets, 1);
    const std::clock_t begin = std::clock();
    Sculptor<Mesh> sculptor(mesh);
    move_vertices(sculptor, mesh.vertices(), get(CGAL::vertex_point, targets));
    rows.push_back(row(m, "move_vertices", seconds_since(begin), mesh));
  }
  {
    Mesh mesh = m.start;
    const std::clock_t begin = std::clock();
    Sculptor<Mesh> sculptor(mesh, parameters::response(Response::stop));
    for (int pass = 0; pass < 4; ++pass)
      for (const Vertex_index v : m.start.vertices())
        if (mesh.point(v) != m.targets[v])
          sculptor.grab(v).drag_to(m.targets[v]);
    rows.push_back(row(m, "one after the other", seconds_since(begin), mesh));
  }
  {
    Mesh mesh = m.start;
    const std::clock_t begin = std::clock();
    const double way = line_search(m, mesh);
    const double seconds = seconds_since(begin); // what follows is not timed
    rows.push_back(row(m, "halving on does_self_intersect", seconds, mesh, way > 0 && passed_through(m, way)));
  }
}

/// The motion alone: neither validation nor the tree of the Sculptor; and beside it one check of CGAL's.
void measure_motion(const Motion& m, Json& rows) {
  for (const bool drags : {false, true}) {
    Mesh mesh = m.start, targets = m.start;
    move_straight(m, targets, 1);
    Sculptor<Mesh> sculptor(mesh, Sculptor_parameters().known_valid(true));
    const std::clock_t begin = std::clock();
    move_vertices(sculptor, mesh.vertices(), get(CGAL::vertex_point, targets), Move_parameters().drags(drags));
    rows.push_back(row(m, drags ? "move_vertices" : "one round of axis moves", seconds_since(begin), mesh));
  }
  const std::clock_t begin = std::clock();
  PMP::does_self_intersect(m.start);
  rows.push_back(row(m, "one does_self_intersect", seconds_since(begin), m.start));
}

} // namespace

int main(int argc, char** argv) {
  CLI::App app(
      "Many vertices to targets: share of the way against time, by move_vertices, by one drag after the other, and all "
      "at once with a line search on CGAL's does_self_intersect. Exit: 10 a guarded mesh is not embedded.");
  std::string given;
  std::uint64_t seed = 1;
  int level = 4, rounds = 1;
  app.add_option("--mesh", given, "Motions of this mesh instead: times of the motion alone");
  app.add_option("--level", level, "Fineness: 20 * 4^level triangles; below 2 they meet")
      ->check(CLI::Range(2, 8))
      ->capture_default_str();
  app.add_option("--rounds", rounds, "Each with another seed")->check(positive_number)->capture_default_str();
  app.add_option("--seed", seed)->capture_default_str();
  Benchmark_program program("many_vertices_speed_error", app, "motion");
  return program.run(argc, argv, [&](Promises& promises) -> Json {
    Mesh mesh;
    if (!given.empty())
      mesh = read_given([&] { return read_surface<Mesh>(given); });
    Json rows = Json::array();
    std::size_t asked = 0, broken = 0;
    for (int round = 0; round < rounds; ++round) {
      const std::uint64_t own_seed = seed * 1000003 + static_cast<std::uint64_t>(round);
      for (const Motion& m : given.empty() ? motions(level, own_seed) : motions_of(mesh, own_seed)) {
        const std::size_t unit = program.shard.next_unit(), before = rows.size();
        if (!program.shard.takes_next())
          continue;
        given.empty() ? measure(m, rows) : measure_motion(m, rows);
        for (std::size_t k = before; k < rows.size(); ++k) {
          rows[k]["unit"] = unit;
          const bool is_of_cgal = rows[k]["method"].get<std::string>().find("does_self_intersect") != std::string::npos;
          if (!is_of_cgal)
            ++asked, broken += !rows[k]["valid"].get<bool>();
        }
      }
    }
    promises.add(not_embedded, "a mesh moved under the guard is embedded", asked, broken);
    return {{"seed", seed}, {"level", level}, {"rows", rows}};
  });
}
