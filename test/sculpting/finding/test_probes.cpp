// SPDX-License-Identifier: GPL-3.0-or-later
// Probes: where they may begin, where they come to and on which way, and what ends them. Against decisions in integers.
#include "sculpting/Mesh_snapshot.h"
#include "sculpting/edits/random_edits.h"
#include "sculpting/finding/probe_scenes.h"

#include <haptic_sculpt/sculpting/paper_1997.h>

#include <boost/test/unit_test.hpp>

#include <functional>

using namespace haptic_sculpt;
using namespace haptic_sculpt::test;

namespace {

using Face_index = Mesh::Face_index;

std::array<double, 3> array_of(const Point_3& p) {
  return {p.x(), p.y(), p.z()};
}

} // namespace

// A surface, a point beside it as a vertex without faces, and what the independent decision says of its way.
BOOST_AUTO_TEST_CASE(probes_stop_where_a_point_meets_the_surface) {
  const std::size_t moves = count_from_environment("HAPTIC_SCULPT_PROBE_MOVES", 1200);
  Random random(seed_from_environment(18));
  std::size_t wrong_verdicts = 0, wrong_times = 0, wrong_ends = 0, blocked = 0, done = 0;
  while (done < moves) {
    const int size = 1 + static_cast<int>(random() % 3);
    const meshes::Triangle_list list = random_small_list(random, size);
    const Mesh mesh = meshes::to_mesh(list);
    for (std::size_t i = 0; i < 20 && done < moves; ++i, ++done) {
      const Point_3 start = random_place_off(random, size, list);
      const Point_3 target = random() % 3 == 0 ? list.points[random() % list.points.size()]
                                               : random_place_about(random, 2 * size, list.points);
      oracle::Mesh_list independent = to_oracle(list);
      const int j = static_cast<int>(independent.points.size());
      independent.points.push_back(array_of(start));
      const auto expected = oracle::first_time_not_embedded(independent, j, array_of(target));
      blocked += expected.has_value();
      Mesh with_point = mesh;
      const auto found = first_impact(with_point, with_point.add_vertex(start), target);
      if (expected.has_value() != found.has_value())
        ++wrong_verdicts;
      else if (expected)
        wrong_times += found->impact().exact_time() != *expected;
      for (const bool is_tree : {true, false}) {
        Mesh copy = mesh;
        Drag_result<Mesh> result;
        const auto drag = [&](auto&& sculptor) {
          auto probe = sculptor.probe(start, Probe_start::anywhere);
          result = probe.drag_to(target);
          wrong_ends += probe.position() != result.position;
        };
        if (is_tree)
          drag(Sculptor<Mesh>(copy, parameters::response(Response::stop)));
        else
          drag(Sculptor<Mesh, Brute_force_broad_phase<Mesh>>(copy, parameters::response(Response::stop)));
        wrong_verdicts += start != target && result.reached == expected.has_value();
        wrong_ends += result.position != start &&
                      oracle::first_time_not_embedded(independent, j, array_of(result.position)).has_value();
      }
    }
  }
  BOOST_TEST_MESSAGE(moves << " moves, " << blocked << " blocked");
  BOOST_TEST(wrong_verdicts == 0u);
  BOOST_TEST(wrong_times == 0u);
  BOOST_TEST(wrong_ends == 0u);
  BOOST_TEST(blocked > moves / 10);
}

