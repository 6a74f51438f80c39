// SPDX-License-Identifier: GPL-3.0-or-later
// Flips and collapses against decisions that share nothing with them, and against each other.
#include "sculpting/Mesh_snapshot.h"
#include "sculpting/motion/embedding_oracle_input.h"

#include "oracle/flip_oracle.h"

#include <haptic_sculpt/surface.h>

#include <shared_data.h>

#include <boost/test/unit_test.hpp>

#include <chrono>
#include <filesystem>
#include <map>

using namespace haptic_sculpt;
using namespace haptic_sculpt::test;
using oracle::Flip_obstacle;

namespace {

using Edge_index = Mesh::Edge_index;
using Halfedge_index = Mesh::Halfedge_index;

/// A mesh as the independent decision takes it. \pre no garbage
template <class Integer>
struct Exact_mesh {
  std::vector<oracle::Point<Integer>> points;
  std::vector<oracle::Corner_indices> faces;

  Exact_mesh(const Mesh& mesh, std::vector<oracle::Point<Integer>> p) : points(std::move(p)) {
    for (const auto f : mesh.faces()) {
      const auto corners = internal::corners_of_face(mesh, f);
      faces.push_back({static_cast<int>(corners[0]), static_cast<int>(corners[1]), static_cast<int>(corners[2])});
    }
  }

  Flip_obstacle obstacle(const Mesh& mesh, Edge_index e, const mpq_class& delta) const {
    const Halfedge_index h = mesh.halfedge(e), o = mesh.opposite(h);
    const auto corner = [](Vertex_index v) { return static_cast<int>(v); };
    return oracle::flip_obstacle(points, faces, corner(mesh.source(h)), corner(mesh.target(h)),
                                 corner(mesh.target(mesh.next(h))), corner(mesh.target(mesh.next(o))), delta);
  }
};

Refusal_reason expected_reason(Flip_obstacle obstacle) {
  switch (obstacle) {
  case Flip_obstacle::joined:
    return Refusal_reason::doubled_edge;
  case Flip_obstacle::degenerate:
  case Flip_obstacle::low:
    return Refusal_reason::delta;
  default:
    return Refusal_reason::blocked;
  }
}

struct Flip_tally {
  std::map<Flip_obstacle, std::size_t> verdicts;
  std::size_t asked = 0, wrong = 0, wrong_reason = 0, not_restored = 0, invalid = 0, differs_from_composition = 0;

