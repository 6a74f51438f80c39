// SPDX-License-Identifier: GPL-3.0-or-later
// Many vertices at once along one axis through a Sculptor: all or none, one change of the history, told when all stand.
#include "oracle/embedding_oracle.h"
#include "sculpting/axis_moves/embedded_at.h"
#include "sculpting/motion/embedding_oracle_input.h"

#include <haptic_sculpt/sculpting.h>

#include <boost/property_map/property_map.hpp>
#include <boost/test/unit_test.hpp>

#include <map>

using namespace haptic_sculpt;
using namespace haptic_sculpt::test;

namespace {

using Ways = std::vector<std::pair<Vertex_index, double>>;
using Points = std::vector<std::array<double, 3>>;

Points points_of(const Mesh& mesh) {
  Points points;
  for (const Vertex_index v : mesh.vertices())
    points.push_back(vertex_coordinates(mesh, v));
  return points;
}

/// Of all vertices by a share of another coordinate.
Ways shear(const Mesh& mesh, int axis, int other, double share) {
  Ways ways;
  for (const Vertex_index v : mesh.vertices()) {
    const auto p = vertex_coordinates(mesh, v);
    ways.emplace_back(v, p[axis] + share * p[other]);
  }
  return ways;
}

/// Notes how the mesh stands whenever it hears of a move.
struct Looking_visitor : Default_edit_visitor {
  const Mesh* mesh = nullptr;
  std::vector<Points> seen;
  std::vector<Vertex_index> moved;
  void vertex_moved(Vertex_index v) {
    moved.push_back(v);
    seen.push_back(points_of(*mesh));
  }
};

using Looking_sculptor = Sculptor<Mesh, Box_tree_broad_phase<Mesh>, Looking_visitor>;

} // namespace

BOOST_AUTO_TEST_CASE(a_shift_is_one_change) {
  Mesh mesh = ball();
  Looking_visitor visitor;
  visitor.mesh = &mesh;
  Looking_sculptor sculptor(mesh, Sculptor_parameters(), visitor);
  const Points before = points_of(mesh);
  const std::size_t bytes = sculptor.history().bytes();
  BOOST_TEST(bool(sculptor.shift(2, shear(mesh, 2, 0, 7.25))));
  const Points after = points_of(mesh);
  BOOST_TEST((after != before));
  BOOST_TEST(validate(mesh).is_valid());
  BOOST_TEST(sculptor.history().number_of_undo_steps() == 1u);
  const std::size_t moved = sculptor.visitor().moved.size();
  BOOST_TEST(moved > 30u); // one at x = 0 stays
  BOOST_TEST(sculptor.history().bytes() - bytes == 48 + 24 * moved + 16);
  for (const Points& seen : sculptor.visitor().seen)
    BOOST_TEST((seen == after));
  sculptor.check_unchanged();
  sculptor.visitor().seen.clear();
  BOOST_TEST(bool(sculptor.undo()));
  BOOST_TEST((points_of(mesh) == before));
  for (const Points& seen : sculptor.visitor().seen)
    BOOST_TEST((seen == before));
  BOOST_TEST(sculptor.visitor().moved.size() == 2 * moved);
  sculptor.check_unchanged();
  BOOST_TEST(bool(sculptor.redo()));
  BOOST_TEST((points_of(mesh) == after));
  BOOST_TEST(!bool(sculptor.redo()));
  BOOST_TEST(bool(sculptor.undo()));
  BOOST_TEST(!bool(sculptor.undo()));
}

BOOST_AUTO_TEST_CASE(a_shift_that_is_blocked_changes_nothing) {
  Mesh mesh = meshes::to_mesh(meshes::bumpy_sphere(2, 0.3, 0.02)); // no face of it is in a plane along an axis
  Sculptor<Mesh> sculptor(mesh);
  const Points before = points_of(mesh);
  Ways ways = shear(mesh, 1, 1, -2); // inside out
  const auto refused = sculptor.shift(1, ways);
  BOOST_REQUIRE(!refused);
  BOOST_TEST(int(refused.refusal->reason) == int(Refusal_reason::blocked));
  BOOST_TEST(refused.refusal->elements.size() == 4u);
  BOOST_TEST((points_of(mesh) == before));
  BOOST_TEST(sculptor.history().number_of_undo_steps() == 0u);
  BOOST_CHECK_THROW(sculptor.shift(3, ways), Invalid_parameter);
  ways[5].second = 0x1p1001;
  BOOST_CHECK_THROW(sculptor.shift(1, ways), Out_of_range);
  ways[5] = {Vertex_index(10000), 0};
  BOOST_CHECK_THROW(sculptor.shift(1, ways), Unknown_vertex);
  BOOST_TEST((points_of(mesh) == before));
  BOOST_TEST(bool(sculptor.shift(1, {})));
  const Vertex_index v(0);
  const double here = vertex_coordinates(mesh, v)[0];
  const auto nothing = sculptor.shift(0, {{v, 100}, {v, here}}); // the last counts
  BOOST_TEST((nothing && !nothing.vertex)); // none was moved
  const Vertex_index w(1);
  const double there = vertex_coordinates(mesh, w)[0];
  const auto one = sculptor.shift(0, {{w, there}, {v, here + 1e-9}});
  BOOST_TEST((one && one.vertex == v));
  BOOST_TEST(bool(sculptor.undo()));
  BOOST_TEST((points_of(mesh) == before));
}

