// SPDX-License-Identifier: GPL-3.0-or-later
// Drags on machine parts and near-degenerate solids: no end may have a free straight way to somewhere nearer.
#include "sculpting/clearances.h"
#include "sculpting/response/end_certificate.h"
#include "sculpting/response/part_scenes.h"

#include <boost/test/unit_test.hpp>

using namespace haptic_sculpt;
using namespace haptic_sculpt::test;

namespace {

struct End_counts {
  std::size_t drags = 0, certified = 0, missed = 0;
};

/// Grabs of two drags each, all kept, so that the scene is deformed more and more.
End_counts drag_and_certify(const Part_scene& scene, std::size_t drags, Random& random, Response response) {
  Mesh mesh = scene.mesh;
  Sculptor<Mesh> sculptor(mesh, parameters::response(response));
  End_certifier certifier(mesh);
  End_counts ends;
  std::vector<Point_3> probes = scene.probes;
  // \param v null: of a probe
  const auto drag_and_look = [&](auto& held, Vertex_index v, const Point_3& source) {
    const Point_3 target = part_target(scene, mesh, v, source, random);
    const auto result = held.drag_to(target);
    const double c = clearance_kept(sculptor, result);
    ++ends.drags;
    if (result.reached)
      return result.position;
    const auto found = certifier.certify(v, result.position, target, std::sqrt(CGAL::squared_distance(source, target)),
                                         c, 0, random, 300);
    ends.certified += found.asked;
    ends.missed += found.gain > 0 || result.end == Drag_end::stuck;
    if (found.gain > 0)
      BOOST_TEST_MESSAGE(scene.family << ": nearer by " << found.gain / c << " c");
    return result.position;
  };
  while (ends.drags < drags) {
    if (!probes.empty() && random() % 4 == 0) {
      Point_3& p = probes[random() % probes.size()];
      auto probe = sculptor.probe(p, Probe_start::anywhere);
      for (int i = 0; i < 2 && probe; ++i)
        p = drag_and_look(probe, Vertex_index(), p);
      continue;
    }
    const Vertex_index v = part_vertex(scene, mesh, random);
    auto grab = sculptor.grab(v);
    for (int i = 0; i < 2; ++i)
      drag_and_look(grab, v, mesh.point(v));
  }
  BOOST_TEST(validate(mesh).is_valid());
  return ends;
}

End_counts drag_in_all_families(Response response, std::size_t first, std::size_t last, std::size_t drags,
                                Random& random) {
  constexpr std::size_t per_scene = 20;
  End_counts all;
  for (std::size_t done = 0; done < drags; done += per_scene)
    for (std::size_t family = first; family < last; ++family) {
      const End_counts ends = drag_and_certify(part_scene(family, random), per_scene, random, response);
      all.drags += ends.drags, all.certified += ends.certified, all.missed += ends.missed;
    }
  BOOST_TEST_MESSAGE(all.drags << " drags, " << all.certified << " ends certified, " << all.missed << " missed");
  return all;
}

/// How many may be missed beyond the rate: among few drags chance is larger than that.
std::size_t chance() { return share_of_sizes() < 1 ? 5 : 1; }

} // namespace

BOOST_AUTO_TEST_CASE(no_end_on_a_part_is_too_early) {
  Random random(seed_from_environment(801));
  const End_counts ends = drag_in_all_families(Response::slide, 0, first_near_degenerate_family,
                                               count_from_environment("HAPTIC_SCULPT_CERTIFIED", 200), random);
  BOOST_TEST(is_enough(ends.certified, 500));
  BOOST_TEST(ends.missed <= chance() + ends.drags / 250); // doc/results/slide.md
}

