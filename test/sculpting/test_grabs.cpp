// SPDX-License-Identifier: GPL-3.0-or-later
// The life of a Grab.
#include "sculpting/Random_scene.h"

#include <haptic_sculpt/sculpting/paper_1997.h>

#include <CGAL/boost/graph/copy_face_graph.h>

#include <boost/test/unit_test.hpp>

#include <array>
#include <cmath>
#include <functional>
#include <memory>
#include <stdexcept>
#include <string>

using namespace haptic_sculpt;
using namespace haptic_sculpt::test;

namespace {

using Grab_type = Grab<Sculptor<Mesh>>;

std::function<void()> heard; ///< once a vertex has moved
struct Heard_visitor : Default_edit_visitor {
  void vertex_moved(Vertex_index) {
    if (heard)
      heard();
  }
};
using Heard_sculptor = Sculptor<Mesh, Box_tree_broad_phase<Mesh>, Heard_visitor>;

Point_3 beside(const Mesh& mesh, Vertex_index v) { return mesh.point(v) + meshes::Kernel::Vector_3(0.01, 0.02, 0.005); }

} // namespace

static_assert(!std::is_copy_constructible<Grab_type>::value && !std::is_copy_assignable<Grab_type>::value, "");
static_assert(std::is_nothrow_move_constructible<Grab_type>::value && std::is_nothrow_move_assignable<Grab_type>::value,
              "");

BOOST_AUTO_TEST_CASE(a_grab_is_stale_once_another_has_the_hand) {
  Mesh mesh = ball();
  Sculptor<Mesh> sculptor(mesh);
  auto first = sculptor.grab(Vertex_index(1));
  auto second = sculptor.grab(Vertex_index(2));
  BOOST_TEST(!first.vertex().is_valid());
  const Point_3 before = mesh.point(Vertex_index(1));
  const auto result = first.drag_to(beside(mesh, Vertex_index(1)));
  BOOST_TEST((result.end == Drag_end::stale));
  BOOST_TEST(!result.reached);
  BOOST_TEST((mesh.point(Vertex_index(1)) == before));
  BOOST_TEST(second.drag_to(beside(mesh, Vertex_index(2))).reached);
  first.release(); // nothing of the second's
  {
    const Grab_type dying = std::move(first);
  }
  BOOST_TEST((second.vertex() == Vertex_index(2)));
  BOOST_TEST(second.drag_to(beside(mesh, Vertex_index(2))).reached);
}

// A visitor does it while the drag is under way.
BOOST_AUTO_TEST_CASE(a_grab_may_end_or_move_elsewhere_within_its_own_drag) {
  const auto at_end = [](bool throws, const auto& meanwhile) {
    Mesh mesh = ball();
    std::unique_ptr<Grab<Heard_sculptor>> grab, other;
    heard = [&] {
      meanwhile(grab, other);
      if (throws)
        throw std::runtime_error("on purpose");
    };
    Heard_sculptor sculptor(mesh);
    grab = std::make_unique<Grab<Heard_sculptor>>(sculptor.grab(Vertex_index(1)));
    const Point_3 target = beside(mesh, Vertex_index(1));
    if (throws)
      BOOST_CHECK_THROW(grab->drag_to(target), std::runtime_error);
    else
      BOOST_TEST(grab->drag_to(target).reached);
    heard = nullptr;
    BOOST_TEST((mesh.point(Vertex_index(1)) == target));
    if (Grab<Heard_sculptor>* const left = other ? other.get() : grab.get()) {
      BOOST_TEST((left->vertex() == Vertex_index(1)));
      const auto taken = sculptor.grab(Vertex_index(2));
      BOOST_TEST((left->drag_to(Point_3(0, 0, 0)).position == target)); // stale, and where it was left
    }
    sculptor.check_unchanged();
    return other || grab;
  };
  for (const bool throws : {false, true}) {
    BOOST_TEST(!at_end(throws, [](auto& grab, auto&) { grab.reset(); }));
    BOOST_TEST(at_end(throws, [](auto& grab, auto& other) {
      other = std::make_unique<Grab<Heard_sculptor>>(std::move(*grab));
      grab.reset();
    }));
  }
}

BOOST_AUTO_TEST_CASE(a_grab_moves_and_lets_go_of_its_own_vertex_only) {
  Mesh mesh = ball();
  Sculptor<Mesh> sculptor(mesh);
  auto grab = sculptor.grab(Vertex_index(3));
  BOOST_TEST(grab.drag_to(beside(mesh, Vertex_index(3))).reached);
  Grab_type moved = std::move(grab);
  BOOST_TEST(!grab.vertex().is_valid());
  BOOST_TEST((grab.drag_to(Point_3(0, 0, 0)).end == Drag_end::stale));
  BOOST_TEST(moved.drag_to(beside(mesh, Vertex_index(3))).reached);
  moved = sculptor.grab(Vertex_index(4)); // the old one lets go after the new one has taken the hand
  BOOST_TEST((moved.vertex() == Vertex_index(4)));
  BOOST_TEST(moved.drag_to(beside(mesh, Vertex_index(4))).reached);
  moved.release();
  BOOST_TEST(moved.drag_to(beside(mesh, Vertex_index(4))).reached); // takes it again
  BOOST_TEST(validate(mesh).is_valid());
}

