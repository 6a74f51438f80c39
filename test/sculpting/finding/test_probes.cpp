// SPDX-License-Identifier: GPL-3.0-or-later
// Probes, vertices without faces: what passes over them, where they may be placed, what undo does to them; and the
// paths of drags. Against decisions in integers.
#include "sculpting/Mesh_snapshot.h"
#include "sculpting/edits/Mirror_visitor.h"
#include "sculpting/edits/random_edits.h"
#include "sculpting/finding/probe_scenes.h"

#include <boost/test/unit_test.hpp>

using namespace haptic_sculpt;
using namespace haptic_sculpt::test;

namespace {

using Face_index = Mesh::Face_index;

std::vector<Vertex_index> probes_of(const Mesh& mesh) {
  std::vector<Vertex_index> found;
  for (const Vertex_index v : mesh.vertices())
    if (mesh.is_isolated(v))
      found.push_back(v);
  return found;
}

std::array<double, 3> array_of(const Point_3& p) {
  return {p.x(), p.y(), p.z()};
}

struct Moved : Default_edit_visitor {
  std::vector<Vertex_index> vertices;
  void vertex_moved(Vertex_index v) { vertices.push_back(v); }
};

} // namespace

// Verdicts and times of first_impact, and stops, of stars among probes and of probes.
BOOST_AUTO_TEST_CASE(stars_stop_at_probes) {
  const std::size_t moves = count_from_environment("HAPTIC_SCULPT_PROBE_MOVES", 1200);
  Random random(seed_from_environment(18));
  std::size_t wrong_verdicts = 0, wrong_times = 0, wrong_ends = 0, blocked = 0, by_probes = 0;
  for (std::size_t done = 0; done < moves;) {
    const int size = 1 + static_cast<int>(random() % 3);
    meshes::Triangle_list list = random_list_with_probes(random, size, 1 + random() % 4);
    if (random() % 4 == 0) { // one anywhere, on the surface too
      const Point_3 p = random_place_about(random, size, list.points);
      list.add_point(p.x(), p.y(), p.z());
    }
    const oracle::Mesh_list independent = to_oracle(list);
    const Mesh original = meshes::to_mesh(list);
    for (std::size_t i = 0; i < 20 && done < moves; ++i, ++done) {
      const Vertex_index v(static_cast<Mesh::size_type>(random() % list.points.size()));
      const Point_3 target = random() % 3 == 0 ? list.points[random() % list.points.size()]
                                               : random_place_about(random, 2 * size, list.points);
      const int j = static_cast<int>(v);
      const auto expected = oracle::first_time_not_embedded(independent, j, array_of(target), true);
      const auto found = first_impact(original, v, target);
      blocked += expected.has_value();
      by_probes += expected && expected != oracle::first_time_not_embedded(independent, j, array_of(target));
      if (expected.has_value() != found.has_value())
        ++wrong_verdicts;
      else if (expected)
        wrong_times += found->impact().exact_time() != *expected;
      if (original.point(v) == target)
        continue;
      for (const bool is_tree : {true, false}) {
        Mesh mesh = original;
        Drag_result<Mesh> result;
        if (is_tree)
          result = Sculptor<Mesh>(mesh, parameters::response(Response::stop)).grab(v).drag_to(target);
        else
          result = Sculptor<Mesh, Brute_force_broad_phase<Mesh>>(mesh, parameters::response(Response::stop))
                       .grab(v)
                       .drag_to(target);
        wrong_verdicts += result.reached == expected.has_value();
        wrong_ends += mesh.point(v) != original.point(v) &&
                      oracle::first_time_not_embedded(independent, j, array_of(mesh.point(v)), true).has_value();
      }
    }
  }
  BOOST_TEST_MESSAGE(moves << " moves, " << blocked << " blocked, " << by_probes << " first or only by probes");
  BOOST_TEST(wrong_verdicts == 0u);
  BOOST_TEST(wrong_times == 0u);
  BOOST_TEST(wrong_ends == 0u);
  BOOST_TEST(by_probes > moves / 20);
}

