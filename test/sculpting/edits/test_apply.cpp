// SPDX-License-Identifier: GPL-3.0-or-later
// Edits by value: what apply() gives back makes the same again, to the bit, of another copy of the mesh that nobody
// slides in.
#include "sculpting/Mesh_snapshot.h"
#include "sculpting/edits/random_edits.h"

#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <array>
#include <map>
#include <vector>

using namespace haptic_sculpt;
using namespace haptic_sculpt::test;

namespace {

/// Of elements that are there, mostly; here and there of some that are not.
Edit random_value(const Sculptor<Mesh>& sculptor, Random& random) {
  std::uniform_real_distribution<double> number(-1, 1);
  const Mesh& mesh = sculptor.mesh();
  const auto h = pick(mesh.halfedges(), mesh.number_of_halfedges(), random);
  const auto name = [&](Vertex_index v) { return random() % 20 == 0 ? random() % 300 : sculptor.id(v); };
  const Vertex_index a = mesh.source(h), b = mesh.target(h), c = mesh.target(mesh.next(h));
  const Point_3 p = mesh.point(a), inside = in_face(mesh, mesh.face(h), 0.3, 0.4),
                middle = CGAL::midpoint(p, mesh.point(b));
  const auto array_of = [](const Point_3& q) { return std::array<double, 3>{q.x(), q.y(), q.z()}; };
  switch (random() % 12) {
  case 0: case 1: case 2: {
    const double x = number(random), y = number(random), z = number(random);
    return Edit::of(Edit_kind::move, {name(a), 0, 0},
                    array_of(p + (random() % 3 == 0 ? 3 : 0.2) * meshes::Kernel::Vector_3(x, y, z)));
  }
  case 3: return Edit::of(Edit_kind::insert_on_face, {name(b), name(a), name(c)}, array_of(inside));
  case 4: return Edit::of(Edit_kind::insert_on_edge, {name(b), name(a), 0}, array_of(middle));
  case 5: return Edit::of(Edit_kind::remove, {name(a), 0, 0});
  case 6: return Edit::of(Edit_kind::collapse, {name(a), name(b), 0});
  case 7: return Edit::of(Edit_kind::flip, {name(a), name(b), 0});
  case 8: {
    Edit shift = Edit::of(Edit_kind::shift);
    shift.axis = static_cast<int>(random() % 3);
    for (const Vertex_index v : {a, b, c})
      shift.ways.emplace_back(name(v), mesh.point(v)[shift.axis] + 0.1 * number(random));
    return shift;
  }
  case 9: return Edit::of(Edit_kind::undo);
  case 10: return Edit::of(Edit_kind::redo);
  default: return Edit::of(random() % 2 == 0 ? Edit_kind::stroke : Edit_kind::end);
  }
}

/// Drops the edit under way as soon as it has done something, as a journal does that grows.
struct Dropping_visitor : Default_edit_visitor {
  std::vector<Edit>* queue = nullptr;
  void drop() {
    if (queue != nullptr)
      queue->assign(20, Edit::of(Edit_kind::move, {40, 41, 39}, {9, 9, 9}));
  }
  template <class Element>
  void vertex_moved(Element) {
    drop();
  }
  template <class Element, class... More>
  void vertex_created(Element, More...) {
    drop();
  }
  template <class Element, class... More>
  void vertex_dies(Element, More...) {
    drop();
  }
  template <class Element, class... More>
  void face_dies(Element, More...) {
    drop();
  }
};

} // namespace