BOOST_AUTO_TEST_CASE(few_ends_on_near_degenerate_solids_are_too_early) {
  Random random(seed_from_environment(802));
  const End_counts ends = drag_in_all_families(Response::slide, first_near_degenerate_family, part_families().size(),
                                               count_from_environment("HAPTIC_SCULPT_CERTIFIED", 200), random);
  BOOST_TEST(is_enough(ends.certified, 250));
  // 1.6 % of 19,200 drags with 24 seeds (doc/results/slide.md), and four standard deviations of a number as small.
  const double expected = 0.016 * static_cast<double>(ends.drags);
  BOOST_TEST(static_cast<double>(ends.missed) <= expected + 4 * std::sqrt(expected));
}

BOOST_AUTO_TEST_CASE(the_certificate_knows_an_end_that_is_too_early) {
  // A stop is hardly ever a minimum.
  Random random(seed_from_environment(803));
  const End_counts ends = drag_in_all_families(Response::stop, 0, first_near_degenerate_family, 20, random);
  BOOST_TEST(3 * ends.missed > ends.certified);
}

BOOST_AUTO_TEST_CASE(a_slot_that_closes_by_less_than_a_clearance_is_gone_through) {
  // Two plates, 1 to 2.2 clearances apart, that close by 0.05 to 0.8 clearances on a long way. A probe between them is
  // pressed at one and the other, and is drawn to where they are nearer: it cannot keep its clearance, and can go on.
  const unsigned seed = seed_from_environment(804);
  Random random(seed);
  std::uniform_real_distribution<double> number(-1, 1);
  const auto between = [&](double low, double high) { return low + (high - low) * (1 + number(random)) / 2; };
  std::size_t drags = 0, certified = 0, missed = 0, gave_up = 0;
  for (int scene = 0; scene < 60; ++scene) {
    const double c = 1e-3, gap = between(1, 2.2) * c, closing = between(0.05, 0.8) * c;
    meshes::Triangle_list list = meshes::tetrahedron();
    list += meshes::tetrahedron();
    list.points = {Point_3(-8, -8, 0),
                   Point_3(0, 8, 0),
                   Point_3(8, -8, 0),
                   Point_3(0, 0, -3),
                   Point_3(-8, -8, gap + closing),
                   Point_3(8, -8, gap - closing),
                   Point_3(0, 8, gap),
                   Point_3(0, 0, 3)};
    Mesh mesh = meshes::to_mesh(list);
    BOOST_REQUIRE_MESSAGE(validate(mesh).is_valid(), validate(mesh).message());
    Sculptor<Mesh> sculptor(mesh);
    End_certifier certifier(mesh);
    auto probe = sculptor.probe(Point_3(-3, -4, 0.5 * gap));
    BOOST_REQUIRE(bool(probe));
    sculptor.set_drag_parameters(Drag_parameters().clearance(c)); // with which it could not begin here
    for (int i = 0; i < 6; ++i) {
      const Point_3 source = probe.position();
      const Point_3 target(source.x() + between(0.2, 1), -4 + number(random),
                           i % 2 == 0 ? between(0, 0.3) : -between(0, 0.3));
      const auto result = probe.drag_to(target);
      ++drags;
      if (result.reached)
        continue;
      const auto found = certifier.certify(Vertex_index(), result.position, target,
                                           std::sqrt(CGAL::squared_distance(source, target)), c, 0, random, 300);
      certified += found.asked;
      missed += found.gain > 0;
      gave_up += result.end == Drag_end::stuck;
      if (found.gain > 0)
        BOOST_TEST_MESSAGE("scene " << scene << ", drag " << i << ": nearer by " << found.gain / c << " c");
    }
    BOOST_TEST(validate(mesh).is_valid());
  }
  BOOST_TEST_MESSAGE("seed " << seed << ": " << drags << " drags, " << certified << " ends certified, " << missed
                             << " missed, " << gave_up << " gave up");
  BOOST_TEST(is_enough(certified, 250));
  BOOST_TEST(missed == 0u); // with a last look that takes such a gap for a corner: 20 to 34
  BOOST_TEST(gave_up <= drags / 60);
}
