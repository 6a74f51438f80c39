// SPDX-License-Identifier: GPL-3.0-or-later
// Objects that move as one: where they end, by formulas of the tests' own; embedded on the way, by integers at many
// times.
#include "sculpting/axis_moves/embedded_at.h"
#include "sculpting/many_vertices/many_vertices_scene.h"
#include "sculpting/motion/embedding_oracle_input.h"
#include "sculpting/scene_parts.h"

#include <set>

using namespace haptic_sculpt;
using namespace haptic_sculpt::test;

namespace {

/// About an axis through a point, by Rodrigues' formula in long doubles.
struct Turn {
  std::array<long double, 3> axis, centre;
  long double angle;

  std::array<long double, 3> operator()(const Point_3& p, long double share = 1) const {
    std::array<long double, 3> d, result;
    for (int i = 0; i < 3; ++i)
      d[i] = p[i] - centre[i];
    const long double c = std::cos(share * angle), s = std::sin(share * angle);
    const long double along = axis[0] * d[0] + axis[1] * d[1] + axis[2] * d[2];
    for (int i = 0; i < 3; ++i) {
      const int j = (i + 1) % 3, k = (i + 2) % 3;
      result[i] = centre[i] + c * d[i] + s * (axis[j] * d[k] - axis[k] * d[j]) + (1 - c) * along * axis[i];
    }
    return result;
  }
  Transformation transformation() const {
    double m[3][4];
    const auto zero = (*this)(Point_3(0, 0, 0));
    for (int j = 0; j < 3; ++j) {
      const auto image = (*this)(Point_3(j == 0, j == 1, j == 2));
      for (int i = 0; i < 3; ++i)
        m[i][j] = static_cast<double>(image[i] - zero[i]), m[i][3] = static_cast<double>(zero[i]);
    }
    return {m[0][0], m[0][1], m[0][2], m[0][3], m[1][0], m[1][1], m[1][2], m[1][3], m[2][0], m[2][1], m[2][2], m[2][3]};
  }
  static Turn random(Random& random, long double angle) {
    const Vector_3 u = uniform_direction(random), c = uniform_vector(random, 2);
    return {{u.x(), u.y(), u.z()}, {c.x(), c.y(), c.z()}, angle};
  }
};

/// Notes how the mesh stands whenever many vertices have moved.
struct State_visitor : Default_edit_visitor {
  const Mesh* mesh = nullptr;
  std::vector<std::vector<std::array<double, 3>>> states;
  void vertex_moved(Vertex_index) {
    std::vector<std::array<double, 3>> state;
    for (const Vertex_index v : mesh->vertices())
      state.push_back(vertex_coordinates(*mesh, v));
    if (states.empty() || states.back() != state)
      states.push_back(std::move(state));
  }
};
using Watched_sculptor = Sculptor<Mesh, Box_tree_broad_phase<Mesh>, State_visitor>;

/// Throws when it has heard this often that a vertex moved, and once more after as many calls.
struct Throwing_visitor : Default_edit_visitor {
  std::size_t calls_left = ~std::size_t{0}, again = 0;
  void vertex_moved(Vertex_index) {
    if (--calls_left != 0)
      return;
    calls_left = std::exchange(again, 0);
    throw std::runtime_error("enough");
  }
};
using Throwing_sculptor = Sculptor<Mesh, Box_tree_broad_phase<Mesh>, Throwing_visitor>;

/// Two states that differ along one axis only, if they do. \return -1 where they differ along more
int only_axis(const std::vector<std::array<double, 3>>& a, const std::vector<std::array<double, 3>>& b) {
  int axis = -1;
  for (std::size_t i = 0; i < a.size(); ++i)
    for (int k = 0; k < 3; ++k)
      if (a[i][k] != b[i][k]) {
        if (axis != -1 && axis != k)
          return -1;
        axis = k;
      }
  return axis;
}

} // namespace

