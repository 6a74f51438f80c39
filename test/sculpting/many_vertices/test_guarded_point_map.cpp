// SPDX-License-Identifier: GPL-3.0-or-later
// CGAL's own functions on meshes that they break, with and without the guard.
#include "sculpting/many_vertices/many_vertices_scene.h"

#include <haptic_sculpt/sculpting/Allow_embedded_move.h>
#include <haptic_sculpt/sculpting/guarded_point_map.h>

#include <CGAL/Polygon_mesh_processing/random_perturbation.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Polygon_mesh_processing/tangential_relaxation.h>

#include <boost/concept/assert.hpp>
#include <boost/property_map/property_map.hpp>

using namespace haptic_sculpt;
using namespace haptic_sculpt::test;
namespace PMP = CGAL::Polygon_mesh_processing;

namespace {

std::size_t pairs(const Mesh& mesh) {
  std::vector<std::pair<Face_index, Face_index>> result;
  PMP::self_intersections(mesh, std::back_inserter(result));
  return result.size();
}

std::vector<Named_mesh> thin_meshes() {
  return {{"hollow ball", meshes::to_mesh(meshes::hollow_ball(3, 0.012))},
          {"wavy plate", meshes::to_mesh(meshes::wavy_plate())},
          {"hidden cavity", meshes::to_mesh(meshes::hidden_cavity())},
          {"Swiss cheese", meshes::to_mesh(meshes::swiss_cheese(2, 0.01))}};
}

/// Runs `function(mesh, map)` with the mesh's own map and with guarded ones.
template <class Function>
void check_function(const std::string& what, const Function& function) {
  std::size_t plain_pairs = 0;
  for (const auto& [name, mesh] : thin_meshes())
    BOOST_TEST_CONTEXT(what << " of " << name) {
      Mesh plain = mesh;
      function(plain, get(CGAL::vertex_point, plain));
      plain_pairs += pairs(plain);
      for (const Guard_policy policy :
           {Guard_policy::back_off, Guard_policy::stop, Guard_policy::slide, Guard_policy::whole}) {
        Mesh guarded = mesh;
        Sculptor<Mesh> sculptor(guarded);
        const Mesh_snapshot before = snapshot(sculptor);
        const auto map = guarded_point_map(sculptor, policy);
        {
          const auto stroke = sculptor.stroke();
          function(guarded, map);
        }
        BOOST_TEST(pairs(guarded) == 0u);
        BOOST_TEST(validate(guarded).is_valid());
        const Guard_counts& counts = map.counts();
        BOOST_TEST(counts.puts >= counts.refused);
        BOOST_TEST(counts.left <= counts.asked);
        BOOST_TEST(map.refused() == counts.refused);
        check_undo_and_redo(sculptor, before);
        BOOST_TEST_MESSAGE(what << " of " << name << ", policy " << static_cast<int>(policy) << ": plain "
                                << pairs(plain) << " pairs, guarded 0; refused " << map.refused() << " of "
                                << counts.puts << " puts, " << 100 * (1 - counts.left / counts.asked)
                                << " % of the way");
      }
    }
  BOOST_TEST(plain_pairs > 0u, what << " breaks none of these meshes by itself: they prove nothing");
}

} // namespace

BOOST_AUTO_TEST_CASE(the_concept) {
  using Map = Guarded_point_map<Sculptor<Mesh>>;
  BOOST_CONCEPT_ASSERT((boost::ReadWritePropertyMapConcept<Map, Vertex_index>));
}

BOOST_AUTO_TEST_CASE(tangential_relaxation_of_thin_walls) {
  check_function("tangential relaxation", [](Mesh& mesh, const auto& map) {
    PMP::tangential_relaxation(mesh, CGAL::parameters::number_of_iterations(5).vertex_point_map(map));
  });
}

BOOST_AUTO_TEST_CASE(random_perturbation_of_thin_walls) {
  check_function("random perturbation", [](Mesh& mesh, const auto& map) {
    PMP::random_perturbation(vertices(mesh), mesh, 0.5 * mean_edge(mesh),
                             CGAL::parameters::vertex_point_map(map).do_project(false).random_seed(5));
  });
}

