// SPDX-License-Identifier: GPL-3.0-or-later
// A bound on the work of a drag: what holds whatever it is, and that drags with one come to where drags without one
// end.
#include "sculpting/Random_scene.h"

#include <haptic_sculpt/sculpting/paper_1997.h>

#include <boost/test/unit_test.hpp>

using namespace haptic_sculpt;
using namespace haptic_sculpt::test;

namespace {

double distance(const Point_3& a, const Point_3& b) {
  return std::sqrt(CGAL::squared_distance(a, b));
}

Mesh terrain() {
  return meshes::to_mesh(meshes::bumpy_sphere(3, 0.3, 0.03));
}

Point_3 random_target(Random& random, const Point_3& from, double size) {
  const auto uniform = [&] { return static_cast<double>(random() >> 11) * 0x1p-52 - 1; };
  const double x = uniform(), y = uniform(), z = uniform();
  return from + size * meshes::Kernel::Vector_3(x, y, z);
}

} // namespace

BOOST_AUTO_TEST_CASE(a_bound_that_no_drag_comes_to_changes_no_bit) {
  Mesh mesh = terrain(), other = terrain();
  Sculptor<Mesh> without(mesh), with(other, parameters::work_limit(1000000000));
  Random random(seed_from_environment(5));
  std::size_t most = 0;
  for (int k = 0; k < 300; ++k) {
    const Vertex_index v(static_cast<Mesh::size_type>(random() % mesh.number_of_vertices()));
    const Point_3 target = random_target(random, mesh.point(v), 0.5);
    const auto a = without.grab(v).drag_to(target), b = with.grab(v).drag_to(target);
    BOOST_REQUIRE((a.position == b.position));
    BOOST_REQUIRE((a.end == b.end));
    BOOST_REQUIRE(a.work == b.work);
    most = std::max(most, a.work);
  }
  BOOST_TEST(most > 100);
}

BOOST_AUTO_TEST_CASE(a_drag_without_a_bound_does_the_same_after_drags_that_were_cut) {
  Random random(seed_from_environment(7));
  std::size_t reached = 0, held = 0;
  for (int k = 0; k < 60; ++k) {
    Mesh mesh = terrain(), other = mesh;
    Sculptor<Mesh> sculptor(mesh), fresh(other);
    const Vertex_index v(static_cast<Mesh::size_type>(random() % mesh.number_of_vertices()));
    const Point_3 start = mesh.point(v), target = random_target(random, start, k % 2 == 0 ? 0.01 : 0.5);
    auto grab = sculptor.grab(v);
    for (int cut = 0; cut <= k % 4; ++cut)
      grab.drag_to(target, Drag_parameters().work_limit(0));
    BOOST_REQUIRE((mesh.point(v) == start)); // else contacts would be known
    const auto a = grab.drag_to(target), b = fresh.grab(v).drag_to(target);
    BOOST_TEST((a.position == b.position));
    BOOST_TEST((a.end == b.end), name_of(a.end) << " for " << name_of(b.end));
    reached += a.end == Drag_end::reached, held += a.end == Drag_end::held;
  }
  BOOST_TEST(reached > 10u);
  BOOST_TEST(held > 3u);
}

BOOST_AUTO_TEST_CASE(with_any_bound_a_mesh_stays_embedded) {
  Random random(seed_from_environment(6));
  std::size_t cut = 0, moved = 0;
  for (const std::size_t bound : {0, 1, 3, 10, 30, 100, 300})
    for (int scene = 0; scene < 12; ++scene) {
      Mesh mesh = scene % 4 == 0 ? terrain() : meshes::to_mesh(random_small_list(random, 3));
      Sculptor<Mesh> sculptor(mesh, parameters::work_limit(bound).response(scene % 3 == 0   ? Response::paper()
                                                                           : scene % 3 == 1 ? Response::stop
                                                                                            : Response::slide));
      for (int k = 0; k < 30; ++k) {
        const Vertex_index v(static_cast<Mesh::size_type>(random() % mesh.number_of_vertices()));
        auto grab = sculptor.grab(v);
        Point_3 target = random_target(random, mesh.point(v), 1);
        for (int i = 0; i < 5; ++i) {
          const Mesh unmoved = bound == 0 ? mesh : Mesh();
          const Point_3 before = mesh.point(v);
          const auto result = grab.drag_to(target);
          BOOST_REQUIRE((result.position == mesh.point(v)));
          BOOST_REQUIRE(result.reached == (result.position == target));
          BOOST_REQUIRE(!(result.reached && result.end == Drag_end::work_limit));
          if (bound == 0 && result.position != before) { // which nothing had to be decided for
            Mesh copy = unmoved;
            Sculptor<Mesh> unbounded(copy, parameters::response(sculptor.parameters().drag.response_rule));
            BOOST_REQUIRE(unbounded.grab(v).drag_to(target).work == 0);
          }
          cut += result.end == Drag_end::work_limit;
          moved += result.position != before;
        }
      }
      BOOST_REQUIRE(validate(mesh).is_valid());
      sculptor.check_unchanged();
    }
  BOOST_TEST_MESSAGE(cut << " drags were cut short, " << moved << " moved");
  BOOST_TEST(cut > 500);
  BOOST_TEST(moved > 500);
}