// Each leg is free by the independent decision, the last point is the position, and asking changes nothing.
BOOST_AUTO_TEST_CASE(paths_of_drags_are_free) {
  const std::size_t drags = count_from_environment("HAPTIC_SCULPT_PATHS", 300);
  Random random(seed_from_environment(19));
  std::size_t wrong = 0, not_free = 0, different = 0, legs = 0, bent = 0;
  for (std::size_t done = 0; done < drags; ++done) {
    const int size = 2;
    const meshes::Triangle_list list = random_list_with_probes(random, size, random() % 3);
    const Response rule = done % 4 == 0 ? Response::paper : done % 4 == 1 ? Response::stop : Response::slide;
    Mesh mesh = meshes::to_mesh(list), other = mesh;
    Sculptor<Mesh> sculptor(mesh, parameters::response(rule)), silent(other, parameters::response(rule));
    const Vertex_index v(static_cast<Mesh::size_type>(random() % list.points.size()));
    auto grab = sculptor.grab(v), again = silent.grab(v);
    std::vector<Point_3> path = {Point_3(9, 9, 9)};
    for (int k = 0; k < 3; ++k) {
      oracle::Mesh_list scene = to_oracle(mesh);
      const Point_3 source = mesh.point(v), target = random_place_about(random, 2 * size, list.points);
      const auto result = grab.drag_to(target, path);
      again.drag_to(target);
      different += mesh.point(v) != other.point(v);
      if (path.empty() || path.front() != source || path.back() != result.position ||
          result.position != mesh.point(v)) {
        ++wrong;
        continue;
      }
      wrong += path.size() != 1 && path.size() != static_cast<std::size_t>(result.legs) + 1;
      legs += path.size() - 1;
      bent += path.size() > 2;
      for (std::size_t i = 1; i < path.size(); ++i) {
        not_free += oracle::first_time_not_embedded(scene, static_cast<int>(v), array_of(path[i]), true).has_value();
        scene.points[static_cast<std::size_t>(v)] = array_of(path[i]);
      }
    }
  }
  BOOST_TEST_MESSAGE(legs << " legs, " << bent << " drags of more than one");
  BOOST_TEST(wrong == 0u);
  BOOST_TEST(not_free == 0u);
  BOOST_TEST(different == 0u);
  BOOST_TEST(bent > drags / 4);
}

BOOST_AUTO_TEST_CASE(a_probe_is_placed_where_it_is_outside) {
  const std::size_t scenes = count_from_environment("HAPTIC_SCULPT_PLACEMENTS", 300);
  Random random(seed_from_environment(20));
  std::size_t wrong = 0;
  std::array<std::size_t, 3> sides{};
  for (std::size_t k = 0; k < scenes; ++k) {
    const int size = 1 + static_cast<int>(random() % 3);
    meshes::Triangle_list list = random_list_with_probes(random, size, 1);
    if (random() % 2 == 0)
      list.turn_inside_out();
    Mesh mesh = meshes::to_mesh(list), other = mesh;
    const oracle::Mesh_list surface = to_oracle(list);
    Sculptor<Mesh> sculptor(mesh);
    Sculptor<Mesh, Brute_force_broad_phase<Mesh>> all(other);
    const Vertex_index probe = probes_of(mesh).front();
    for (int i = 0; i < 20; ++i) {
      const Point_3 p = random_place_about(random, size, list.points), before = mesh.point(probe);
      const Side side = side_of(surface, p);
      ++sides[static_cast<std::size_t>(side)];
      const auto placed = sculptor.place(probe, p);
      wrong += static_cast<bool>(placed) != (side == Side::outside) || mesh.point(probe) != (placed ? p : before);
      if (!placed)
        wrong += placed.refusal->reason != (side == Side::on ? Refusal_reason::too_near : Refusal_reason::inside);
      wrong += static_cast<bool>(all.place(probe, p)) != static_cast<bool>(placed);
    }
  }
  BOOST_TEST_MESSAGE("placed outside, inside, on: " << sides[0] << ", " << sides[1] << ", " << sides[2]);
  BOOST_TEST(wrong == 0u);
  for (const std::size_t count : sides)
    BOOST_TEST(count > scenes);
}