  std::size_t refused() const {
    const auto count = [&](Flip_obstacle o) {
      const auto found = verdicts.find(o);
      return found == verdicts.end() ? 0 : found->second;
    };
    return asked - count(Flip_obstacle::none) - count(Flip_obstacle::none_flat);
  }
  void report(const std::string& name) const {
    BOOST_TEST_MESSAGE(name << ": " << asked << " edges, " << refused() << " refused");
    for (const auto& [obstacle, count] : verdicts)
      BOOST_TEST_MESSAGE("  " << oracle::flip_obstacle_names[static_cast<int>(obstacle)] << ": " << count);
    BOOST_TEST(wrong == 0u);
    BOOST_TEST(wrong_reason == 0u);
    BOOST_TEST(not_restored == 0u);
    BOOST_TEST(invalid == 0u);
    BOOST_TEST(differs_from_composition == 0u);
  }
};

/// Flips, compares, and takes it back. \return whether it was done
bool flip_and_back(Sculptor<Mesh>& sculptor, Edge_index e, Flip_obstacle obstacle, Flip_tally& tally) {
  ++tally.asked;
  ++tally.verdicts[obstacle];
  const Mesh& mesh = sculptor.mesh();
  const Halfedge_index h = mesh.halfedge(e);
  const Vertex_index c = mesh.target(mesh.next(h)), d = mesh.target(mesh.next(mesh.opposite(h)));
  const auto result = sculptor.flip(e);
  const bool is_free = obstacle == Flip_obstacle::none || obstacle == Flip_obstacle::none_flat;
  if (static_cast<bool>(result) != is_free) {
    ++tally.wrong;
    BOOST_TEST_MESSAGE("edge " << e << ": " << (result ? "flipped" : name_of(result.refusal->reason)) << ", but "
                               << oracle::flip_obstacle_names[static_cast<int>(obstacle)]);
  } else if (!result) {
    tally.wrong_reason += result.refusal->reason != expected_reason(obstacle) || result.refusal->elements.empty();
  }
  if (result) {
    tally.wrong += !mesh.halfedge(c, d).is_valid() || mesh.edge(mesh.halfedge(c, d)) != e ||
                   (*result.vertex != c && *result.vertex != d);
    tally.not_restored += !sculptor.undo();
  }
  return static_cast<bool>(result);
}

/// The same by another road: a vertex in the middle of the edge, drawn into an opposite corner. It sweeps over the same
/// tetrahedron where the middle is exact.
bool composition(Sculptor<Mesh>& sculptor, Edge_index e) {
  const Mesh& mesh = sculptor.mesh();
  const Halfedge_index h = mesh.halfedge(e);
  const Vertex_index c = mesh.target(mesh.next(h));
  const auto made = sculptor.insert_on_edge(e, CGAL::midpoint(mesh.point(mesh.source(h)), mesh.point(mesh.target(h))));
  if (!made)
    return false;
  const auto gone = sculptor.collapse(mesh.halfedge(*made.vertex, c));
  if (gone)
    sculptor.undo();
  sculptor.undo();
  return static_cast<bool>(gone);
}

/// By their ends, as undo may give an edge another descriptor.
std::vector<std::array<Vertex_index, 2>> edges_of(const Mesh& mesh) {
  std::vector<std::array<Vertex_index, 2>> edges;
  for (const Edge_index e : mesh.edges())
    edges.push_back({mesh.vertex(e, 0), mesh.vertex(e, 1)});
  return edges;
}

/// Every edge of a mesh whose vertices have even integer coordinates.
void check_edges(const meshes::Triangle_list& list, double delta, bool by_composition, Flip_tally& tally) {
  Mesh mesh = meshes::to_mesh(list);
  Sculptor<Mesh> sculptor(mesh, parameters::delta(delta));
  constexpr int unit = 8;
  std::vector<oracle::Point<__int128>> points;
  for (const Point_3& p : list.points)
    points.push_back({static_cast<__int128>(unit * p.x()), static_cast<__int128>(unit * p.y()),
                      static_cast<__int128>(unit * p.z())});
  const Exact_mesh<__int128> exact(mesh, points);
  const Mesh_snapshot before = snapshot(sculptor);
  for (const auto& [v, w] : edges_of(mesh)) {
    const Edge_index e = mesh.edge(mesh.halfedge(v, w));
    const Flip_obstacle obstacle = exact.obstacle(mesh, e, mpq_class(unit * delta));
    const bool is_done = flip_and_back(sculptor, e, obstacle, tally);
    if (by_composition)
      tally.differs_from_composition += is_done != composition(sculptor, mesh.edge(mesh.halfedge(v, w)));
  }
  tally.not_restored += snapshot(sculptor) != before;
  tally.invalid += !validate(mesh).is_valid();
}

/// Small meshes on a grid; or a box of flat sides, the vertices of which are moved in them and
/// here and there off.
meshes::Triangle_list grid_scene(Random& random) {
  const auto is_valid = [](const meshes::Triangle_list& list) { return validate(meshes::to_mesh(list)).is_valid(); };
  meshes::Triangle_list list;
  switch (random() % 4) {
  case 0:
    list = random_small_list(random, 2);
    break;
  case 1:
    list = random_small_list(random, 4);
    break;
  case 2:
    list = meshes::bipyramid(4 + random() % 5);
    break;
  default:
    list = meshes::box(2, 4);
  }
  for (Point_3& p : list.points)
    p = Point_3(2 * std::round(2 * p.x()), 2 * std::round(2 * p.y()), 2 * std::round(2 * p.z()));
  if (!is_valid(list))
    return grid_scene(random);
  for (int i = 0; i < 12; ++i) {
    meshes::Triangle_list moved = list;
    Point_3& p = moved.points[random() % moved.points.size()];
    std::array<double, 3> x = {p.x(), p.y(), p.z()};
    x[random() % 3] += random() % 2 == 0 ? 2 : -2;
    x[random() % 3] += random() % 2 == 0 ? 2 : -2;
    p = Point_3(x[0], x[1], x[2]);
    if (is_valid(moved))
      list = moved;
  }
  return list;
}

} // namespace