BOOST_AUTO_TEST_CASE(drags_that_go_on_come_to_an_end_that_is_one_without_a_bound) {
  Random random(seed_from_environment(7));
  std::size_t held_ends = 0, went_on = 0, calls = 0, not_ended = 0, improved = 0, drags = 0;
  for (const std::size_t bound : {40, 80, 160, 320}) {
    Mesh mesh = terrain();
    Sculptor<Mesh> sculptor(mesh, parameters::work_limit(bound));
    // \param again_from what drags it from the end, by a Sculptor without a bound that knows nothing of what was tried
    const auto drag_to_the_end = [&](auto&& held, const Point_3& target, const auto& again_from) {
      auto result = held.drag_to(target);
      int more = 0;
      for (; result.end == Drag_end::work_limit && more < 200; ++more)
        result = held.drag_to(target);
      ++drags;
      went_on += more > 0;
      calls += static_cast<std::size_t>(more);
      not_ended += result.end == Drag_end::work_limit;
      if (result.end != Drag_end::held)
        return;
      ++held_ends;
      Mesh copy = mesh;
      Sculptor<Mesh> fresh(copy);
      const auto further = again_from(fresh, result.position);
      improved += distance(result.position, target) - distance(further.position, target) >
                  64 * fresh.clearance(result.position);
    };
    for (int k = 0; k < 100; ++k) {
      const Point_3 start(2, 0, 0), target = random_target(random, start, 0.4);
      drag_to_the_end(sculptor.probe(start), target, [&](auto& fresh, const Point_3& p) {
        return fresh.probe(p, Probe_start::anywhere).drag_to(target); // held where p is too near to begin
      });
      const Vertex_index v(static_cast<Mesh::size_type>(random() % mesh.number_of_vertices()));
      const Point_3 there = random_target(random, mesh.point(v), 0.4), home = mesh.point(v);
      drag_to_the_end(sculptor.grab(v), there,
                      [&](auto& fresh, const Point_3&) { return fresh.grab(v).drag_to(there); });
      if (mesh.point(v) != home)
        sculptor.undo();
    }
  }
  BOOST_TEST_MESSAGE(drags << " drags, " << went_on << " of which went on over " << calls << " calls; " << held_ends
                           << " held, of which " << improved << " could go on; " << not_ended << " did not end");
  BOOST_TEST(went_on > 20);
  BOOST_TEST(held_ends > 50);
  BOOST_TEST(not_ended <= drags / 20);
  BOOST_TEST(improved <= held_ends / 50);
}

// A search that another target began, or that had to leave a trial out, proves nothing of this target.
BOOST_AUTO_TEST_CASE(held_by_drags_that_went_on_says_that_all_was_tried_for_this_target) {
  Mesh mesh = terrain();
  Sculptor<Mesh> sculptor(mesh);
  Random random(seed_from_environment(3));
  std::size_t held = 0, searched = 0, gave_up = 0;
  const meshes::Kernel::Vector_3 aside(1e-9, -1e-9, 1e-9);
  for (int k = 0; k < 2500; ++k) {
    const Vertex_index v(static_cast<Mesh::size_type>(random() % mesh.number_of_vertices()));
    const Point_3 home = mesh.point(v), target = random_target(random, home, 0.5), other = target + aside;
    const auto portion = Drag_parameters().work_limit(70 + 50 * (k % 4));
    auto grab = sculptor.grab(v);
    bool is_searching = false;
    for (int i = 0; i < 300 && !is_searching; ++i) {
      const Point_3 before = mesh.point(v);
      const auto result = grab.drag_to(target, portion);
      if (result.end != Drag_end::work_limit)
        break;
      is_searching = mesh.point(v) == before && result.contacts.size() > 1 && random() % 3 == 0;
    }
    const Point_3 rest = mesh.point(v);
    std::size_t work = 0;
    Drag_end end = is_searching ? Drag_end::work_limit : Drag_end::stuck;
    for (int i = 0; i < 300 && end == Drag_end::work_limit; ++i) {
      const auto result = grab.drag_to(other, portion);
      work += result.work;
      end = result.end;
    }
    gave_up += is_searching && end == Drag_end::stuck;
    if (end == Drag_end::held && mesh.point(v) == rest) {
      const auto whole = grab.drag_to(other + aside); // a search by itself, from here with what is known here
      if (mesh.point(v) == rest) {
        BOOST_TEST(4 * work >= 3 * whole.work, // the trials are alike, not the same
                   "drag " << k << ": " << work << " pairs for " << whole.work);
        ++held;
        searched += whole.work > 0;
      }
    }
    if (mesh.point(v) != home)
      sculptor.undo();
  }
  BOOST_TEST_MESSAGE(held << " held, " << searched << " of them by a search; " << gave_up << " gave up");
  BOOST_TEST(searched > 10u);
  BOOST_TEST(gave_up > 40u);
}