// Each leg is free by the independent decision, the last point is the position, and asking changes nothing.
BOOST_AUTO_TEST_CASE(paths_of_drags_are_free) {
  const std::size_t drags = count_from_environment("HAPTIC_SCULPT_PATHS", 300);
  Random random(seed_from_environment(19));
  std::size_t wrong = 0, not_free = 0, different = 0, legs = 0, bent = 0;
  for (std::size_t done = 0; done < drags; ++done) {
    const int size = 2;
    const meshes::Triangle_list list = random_small_list(random, size);
    const Response rule = done % 4 == 0 ? Response::paper() : done % 4 == 1 ? Response::stop : Response::slide;
    Mesh mesh = meshes::to_mesh(list), other = mesh;
    Sculptor<Mesh> sculptor(mesh, parameters::response(rule)), silent(other, parameters::response(rule));
    const auto drag_thrice = [&](auto&& held, auto&& again, std::size_t moved, oracle::Mesh_list scene) {
      std::vector<Point_3> path = {Point_3(9, 9, 9)};
      for (int k = 0; k < 3; ++k) {
        const auto& p = scene.points[moved];
        const Point_3 source(p[0], p[1], p[2]), target = random_place_about(random, 2 * size, list.points);
        const auto result = held.drag_to(target, path);
        different += again.drag_to(target).position != result.position;
        scene.points[moved] = array_of(result.position);
        if (path.empty() || path.front() != source || path.back() != result.position) {
          ++wrong;
          continue;
        }
        wrong += path.size() != 1 && path.size() != static_cast<std::size_t>(result.legs) + 1;
        legs += path.size() - 1;
        bent += path.size() > 2;
        for (std::size_t i = 1; i < path.size(); ++i) {
          scene.points[moved] = array_of(path[i - 1]);
          not_free += oracle::first_time_not_embedded(scene, static_cast<int>(moved), array_of(path[i])).has_value();
        }
        scene.points[moved] = array_of(result.position);
      }
    };
    oracle::Mesh_list scene = to_oracle(list);
    if (random() % 2 == 0) {
      const std::size_t v = random() % list.points.size();
      const Vertex_index moved(static_cast<Mesh::size_type>(v));
      drag_thrice(sculptor.grab(moved), silent.grab(moved), v, scene);
    } else {
      const Point_3 start = random_place_off(random, size, list);
      scene.points.push_back(array_of(start));
      drag_thrice(sculptor.probe(start, Probe_start::anywhere), silent.probe(start, Probe_start::anywhere),
                  list.points.size(), scene);
      sculptor.check_unchanged();
      different += sculptor.history().number_of_undo_steps() != 0;
    }
  }
  BOOST_TEST_MESSAGE(legs << " legs, " << bent << " drags of more than one");
  BOOST_TEST(wrong == 0u);
  BOOST_TEST(not_free == 0u);
  BOOST_TEST(different == 0u);
  BOOST_TEST(bent > drags / 4);
}

BOOST_AUTO_TEST_CASE(a_probe_begins_where_it_is_outside) {
  const std::size_t scenes = count_from_environment("HAPTIC_SCULPT_PLACEMENTS", 300);
  Random random(seed_from_environment(20));
  std::size_t wrong = 0;
  std::array<std::size_t, 3> sides{};
  for (std::size_t k = 0; k < scenes; ++k) {
    const int size = 1 + static_cast<int>(random() % 3);
    meshes::Triangle_list list = random_small_list(random, size);
    if (random() % 2 == 0)
      list.turn_inside_out();
    Mesh mesh = meshes::to_mesh(list), other = mesh;
    const oracle::Mesh_list surface = to_oracle(list);
    Sculptor<Mesh> sculptor(mesh);
    Sculptor<Mesh, Brute_force_broad_phase<Mesh>> all(other);
    for (int i = 0; i < 20; ++i) {
      const Point_3 p = random_place_about(random, size, list.points);
      const Side side = side_of(surface, p);
      ++sides[static_cast<std::size_t>(side)];
      const auto probe = sculptor.probe(p);
      wrong += bool(probe) != (side == Side::outside) || probe.position() != p;
      if (!probe)
        wrong += probe.refusal()->reason != (side == Side::on ? Refusal_reason::too_near : Refusal_reason::inside);
      wrong += bool(sculptor.probe(p, Probe_start::anywhere)) != (side != Side::on);
      wrong += bool(all.probe(p)) != bool(probe);
    }
  }
  BOOST_TEST_MESSAGE("outside, inside, on: " << sides[0] << ", " << sides[1] << ", " << sides[2]);
  BOOST_TEST(wrong == 0u);
  for (const std::size_t count : sides)
    BOOST_TEST(count > scenes);
}