BOOST_AUTO_TEST_CASE(a_grab_is_harmless_after_its_sculptor) {
  Mesh mesh = ball();
  auto sculptor = std::make_unique<Sculptor<Mesh>>(mesh);
  auto grab = sculptor->grab(Vertex_index(5));
  sculptor.reset();
  BOOST_TEST((grab.drag_to(Point_3(1, 1, 1)).end == Drag_end::stale));
  BOOST_TEST(!grab.vertex().is_valid());
  grab.release();
}

BOOST_AUTO_TEST_CASE(undo_that_revives_a_vertex_makes_its_grab_usable) {
  Mesh mesh = ball();
  Sculptor<Mesh> sculptor(mesh);
  auto grab = sculptor.grab(Vertex_index(6));
  BOOST_REQUIRE(sculptor.remove(Vertex_index(6)));
  BOOST_TEST((grab.drag_to(Point_3(1, 1, 1)).end == Drag_end::stale));
  BOOST_REQUIRE(sculptor.undo());
  BOOST_REQUIRE(grab.vertex().is_valid());
  BOOST_TEST(grab.drag_to(beside(mesh, grab.vertex())).reached);
  BOOST_TEST(validate(mesh).is_valid());
}

BOOST_AUTO_TEST_CASE(a_broad_phase_knows_where_a_grab_has_left_its_vertex) {
  Mesh mesh = ball();
  Sculptor<Mesh> sculptor(mesh, parameters::response(Response::stop)); // a slide would lead round the spike
  const auto out = mesh.point(Vertex_index(7)) - CGAL::ORIGIN;
  {
    auto grab = sculptor.grab(Vertex_index(7));
    BOOST_REQUIRE(grab.drag_to(CGAL::ORIGIN + 3 * out).reached);
  }
  const auto across = CGAL::cross_product(out, meshes::Kernel::Vector_3(1, 2, 3));
  const Point_3 in_the_spike = CGAL::ORIGIN + 2 * out;
  BOOST_TEST(!sculptor.probe(in_the_spike + across).drag_to(in_the_spike - across).reached);
}

// Contacts are carried from drag to drag: to let go of them ends the next drag elsewhere.
BOOST_AUTO_TEST_CASE(a_delta_that_is_refused_lets_go_of_nothing) {
  std::size_t blocked = 0;
  for (std::uint32_t seed = 0; seed < 40; ++seed) {
    std::array<Point_3, 2> ends;
    for (const bool asks : {false, true}) {
      Mesh mesh = meshes::to_mesh(meshes::icosphere(2));
      meshes::Triangle_list beside = meshes::icosphere(2);
      CGAL::copy_face_graph(meshes::to_mesh(beside.scale_and_move(1, 2.05, 0, 0)), mesh);
      Sculptor<Mesh> sculptor(mesh);
      const Vertex_index v(5 * seed);
      const Point_3 from = mesh.point(v);
      const meshes::Kernel::Vector_3 way(std::sin(seed), std::cos(2.0 * seed), std::sin(3.0 * seed));
      auto grab = sculptor.grab(v);
      for (int i = 1; i <= 8; ++i) {
        if (asks)
          BOOST_CHECK_THROW(sculptor.set_delta(-1), Invalid_parameter);
        const auto result = grab.drag_to(from + i / 8.0 * way);
        blocked += !result.reached;
      }
      ends[asks] = mesh.point(v);
    }
    BOOST_TEST((ends[0] == ends[1]));
  }
  BOOST_TEST(blocked > 100u);
}

// Whether it has moved or not: `no_progress` is where no contact explains it.
BOOST_AUTO_TEST_CASE(a_vertex_that_contacts_hold_is_held_however_often_it_is_drawn) {
  for (const Response response : {Response::slide, Response::stop, Response::paper()}) {
    Mesh mesh = meshes::to_mesh(meshes::row_of_spheres(2));
    Sculptor<Mesh> sculptor(mesh, parameters::response(response));
    Vertex_index v(0);
    for (const Vertex_index w : mesh.vertices()) // of the first, that nearest to the second
      if (static_cast<std::size_t>(w) < mesh.number_of_vertices() / 2 && mesh.point(w).x() > mesh.point(v).x())
        v = w;
    auto grab = sculptor.grab(v);
    const Point_3 target = mesh.point(v) + meshes::Kernel::Vector_3(1, 0, 0);
    for (int k = 0; k < 4; ++k) {
      const auto result = grab.drag_to(target);
      BOOST_TEST(!result.contacts.empty());
      BOOST_TEST(std::string(name_of(result.end)) == "held");
    }
  }
}

// Nor by a hand that holds nothing.
BOOST_AUTO_TEST_CASE(no_vertex_is_not_dragged) {
  Mesh mesh = meshes::to_mesh(meshes::bumpy_sphere(2, 0.1));
  Sculptor<Mesh> sculptor(mesh);
  const Point_3 p(0, 0, 2);
  for (const bool is_once : {false, true}) {
    BOOST_CHECK_THROW(sculptor.drag(Vertex_index(), p, Drag_parameters().once(is_once)), Unknown_vertex);
    sculptor.drag(Vertex_index(3), p, Drag_parameters().once(is_once));
    sculptor.release();
    BOOST_CHECK_THROW(sculptor.drag(Vertex_index(), p, Drag_parameters().once(is_once)), Unknown_vertex);
    BOOST_CHECK_THROW(sculptor.move_if_free(Vertex_index(), p, Drag_parameters().once(is_once)), Unknown_vertex);
    BOOST_CHECK_THROW(sculptor.first_impact(Vertex_index(), p), Unknown_vertex);
  }
}
