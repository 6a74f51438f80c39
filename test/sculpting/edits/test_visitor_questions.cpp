// SPDX-License-Identifier: GPL-3.0-or-later
// What a visitor asks the Sculptor in the midst of a change is not used when that is over.
#include "sculpting/Mesh_snapshot.h"
#include "sculpting/edits/random_edits.h"

#include <CGAL/boost/graph/copy_face_graph.h>

#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <utility>

using namespace haptic_sculpt;
using namespace haptic_sculpt::test;

namespace {

/// Asks in the midst of changes.
struct Asking_visitor : Default_edit_visitor {
  std::function<void()> ask;
  Vertex_index moved; ///< the last one
  void vertex_moved(Vertex_index v) { moved = v, hear(); }
  void face_dies(Mesh::Face_index) { hear(); }
  void face_created(Mesh::Face_index) { hear(); }

private:
  void hear() {
    if (ask)
      ask();
  }
};

using Asked_sculptor = Sculptor<Mesh, Box_tree_broad_phase<Mesh>, Asking_visitor>;

} // namespace

// Between the questions of one edit the mesh changes.
BOOST_AUTO_TEST_CASE(each_question_within_an_edit_is_answered_by_the_mesh_as_it_is_then) {
  const auto add = [](Mesh& mesh, std::array<Mesh::Point, 4> p, bool is_turned) {
    if (is_turned)
      std::swap(p[0], p[1]);
    std::array<Vertex_index, 4> v;
    std::transform(p.begin(), p.end(), v.begin(), [&mesh](const Mesh::Point& q) { return mesh.add_vertex(q); });
    mesh.add_face(v[0], v[2], v[1]), mesh.add_face(v[0], v[1], v[3]);
    mesh.add_face(v[1], v[2], v[3]), mesh.add_face(v[2], v[0], v[3]);
    return v;
  };
  int some_inside_out = 0;
  for (const bool is_turned : {false, true}) {
    Mesh mesh;
    const auto a = add(mesh, {Mesh::Point(-1, -1, 0), {1, -1, 0}, {0, 1, 0}, {0, 0, 1}}, false);
    // Beside the way of the tip of the first; the new vertex is drawn out over it.
    const auto b = add(mesh, {Mesh::Point(2, -1, 1), {2, 0, 4}, {2, 1, 1}, {3, 0, 2}}, is_turned);
    Asked_sculptor sculptor(mesh);
    const Mesh::Point target(0, 0, 2.5);
    BOOST_TEST(!sculptor.first_impact(a[3], target));
    const bool is_inside_out = sculptor.is_inside_out(b[0]);
    some_inside_out += is_inside_out;
    std::size_t questions = 0;
    sculptor.visitor().ask = [&] {
      ++questions;
      BOOST_TEST(sculptor.first_impact(a[3], target).has_value() == first_impact(mesh, a[3], target).has_value());
      for (const Vertex_index v : mesh.vertices())
        BOOST_TEST(sculptor.is_inside_out(v) == (is_inside_out && std::find(a.begin(), a.end(), v) == a.end()));
    };
    const auto f = sculptor.face_of(sculptor.id(b[0]), sculptor.id(b[1]), sculptor.id(b[2]));
    BOOST_TEST(static_cast<bool>(sculptor.insert_on_face(f, {-0.5, 0, 2})));
    BOOST_TEST(sculptor.first_impact(a[3], target).has_value());
    BOOST_TEST(static_cast<bool>(sculptor.undo()));
    BOOST_TEST(questions > 6u);
  }
  BOOST_TEST(some_inside_out == 1);
}

// The star of a vertex, looked up while a neighbour is not back yet, would miss what stands where that comes to be.
BOOST_AUTO_TEST_CASE(a_question_within_an_undo_lets_nothing_be_passed_through) {
  for (const bool asks : {false, true}) {
    Mesh mesh;
    const auto add = [&mesh](const std::array<Mesh::Point, 4>& p) {
      std::array<Vertex_index, 4> v;
      std::transform(p.begin(), p.end(), v.begin(), [&mesh](const Mesh::Point& q) { return mesh.add_vertex(q); });
      mesh.add_face(v[0], v[2], v[1]), mesh.add_face(v[0], v[1], v[3]);
      mesh.add_face(v[1], v[2], v[3]), mesh.add_face(v[2], v[0], v[3]);
      return v;
    };
    // A long one; and a small one over its long end, in the way of the tip's faces, but not once that end is drawn in.
    const auto v = add({Mesh::Point(-2, -1, 0), Mesh::Point(4, -1, 0), Mesh::Point(0, 1, 0), Mesh::Point(0, 0, 1)});
    add({Mesh::Point(2, -0.45, 0.9), Mesh::Point(2.125, -0.45, 0.9), Mesh::Point(2, -0.3, 0.9),
         Mesh::Point(2, -0.45, 1)});
    Asked_sculptor sculptor(mesh);
    {
      const auto stroke = sculptor.stroke();
      BOOST_REQUIRE(sculptor.drag(v[1], {1, -1, 0}).reached);
      BOOST_REQUIRE(sculptor.drag(v[0], {-3, -1, 0}).reached);
    }
    bool has_asked = false;
    if (asks)
      sculptor.visitor().ask = [&] {
        if (sculptor.visitor().moved == v[0]) { // the first to be moved back
          has_asked = true;
          BOOST_TEST(!sculptor.first_impact(v[3], {0, 0, 3}));
        }
      };
    sculptor.undo();
    sculptor.visitor().ask = nullptr;
    BOOST_TEST(has_asked == asks);
    BOOST_TEST(!sculptor.drag(v[3], {0, 0, 3}, Drag_parameters().response(Response::stop)).reached);
    BOOST_TEST(validate(mesh).is_valid());
  }
}