BOOST_AUTO_TEST_CASE(beginnings_know_cavities_and_clearances) {
  Mesh mesh = meshes::to_mesh(meshes::ball_in_a_cavity());
  const oracle::Mesh_list surface = to_oracle(mesh);
  Sculptor<Mesh> sculptor(mesh, parameters::clearance(0x1p-10));
  std::size_t free = 0, inside = 0, wrong = 0;
  for (double x = 0; x < 4; x += 0.125) {
    auto probe = sculptor.probe(Point_3(x, 0, 0)); // along an axis, through vertices
    const Side side = side_of(surface, Point_3(x, 0, 0));
    free += bool(probe);
    if (probe) {
      wrong += side != Side::outside;
      continue;
    }
    const bool is_inside = probe.refusal()->reason == Refusal_reason::inside;
    inside += is_inside;
    wrong += is_inside && side != Side::inside;
    const auto result = probe.drag_to(Point_3(9, 9, 9)); // it is nowhere
    wrong += result.end != Drag_end::refused || result.reached || result.position != Point_3(x, 0, 0) ||
             result.contacts.size() != (is_inside ? 0u : 1u);
  }
  BOOST_TEST(wrong == 0u);
  BOOST_TEST(free > 0u);
  BOOST_TEST(inside > 0u);
  BOOST_CHECK_THROW(sculptor.probe(Point_3(0, 0, std::nan(""))), Non_finite_point);

  // Exactly at the clearance is too near, an ulp more is not; the face is named.
  meshes::Triangle_list flat = meshes::tetrahedron();
  flat.points = {{-8, -8, 0}, {8, -8, 0}, {0, 8, 0}, {0, 0, -3}};
  Mesh slab = meshes::to_mesh(flat);
  Sculptor<Mesh> above(slab, parameters::clearance(0x1p-10));
  auto near = above.probe(Point_3(0.5, 0.25, 0x1p-10));
  BOOST_REQUIRE(!near);
  BOOST_TEST((near.refusal()->reason == Refusal_reason::too_near));
  BOOST_TEST(near.refusal()->elements.size() == 3u);
  BOOST_TEST((near.drag_to(Point_3(0, 0, 5)).contacts.at(0).vertices[0] == near.refusal()->elements[0]));
  BOOST_TEST(bool(above.probe(Point_3(0.5, 0.25, std::nextafter(0x1p-10, 1)))));
}

// Of each kind of change; what is refused, or blocked where it is, changes nothing.
BOOST_AUTO_TEST_CASE(any_change_of_the_mesh_ends_a_probe) {
  Mesh mesh = meshes::to_mesh(meshes::bumpy_sphere(2, 0.12));
  Sculptor<Mesh> sculptor(mesh);
  const Point_3 start(0, 0, 3), low(0.1, 0, 1.5), target(0.03, 0.02, 0.1);
  const Vertex_index v(17);
  const auto out = [&](double share) { return CGAL::ORIGIN + share * (mesh.point(v) - CGAL::ORIGIN); };
  const auto face = [&] { return *std::next(mesh.faces().begin(), 40); };
  const auto middle = [&](Mesh::Edge_index e) {
    return CGAL::midpoint(mesh.point(mesh.vertex(e, 0)), mesh.point(mesh.vertex(e, 1)));
  };
  const Mesh::Edge_index e = *std::next(mesh.edges().begin(), 30);
  const std::pair<const char*, std::function<bool()>> changes[] = {
      {"drag", [&] { return sculptor.grab(v).drag_to(out(1.1)).reached; }},
      {"move if free", [&] { return sculptor.move_if_free(v, out(1.1)); }},
      {"insert on face", [&] { return bool(sculptor.insert_on_face(face(), in_face(mesh, face(), 0.3, 0.3))); }},
      {"insert on edge", [&] { return bool(sculptor.insert_on_edge(e, middle(e))); }},
      {"remove", [&] { return bool(sculptor.remove(Vertex_index(25))); }},
      {"collapse", [&] { return bool(sculptor.collapse(mesh.halfedge(Vertex_index(60)))); }},
      {"flip", [&] { return bool(sculptor.flip(*std::next(mesh.edges().begin(), 200))); }},
      {"shift",
       [&] {
         return bool(
             sculptor.shift(2, {{v, mesh.point(v).z() + 0.01}, {Vertex_index(3), mesh.point(Vertex_index(3)).z()}}));
       }},
      {"undo", [&] { return bool(sculptor.undo()); }},
      {"redo", [&] { return bool(sculptor.redo()); }},
      {"undo of a stroke", [&] { return bool(sculptor.undo()); }}};
  for (const auto& [name, change] : changes) {
    BOOST_TEST_INFO_SCOPE(name);
    auto probe = sculptor.probe(start), copy = probe;
    BOOST_REQUIRE(probe.drag_to(low).reached);
    BOOST_TEST(bool(copy));
    BOOST_REQUIRE(change());
    BOOST_TEST(!probe);
    BOOST_TEST(!probe.refusal());
    std::vector<Point_3> path(3);
    const auto result = probe.drag_to(target, path);
    BOOST_TEST((result.end == Drag_end::stale));
    BOOST_TEST((result.position == low && probe.position() == low && !result.reached && result.contacts.empty() &&
                path.empty()));
    BOOST_TEST((copy.drag_to(target).end == Drag_end::stale));
    BOOST_TEST((probe.drag_to(low).end == Drag_end::stale));
    BOOST_CHECK_THROW(probe.drag_to(Point_3(0, std::nan(""), 0)), Non_finite_point);
    probe = sculptor.probe(probe.position()); // placed again
    BOOST_REQUIRE(bool(probe));
    BOOST_TEST((probe.drag_to(target).end == Drag_end::held));
  }
  // What changes nothing.
  auto probe = sculptor.probe(start);
  BOOST_REQUIRE(probe.drag_to(low).reached);
  while (sculptor.redo())
    probe = sculptor.probe(low);
  const Mesh_snapshot before = snapshot(sculptor);
  auto grab = sculptor.grab(v);
  BOOST_TEST(grab.drag_to(mesh.point(v)).reached);
  BOOST_TEST(!sculptor.insert_on_face(face(), mesh.point(mesh.target(mesh.halfedge(face())))));
  BOOST_TEST(!sculptor.move_if_free(v, out(-3)));
  BOOST_TEST(!sculptor.redo());
  sculptor.nearest_vertex(low, 5), sculptor.first_hit(start, target), sculptor.first_impact(v, out(2));
  sculptor.set_drag_parameters(Drag_parameters().clearance(1e-9));
  sculptor.set_drag_parameters(Drag_parameters().response(Response::stop));
  { const auto stroke = sculptor.stroke(); }
  BOOST_TEST(bool(probe));
  BOOST_TEST((probe.drag_to(target).end == Drag_end::held));
  BOOST_TEST((snapshot(sculptor) == before));
}