BOOST_AUTO_TEST_CASE(free_objects_arrive_to_the_bit) {
  Random random(seed_from_environment(31));
  for (const auto& [name, scene] : scenes(false))
    for (const double angle : {0.0, 1e-9, 0.3, 1.5, 3.1, 3.14159}) {
      Mesh mesh = scene;
      Sculptor<Mesh> sculptor(mesh);
      const Mesh_snapshot before = snapshot(sculptor);
      const Transformation t =
          angle == 0 ? translation(uniform_vector(random, 3)) : Turn::random(random, angle).transformation();
      const auto report = move_rigidly(sculptor, mesh.vertices(), t);
      BOOST_TEST(report.share == 1, name << " by " << angle);
      BOOST_TEST(report.contacts.empty());
      BOOST_TEST(report.asked == mesh.number_of_vertices());
      for (const Vertex_index v : scene.vertices())
        BOOST_TEST((mesh.point(v) == t.transform(scene.point(v))));
      BOOST_TEST(validate(mesh).is_valid());
      BOOST_TEST(sculptor.history().number_of_undo_steps() == 1u);
      check_undo_and_redo(sculptor, before);
    }
}

BOOST_AUTO_TEST_CASE(an_obstacle_is_named_and_the_share_is_where_it_stands) {
  for (int axis = 0; axis < 3; ++axis)
    for (const double gap : {0.5, 0.25, 0.3, 1e-3}) {
      meshes::Triangle_list list;
      const auto turned = [axis](double a, double b, double c) {
        std::array<double, 3> p;
        p[axis] = a, p[(axis + 1) % 3] = b, p[(axis + 2) % 3] = c;
        return Vector_3(p[0], p[1], p[2]);
      };
      const auto box = add_box(list, turned(0, 0, 0), turned(1, 1, 1));
      const auto wall = add_box(list, turned(1 + gap, -2, -2), turned(0.5, 5, 5));
      Mesh mesh = meshes::to_mesh(list);
      const Mesh start = mesh;
      Sculptor<Mesh> sculptor(mesh);
      const Mesh_snapshot before = snapshot(sculptor);
      const auto report = move_rigidly(sculptor, box, translation(turned(2, 0, 0)));
      BOOST_TEST(!report);
      for (const double least : {0x1p-1074, 0x1p-1073, 0x1p-1022}) { // a rotation by that angle, rad, is none to see
        Mesh same = start;
        Sculptor<Mesh> alone(same);
        const Vector_3 way = turned(2, 0, 0);
        const Transformation turn(1, -least, 0, way.x(), least, 1, 0, way.y(), 0, 0, 1, way.z());
        BOOST_TEST(move_rigidly(alone, box, turn).share == report.share);
      }
      // The last step that does not touch: at gap / 2 of the way it would.
      BOOST_TEST(report.share == (std::ceil(((1 + gap) - 1) / 2 * 1024) - 1) / 1024);
      BOOST_REQUIRE(!report.contacts.empty());
      for (const auto& contact : report.contacts) {
        std::size_t of_box = 0, of_wall = 0;
        for (const Vertex_index v : contact.vertices) {
          of_box += std::count(box.begin(), box.end(), v);
          of_wall += std::count(wall.begin(), wall.end(), v);
        }
        BOOST_TEST((of_box > 0 && of_wall > 0 && of_box + of_wall == 4));
        BOOST_TEST((contact.kind == Blocking_kind::vertex_face || contact.kind == Blocking_kind::edge_edge));
      }
      for (const Vertex_index v : box)
        BOOST_TEST((mesh.point(v) == start.point(v) + report.share * turned(2, 0, 0)));
      for (const Vertex_index v : wall)
        BOOST_TEST((mesh.point(v) == start.point(v)));
      BOOST_TEST(validate(mesh).is_valid());
      check_undo_and_redo(sculptor, before);
    }
}

