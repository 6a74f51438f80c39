// SPDX-License-Identifier: GPL-3.0-or-later
// What a call, and no button, puts into the hand: where it is then, the tool is.
#include "haptic_rendering/pose_readings.h"
#include "meshes/generated_meshes.h"

#include <haptic_sculpt/haptic_rendering.h>

#include <boost/test/unit_test.hpp>

using namespace haptic_sculpt;
using namespace exchange_tests;

namespace {

/// A hand at rest above the box [0, 1]^3.
struct Resting_hand {
  using Mesh = meshes::Mesh;
  using Vertex_index = Mesh::Vertex_index;
  Mesh mesh = meshes::to_mesh(meshes::box(1, 1));
  Sculptor<Mesh> sculptor{mesh};
  Pose_loop<Sculptor<Mesh>> loop{sculptor, map_of_tests, parameters_of_tests()};
  Vector3d place{0.5, 0.4, 1.2};

  const Haptic_tick& go(int ticks, int button = 0) {
    const Haptic_tick* tick = nullptr;
    for (int k = 0; k < ticks; ++k)
      tick = &loop.tick(Pose_reading{map_of_tests.to_device(place), button, 0.001});
    BOOST_REQUIRE((tick->fault == Loop_fault::none));
    return *tick;
  }
  Vertex_index corner_at(const Vector3d& p) const {
    for (const Vertex_index v : mesh.vertices())
      if (internal::vector_of(mesh.point(v)) == p)
        return v;
    return Vertex_index();
  }
};

BOOST_AUTO_TEST_CASE(closed_again_a_clutch_goes_on_from_what_was_put_into_the_hand_meanwhile) {
  for (const bool restarts : {false, true})
    for (const int ticks_before : {0, 50}) {
      Resting_hand hand;
      if (ticks_before > 0)
        hand.go(ticks_before);
      hand.loop.open_clutch();
      hand.go(10);
      const Vector3d put{-0.7, 2, 0.6};
      BOOST_REQUIRE(hand.loop.tool().take_probe(put));
      BOOST_TEST((hand.go(1).tool.proxy == put));
      if (restarts)
        hand.loop.restart();
      hand.place += Vector3d(0.1, 0.1, 0.3); // the handle alone
      BOOST_TEST((hand.go(5).tool.proxy == put));
      hand.loop.open_clutch(false);
      double farthest = 0;
      for (int k = 0; k < 1000; ++k)
        farthest = std::fmax(farthest, (hand.go(1).tool.proxy - put).norm());
      BOOST_TEST(farthest <= 1e-12);
      BOOST_TEST((hand.loop.map().to_scene(map_of_tests.to_device(hand.place)) - put).norm() <= 1e-12);
    }
  Resting_hand hand;
  hand.go(50);
  hand.loop.open_clutch();
  hand.loop.tool().take(hand.corner_at({1, 1, 1}));
  BOOST_TEST((hand.go(3).tool.proxy == Vector3d(1, 1, 1)));
  hand.loop.tool().take(hand.corner_at({0, 1, 0}));
  hand.loop.open_clutch(false);
  BOOST_TEST((hand.go(100).tool.proxy - Vector3d(0, 1, 0)).norm() <= 1e-12);
  // What is let go of under an open clutch leaves the tool where it was.
  hand.loop.open_clutch();
  hand.loop.tool().take(hand.corner_at({1, 0, 1}));
  hand.go(1);
  hand.loop.tool().let_go();
  BOOST_TEST((hand.go(1).tool.proxy == Vector3d(1, 0, 1)));
}

// It is let go of by a press and a release: the press takes it again, whatever is where the bare hand would be.
BOOST_AUTO_TEST_CASE(a_press_keeps_the_vertex_that_a_call_has_put_into_the_hand) {
  for (const bool is_near_another : {true, false}) {
    Resting_hand hand;
    hand.place = is_near_another ? Vector3d(1.0137, 1, 1.01) : Vector3d(0.5371, 0.4, 1.2);
    hand.go(50);
    const auto far = hand.corner_at({0, 0, 1});
    hand.loop.tool().take(far);
    hand.go(50);
    BOOST_TEST((hand.go(1, 1).tool.event == Tool_event::grabbed));
    hand.go(50, 1);
    BOOST_TEST((hand.loop.tool().vertex() == far));
    BOOST_TEST((hand.mesh.point(far) - meshes::Point_3(0, 0, 1)).squared_length() <= 1e-30);
    hand.go(50);
    BOOST_TEST(!hand.loop.tool().holds_vertex());
    BOOST_TEST(hand.loop.tool().edits().refused == 0u);
  }
}

BOOST_AUTO_TEST_CASE(a_zoom_that_a_restart_forgets_leaves_the_map) {
  Resting_hand hand;
  hand.go(50);
  hand.loop.zoom(3);
  hand.loop.end_by(Loop_fault::stall);
  hand.loop.tick(Pose_reading{map_of_tests.to_device(hand.place), 0, 0.001});
  hand.place += Vector3d(0.3, 0.1, 0.2);
  hand.loop.restart();
  hand.go(1);
  BOOST_TEST((hand.loop.map() == map_of_tests));
}

} // namespace