BOOST_AUTO_TEST_CASE(flips_agree_with_an_independent_decision_on_grids) {
  Random random(seed_from_environment(41));
  const std::size_t edges = count_from_environment("HAPTIC_SCULPT_FLIPS", 12000);
  Flip_tally tally;
  for (std::size_t scene = 0; tally.asked < edges; ++scene) {
    const meshes::Triangle_list list = grid_scene(random);
    const double delta = scene % 2 == 0 && validate(meshes::to_mesh(list), 1.25).is_valid() ? 1.25 : 0;
    check_edges(list, delta, delta == 0, tally);
  }
  tally.report("grids");
  BOOST_TEST(is_enough(tally.refused(), tally.asked / 5));
  for (const Flip_obstacle obstacle :
       {Flip_obstacle::none, Flip_obstacle::none_flat, Flip_obstacle::joined, Flip_obstacle::degenerate,
        Flip_obstacle::low, Flip_obstacle::folded, Flip_obstacle::vertex_inside,
        Flip_obstacle::face_crossed})
    BOOST_TEST(is_enough(tally.verdicts[obstacle], 10), oracle::flip_obstacle_names[static_cast<int>(obstacle)]);
}

BOOST_AUTO_TEST_CASE(flips_agree_with_an_independent_decision_on_meshes) {
  Random random(seed_from_environment(42));
  const std::size_t most = count_from_environment("HAPTIC_SCULPT_FLIPS_PER_MESH", 40);
  const auto check = [&](Mesh mesh, const std::string& name) {
    Sculptor<Mesh> sculptor(mesh);
    std::vector<std::array<double, 3>> points;
    for (const Vertex_index v : mesh.vertices())
      points.push_back(vertex_coordinates(mesh, v));
    const Exact_mesh<mpz_class> exact(mesh, oracle::scaled_to_integers(points));
    const Mesh_snapshot before = snapshot(sculptor);
    Flip_tally tally;
    std::size_t composed = 0, wrongly_composed = 0;
    std::vector<double> times;
    const std::size_t step = std::max<std::size_t>(1, mesh.num_edges() / most);
    const auto edges = edges_of(mesh);
    for (std::size_t i = random() % step; i < edges.size(); i += step) {
      const Edge_index e = mesh.edge(mesh.halfedge(edges[i][0], edges[i][1]));
      const Flip_obstacle obstacle = exact.obstacle(mesh, e, 0);
      const auto begin = std::chrono::steady_clock::now();
      const bool is_done = flip_and_back(sculptor, e, obstacle, tally);
      times.push_back(std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
      const bool is_composed = composition(
          sculptor, mesh.edge(mesh.halfedge(edges[i][0], edges[i][1]))); // which bends what it passes by an ulp
      composed += is_composed, wrongly_composed += is_composed && !is_done;
    }
    BOOST_TEST((snapshot(sculptor) == before));
    tally.report(name);
    std::nth_element(times.begin(), times.begin() + static_cast<std::ptrdiff_t>(times.size() / 2), times.end());
    BOOST_TEST_MESSAGE("  " << 1e6 * times[times.size() / 2] << " us each in the median, undo and comparison included; "
                            << composed << " by a vertex on the edge, " << wrongly_composed
                            << " of which were refused");
  };
  check(meshes::to_mesh(meshes::bumpy_sphere(2, 0.3, 0.05)), "bumpy sphere");
  check(meshes::to_mesh(meshes::ball_in_a_cavity(1)), "ball in a cavity");
  const auto folder = haptic_sculpt::test::shared_data("meshes");
  if (!folder)
    return;
  std::set<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(*folder))
    if (entry.path().filename() != "cgal_elk.off" && entry.path().extension() != ".md" && entry.file_size() < 400000)
      files.insert(entry.path());
  for (const auto& file : files) {
    Mesh mesh = read_surface<Mesh>(file);
    check(std::move(mesh), file.filename().string());
  }
}

