// SPDX-License-Identifier: GPL-3.0-or-later
// Broad phases against brute force and exact sweeps, while the mesh moves, grows and shrinks.
#include "surface/broad_phase/Checked_mesh.h"

#include <boost/test/unit_test.hpp>

#include <cfenv>

using namespace haptic_sculpt;
using namespace broad_phase_tests;

namespace {

const std::vector<Frame> frames = {{1, 0},      {1, 1e6},  {1e-3, 1e9},    {1e-7, 1},  {1e-42, 0},
                                   {1e-310, 0}, {3e38, 0}, {5e37, 2.5e38}, {1e150, 0}, {1e300, 0}};

std::vector<Mesh> scenes() {
  return {meshes::to_mesh(meshes::icosphere(1)), meshes::to_mesh(meshes::box(3)), meshes::to_mesh(meshes::torus(9, 6)),
          meshes::to_mesh(meshes::tetrahedron())};
}

} // namespace

BOOST_AUTO_TEST_CASE(queries_answer_as_brute_force_does_while_the_mesh_changes) {
  Random random(seed());
  const std::size_t rounds = test::count_from_environment("HAPTIC_SCULPT_QUERY_ROUNDS", 60);
  std::size_t inserted = 0, removed = 0, parts = 0, given_up = 0;
  for (const Mesh& scene : scenes())
    for (const Frame& frame : frames) {
      Checked_mesh changing(scene, frame);
      changing.check_everything();
      for (std::size_t round = 0; round < rounds; ++round) {
        const unsigned growth = 2 * round < rounds ? 4 : 1; // grows far beyond what it was built for, then shrinks
        for (int k = 0; k < 4; ++k)
          changing.change(random, growth);
        changing.check(random);
      }
      changing.check_everything();
      parts += changing.parts;
      given_up += changing.given_up;
      inserted += changing.inserted;
      removed += changing.removed;
      Checked_mesh anew(changing.mesh, {1, 0}); // with garbage among its faces
      anew.check_everything();
      anew.check(random);
        BOOST_TEST(test::is_enough(anew.mesh.has_garbage() ? 1 : 0, 0));
    }
  BOOST_TEST(test::is_enough(inserted, 1000));
  BOOST_TEST(test::is_enough(parts, 100));
  BOOST_TEST(test::is_enough(given_up, 1000));
  BOOST_TEST(test::is_enough(removed, 1000));
}

BOOST_AUTO_TEST_CASE(rounding_modes_lose_nothing) {
  Random random(seed());
  for (const int mode : {FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO})
    for (const Frame& frame : {frames[0], frames[1], frames[3]}) {
      Changing_mesh changing(scenes()[1], frame);
      for (int k = 0; k < 30; ++k) {
        changing.change(random, 3);
        internal::Star<Mesh> star;
        const Vertex_index v = changing.random_vertex(random);
        star.collect(changing.mesh, v);
        const Swept_star_3 swept = star.swept(vertex_coordinates(changing.mesh, v), frame(random_point(random, 6)));
        const std::vector<Face_index> expected = swept_faces(changing.mesh, swept);
        std::vector<Face_index> found;
        std::fesetround(mode);
        Box_tree_broad_phase<Mesh> tree(changing.mesh);
        tree.query_star(swept, found);
        changing.tree.query_star(swept, found);
        std::fesetround(FE_TONEAREST);
        found = sorted(found);
        found.erase(std::unique(found.begin(), found.end()), found.end());
        BOOST_TEST(std::includes(found.begin(), found.end(), expected.begin(), expected.end()));
      }
    }
}