// Two bodies, one of which is moved at random: where it is after each step, and all pairs at many times between.
BOOST_AUTO_TEST_CASE(bodies_among_others_are_where_the_share_says_and_embedded_between) {
  Random random(seed_from_environment(32));
  std::size_t blocked = 0, whole = 0, wrong = 0, looks = 0, not_named = 0;
  const std::size_t runs = count_from_environment("HAPTIC_SCULPT_RIGID_MOVES", 60);
  for (std::size_t run = 0; run < runs; ++run) {
    meshes::Triangle_list list = meshes::icosphere(0);
    const std::size_t own = list.points.size();
    const Vector_3 offset = 2.4 * uniform_direction(random);
    list += meshes::bipyramid(5).transform([&](const Point_3& p) { return p + offset; });
    Mesh mesh = meshes::to_mesh(list);
    if (!validate(mesh).is_valid())
      continue;
    std::vector<Vertex_index> body;
    for (std::size_t v = 0; v < own; ++v)
      body.emplace_back(static_cast<Mesh::size_type>(v));
    const Mesh start = mesh;
    State_visitor visitor;
    visitor.mesh = &mesh;
    Watched_sculptor sculptor(mesh, Sculptor_parameters(), visitor);
    const bool is_turn = run % 2 == 0;
    const Turn turn = Turn::random(random, uniform(random, 0.1, 3));
    const Vector_3 way = uniform_vector(random, 4);
    const auto report = move_rigidly(sculptor, body, is_turn ? turn.transformation() : translation(way));
    (report ? whole : blocked) += 1;
    not_named += report.contacts.empty() != bool(report);
    for (const Vertex_index v : mesh.vertices()) {
      const Point_3 p = start.point(v);
      std::array<long double, 3> expected = {p.x(), p.y(), p.z()};
      if (static_cast<std::size_t>(v) < own) {
        if (is_turn)
          expected = turn(p, report.share);
        else
          for (int i = 0; i < 3; ++i)
            expected[i] += static_cast<long double>(report.share) * way[i];
      }
      for (int i = 0; i < 3; ++i)
        wrong += !(std::abs(expected[i] - mesh.point(v)[i]) <= 1e-13L);
    }
    wrong += !validate(mesh).is_valid();
    // Steps that were taken back are states, too.
    Axis_scene scene{to_oracle(list), 0, {}};
    auto state = scene.mesh.points;
    for (const auto& next : sculptor.visitor().states) {
      scene.axis = only_axis(state, next);
      BOOST_REQUIRE(scene.axis >= 0);
      scene.mesh.points = state;
      scene.ends.clear();
      for (const auto& p : next)
        scene.ends.push_back(p[scene.axis]);
      for (const mpq_class& t : {mpq_class(1), mpq_class(static_cast<unsigned long>(random() % 1000), 1000u)}) {
        ++looks;
        wrong += !is_embedded_at(scene, t);
      }
      state = next;
    }
  }
  BOOST_TEST_MESSAGE(whole << " whole, " << blocked << " blocked, looked at " << looks << " times between");
  BOOST_TEST(wrong == 0u);
  BOOST_TEST(not_named == 0u);
  BOOST_TEST((runs < 60 || (blocked >= 3 && whole >= 3)));
}

// It is where it was, or has arrived: it has not moved along some of the axes alone.
BOOST_AUTO_TEST_CASE(an_exception_of_the_progress_function_leaves_no_object_sheared) {
  for (int call = 1; call <= 4; ++call) {
    Mesh mesh = meshes::to_mesh(meshes::tetrahedron());
    const Mesh at_first = mesh;
    Sculptor<Mesh> sculptor(mesh);
    const std::vector<Vertex_index> all(mesh.vertices().begin(), mesh.vertices().end());
    int left = call;
    bool has_thrown = false;
    try {
      move_rigidly(sculptor, all, Transformation(CGAL::TRANSLATION, meshes::Kernel::Vector_3(3, 5, 7)),
                   Move_parameters().progress([&](const Move_progress&) {
                     if (--left == 0)
                       throw std::runtime_error("enough");
                     return true;
                   }));
    } catch (const std::runtime_error&) {
      has_thrown = true;
    }
    BOOST_TEST(has_thrown == (call <= 3));
    for (const Vertex_index v : all)
      BOOST_TEST(
          (mesh.point(v) == at_first.point(v) + meshes::Kernel::Vector_3(3, 5, 7) * static_cast<double>(!has_thrown)));
    BOOST_TEST(validate(mesh).is_valid());
    sculptor.check_unchanged();
  }
}