BOOST_AUTO_TEST_CASE(placements_know_cavities_and_clearances) {
  Mesh mesh = meshes::to_mesh(meshes::ball_in_a_cavity());
  const Vertex_index probe = mesh.add_vertex(Point_3(9, 9, 9));
  const oracle::Mesh_list surface = to_oracle(mesh);
  Moved* told = nullptr;
  Sculptor<Mesh, Box_tree_broad_phase<Mesh>, Moved> sculptor(mesh, parameters::clearance(0x1p-10));
  told = &sculptor.visitor();
  std::size_t free = 0, inside = 0, wrong = 0;
  for (double x = 0; x < 4; x += 0.125) {
    const auto placed = sculptor.place(probe, Point_3(x, 0, 0)); // along an axis, through vertices
    const Side side = side_of(surface, Point_3(x, 0, 0));
    free += static_cast<bool>(placed);
    inside += !placed && placed.refusal->reason == Refusal_reason::inside;
    wrong += placed ? side != Side::outside : placed.refusal->reason == Refusal_reason::inside && side != Side::inside;
  }
  BOOST_TEST(wrong == 0u);
  BOOST_TEST(free > 0u);
  BOOST_TEST(inside > 0u);
  BOOST_TEST(told->vertices.size() == free);
  BOOST_TEST(sculptor.history().number_of_undo_steps() == free);
  BOOST_TEST((sculptor.place(Vertex_index(0), Point_3(9, 9, 9)).refusal->reason == Refusal_reason::not_isolated));
  BOOST_TEST((sculptor.place(Vertex_index(4711), Point_3(9, 9, 9)).refusal->reason == Refusal_reason::unknown_element));
  BOOST_TEST((sculptor.place(Vertex_index(), Point_3(9, 9, 9)).refusal->reason == Refusal_reason::unknown_element));
  BOOST_CHECK_THROW(sculptor.place(probe, Point_3(0, 0, std::nan(""))), Non_finite_point);
  for (; free != 0; --free)
    BOOST_TEST(static_cast<bool>(sculptor.undo()));
  BOOST_TEST((mesh.point(probe) == Point_3(9, 9, 9)));
  BOOST_TEST(static_cast<bool>(sculptor.redo()));
  BOOST_TEST(static_cast<bool>(sculptor.undo()));

  // Exactly at the clearance is too near, an ulp more is not; the face is named.
  meshes::Triangle_list flat = meshes::tetrahedron();
  flat.points = {{-8, -8, 0}, {8, -8, 0}, {0, 8, 0}, {0, 0, -3}};
  flat.add_point(0, 0, 5);
  Mesh slab = meshes::to_mesh(flat);
  Sculptor<Mesh> above(slab, parameters::clearance(0x1p-10));
  const auto near = above.place(Vertex_index(4), Point_3(0.5, 0.25, 0x1p-10));
  BOOST_REQUIRE(!near);
  BOOST_TEST((near.refusal->reason == Refusal_reason::too_near));
  BOOST_TEST(near.refusal->elements.size() == 3u);
  BOOST_TEST(static_cast<bool>(above.place(Vertex_index(4), Point_3(0.5, 0.25, std::nextafter(0x1p-10, 1)))));
}

