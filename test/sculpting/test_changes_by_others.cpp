// SPDX-License-Identifier: GPL-3.0-or-later
// A mesh that others than its Sculptor have changed.
#include "sculpting/Random_scene.h"

#include <boost/test/unit_test.hpp>

#include <cmath>
#include <limits>

using namespace haptic_sculpt;
using namespace haptic_sculpt::test;

BOOST_AUTO_TEST_CASE(a_mesh_that_others_have_changed_is_seen_by_name) {
  Mesh mesh = ball();
  Sculptor<Mesh> sculptor(mesh);
  const Vertex_index added = mesh.add_vertex(Point_3(9, 9, 9));
  BOOST_CHECK_THROW(sculptor.id(added), Mesh_changed);
  BOOST_CHECK_THROW(sculptor.set_delta(1e-6), Mesh_changed);
  mesh.clear();
  BOOST_CHECK_THROW(sculptor.set_delta(1e-6), Mesh_changed);
  BOOST_TEST(sculptor.parameters().delta_length == 0);
}

BOOST_AUTO_TEST_CASE(changes_by_others_are_found) {
  {
    Mesh mesh = ball();
    Sculptor<Mesh> sculptor(mesh);
    mesh.point(Vertex_index(5)) = Point_3(3, 3, 3);
    BOOST_CHECK_THROW(sculptor.grab(Vertex_index(0)), Mesh_changed);
    BOOST_CHECK_THROW(sculptor.check_unchanged(), Mesh_changed);
  }
  {
    Mesh mesh = ball();
    Sculptor<Mesh> sculptor(mesh);
    auto grab = sculptor.grab(Vertex_index(0));
    mesh.point(Vertex_index(0)) = Point_3(3, 3, 3);
    BOOST_CHECK_THROW(grab.drag_to(Point_3(0, 0, 2)), Mesh_changed);
  }
  {
    Mesh mesh = ball();
    Sculptor<Mesh> sculptor(mesh);
    mesh.add_vertex(Point_3(9, 9, 9));
    BOOST_CHECK_THROW(sculptor.grab(Vertex_index(0)), Mesh_changed);
  }
  {
    Mesh mesh = ball();
    const Vertex_index extra = mesh.add_vertex(Point_3(9, 9, 9));
    mesh.remove_vertex(extra);
    Sculptor<Mesh> sculptor(mesh);
    mesh.collect_garbage();
    BOOST_CHECK_THROW(sculptor.grab(Vertex_index(0)), Mesh_changed);
  }
}

// What is in hand has faces that are no more, and nothing is read of them.
BOOST_AUTO_TEST_CASE(others_that_leave_fewer_elements_than_the_hand_holds_are_found) {
  for (const bool clears : {false, true})
    for (int way = 0; way < 17; ++way) {
      BOOST_TEST_INFO_SCOPE("clears " << clears << ", way " << way);
      Mesh mesh = meshes::to_mesh(meshes::bumpy_sphere(2, 0.1));
      const Mesh fewer = meshes::to_mesh(meshes::tetrahedron());
      Sculptor<Mesh> sculptor(mesh);
      const Vertex_index v(static_cast<Mesh::size_type>(mesh.number_of_vertices() - 1));
      auto grab = sculptor.grab(v);
      if (way < 8) // else nothing in hand has moved, whose faces would be looked for
        BOOST_TEST(grab.drag_to(mesh.point(v) + 0.2 * (mesh.point(v) - CGAL::ORIGIN)).reached);
      if (clears)
        mesh.clear();
      else
        mesh = Mesh(fewer);
      const auto use = [&] {
        switch (way) {
        case 0: sculptor.nearest_vertex(Point_3(0, 0, 0), 10); break;
        case 1: sculptor.undo(); break;
        case 2: grab.release(); break;
        case 3: sculptor.first_hit(Point_3(9, 9, 9), Point_3(0, 0, 0)); break;
        case 4: sculptor.edge_of(100, 101); break;
        case 5: sculptor.face_of(100, 101, 102); break;
        case 6: sculptor.apply(Edit::of(Edit_kind::collapse, {100, 101, 0})); break;
        case 7:
          sculptor.probe(Point_3(9, 9, 9));
          break;
        case 8:
          sculptor.apply(Edit::of(Edit_kind::move, {100, 0, 0}, {0, 0, 2}));
          break;
        case 9:
          sculptor.apply(Edit::of(Edit_kind::remove, {100, 0, 0}));
          break;
        case 10: {
          Edit shift = Edit::of(Edit_kind::shift);
          shift.ways = {{100, 0.5}};
          sculptor.apply(shift);
          break;
        }
        case 11:
          grab.drag_to(Point_3(0, 0, 2));
          break;
        case 12:
          sculptor.drag(v, Point_3(0, 0, 2));
          break;
        case 13:
          sculptor.move_if_free(v, Point_3(0, 0, 2));
          break;
        case 14:
          sculptor.first_impact(v, Point_3(0, 0, 2));
          break;
        case 15:
          sculptor.is_inside_out(v);
          break;
        default:
          sculptor.grab(v);
        }
      };
      BOOST_CHECK_THROW(use(), Mesh_changed);
    }
}

// The precondition of a sweep says nothing to who catches an Error.
BOOST_AUTO_TEST_CASE(what_others_make_infinite_or_no_number_on_the_way_is_found) {
  for (const double x : {std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()})
    for (const bool is_once : {false, true}) {
      Mesh mesh = meshes::to_mesh(meshes::bumpy_sphere(2, 0.12));
      Sculptor<Mesh> sculptor(mesh);
      const Vertex_index top = sculptor.nearest_vertex(Point_3(0, 0, 2), 9);
      const Vertex_index bottom = sculptor.nearest_vertex(Point_3(0, 0, -2), 9);
      const Mesh before = mesh;
      auto probe = sculptor.probe(Point_3(0, 0, 1.5));
      mesh.point(bottom) = Point_3(x, before.point(bottom).y(), before.point(bottom).z());
      const Point_3 far(0, 0.01, -3);
      BOOST_CHECK_THROW(sculptor.drag(top, far, Drag_parameters().once(is_once)), Mesh_changed);
      BOOST_CHECK_THROW(sculptor.move_if_free(top, far, Drag_parameters().once(is_once)), Mesh_changed);
      BOOST_CHECK_THROW(sculptor.first_impact(top, far), Mesh_changed);
      mesh.point(bottom) = before.point(bottom);
      mesh.point(top) = Point_3(before.point(top).x(), before.point(top).y(), x);
      BOOST_CHECK_THROW(probe.drag_to(Point_3(0, 0, 0)), Mesh_changed);
      mesh.point(top) = before.point(top);
      sculptor.check_unchanged();
      BOOST_TEST(sculptor.drag(top, Point_3(0, 0, 2)).reached); // it goes on
    }
}

// Where it was is nobody's business, not even where no number equals itself.
BOOST_AUTO_TEST_CASE(a_removed_vertex_may_be_anywhere) {
  Mesh mesh = meshes::to_mesh(meshes::tetrahedron());
  mesh.remove_vertex(mesh.add_vertex({std::nan(""), 0, 0}));
  Sculptor<Mesh> sculptor(mesh);
  sculptor.check_unchanged();
  BOOST_TEST(sculptor.drag(Vertex_index(3), {0, 0, 2}).reached);
  sculptor.check_unchanged();
}