BOOST_AUTO_TEST_CASE(an_edit_that_is_dropped_while_it_is_made_is_made_all_the_same) {
  using Droppable = Sculptor<Mesh, Box_tree_broad_phase<Mesh>, Dropping_visitor>;
  const Mesh ball = meshes::to_mesh(meshes::bumpy_sphere(1, 0));
  Edit move = Edit::of(Edit_kind::move, {3, 0, 0}, {0, 0, 0}), shift = Edit::of(Edit_kind::shift);
  const Point_3 p = ball.point(Vertex_index(3));
  for (const double share : {1.05, 1.1})
    move.legs.push_back({share * p.x(), share * p.y(), share * p.z()});
  move.point = {1.2 * p.x(), 1.2 * p.y(), 1.2 * p.z()};
  shift.ways = {{5, ball.point(Vertex_index(5)).x() + 0.01}, {6, ball.point(Vertex_index(6)).x() + 0.01}};
  const auto h = ball.halfedge(Vertex_index(7));
  const std::size_t a = ball.source(h), b = ball.target(h), c = ball.target(ball.next(h));
  const Point_3 inside = in_face(ball, ball.face(h), 0.3, 0.4), middle = CGAL::midpoint(ball.point(ball.source(h)), p);
  for (const Edit& edit : {move, shift, Edit::of(Edit_kind::remove, {10, 0, 0}),
                           Edit::of(Edit_kind::collapse, {a, b, 0}), Edit::of(Edit_kind::flip, {a, b, 0}),
                           Edit::of(Edit_kind::insert_on_face, {a, b, c}, {inside.x(), inside.y(), inside.z()}),
                           Edit::of(Edit_kind::insert_on_edge, {a, b, 0}, {middle.x(), middle.y(), middle.z()})}) {
    BOOST_TEST_INFO_SCOPE("kind " << static_cast<int>(edit.kind));
    Mesh mesh = ball, other = ball;
    std::vector<Edit> queue = {edit};
    Dropping_visitor visitor;
    visitor.queue = &queue;
    Droppable dropped(mesh, {}, visitor), kept(other, {}, Dropping_visitor());
    const auto result = dropped.apply(queue[0]);
    const auto expected = kept.apply(edit);
    BOOST_TEST(static_cast<bool>(result) == static_cast<bool>(expected));
    BOOST_TEST((queue.size() == 20u || !expected));
    BOOST_TEST((snapshot(dropped) == snapshot(kept)));
    BOOST_TEST((result.edit.kind == expected.edit.kind && result.edit.vertices == expected.edit.vertices &&
                result.edit.point == expected.edit.point && result.edit.legs == expected.edit.legs &&
                result.edit.ways == expected.edit.ways));
  }
}

BOOST_AUTO_TEST_CASE(what_was_applied_can_be_done_again) {
  const std::size_t edits = count_from_environment("HAPTIC_SCULPT_APPLIED_EDITS", 4000);
  Random random(seed_from_environment(61));
  std::map<Edit_kind, std::size_t> done, refused;
  std::size_t legs = 0, ended_strokes = 0, different = 0, not_again = 0, changed_by_refusal = 0, other_steps = 0;
  std::size_t misplaced = 0;
  for (std::size_t i = 0; i < edits;) {
    Mesh mesh = meshes::to_mesh(meshes::bumpy_sphere(1, 0.3, 0.05)), copy = mesh;
    Sculptor<Mesh> sculptor(mesh), other(copy, parameters::response(Response::stop));
    for (std::size_t k = 0; k < 100; ++k, ++i) {
      const Edit wanted = random_value(sculptor, random);
      const Mesh_snapshot before = snapshot(sculptor);
      const auto result = sculptor.apply(wanted);
      ++(result ? done : refused)[wanted.kind];
      const bool has_place = result && wanted.kind != Edit_kind::stroke && wanted.kind != Edit_kind::end;
      misplaced += result.vertex.has_value() != has_place ||
                   (has_place && (!mesh.has_valid_index(*result.vertex) || mesh.is_removed(*result.vertex)));
      const Edit again = result; // by value
      legs += again.legs.size();
      // Undo and redo end the stroke under way, refused or not.
      const bool has_ended_stroke = !result && again.kind != Edit_kind::none;
      ended_strokes += has_ended_stroke;
      if (!result)
        changed_by_refusal += snapshot(sculptor) != before ||
                              (has_ended_stroke && wanted.kind != Edit_kind::undo && wanted.kind != Edit_kind::redo);
      const auto second = other.apply(again);
      not_again += bool(second) == has_ended_stroke || (second.drag && !second.drag->reached);
      different += snapshot(sculptor) != snapshot(other);
      other_steps += sculptor.history().number_of_undo_steps() != other.history().number_of_undo_steps() ||
                     sculptor.history().number_of_redo_steps() != other.history().number_of_redo_steps();
    }
    BOOST_TEST(validate(mesh).is_valid());
    while (sculptor.apply(Edit::of(Edit_kind::end)))
      ;
    BOOST_TEST((sculptor.apply(Edit::of(Edit_kind::end)).refusal->reason == Refusal_reason::no_stroke));
  }
  for (int kind = 1; kind <= static_cast<int>(Edit_kind::end); ++kind) {
    const auto of = static_cast<Edit_kind>(kind);
    BOOST_TEST_MESSAGE("kind " << kind << ": " << done[of] << " done, " << refused[of] << " refused");
    BOOST_TEST(is_enough(done[of], edits / 200));
  }
  BOOST_TEST_MESSAGE(legs << " legs before the last ones");
  BOOST_TEST(is_enough(legs, edits / 50));
  BOOST_TEST(is_enough(ended_strokes, edits / 500));
  BOOST_TEST(changed_by_refusal == 0u);
  BOOST_TEST(misplaced == 0u); // where an edit was done is a vertex of the mesh
  BOOST_TEST(not_again == 0u);
  BOOST_TEST(different == 0u);
  BOOST_TEST(other_steps == 0u);
}