BOOST_AUTO_TEST_CASE(a_mesh_may_come_from_nothing_and_go) {
  Mesh mesh;
  Six_list_broad_phase<Mesh> six_lists(mesh);
  Box_tree_broad_phase<Mesh> tree(mesh);
  const Box_3 everything = Box_3({-9, -9, -9}).include({9, 9, 9});
  std::vector<Vertex_index> corner;
  for (const auto& p : meshes::box(4).points)
    corner.push_back(mesh.add_vertex(p));
  const auto count = [&](auto& model) {
    std::vector<Face_index> found;
    model.query(everything, found);
    return found.size();
  };
  for (int again = 0; again < 3; ++again) {
    BOOST_TEST(count(six_lists) == 0u);
    BOOST_TEST(count(tree) == 0u);
    std::size_t expected = 0;
    for (const auto& f : meshes::box(4).faces) {
      const std::array<Face_index, 1> face = {mesh.add_face(corner[f[0]], corner[f[1]], corner[f[2]])};
      six_lists.faces_inserted(face), tree.faces_inserted(face);
      ++expected;
      BOOST_TEST(count(six_lists) == expected);
      BOOST_TEST(count(tree) == expected);
    }
    while (mesh.number_of_faces() != 0) {
      const std::array<Face_index, 1> face = {*mesh.faces().begin()};
      six_lists.faces_removed(face), tree.faces_removed(face);
      CGAL::Euler::remove_face(mesh.halfedge(face[0]), mesh);
      BOOST_TEST(count(tree) == --expected);
    }
    mesh = Mesh(); // remove_face() has taken the vertices too
    corner.clear();
    for (const auto& p : meshes::box(4).points)
      corner.push_back(mesh.add_vertex(p));
  }
}

// In the scale of a small scene a point far out overflows: then slabs, cones and boxes know less, and lose nothing.
BOOST_AUTO_TEST_CASE(points_far_beyond_the_scene_lose_nothing) {
  Random random(seed());
  constexpr double unit = 0x1p-45, far = 1e300;
  std::size_t swept_at_all = 0;
  for (std::size_t round = 0; round < test::count_from_environment("HAPTIC_SCULPT_QUERY_ROUNDS", 300); ++round) {
    Mesh mesh;
    const auto add_tetrahedron = [&mesh](const Coordinates& p, const Coordinates& size) {
      std::array<Vertex_index, 4> v;
      for (int k = 0; k < 4; ++k)
        v[k] = mesh.add_vertex(Point_3(p[0] + (k == 1 ? size[0] : 0), p[1] + (k == 2 ? size[1] : 0),
                                       p[2] + (k == 3 ? size[2] : 0)));
      for (const auto& f : {std::array{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}})
        mesh.add_face(v[f[0]], v[f[1]], v[f[2]]);
    };
    // Every other star lies in a plane along an axis but for one point, which is far out along that axis: its slab has
    // a normal with a 0 there.
    const bool is_flat = round % 2 == 0;
    const std::size_t axis = random() % 3;
    const auto number = [&] { return unit * (static_cast<double>(random() % 7) - 3); };
    const double a = number() / unit, b = number() / unit;
    const auto point = [&] {
      const double s = number();
      Coordinates p;
      p[axis] = number();
      p[(axis + 1) % 3] = is_flat ? a * s : number(), p[(axis + 2) % 3] = is_flat ? b * s : number();
      return p;
    };
    std::vector<Coordinates> link(3 + random() % 3);
    for (Coordinates& p : link)
      p = point();
    Coordinates& out = link[random() % link.size()];
    out = {5 * number(), 5 * number(), 5 * number()};
    out[axis] = far * uniform(random);
    const Swept_star_3 star{point(), point(), link.data(), link.size()};
    for (int k = 0; k < 6; ++k) {
      const std::size_t i = random() % link.size();
      const std::array<Coordinates, 4> corner = {star.source, star.target, link[i], link[(i + 1) % link.size()]};
      Coordinates p{}, size{};
      double left = 1;
      for (int c = 0; c < 4; ++c) {
        const double weight = c == 3 ? left : left * std::abs(uniform(random));
        left -= weight;
        for (int j = 0; j < 3; ++j)
          p[j] += weight * corner[c][j];
      }
      for (int j = 0; j < 3; ++j)
        size[j] = 0.2 * unit + 0.02 * std::abs(p[j]);
      add_tetrahedron(p, size);
    }
    for (int k = 0; k < 20; ++k) // so that the scale is theirs
      add_tetrahedron(random_point(random, 4 * unit), {unit, unit, unit});
    const std::vector<Face_index> expected = swept_faces(mesh, star);
    swept_at_all += !expected.empty();
    std::vector<Face_index> by_tree, by_all;
    Box_tree_broad_phase<Mesh>(mesh).query_star(star, by_tree);
    Brute_force_broad_phase<Mesh>(mesh).query_star(star, by_all);
    by_tree = sorted(by_tree);
    BOOST_TEST(std::includes(by_tree.begin(), by_tree.end(), expected.begin(), expected.end()), "round " << round);
    BOOST_TEST(by_tree == sorted(by_all), "round " << round);
  }
  BOOST_TEST(test::is_enough(swept_at_all, 100));
}