// What undo has left below a delta that was set since may go along, without rounding, and grow, and must not shrink.
BOOST_AUTO_TEST_CASE(altitudes_that_are_low_already_are_in_nobodys_way) {
  Mesh mesh = ball();
  Sculptor<Mesh> sculptor(mesh);
  const Vertex_index v(20), near = mesh.source(mesh.halfedge(v));
  const Point_3 p = mesh.point(v);
  const auto way = 0.95 * (mesh.point(near) - p);
  BOOST_REQUIRE(sculptor.move_if_free(v, p + way));
  const Point_3 low = mesh.point(v);
  BOOST_REQUIRE(sculptor.move_if_free(v, p));
  sculptor.set_delta(0.04);
  BOOST_REQUIRE(bool(sculptor.undo()));
  BOOST_REQUIRE((mesh.point(v) == low));
  BOOST_REQUIRE(!validate(mesh, 0.04).is_valid());
  for (int axis = 0; axis < 3; ++axis) { // all of it; by a power of two, without rounding
    Ways ways;
    for (const Vertex_index u : mesh.vertices())
      ways.emplace_back(u, vertex_coordinates(mesh, u)[axis] + 0x1p-10);
    BOOST_TEST(bool(sculptor.shift(axis, ways)), "axis " << axis);
    BOOST_TEST(bool(sculptor.undo()));
  }
  for (int axis = 0; axis < 3; ++axis) {
    if (std::fabs(way[axis]) < 0.1)
      continue;
    const double here = low[axis], back = here + 0.1 * (p[axis] - here), on = here - 0.01 * (p[axis] - here);
    const auto shrinks = sculptor.shift(axis, {{v, on}});
    BOOST_REQUIRE(!shrinks);
    BOOST_TEST((shrinks.refusal->reason == Refusal_reason::delta),
               "axis " << axis << ", reason " << int(shrinks.refusal->reason));
    BOOST_TEST(bool(sculptor.shift(axis, {{v, back}})), "axis " << axis);
  }
  std::map<Vertex_index, Point_3> targets;
  for (const Vertex_index u : mesh.vertices())
    targets[u] = CGAL::ORIGIN + 1.25 * (mesh.point(u) - CGAL::ORIGIN);
  const auto report = move_vertices(sculptor, mesh.vertices(), boost::make_assoc_property_map(targets));
  BOOST_TEST(report.reached == mesh.num_vertices());
  sculptor.check_unchanged();
}

// Between two drags of a vertex in one stroke: what is taken back goes by the states that were there.
BOOST_AUTO_TEST_CASE(a_shift_is_not_merged_with_drags) {
  Mesh mesh = ball();
  Looking_visitor visitor;
  visitor.mesh = &mesh;
  Looking_sculptor sculptor(mesh, Sculptor_parameters(), visitor);
  const Points before = points_of(mesh);
  const Vertex_index v(3);
  std::vector<Points> states{before};
  {
    const auto stroke = sculptor.stroke();
    sculptor.grab(v).drag_to(mesh.point(v) + (mesh.point(v) - CGAL::ORIGIN) * 0.125);
    states.push_back(points_of(mesh));
    BOOST_TEST(bool(sculptor.shift(0, shear(mesh, 0, 1, 3))));
    states.push_back(points_of(mesh));
    BOOST_TEST(bool(sculptor.shift(1, shear(mesh, 1, 2, -2))));
    states.push_back(points_of(mesh));
    sculptor.grab(v).drag_to(mesh.point(v) + (mesh.point(v) - CGAL::ORIGIN) * 0.125);
    states.push_back(points_of(mesh));
  }
  BOOST_TEST(sculptor.history().number_of_undo_steps() == 1u);
  for (int round = 0; round < 2; ++round) {
    sculptor.visitor().seen.clear();
    BOOST_TEST(bool(sculptor.undo()));
    BOOST_TEST((points_of(mesh) == before));
    BOOST_TEST(bool(sculptor.redo()));
    BOOST_TEST((points_of(mesh) == states.back()));
    for (const Points& seen : sculptor.visitor().seen)
      BOOST_TEST(std::count(states.begin(), states.end(), seen) == 1);
  }
}