// Its first leg leaves what the clearance serves, and its last comes back.
BOOST_AUTO_TEST_CASE(an_edit_with_legs_is_made_again_where_the_scene_outgrows_the_clearance_on_the_way) {
  Mesh mesh = meshes::to_mesh(meshes::tetrahedron());
  Sculptor<Mesh> sculptor(mesh, parameters::clearance(0x1p-52));
  Edit move = Edit::of(Edit_kind::move, {3, 0, 0}, {0, 0, 1.5});
  move.legs = {{0.125, 0, 3}};
  const Point_3 start = mesh.point(Vertex_index(3));
  for (int again = 0; again < 2; ++again) {
    const auto done = sculptor.apply(move);
    BOOST_TEST((done.edit.legs == move.legs && done.edit.point == move.point));
    BOOST_REQUIRE(done.drag.has_value());
    BOOST_TEST((done.drag->reached && done.drag->legs == 1 && done.drag->position == Point_3(0, 0, 1.5)));
    BOOST_TEST(static_cast<bool>(sculptor.undo()));
    BOOST_TEST((mesh.point(Vertex_index(3)) == start));
  }
  move.legs[0] = {0, 0, 3}, move.point = {0, 0, -1}; // through the face of the others
  BOOST_CHECK_THROW(sculptor.apply(move), Invalid_parameter);
}

// A removal is the collapse that it was, a vertex that nothing moves gives nothing, and moves that follow each other
// are one grab.
BOOST_AUTO_TEST_CASE(what_apply_says) {
  Mesh mesh = meshes::to_mesh(meshes::icosphere(1)), copy = mesh;
  Sculptor<Mesh> sculptor(mesh), by_functions(copy);
  const auto into = by_functions.remove(Vertex_index(5));
  const auto removed = sculptor.apply(Edit::of(Edit_kind::remove, {5, 0, 0}));
  BOOST_REQUIRE((into && removed));
  BOOST_TEST((removed.edit.kind == Edit_kind::collapse));
  BOOST_TEST((removed.edit.vertices == std::array<std::size_t, 3>{5, by_functions.id(*into.vertex), 0}));
  BOOST_TEST((snapshot(sculptor) == snapshot(by_functions)));
  const Point_3 p = mesh.point(Vertex_index(7));
  const auto still = sculptor.apply(Edit::of(Edit_kind::move, {7, 0, 0}, {p.x(), p.y(), p.z()}));
  BOOST_TEST((still && still.drag->reached && still.edit.kind == Edit_kind::none));
  BOOST_TEST(!sculptor.apply(Edit::of(Edit_kind::move, {5, 0, 0}, {0, 0, 9})));
  auto grab = by_functions.grab(Vertex_index(7));
  for (const double x : {-1., -1.1, -1.2, -1.3}) { // pressed on through the ball: contacts are carried on
    const auto by_value = sculptor.apply(Edit::of(Edit_kind::move, {7, 0, 0}, {x * p.x(), x * p.y(), x * p.z() + 0.1}));
    const auto by_grab = grab.drag_to(Point_3(x * p.x(), x * p.y(), x * p.z() + 0.1));
    BOOST_TEST((by_value.drag->position == by_grab.position && by_value.drag->work == by_grab.work));
  }
  BOOST_CHECK_THROW(sculptor.apply(Edit::of(Edit_kind::move, {7, 0, 0}, {0, std::nan(""), 0})), Non_finite_point);
  Edit far = Edit::of(Edit_kind::move, {7, 0, 0}, {0, 0, 1e305}); // its leg is not gone either
  far.legs.push_back({0.5 * p.x(), 0.5 * p.y(), 0.5 * p.z()});
  const auto before = snapshot(sculptor);
  BOOST_CHECK_THROW(sculptor.apply(far), Out_of_range);
  BOOST_TEST((snapshot(sculptor) == before));
  Edit shift = Edit::of(Edit_kind::shift);
  shift.axis = 3;
  BOOST_CHECK_THROW(sculptor.apply(shift), Invalid_parameter);
  shift.axis = 2;
  BOOST_TEST((sculptor.apply(shift).edit.kind == Edit_kind::none));
  shift.ways = {{7, sculptor.mesh().point(Vertex_index(7)).z()}};
  for (int twice = 0; twice < 2; ++twice) {
    const auto done = sculptor.apply(shift);
    BOOST_TEST((done && done.edit.kind == Edit_kind::none));
    shift.ways.insert(shift.ways.begin(), {7, 2.0}); // of one vertex the last counts
  }
  BOOST_TEST((snapshot(sculptor) == before));
  Edit again = Edit::of(Edit_kind::flip, {7, sculptor.id(mesh.source(mesh.halfedge(Vertex_index(7)))), 0});
  again.legs.push_back({9, 9, 9}); // of a move that it was used for before
  const auto flipped = sculptor.apply(again);
  BOOST_TEST((flipped && flipped.edit.kind == Edit_kind::flip && flipped.edit.legs.empty()));
}

