// SPDX-License-Identifier: GPL-3.0-or-later
// What the paper's walk says it is held by holds it where it is, and still does so when it is asked again.
#include "sculpting/Mover_hand.h"
#include "sculpting/Random_scene.h"
#include "sculpting/response/outside_scenes.h"

#include <haptic_sculpt/sculpting/paper_1997.h>

#include <boost/test/unit_test.hpp>

using namespace haptic_sculpt;
using namespace haptic_sculpt::test;

namespace {

/// How far p is from the nearest contact plane, in default clearances there; 0 where a contact is flat.
double clearances_from_contacts(const Drag_result<Mesh>& result) {
  const auto coordinates = [](const Point_3& p) { return internal::Coordinates{p.x(), p.y(), p.z()}; };
  double least = std::numeric_limits<double>::infinity();
  for (const auto& contact : result.contacts) {
    const Point_3 &a = contact.plane[0], &b = contact.plane[1], &c = contact.plane[2];
    if (contact.is_flat)
      return 0;
    const double height = std::sqrt(CGAL::squared_distance(meshes::Kernel::Plane_3(a, b, c), result.position));
    double reach = internal::largest_magnitude(coordinates(result.position));
    for (const Point_3& p : {a, b, c})
      reach = std::fmax(reach, internal::largest_magnitude(coordinates(p)));
    least = std::fmin(least, height / internal::default_clearance(reach));
  }
  return least;
}

} // namespace

BOOST_AUTO_TEST_CASE(the_papers_walk_names_what_holds_it_where_it_is) {
  const std::uint64_t seed = seed_from_environment(512);
  const std::size_t drags = count_from_environment("HAPTIC_SCULPT_PAPER_DRAGS", 2000);
  Random random(seed);
  std::size_t held = 0, held_again = 0, unfinished = 0, lost = 0, away = 0;
  double most = 0;
  const std::vector<Outside_scene> scenes = outside_scenes(random);
  for (const Outside_scene& scene : scenes) {
    Random own(seed_of(scene.name, seed));
    Mover_hand hand(scene.mesh, scene.moved, parameters::response(Response::paper()));
    for (std::size_t done = 0; done < drags / scenes.size(); ++done) {
      const Point_3 target = outside_target(scene, hand.mesh, own);
      for (int again = 0; again < 3; ++again) {
        const auto result = hand.drag_to(target);
        if (result.end == Drag_end::held || result.end == Drag_end::leg_limit) {
          (result.end == Drag_end::leg_limit ? unfinished : again == 0 ? held : held_again) += 1;
          const double distance = clearances_from_contacts(result);
          most = std::fmax(most, distance);
          away += distance > 16;
        }
        lost += again > 0 && result.end == Drag_end::no_progress;
      }
    }
  }
  BOOST_TEST_MESSAGE(held << " held, " << held_again << " again, " << unfinished << " at the limit of legs, " << lost
                          << " by nothing then; at most " << most << " clearances from what holds them, " << away
                          << " beyond 16");
  BOOST_TEST(away == 0u);
  BOOST_TEST(lost == 0u);
  BOOST_TEST(is_enough(held, 200));
  BOOST_TEST(is_enough(held_again, 200));
}
