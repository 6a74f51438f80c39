// SPDX-License-Identifier: GPL-3.0-or-later
// Parameters: what follows from them, and what is refused of them.
#include "haptic_rendering/devices_of_tests.h"

#include <haptic_sculpt/haptic_rendering/Passivity_limits.h>
#include <haptic_sculpt/haptic_rendering/Pose_loop.h>
#include <haptic_sculpt/haptic_rendering/simulation/Simulated_hand.h>

#include <boost/test/unit_test.hpp>

#include <cmath>
#include <string>

using namespace haptic_sculpt;
using namespace haptic_rendering_tests;

namespace {

BOOST_AUTO_TEST_CASE(a_coupling_is_as_stiff_as_spring_and_snap_and_needs_friction_for_both) {
  Haptic_parameters parameters;
  parameters.coupling = {300, 0.7}, parameters.tick = 0.002, parameters.delay = 1.5;
  BOOST_TEST(parameters.stiffest().stiffness == 300);
  parameters.snap.length = 0.01, parameters.snap.force = 2; // 2 N within half of the length
  const Virtual_coupling both = parameters.stiffest();
  BOOST_TEST(both.stiffness == 300 + 400);
  BOOST_TEST(both.damping == 0.7);
  // With just so much friction the stiffness is at the passive limit.
  BOOST_TEST(std::abs(passive_stiffness(parameters.needed_friction(), 0.7, 0.002, 1.5) / both.stiffness - 1) <= 1e-12);
}

BOOST_AUTO_TEST_CASE(parts_that_are_checked_by_themselves_name_what_no_device_has) {
  const auto refuses = [](const char* name, const auto& part) {
    BOOST_CHECK_EXCEPTION(part.check(), Error, [&](const Error& error) {
      return std::string(error.what()).find(name) != std::string::npos;
    });
  };
  Force_limits().check(), Virtual_coupling().check(), Virtual_mass_parameters().check(), Simulated_hand::arm().check();
  Force_limits forces;
  forces.largest = NAN;
  refuses("largest force", forces);
  refuses("stiffness", Virtual_coupling{-1, 0});
  Virtual_mass_parameters mass;
  mass.mass = 11;
  refuses("virtual mass", mass);
  Simulated_hand hand = Simulated_hand::arm();
  hand.stage[1].mass = 0;
  refuses("stage 1", hand);
  hand.stages = 4;
  refuses("4", hand);
  Haptic_parameters parameters;
  parameters.reach = 1e-9;
  parameters.coupling.stiffness = Virtual_coupling::most_stiffness;
  parameters.check();
  parameters.snap.length = 0.01;
  refuses("that of the snap", parameters);
  parameters.coupling.stiffness = 0;
  parameters.check();
  parameters.reach = 0;
  refuses("from 1e-09 to 1 m", parameters);
}

} // namespace