// A refused edit between two moves of a vertex ends its grab, as every other edit does: whoever makes the lines of a
// log again comes to the same bits.
BOOST_AUTO_TEST_CASE(a_vertex_that_is_not_there_ends_the_grab) {
  Random random(seed_from_environment(62));
  std::uniform_real_distribution<double> number(-1.5, 1.5);
  std::size_t other_than_released = 0, other_than_carried = 0;
  for (int i = 0; i < 300; ++i) {
    const Mesh scene = meshes::to_mesh(meshes::bumpy_sphere(1, 0.3, 0.05));
    Mesh unknown_between = scene, released_between = scene, nothing_between = scene;
    Sculptor<Mesh> a(unknown_between), b(released_between), c(nothing_between);
    const std::size_t v = random() % scene.number_of_vertices();
    for (int drag = 0; drag < 4; ++drag) {
      const double x = number(random), y = number(random), z = number(random);
      const Edit move = Edit::of(Edit_kind::move, {v, 0, 0}, {x, y, z});
      const auto first = a.apply(move), second = b.apply(move), third = c.apply(move);
      const auto is_same = [&](const auto& other) {
        return first.drag->position == other.drag->position && first.drag->work == other.drag->work;
      };
      other_than_released += !is_same(second), other_than_carried += !is_same(third);
      BOOST_TEST(!a.apply(Edit::of(Edit_kind::move, {99999, 0, 0}, {0, 0, 0})));
      b.release();
    }
  }
  BOOST_TEST_MESSAGE(other_than_carried << " of 1,200 drags differ where contacts are carried on");
  BOOST_TEST(other_than_released == 0u);
  BOOST_TEST(other_than_carried > 10u);
}

namespace {

using Corners = std::array<std::size_t, 3>;

/// By numbers, each from its least corner on.
std::vector<Corners> faces_by_number(const Sculptor<Mesh>& sculptor) {
  std::vector<Corners> faces;
  const Mesh& mesh = sculptor.mesh();
  for (const auto f : mesh.faces()) {
    Corners corners;
    std::size_t k = 0;
    for (const auto v : mesh.vertices_around_face(mesh.halfedge(f)))
      corners[k++] = sculptor.id(v);
    std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
    faces.push_back(corners);
  }
  std::sort(faces.begin(), faces.end());
  return faces;
}

} // namespace

// Undo gives connectivity and places back, not where circulators begin: what is removed then goes into the same
// neighbour all the same, of several that are as good, too, as those of an octahedron are.
BOOST_AUTO_TEST_CASE(after_undo_a_removal_is_what_it_would_have_been) {
  for (const Mesh& scene : {meshes::to_mesh(meshes::bipyramid(4)), meshes::to_mesh(meshes::icosphere(1)),
                            meshes::to_mesh(meshes::bumpy_sphere(1, 0.3, 0.05))})
    for (std::size_t v = 0; v < scene.number_of_vertices(); ++v) {
      Mesh never_edited = scene;
      Sculptor<Mesh> fresh(never_edited);
      const auto expected = fresh.remove(fresh.vertex(v));
      for (const auto h : scene.halfedges_around_target(scene.halfedge(Vertex_index(static_cast<unsigned>(v)))))
        for (const Edit_kind kind : {Edit_kind::collapse, Edit_kind::flip, Edit_kind::insert_on_face}) {
          Mesh mesh = scene;
          Sculptor<Mesh> sculptor(mesh);
          const auto done = kind == Edit_kind::collapse ? sculptor.collapse(mesh.opposite(h))
                            : kind == Edit_kind::flip
                                ? sculptor.flip(mesh.edge(h))
                                : sculptor.insert_on_face(mesh.face(h), in_face(mesh, mesh.face(h), 0.3, 0.3));
          if (done)
            BOOST_REQUIRE(sculptor.undo());
          BOOST_TEST(bool(sculptor.remove(sculptor.vertex(v))) == bool(expected));
          BOOST_TEST((faces_by_number(sculptor) == faces_by_number(fresh)));
        }
    }
}