// A vertex goes from where a stroke has brought it to where it was before: on the way the mesh may be turned over.
BOOST_AUTO_TEST_CASE(what_a_visitor_hears_of_orientation_within_an_undo_is_not_kept) {
  Mesh mesh = meshes::to_mesh(meshes::tetrahedron().scale_and_move(1, -0.25, -0.25, -0.25));
  Asked_sculptor sculptor(mesh);
  const Mesh before = mesh;
  {
    const auto stroke = sculptor.stroke(); // half a turn
    for (int i = 1; i <= 64; ++i)
      for (const Vertex_index v : mesh.vertices()) {
        const Mesh::Point p = before.point(v);
        const double c = std::cos(i * CGAL_PI / 64), s = std::sin(i * CGAL_PI / 64);
        BOOST_REQUIRE(sculptor.drag(v, {c * p.x() - s * p.y(), s * p.x() + c * p.y(), p.z()}).reached);
      }
  }
  int questions = 0, answers = 0;
  sculptor.visitor().ask = [&] { ++questions, answers += sculptor.is_inside_out(Vertex_index(0)); };
  BOOST_TEST(static_cast<bool>(sculptor.undo()));
  sculptor.visitor().ask = nullptr;
  BOOST_TEST(questions == 4);
  BOOST_TEST(answers > 0);
  BOOST_TEST(!sculptor.is_inside_out(Vertex_index(0)));
}

BOOST_AUTO_TEST_CASE(what_a_question_within_an_undo_finds_out_about_the_scene_is_not_kept) {
  for (const bool asks : {false, true}) {
    Mesh mesh = meshes::to_mesh(meshes::icosphere(1));
    Asked_sculptor sculptor(mesh);
    const Vertex_index far(0), last(1);
    const auto times = [&](Vertex_index v, double x) { return CGAL::ORIGIN + x * (mesh.point(v) - CGAL::ORIGIN); };
    BOOST_REQUIRE(sculptor.drag(far, times(far, 0x1p60)).reached);
    {
      const auto stroke = sculptor.stroke();
      BOOST_REQUIRE(sculptor.drag(far, times(far, 0x1p-60)).reached);
      BOOST_REQUIRE(sculptor.drag(last, times(last, 1.5)).reached);
    }
    sculptor.set_drag_parameters(Drag_parameters().clearance(0x1p-10)); // serves the scene as it is
    if (asks) // in the undo, before the far one is back
      sculptor.visitor().ask = [&, is_first = true]() mutable {
        if (std::exchange(is_first, false))
          BOOST_TEST(static_cast<bool>(sculptor.probe({0, 0, 7})));
      };
    BOOST_TEST(static_cast<bool>(sculptor.undo()));
    sculptor.visitor().ask = nullptr;
    BOOST_CHECK_THROW(sculptor.drag(last, times(last, 1.1)), Invalid_parameter); // below an ulp of the scene
  }
}

// It may be far out: the face that is new is near then as far out as it goes.
BOOST_AUTO_TEST_CASE(a_probe_begun_within_a_creation_keeps_the_clearance_of_the_new_vertex) {
  for (const bool has_own_clearance : {false, true}) {
    Mesh mesh = meshes::to_mesh(meshes::cube());
    Asked_sculptor sculptor(mesh, has_own_clearance ? parameters::clearance(1e-9) : Sculptor_parameters());
    Mesh::Face_index top;
    for (const auto f : mesh.faces()) {
      bool is_on_top = true, is_at_front = false;
      for (const auto v : mesh.vertices_around_face(mesh.halfedge(f)))
        is_on_top &= mesh.point(v).z() == 1, is_at_front |= mesh.point(v) == Mesh::Point(1, 0, 1);
      if (is_on_top && is_at_front)
        top = f;
    }
    BOOST_REQUIRE(top.is_valid());
    int near = 0, asked = 0;
    const Mesh::Point beside(0.3, -0x1p-27, 1.5);
    sculptor.visitor().ask = [&] { ++asked, near += !sculptor.probe(beside); };
    const auto made = sculptor.insert_on_face(top, {0.3, 0.0, 0x1p30});
    sculptor.visitor().ask = nullptr;
    BOOST_REQUIRE(static_cast<bool>(made));
    BOOST_TEST(asked > 1);
    BOOST_TEST(near == asked - 1); // the first is asked before the vertex is there
    if (has_own_clearance)
      BOOST_CHECK_THROW(sculptor.probe(beside), Invalid_parameter); // the scene has outgrown it
    else
      BOOST_TEST(!sculptor.probe(beside));
  }
}