BOOST_AUTO_TEST_CASE(collapses_agree_with_an_independent_decision) {
  Random random(seed_from_environment(43));
  const std::size_t collapses = count_from_environment("HAPTIC_SCULPT_COLLAPSES", 2000);
  std::size_t tried = 0, done = 0, wrong = 0, not_restored = 0;
  std::map<std::string, std::size_t> refused;
  while (tried < collapses) {
    const meshes::Triangle_list list = random_small_list(random, 2);
    const oracle::Mesh_list independent = to_oracle(list);
    Mesh mesh = meshes::to_mesh(list);
    Sculptor<Mesh> sculptor(mesh);
    const Mesh_snapshot before = snapshot(sculptor);
    for (std::size_t i = 0; i < list.faces.size() * 3; ++i) {
      // Undo may use other descriptors: ask by number.
      const auto& f = list.faces[i / 3];
      const Vertex_index v = sculptor.vertex(f[i % 3]), w = sculptor.vertex(f[(i + 1) % 3]);
      ++tried;
      const auto result = sculptor.collapse(mesh.halfedge(v, w));
      wrong += static_cast<bool>(result) != oracle::collapse_stays_embedded(independent, static_cast<int>(f[i % 3]),
                                                                            static_cast<int>(f[(i + 1) % 3]));
      if (!result) {
        ++refused[name_of(result.refusal->reason)];
        continue;
      }
      ++done;
      wrong += *result.vertex != w || sculptor.vertex(f[i % 3]).is_valid() || !validate(mesh).is_valid();
      const Mesh_snapshot after = snapshot(sculptor);
      not_restored += !sculptor.undo() || snapshot(sculptor) != before;
      not_restored += !sculptor.redo() || snapshot(sculptor) != after;
      sculptor.undo();
    }
  }
  BOOST_TEST_MESSAGE(tried << " collapses, " << done << " done");
  for (const auto& [reason, count] : refused)
    BOOST_TEST_MESSAGE("  " << reason << ": " << count);
  BOOST_TEST(wrong == 0u);
  BOOST_TEST(not_restored == 0u);
  BOOST_TEST(is_enough(done, 50));
  for (const char* reason : {"tetrahedron", "doubled-edge", "delta", "blocked"})
    BOOST_TEST(is_enough(refused[reason], 0), reason);
}

BOOST_AUTO_TEST_CASE(flips_by_hand) {
  // Two faces in a plane over a tip, whose outline is convex or reflex at corner 0.
  for (const double x : {-1.0, 0.0, 0.5}) {
    meshes::Triangle_list list;
    list.points = {{x, 0, 0}, {2, 0, 0}, {0, 2, 0}, {0, -2, 0}, {0.6, 0, -3}};
    list.faces = {{0, 1, 2}, {1, 0, 3}, {1, 4, 2}, {2, 4, 0}, {0, 4, 3}, {3, 4, 1}};
    Mesh mesh = meshes::to_mesh(list);
    BOOST_REQUIRE(validate(mesh).is_valid());
    Sculptor<Mesh> sculptor(mesh);
    const auto result = sculptor.flip(sculptor.edge_of(0, 1));
    BOOST_TEST(static_cast<bool>(result) == (x < 0));
    if (x == 0) // the new edge runs through the corner
      BOOST_TEST((result.refusal->reason == Refusal_reason::delta));
    if (x > 0)
      BOOST_TEST((result.refusal->reason == Refusal_reason::blocked));
    if (result) {
      BOOST_TEST(sculptor.edge_of(2, 3).is_valid());
      BOOST_TEST(!sculptor.edge_of(0, 1).is_valid());
      BOOST_TEST(validate(mesh).is_valid());
    }
  }
  Mesh mesh = meshes::to_mesh(meshes::tetrahedron());
  Sculptor<Mesh> sculptor(mesh);
  for (const Edge_index e : mesh.edges())
    BOOST_TEST((sculptor.flip(e).refusal->reason == Refusal_reason::doubled_edge));
  for (const Halfedge_index h : mesh.halfedges())
    BOOST_TEST((sculptor.collapse(h).refusal->reason == Refusal_reason::tetrahedron));
  BOOST_TEST((sculptor.flip(Edge_index(6)).refusal->reason == Refusal_reason::unknown_element));
  BOOST_TEST((sculptor.flip(Edge_index()).refusal->reason == Refusal_reason::unknown_element));
  BOOST_TEST((sculptor.collapse(Halfedge_index(12)).refusal->reason == Refusal_reason::unknown_element));
}
