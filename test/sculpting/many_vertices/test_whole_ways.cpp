// SPDX-License-Identifier: GPL-3.0-or-later
// Ways that are made once, as many vertices make them: the cheaper proof beside the sweeps alone.
#include "sculpting/many_vertices/many_vertices_scene.h"

using namespace haptic_sculpt;
using namespace haptic_sculpt::test;

BOOST_AUTO_TEST_CASE(a_drag_made_once_changes_no_result) {
  std::mt19937 random(static_cast<std::uint32_t>(seed_from_environment(11)));
  for (const auto& [name, scene] : scenes()) {
    Mesh usual = scene, single = scene;
    Sculptor<Mesh> one(usual, parameters::response(Response::stop)),
        other(single, parameters::response(Response::stop));
    const auto once = Drag_parameters().response(Response::stop).once();
    std::size_t free = 0, tries = 1500, wrong = 0;
    for (std::size_t i = 0; i < tries; ++i) {
      const Vertex_index v(static_cast<Mesh::size_type>(random() % usual.num_vertices()));
      const Point_3 p = usual.point(v), q = usual.point(usual.source(usual.halfedge(v)));
      const double size =
          std::sqrt(CGAL::squared_distance(p, q)) * std::pow(2, -0.5 * static_cast<double>(random() % 12));
      // Across the surface, along it, and straight at a neighbour, where stars fold over.
      const Vector_3 noise(meshes::uniform(random), meshes::uniform(random), meshes::uniform(random)),
          n = normal(usual, v);
      const Vector_3 way = i % 3 == 0   ? noise
                           : i % 3 == 1 ? noise - (noise * n) * n
                                        : 1.1 * (q - p) / std::sqrt(CGAL::squared_distance(p, q));
      const Point_3 target = p + size * way;
      const bool reached = one.grab(v).drag_to(target).reached;
      // Whether the whole way is free, by the sweeps alone and by the cheaper proof.
      wrong += other.drag(v, target, once).reached != reached || usual.point(v) != single.point(v);
      free += reached;
    }
    BOOST_TEST(wrong == 0u, name);
    BOOST_TEST(free > tries / 8, name);
    BOOST_TEST(free < tries, name);
    BOOST_TEST((snapshot(one) == snapshot(other)), name);
    one.check_unchanged();
    other.check_unchanged();
  }
}

BOOST_AUTO_TEST_CASE(a_whole_way_or_none) {
  std::mt19937 random(static_cast<std::uint32_t>(seed_from_environment(12)));
  for (const auto& [name, scene] : scenes(false)) {
    Mesh mesh = scene;
    Sculptor<Mesh> sculptor(mesh);
    for (int i = 0; i < 100; ++i) {
      const Vertex_index v(static_cast<Mesh::size_type>(random() % mesh.num_vertices()));
      const Point_3 p = mesh.point(v);
      const Point_3 target =
          p + mean_edge(mesh) * Vector_3(meshes::uniform(random), meshes::uniform(random), meshes::uniform(random));
      const bool is_free = !first_impact(mesh, v, target); // brute force over all faces
      BOOST_TEST(sculptor.move_if_free(v, target) == is_free);
      BOOST_TEST((mesh.point(v) == (is_free ? target : p)));
      BOOST_TEST(sculptor.history().number_of_undo_steps() == (is_free ? 1u : 0u));
      if (is_free)
        sculptor.undo();
      BOOST_TEST((mesh.point(v) == p));
    }
    BOOST_CHECK_THROW(sculptor.move_if_free(Vertex_index(0), Point_3(std::nan(""), 0, 0)), Out_of_range);
    BOOST_CHECK_THROW(sculptor.move_if_free(Vertex_index(), Point_3(0, 0, 0)), Unknown_vertex);
  }
}

BOOST_AUTO_TEST_CASE(the_cheaper_proof_is_right_and_often_found) {
  std::mt19937 random(static_cast<std::uint32_t>(seed_from_environment(13)));
  std::size_t free = 0, proven = 0, wrong = 0;
  for (const Named_mesh& scene : scenes(false))
    for (int i = 0; i < 150; ++i) {
      const Mesh& mesh = scene.mesh;
      const Vertex_index v(static_cast<Mesh::size_type>(random() % mesh.num_vertices()));
      const double size = mean_edge(mesh) * std::pow(2, -static_cast<double>(random() % 6));
      const Point_3 target =
          mesh.point(v) + size * Vector_3(meshes::uniform(random), meshes::uniform(random), meshes::uniform(random));
      internal::Star<Mesh> star;
      star.collect(mesh, v);
      internal::Convex_star<Mesh> proof;
      const bool is_proven =
          proof.assign(star, vertex_coordinates(mesh, v), internal::coordinates(target)) &&
          std::all_of(mesh.faces().begin(), mesh.faces().end(), [&](Face_index f) {
            const auto corners = internal::corners_of_face(mesh, f);
            return std::count(corners.begin(), corners.end(), v) != 0 || proof.is_apart(mesh, corners);
          });
      const bool is_free = !first_impact(mesh, v, target); // exact, over all faces
      wrong += is_proven && !is_free;
      free += is_free;
      proven += is_proven;
    }
  BOOST_TEST_MESSAGE("proven " << proven << " of " << free << " free motions");
  BOOST_TEST(wrong == 0u);
  BOOST_TEST(2 * proven > free);
}
