// SPDX-License-Identifier: GPL-3.0-or-later
// What the box tree promises beside right answers: few faces, little memory, fetching ahead that changes nothing.
#include "surface/broad_phase/random_points.h"
#include "surface/broad_phase/swept_faces.h"

#include <haptic_sculpt/surface/broad_phase/Box_tree_broad_phase.h>
#include <haptic_sculpt/surface/connectivity/star.h>

#include <boost/test/unit_test.hpp>

#include <cmath>

using namespace haptic_sculpt;
using namespace broad_phase_tests;

namespace {

/// How many faces the tree names of those in the boxes around swept stars of a torus, over 50 of them.
/// \param swept_of(mesh, v, star, random) makes one, `star` being that of v
template <class Swept_of>
double share_of_boxes(const Swept_of& swept_of) {
  const Mesh mesh = meshes::to_mesh(meshes::torus(400, 200));
  Random random(seed());
  Brute_force_broad_phase<Mesh> brute_force(mesh);
  Box_tree_broad_phase<Mesh> tree(mesh);
  std::vector<Face_index> in_box, found; // of all, one after the other
  internal::Star<Mesh> star;
  for (int k = 0; k < 50; ++k) {
    const Vertex_index v(static_cast<Mesh::size_type>(random() % mesh.num_vertices()));
    star.collect(mesh, v);
    const Swept_star_3 swept = swept_of(mesh, v, star, random);
    brute_force.query(swept.box(), in_box);
    tree.query_star(swept, found);
  }
  return static_cast<double>(found.size()) / static_cast<double>(in_box.size());
}

Coordinates near_by(Coordinates p, Random& random) {
  for (double& x : p)
    x += uniform(random);
  return p;
}

} // namespace

BOOST_AUTO_TEST_CASE(a_long_push_asks_for_few_faces) {
  BOOST_TEST(share_of_boxes([](const Mesh& mesh, Vertex_index v, const internal::Star<Mesh>& star, Random& random) {
               const Coordinates source = vertex_coordinates(mesh, v);
               return star.swept(source, near_by(source, random));
             }) < 0.05);
}

BOOST_AUTO_TEST_CASE(a_spike_that_is_drawn_in_asks_for_few_faces) {
  BOOST_TEST(share_of_boxes([](const Mesh&, Vertex_index, const internal::Star<Mesh>& star, Random& random) {
               const Coordinates tip = near_by(star.link_points[0], random);
               return star.swept(tip, star.link_points[random() % star.valence()]);
             }) < 0.05);
}

// Among what the tree was built of, and among what has come since.
BOOST_AUTO_TEST_CASE(a_query_that_may_find_few_is_given_up) {
  constexpr std::size_t most = 100;
  for (const bool comes_later : {false, true}) {
    Mesh mesh = meshes::to_mesh(meshes::tetrahedron(4));
    const Mesh ball = meshes::to_mesh(meshes::icosphere(4).scale_and_move(0.5, 3, 1, 1));
    if (!comes_later)
      mesh += ball;
    Box_tree_broad_phase<Mesh> tree(mesh);
    if (comes_later) {
      const std::size_t first = mesh.num_faces();
      mesh += ball;
      tree.faces_inserted(
          std::vector<Face_index>(mesh.faces().begin() + static_cast<std::ptrdiff_t>(first), mesh.faces().end()));
    }
    internal::Star<Mesh> star;
    star.collect(mesh, Vertex_index(0));
    const Swept_star_3 through = star.swept(vertex_coordinates(mesh, Vertex_index(0)), {12, 0, 0});
    std::vector<Face_index> all, few;
    BOOST_TEST(tree.query_star(through, all));
    BOOST_TEST(all.size() > 3 * most);
    BOOST_TEST(!tree.query_star(through, few, most));
    BOOST_TEST(few.size() > most);
    BOOST_TEST(few.size() <= most + 8); // those of a leaf
  }
}

BOOST_AUTO_TEST_CASE(fetching_ahead_changes_no_answer) {
  Mesh mesh = meshes::to_mesh(meshes::torus(320, 160)); // smaller trees are taken to be in cache
  Random random(seed());
  Box_tree_broad_phase<Mesh> tree(mesh), asked_ahead(mesh);
  std::vector<Face_index> expected, found;
  const auto random_box = [&] {
    const Vertex_index v(static_cast<Mesh::size_type>(random() % mesh.num_vertices()));
    Box_3 box(vertex_coordinates(mesh, v));
    const double size = std::ldexp(1.0, -static_cast<int>(random() % 12)); // of few faces, or of nearly all
    for (int i = 0; i < 3; ++i)
      box.lower[i] -= size * std::abs(uniform(random)), box.upper[i] += size * std::abs(uniform(random));
    return box;
  };
  for (int k = 0; k < 300; ++k) {
    const Box_3 box = random_box();
    if (random() % 4 != 0)
      asked_ahead.fetch_ahead(random() % 2 == 0 ? box : random_box());
    for (std::size_t steps = random() % 6; steps != 0; --steps) {
      if (random() % 4 == 0) { // what was fetched may have changed
        const Vertex_index v(static_cast<Mesh::size_type>(random() % mesh.num_vertices()));
        const Point_3 p = mesh.point(v);
        mesh.point(v) = Point_3(p.x() + 0.1 * uniform(random), p.y(), p.z());
        const auto around = mesh.faces_around_target(mesh.halfedge(v));
        const std::vector<Face_index> faces(around.begin(), around.end());
        tree.faces_moved(faces);
        asked_ahead.faces_moved(faces);
      }
      asked_ahead.fetch_on();
    }
    expected.clear(), found.clear();
    tree.query(box, expected);
    asked_ahead.query(box, found);
    BOOST_REQUIRE(!expected.empty());
    BOOST_REQUIRE(sorted(found) == sorted(expected));
  }
}

BOOST_AUTO_TEST_CASE(memory_of_the_tree_is_as_promised) {
  const Mesh mesh = meshes::to_mesh(meshes::torus(300, 170));
  const double bytes = static_cast<double>(Box_tree_broad_phase<Mesh>(mesh).memory()) / mesh.number_of_faces();
  BOOST_TEST_MESSAGE("bytes per triangle: " << bytes);
  BOOST_TEST(bytes <= 36.0);
}