// Whatever is edited, dragged, undone and redone, a probe stays on its side unless it is placed, and is never on a
// face.
BOOST_AUTO_TEST_CASE(nothing_swallows_a_probe) {
  const std::size_t edits = count_from_environment("HAPTIC_SCULPT_PROBE_EDITS", 6000);
  Random random(seed_from_environment(21));
  std::size_t swallowed = 0, changed_by_refusal = 0, refused_undo = 0, done = 0, placed = 0, faults = 0;
  for (std::size_t k = 0; k < edits;) {
    const int size = 2;
    const meshes::Triangle_list list = random_list_with_probes(random, size, 1 + random() % 3);
    Mesh mesh = meshes::to_mesh(list);
    const bool recorded = random() % 2 == 0;
    const std::vector<Vertex_index> probes = probes_of(mesh);
    Sculptor<Mesh, Box_tree_broad_phase<Mesh>, Mirror_visitor> sculptor(mesh, parameters::record_probes(recorded),
                                                                        Mirror_visitor(mesh));
    std::map<Vertex_index, Side> sides;
    const auto look = [&] {
      const oracle::Mesh_list now = to_oracle(mesh);
      for (const Vertex_index v : probes)
        sides[v] = side_of(now, mesh.point(v));
    };
    look();
    for (std::size_t i = 0; i < 60 && k < edits; ++i, ++k) {
      const std::map<Vertex_index, Side> before = sides;
      const Mesh_snapshot state = snapshot(sculptor);
      const std::size_t steps = sculptor.history().number_of_undo_steps(),
                        again = sculptor.history().number_of_redo_steps();
      const Vertex_index probe = probes[random() % probes.size()];
      bool may_change_side = false, is_probe_move = false;
      switch (random() % 6) {
      case 0:
        may_change_side = is_probe_move = true;
        placed += static_cast<bool>(sculptor.place(probe, random_place_about(random, size, list.points)));
        break;
      case 1:
        is_probe_move = true;
        sculptor.grab(probe).drag_to(random_place_about(random, size, list.points));
        break;
      case 2: {
        const auto stroke = sculptor.stroke();
        for (int n = 0; n < 3; ++n) {
          const Vertex_index v = pick(mesh.vertices(), mesh.number_of_vertices(), random);
          sculptor.grab(v).drag_to(random_place_about(random, size, list.points));
        }
        break;
      }
      case 3: {
        const auto undone = random() % 3 != 0 ? sculptor.undo() : sculptor.redo();
        if (!undone && undone.refusal->reason == Refusal_reason::blocked) {
          ++refused_undo;
          changed_by_refusal += snapshot(sculptor) != state || sculptor.history().number_of_undo_steps() != steps ||
                                sculptor.history().number_of_redo_steps() != again || recorded;
        }
        may_change_side = recorded; // a placement taken back
        break;
      }
      default:
        done += random_edit(sculptor, random).is_done;
        may_change_side = recorded;
      }
      if (is_probe_move && !recorded)
        faults +=
            sculptor.history().number_of_undo_steps() != steps || sculptor.history().number_of_redo_steps() != again;
      look();
      for (const Vertex_index v : probes)
        swallowed += sides[v] == Side::on || (!may_change_side && sides[v] != before.at(v));
    }
    faults += sculptor.visitor().faults;
    faults += sculptor.visitor().snapshot() != snapshot(sculptor) || !sculptor.visitor().has_edges_of_mesh();
    // Everything back: of what is recorded the sides of the beginning.
    if (recorded) {
      while (sculptor.undo()) {
      }
      look();
    }
    BOOST_TEST(validate(mesh).is_valid());
  }
  BOOST_TEST_MESSAGE(edits << " edits, " << done << " random ones done, " << placed << " placed, " << refused_undo
                           << " undos or redos refused");
  BOOST_TEST(swallowed == 0u);
  BOOST_TEST(changed_by_refusal == 0u);
  BOOST_TEST(faults == 0u);
  BOOST_TEST(placed > edits / 50);
  BOOST_TEST(refused_undo > 0u);
}

// A vertex is drawn away, a probe that is not recorded goes where it was: undo has to wait.
BOOST_AUTO_TEST_CASE(undo_waits_for_a_probe) {
  meshes::Triangle_list list = meshes::icosphere(1);
  list.add_point(0, 0, 5);
  Mesh mesh = meshes::to_mesh(list);
  const Vertex_index tip(0), probe(static_cast<Mesh::size_type>(mesh.num_vertices() - 1));
  const Point_3 home = mesh.point(tip), inward = CGAL::ORIGIN + 0.5 * (home - CGAL::ORIGIN),
                gap = CGAL::midpoint(home, inward);
  Sculptor<Mesh> sculptor(mesh, parameters::record_probes(false));
  BOOST_TEST(!sculptor.place(probe, gap)); // inside
  {
    const auto stroke = sculptor.stroke();
    BOOST_REQUIRE(sculptor.grab(tip).drag_to(inward).reached);
    BOOST_REQUIRE(static_cast<bool>(sculptor.insert_on_face(Face_index(40), in_face(mesh, Face_index(40), 0.3, 0.3))));
  }
  BOOST_REQUIRE(static_cast<bool>(sculptor.place(probe, gap)));
  BOOST_TEST(sculptor.history().number_of_undo_steps() == 1u);
  const Mesh_snapshot state = snapshot(sculptor);
  const auto refused = sculptor.undo();
  BOOST_REQUIRE(!refused);
  BOOST_TEST((refused.refusal->reason == Refusal_reason::blocked));
  BOOST_TEST((refused.refusal->elements.at(0) == probe));
  BOOST_TEST((snapshot(sculptor) == state));
  BOOST_TEST(sculptor.history().number_of_undo_steps() == 1u);
  BOOST_REQUIRE(sculptor.grab(probe).drag_to(CGAL::ORIGIN + 3 * (home - CGAL::ORIGIN)).reached);
  BOOST_TEST(static_cast<bool>(sculptor.undo()));
  BOOST_TEST((mesh.point(tip) == home));
  BOOST_TEST(sculptor.history().number_of_redo_steps() == 1u);
  BOOST_TEST(
      static_cast<bool>(sculptor.place(probe, CGAL::ORIGIN + 2 * (home - CGAL::ORIGIN)))); // keeps what can be redone
  BOOST_TEST(static_cast<bool>(sculptor.redo()));
}