BOOST_AUTO_TEST_CASE(relaxation_that_asks_before_each_move) {
  std::size_t plain_pairs = 0, refused = 0;
  for (const auto& [name, mesh] : thin_meshes())
    BOOST_TEST_CONTEXT(name) {
      Mesh plain = mesh, guarded = mesh;
      PMP::tangential_relaxation(plain, CGAL::parameters::number_of_iterations(5));
      plain_pairs += pairs(plain);
      Sculptor<Mesh> sculptor(guarded);
      const Mesh_snapshot before = snapshot(sculptor);
      const auto allow = haptic_sculpt::allow_embedded_move(sculptor, guarded);
      {
        const auto stroke = sculptor.stroke();
        PMP::tangential_relaxation(guarded, CGAL::parameters::number_of_iterations(5).allow_move_functor(allow));
      }
      sculptor.check_unchanged(); // CGAL has left no point of its own
      BOOST_TEST(pairs(guarded) == 0u);
      BOOST_TEST(validate(guarded).is_valid());
      BOOST_TEST((snapshot(sculptor) != before));
      refused += allow.refused();
      check_undo_and_redo(sculptor, before);
      BOOST_CHECK_THROW(Allow_embedded_move<Sculptor<Mesh>>(sculptor, plain), Invalid_parameter);
    }
  BOOST_TEST(plain_pairs > 0u);
  BOOST_TEST(refused > 0u);
}

BOOST_AUTO_TEST_CASE(policies_at_a_wall) {
  const Mesh scene = meshes::to_mesh(meshes::ball_in_a_cavity());
  const Vertex_index v(static_cast<Mesh::size_type>(scene.num_vertices() - 1));              // of the ball of radius 1
  const Point_3 from = scene.point(v), through = CGAL::ORIGIN + 1.6 * (from - CGAL::ORIGIN); // the wall is at 1.5
  const auto end = [&](Guard_policy policy, const Point_3& to, std::size_t refused) {
    Mesh mesh = scene;
    Sculptor<Mesh> sculptor(mesh);
    const auto map = guarded_point_map(sculptor, policy);
    const auto copy = map;
    put(copy, v, to);
    BOOST_TEST(map.refused() == refused);
    BOOST_TEST(map.counts().puts == 1u);
    BOOST_TEST((get(map, v) == mesh.point(v)));
    BOOST_TEST(validate(mesh).is_valid());
    return Point_3(mesh.point(v));
  };
  const auto left = [&](const Point_3& p) { return CGAL::squared_distance(p, through); };
  const Point_3 half = end(Guard_policy::back_off, through, 1), stopped = end(Guard_policy::stop, through, 1),
                slid = end(Guard_policy::slide, through, 1);
  BOOST_TEST((end(Guard_policy::whole, through, 1) == from));
  BOOST_TEST(CGAL::squared_distance(half, CGAL::midpoint(from, through)) < 1e-30);
  BOOST_TEST(left(stopped) < left(half));
  BOOST_TEST(left(slid) <= left(stopped));
  const Point_3 near = CGAL::ORIGIN + 1.1 * (from - CGAL::ORIGIN);
  for (const Guard_policy policy :
       {Guard_policy::back_off, Guard_policy::stop, Guard_policy::slide, Guard_policy::whole})
    BOOST_TEST((end(policy, near, 0) == near));
}

BOOST_AUTO_TEST_CASE(what_is_no_point_is_refused_and_counted) {
  Mesh mesh = meshes::to_mesh(meshes::icosphere(1));
  Sculptor<Mesh> sculptor(mesh);
  const auto map = guarded_point_map(sculptor);
  const Point_3 before = mesh.point(Vertex_index(3));
  put(map, Vertex_index(3), Point_3(std::nan(""), 0, 0));
  put(map, Vertex_index(3), Point_3(0, 0x1p1001, 0));
  BOOST_TEST(map.refused() == 2u);
  BOOST_TEST(map.counts().out_of_range == 2u);
  BOOST_TEST((mesh.point(Vertex_index(3)) == before));
  BOOST_CHECK_THROW(put(map, Vertex_index(1000), before), Unknown_vertex);
  map.reset_counts();
  BOOST_TEST(map.refused() == 0u);
  // A function that changes connectivity is found out, also by what counts nothing.
  for (const Guard_policy policy :
       {Guard_policy::back_off, Guard_policy::stop, Guard_policy::slide, Guard_policy::whole}) {
    Mesh flipped = meshes::to_mesh(meshes::icosphere(1));
    Sculptor<Mesh> other(flipped);
    const auto h = *flipped.halfedges_begin();
    const std::array<Vertex_index, 2> beside = {flipped.target(flipped.next(h)),
                                                flipped.target(flipped.next(flipped.opposite(h)))};
    CGAL::Euler::flip_edge(h, flipped);
    for (const Vertex_index v : beside) {
      const Point_3 place = flipped.point(v);
      BOOST_CHECK_THROW(put(guarded_point_map(other, policy), v, CGAL::midpoint(place, Point_3(0, 0, 0))),
                        Mesh_changed);
      BOOST_TEST((flipped.point(v) == place));
    }
  }
  mesh.add_vertex(Point_3(9, 9, 9));
  BOOST_CHECK_THROW(put(map, Vertex_index(3), Point_3(0, 0, 0.5)), Mesh_changed);
}