// A question is no drag: a search that was left goes on after it.
BOOST_AUTO_TEST_CASE(drags_that_go_on_come_to_the_same_end_with_questions_between_them) {
  Random random(seed_from_environment(11));
  const auto uniform = [&](double size) { return size * static_cast<double>(random() >> 11) * 0x1p-53; };
  int gone_on = 0;
  for (int scene = 0; scene < 6; ++scene) {
    Mesh begin;
    const auto add = [&begin](const std::array<Point_3, 4>& p) {
      std::array<Vertex_index, 4> v;
      std::transform(p.begin(), p.end(), v.begin(), [&](const Point_3& q) { return begin.add_vertex(q); });
      begin.add_face(v[0], v[2], v[1]), begin.add_face(v[0], v[1], v[3]);
      begin.add_face(v[1], v[2], v[3]), begin.add_face(v[2], v[0], v[3]);
      return v[3];
    };
    const Vertex_index tip = add({Point_3(-1, -1, -1), {1, -1, -1}, {0, 1, -1}, {0, 0, 0.2}});
    for (int i = -4; i <= 4; ++i) // a ceiling of crumbs
      for (int j = -4; j <= 4; ++j) {
        const double x = 0.3 * i, y = 0.3 * j, z = 0.5 + uniform(0.3);
        add({Point_3(x, y, z), {x + 0.25, y, z + 0.05}, {x, y + 0.25, z + 0.02}, {x + 0.05, y + 0.05, z + 0.3}});
      }
    const Point_3 target(0.15 * scene, 0.1, 3);
    for (const std::size_t bound : {60, 160, 260, 360}) {
      const auto portion = Drag_parameters().work_limit(bound);
      const auto drags = [&](bool asks) { // until they come to an end
        Mesh mesh = begin;
        Sculptor<Mesh> sculptor(mesh);
        auto grab = sculptor.grab(tip);
        int k = 1;
        while (grab.drag_to(target, portion).end == Drag_end::work_limit && k++ < 300)
          if (asks)
            BOOST_TEST(sculptor.first_impact(tip, target).has_value() == first_impact(mesh, tip, target).has_value());
        return std::make_pair(k, mesh.point(tip));
      };
      const auto alone = drags(false);
      gone_on += alone.first > 2 && alone.first < 300;
      BOOST_TEST((drags(true) == alone));
    }
  }
  BOOST_TEST(gone_on > 8);
}

// What stands within half a star's width of a large star may be more than any bound, and is no reason to stay.
BOOST_AUTO_TEST_CASE(a_large_star_over_a_fine_surface_follows_the_hand) {
  for (const std::size_t valence : {6, 64}) {
    auto list = meshes::bumpy_sphere(5, 0.05).scale_and_move(10, 0, 0, -10);
    list +=
        meshes::bipyramid(valence).scale_and_move(12, 0, 0, 17); // the lower tip, the last vertex, 5 over the sphere
    Mesh mesh = meshes::to_mesh(list);
    Sculptor<Mesh> sculptor(mesh, parameters::work_limit(400 + 4 * valence));
    const Vertex_index tip(static_cast<Mesh::size_type>(mesh.number_of_vertices() - 1));
    auto grab = sculptor.grab(tip);
    int cut = 0;
    Point_3 hand = mesh.point(tip);
    for (int k = 0; k < 250; ++k) {
      const double angle = 0.05 * std::min(k, 200); // it rests at last
      hand = Point_3(6 * std::sin(0.71 * angle), 6 * std::sin(0.53 * angle), 3 + 2 * std::cos(angle));
      cut += grab.drag_to(hand).end == Drag_end::work_limit;
    }
    BOOST_TEST_MESSAGE("valence " << valence << ": cut short in " << cut << " drags");
    BOOST_TEST(cut < 50);
    BOOST_TEST((mesh.point(tip) == hand));
  }
}
