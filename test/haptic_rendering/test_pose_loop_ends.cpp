// SPDX-License-Identifier: GPL-3.0-or-later
// A loop that is ended from without, or enters another scene.
#include "haptic_rendering/pose_readings.h"
#include "meshes/generated_meshes.h"

#include <haptic_sculpt/haptic_rendering.h>

#include <boost/test/unit_test.hpp>

#include <cmath>
#include <memory>
#include <string>

using namespace haptic_sculpt;
using namespace exchange_tests;

namespace {

/// The box [0, 1]^3, moved, and its Sculptor.
struct Box_scene {
  meshes::Mesh mesh;
  Sculptor<meshes::Mesh> sculptor;
  explicit Box_scene(double up)
      : mesh(meshes::to_mesh(meshes::box(1, 1).scale_and_move(1, 0, 0, up))), sculptor(mesh) {}
};

struct Pressing {
  std::unique_ptr<Box_scene> scene = std::make_unique<Box_scene>(0);
  Pose_loop_parameters parameters = parameters_of_tests();
  Pose_loop<Sculptor<meshes::Mesh>> loop{scene->sculptor, map_of_tests, parameters};
  double port = 0; ///< J, taken from the hand
  Vector3d handle = map_of_tests.to_device(Vector3d(0.5, 0.4, 1.2)), force = Vector3d::Zero();

  /// \param z in the scene
  const Haptic_tick& go(double z) {
    const Vector3d before = handle;
    Pose_reading reading;
    reading.position = handle = map_of_tests.to_device(Vector3d(0.5, 0.4, z)), reading.elapsed = 0.001;
    port -= force.dot(handle - before);
    const Haptic_tick& tick = loop.tick(reading);
    force = tick.rendered.force;
    return tick;
  }
  void press() {
    for (int k = 0; k < 400; ++k)
      go(1.2);
    for (int k = 0; k <= 300; ++k)
      go(1.2 - 0.001 * k); // to a depth of 0.1
  }
};

BOOST_AUTO_TEST_CASE(a_loop_that_is_ended_from_without_fades_as_after_a_fault_and_its_observer_has_seen_all_work) {
  Pressing p;
  p.press();
  const double pressed = p.force.norm();
  BOOST_TEST(std::abs(pressed - p.parameters.coupling.stiffness * 0.1 / map_of_tests.scale()) <= 1e-9);
  BOOST_TEST(std::abs(p.loop.observer().port() - p.port) <= 1e-12);
  BOOST_TEST(p.port > 1e-4);
  p.loop.end_by(Loop_fault::log);
  const Haptic_tick ended = p.go(0.9);
  BOOST_TEST((ended.fault == Loop_fault::log && ended.is_new_fault));
  BOOST_TEST(std::abs(p.force.norm() - 0.99 * pressed) <= 1e-9 * pressed); // of 100 ms
  for (int k = 0; k < 98; ++k)
    BOOST_TEST(!p.go(0.9).is_new_fault);
  BOOST_TEST(!p.loop.has_stopped());
  p.go(0.9);
  BOOST_TEST((p.loop.has_stopped() && p.force == Vector3d::Zero()));
}

BOOST_AUTO_TEST_CASE(a_loop_in_another_scene_begins_without_force_and_the_old_scene_may_be_gone) {
  Pressing p;
  p.press();
  BOOST_REQUIRE(p.force.norm() > 0.5);
  Box_scene other(-0.05); // its upper face is at 0.95
  p.loop.enter(other.sculptor, map_of_tests);
  p.scene.reset();
  BOOST_TEST(p.go(1.2).rendered.force == Vector3d::Zero());
  for (int k = 0; k <= 300; ++k)
    BOOST_TEST((p.go(1.2 - 0.001 * k).fault == Loop_fault::none));
  for (int k = 0; k < 50; ++k)
    p.go(0.9);
  const double depth = 0.05 / map_of_tests.scale();
  BOOST_TEST((p.force - Vector3d(0, 0, p.parameters.coupling.stiffness * depth)).norm() <= 1e-6);
  BOOST_TEST((p.loop.map() == map_of_tests));
}

BOOST_AUTO_TEST_CASE(a_fault_that_no_tick_has_said_outlives_a_restart_and_another_scene) {
  for (const bool enters : {false, true}) {
    Pressing p;
    p.press();
    Box_scene other(-0.05);
    const auto begin_anew = [&] { enters ? p.loop.enter(other.sculptor, map_of_tests) : p.loop.restart(); };
    p.loop.end_by(Loop_fault::stall);
    begin_anew();
    const Haptic_tick said = p.go(1.2);
    BOOST_TEST((said.fault == Loop_fault::stall && said.is_new_fault));
    begin_anew(); // now it is over
    BOOST_TEST((p.go(1.2).fault == Loop_fault::none));
    p.loop.attempt([] { throw Error("a viewer's"); });
    begin_anew();
    BOOST_TEST((p.go(1.2).fault == Loop_fault::error));
    BOOST_TEST(std::string(p.loop.failure()) == "a viewer's");
    p.loop.restart();
    BOOST_TEST((p.go(1.2).fault == Loop_fault::none));
    BOOST_TEST(std::string(p.loop.failure()).empty());
  }
}

} // namespace