// All of a step is made or none, whichever call the visitor throws in, and though it throws again while what was made
// goes back. A floor stops the second of two steps along z: some calls come while that is taken back.
BOOST_AUTO_TEST_CASE(an_exception_of_the_visitor_leaves_no_object_sheared) {
  for (const bool is_blocked : {false, true})
    for (const std::size_t again : {0, 1, 3}) {
      std::size_t whole = 0, as_it_was = 0;
      bool has_thrown = true;
      for (std::size_t call = 1; has_thrown; call += is_blocked ? 7 : 1) { // of hundreds each kind comes up
        meshes::Triangle_list list;
        const auto box = add_box(list, {0, 0, 0}, {1, 1, 1});
        if (is_blocked)
          add_box(list, {-9, -9, -9 - 0x1p-12}, {18, 18, 9});
        Mesh mesh = meshes::to_mesh(list);
        const Mesh at_first = mesh;
        Throwing_sculptor sculptor(mesh);
        const Mesh_snapshot before = snapshot(sculptor);
        sculptor.visitor().calls_left = call, sculptor.visitor().again = again;
        has_thrown = false;
        const Vector_3 way(3, 5, -4);
        try {
          const auto report = move_rigidly(sculptor, box, translation(is_blocked ? way : -way));
          BOOST_TEST(report.share == !is_blocked);
        } catch (const std::runtime_error&) {
          has_thrown = true;
        }
        sculptor.visitor().calls_left = ~std::size_t{0};
        const bool is_there = mesh.point(box[0]) != at_first.point(box[0]);
        ++(is_there ? whole : as_it_was);
        for (const Vertex_index v : box)
          BOOST_TEST((mesh.point(v) == at_first.point(v) - static_cast<double>(is_there) * way));
        BOOST_TEST(sculptor.history().number_of_undo_steps() == std::size_t{is_there});
        BOOST_TEST(validate(mesh).is_valid());
        sculptor.check_unchanged();
        sculptor.drag(box[0], mesh.point(box[0]) + Vector_3(-0.1, 0, 0.1)); // it goes on, and the visitor hears
        BOOST_TEST(sculptor.visitor().calls_left == ~std::size_t{0} - 1);
        while (sculptor.undo())
          ;
        BOOST_TEST((snapshot(sculptor) == before));
      }
      BOOST_TEST(as_it_was > 8u + is_blocked);
      BOOST_TEST((whole > 1) == !is_blocked);
    }
}

BOOST_AUTO_TEST_CASE(an_object_that_has_not_moved_is_no_step_and_what_was_undone_can_be_redone) {
  Box_over_plate scene;
  auto& [box, mesh, sculptor] = scene;
  sculptor.drag(box[0], mesh.point(box[0]) + Vector_3(0, 0, 0.1));
  sculptor.drag(box[1], mesh.point(box[1]) + Vector_3(0, 0, 0.2));
  const Mesh_snapshot both = snapshot(sculptor);
  sculptor.undo();
  const Mesh_snapshot before = snapshot(sculptor);
  for (const bool in_stroke : {false, true}) {
    auto stroke = std::optional(sculptor.stroke());
    if (!in_stroke)
      stroke.reset();
    const auto report = move_rigidly(sculptor, box, translation({3, 5, -4})); // free along x and y
    BOOST_TEST((report.share == 0 && !report.contacts.empty()));
    BOOST_TEST((snapshot(sculptor) == before));
    BOOST_TEST((scene.steps() == std::pair(std::size_t{1}, std::size_t{1})));
  }
  BOOST_TEST(static_cast<bool>(sculptor.redo()));
  BOOST_TEST((snapshot(sculptor) == both));
  // What it did gain is one step, and clears what could be redone.
  sculptor.undo();
  BOOST_TEST(move_rigidly(sculptor, box, translation({3, 5, -1})).share == 0);
  BOOST_TEST((scene.steps() == std::pair(std::size_t{1}, std::size_t{1})));
  BOOST_TEST(move_rigidly(sculptor, box, translation({3, 5, -0x1p-11})).share == 511. / 1024);
  BOOST_TEST((scene.steps() == std::pair(std::size_t{2}, std::size_t{0})));
  sculptor.undo();
  BOOST_TEST((snapshot(sculptor) == before));
  sculptor.check_unchanged();
}