// Some vertices of small meshes among others far away: the faces looked at are found by the broad phase.
BOOST_AUTO_TEST_CASE(some_vertices_go_as_they_would_with_all_faces_looked_at) {
  Random random(seed_from_environment(5));
  std::size_t done = 0, wrong = 0, shifts = 0;
  for (int i = 0; i < 1500; ++i) {
    meshes::Triangle_list list = random_small_list(random, 3);
    const std::size_t here = list.points.size();
    meshes::Triangle_list far = meshes::icosphere(1);
    for (Point_3& p : far.points)
      p = Point_3(p.x() + 100, p.y() + 100, p.z() + 100);
    list += far;
    Mesh mesh = meshes::to_mesh(list);
    Axis_scene scene{to_oracle(list), static_cast<int>(random() % 3), {}};
    for (const auto& p : scene.mesh.points)
      scene.ends.push_back(p[scene.axis]);
    Ways ways;
    for (int k = 0; k < 3; ++k) {
      const std::size_t v = random() % here;
      scene.ends[v] = static_cast<double>(random() % 7) - 3;
      ways.emplace_back(static_cast<Mesh::size_type>(v), scene.ends[v]);
    }
    Filter_counters counters;
    internal::Axis_move<Mesh> move(mesh, counters);
    move.take({mesh.faces().begin(), mesh.faces().end()}, true);
    internal::Axis_ways<Mesh> all;
    for (std::size_t v = 0; v < scene.ends.size(); ++v)
      all.emplace_back(static_cast<Mesh::size_type>(v), scene.ends[v]);
    move.begin(scene.axis, all, 0);
    Sculptor<Mesh> sculptor(mesh);
    const bool is_done = bool(sculptor.shift(scene.axis, ways));
    ++shifts, done += is_done;
    wrong += is_done != move.is_free();
    if (is_done)
      wrong += !validate(mesh).is_valid();
  }
  BOOST_TEST_MESSAGE(done << " of " << shifts << " shifts done");
  BOOST_TEST(wrong == 0u);
  BOOST_TEST(done > shifts / 20);
  BOOST_TEST(done < shifts * 19 / 20);
}

// What is cached for drags is as if the Sculptor had been made after the shift.
BOOST_AUTO_TEST_CASE(drags_after_a_shift_are_those_of_a_new_sculptor) {
  Mesh mesh = meshes::to_mesh(meshes::bumpy_sphere(3, 0.3, 0.02));
  Sculptor<Mesh> sculptor(mesh);
  Random random(seed_from_environment(6));
  const Vertex_index first(7);
  sculptor.grab(first).drag_to(mesh.point(first) + CGAL::Vector_3<meshes::Kernel>(0.05, 0, 0.01));
  BOOST_TEST(bool(sculptor.shift(0, shear(mesh, 0, 2, 5))));
  Mesh copy = mesh;
  Sculptor<Mesh> other(copy);
  for (int i = 0; i < 200; ++i) {
    const Vertex_index v(static_cast<Mesh::size_type>(random() % mesh.number_of_vertices()));
    const auto way = [&] { return static_cast<double>(random() % 2001) / 1000 - 1; };
    const double x = way(), y = way(), z = way();
    const Point_3 target = mesh.point(v) + CGAL::Vector_3<meshes::Kernel>(x, y, z);
    sculptor.grab(v).drag_to(target);
    other.grab(v).drag_to(target);
    BOOST_TEST((mesh.point(v) == copy.point(v)));
  }
}

BOOST_AUTO_TEST_CASE(a_shift_respects_what_stands_still_and_delta) {
  meshes::Triangle_list list = meshes::cube(), above = meshes::cube(); // of edge 1 at the origin
  const std::size_t moving = list.points.size();
  list += above.scale_and_move(1, 0.25, 0.25, 3);
  Mesh mesh = meshes::to_mesh(list);
  Sculptor<Mesh> sculptor(mesh, Sculptor_parameters().delta(0.25));
  const auto put = [&](const auto& height) {
    Ways ways;
    for (std::size_t i = 0; i < moving; ++i) {
      const Vertex_index v(static_cast<Mesh::size_type>(i));
      ways.emplace_back(v, height(mesh.point(v).z()));
    }
    return sculptor.shift(2, ways);
  };
  const auto refused = put([](double z) { return z + 5; });
  BOOST_REQUIRE(!refused);
  BOOST_TEST(int(refused.refusal->reason) == int(Refusal_reason::blocked));
  const auto too_flat = put([](double z) { return z / 5; });
  BOOST_REQUIRE(!too_flat);
  BOOST_TEST(int(too_flat.refusal->reason) == int(Refusal_reason::delta));
  BOOST_TEST(bool(put([](double z) { return z + 1.5; })));
  // A probe may stand anywhere then, and is in nobody's way.
  auto probe = sculptor.probe(Point_3(0.5, 0.5, 0.5));
  BOOST_REQUIRE(bool(probe));
  BOOST_TEST(bool(sculptor.undo()));
  BOOST_TEST((probe.drag_to(Point_3(5, 5, 5)).end == Drag_end::stale));
  BOOST_TEST((sculptor.probe(probe.position()).refusal()->reason == Refusal_reason::inside));
  BOOST_TEST(validate(mesh).is_valid());
}