// A hand that drags a vertex, and probes beside it: neither is in the other's way, and each sees where the vertex is.
BOOST_AUTO_TEST_CASE(probes_go_beside_a_grab) {
  Mesh mesh = meshes::to_mesh(meshes::bumpy_sphere(2, 0.12)), alone = mesh;
  Sculptor<Mesh> sculptor(mesh), other(alone);
  const Vertex_index v(17);
  const auto home = mesh.point(v) - CGAL::ORIGIN;
  auto grab = sculptor.grab(v), same = other.grab(v);
  auto one = sculptor.probe(CGAL::ORIGIN + 4 * home), two = sculptor.probe(CGAL::ORIGIN - 3 * home);
  for (int k = 1; k <= 10; ++k) {
    const Point_3 target = CGAL::ORIGIN + (1 + 0.1 * k) * home;
    const auto a = grab.drag_to(target), b = same.drag_to(target);
    BOOST_TEST((a.position == b.position && a.work == b.work));
    BOOST_TEST((one.drag_to(target).end == Drag_end::stale));
    one = sculptor.probe(CGAL::ORIGIN + 4 * home), two = sculptor.probe(CGAL::ORIGIN - 3 * home);
    BOOST_REQUIRE((one && two));
    // Straight down onto the tip, wherever it is by now; the other from below. In turn: each goes on where it is.
    const auto on = [&](Probe<Sculptor<Mesh>>& probe) { return probe.drag_to(CGAL::ORIGIN); };
    const auto first = on(one), below = on(two), again = on(one);
    BOOST_TEST(!first.reached);
    const Point_3 centre(CGAL::ORIGIN);
    BOOST_TEST(CGAL::squared_distance(again.position, centre) <= CGAL::squared_distance(first.position, centre));
    BOOST_TEST((below.end == Drag_end::held && two.position() == below.position));
    BOOST_TEST((validate(mesh).is_valid() && side_of(to_oracle(mesh), one.position()) == Side::outside));
  }
  BOOST_TEST((mesh.point(v) == alone.point(v)));
}