// The index is that of a vertex that was removed, so that an old answer would be there, and wrong.
BOOST_AUTO_TEST_CASE(a_vertex_created_is_asked_about_anew) {
  Mesh mesh = meshes::to_mesh(meshes::icosphere(1));
  meshes::Triangle_list turned = meshes::tetrahedron();
  CGAL::copy_face_graph(meshes::to_mesh(turned.turn_inside_out().scale_and_move(1, 20, 0, 0)), mesh);
  const Mesh::Face_index f(static_cast<Mesh::size_type>(mesh.num_faces() - 1)); // of the tetrahedron
  Asked_sculptor sculptor(mesh);
  BOOST_REQUIRE(static_cast<bool>(sculptor.remove(Vertex_index(5))));
  bool has_asked = false;
  sculptor.visitor().ask = [&] { has_asked = true, sculptor.is_inside_out(Vertex_index(0)); };
  const auto made = sculptor.insert_on_face(f, in_face(mesh, f, 0.3, 0.3));
  sculptor.visitor().ask = nullptr;
  BOOST_REQUIRE((made && *made.vertex == Vertex_index(5) && has_asked));
  BOOST_TEST(sculptor.is_inside_out(*made.vertex));
  BOOST_TEST(!sculptor.is_inside_out(Vertex_index(0)));
}

// By name, in each call that the visitor hears; and what it was called within comes to the same end.
BOOST_AUTO_TEST_CASE(edits_within_a_change_are_refused) {
  const auto edit_all = [](bool asks) {
    Mesh mesh = meshes::to_mesh(meshes::icosphere(1));
    Asked_sculptor sculptor(mesh);
    std::size_t times = 0;
    if (asks)
      sculptor.visitor().ask = [&] {
        const Vertex_index v(7);
        BOOST_CHECK_THROW(sculptor.undo(), Reentrant_call);
        BOOST_CHECK_THROW(sculptor.drag(v, {0, 0, 0}), Reentrant_call);
        BOOST_CHECK_THROW(sculptor.move_if_free(v, {0, 0, 0}), Reentrant_call);
        BOOST_CHECK_THROW(sculptor.flip(mesh.edge(mesh.halfedge(v))), Reentrant_call);
        BOOST_CHECK_THROW(sculptor.remove(v), Reentrant_call);
        BOOST_CHECK_THROW(sculptor.shift(0, {{v, 0.5}}), Reentrant_call);
        BOOST_CHECK_THROW(static_cast<void>(sculptor.stroke()), Reentrant_call);
        ++times;
      };
    const Vertex_index v(3);
    sculptor.drag(v, CGAL::midpoint(mesh.point(v), Point_3(0, 0, 0)));
    sculptor.insert_on_face(Mesh::Face_index(0), in_face(mesh, Mesh::Face_index(0), 0.3, 0.3));
    sculptor.remove(Vertex_index(9));
    sculptor.shift(1, {{v, mesh.point(v).y() + 0.01}});
    sculptor.undo();
    sculptor.undo();
    sculptor.redo();
    BOOST_TEST((times > 20) == asks);
    BOOST_TEST(validate(mesh).is_valid());
    return snapshot(sculptor);
  };
  BOOST_TEST((edit_all(true) == edit_all(false)));
}

// What is refused within a change leaves what the call under way gives back as it would be.
BOOST_AUTO_TEST_CASE(an_edit_that_a_visitor_tries_by_value_is_refused_and_leaves_what_is_given_back) {
  const Edit outer = Edit::of(Edit_kind::move, {3, 0, 0}, {0.1, 0.2, 2});
  for (const bool is_nowhere : {false, true}) {
    Mesh mesh = meshes::to_mesh(meshes::bumpy_sphere(1, 0.2)), other = mesh;
    const Mesh::Point p = is_nowhere ? mesh.point(Vertex_index(7)) : Mesh::Point(9, 9, 9);
    Asked_sculptor sculptor(mesh);
    int refused = 0;
    sculptor.visitor().ask = [&] {
      BOOST_CHECK_THROW(sculptor.apply(Edit::of(Edit_kind::move, {7, 0, 0}, {p.x(), p.y(), p.z()})), Reentrant_call);
      ++refused;
    };
    const auto made = sculptor.apply(outer);
    BOOST_TEST(refused == 1);
    const auto expected = Sculptor<Mesh>(other).apply(outer);
    BOOST_TEST((made.edit.kind == Edit_kind::move && expected.edit.kind == Edit_kind::move));
    BOOST_TEST(made.edit.vertices == expected.edit.vertices);
    BOOST_TEST(made.edit.point == expected.edit.point);
    BOOST_TEST((made.edit.legs == expected.edit.legs));
    BOOST_TEST(mesh.point(Vertex_index(3)) == other.point(Vertex_index(3)));
  }
}
