// SPDX-License-Identifier: GPL-3.0-or-later
// The hand of the simulated device: the path that it wants to go, and where it rests.
#include "haptic_rendering/devices_of_tests.h"

#include <haptic_sculpt/haptic_rendering/Force_renderer.h>
#include <haptic_sculpt/haptic_rendering/simulation/Hand_path.h>
#include <haptic_sculpt/haptic_rendering/simulation/Simulated_device.h>

#include <boost/test/unit_test.hpp>

#include <string>

using namespace haptic_sculpt;
using namespace haptic_rendering_tests;

namespace {

BOOST_AUTO_TEST_CASE(paths_are_read_or_refused_by_line_and_column) {
  const Hand_path path = Hand_path::parse("t,x,y,z,button\n0,0,0,0.1,0\r\n1,1e-2,-0.02,0.1,1\n", "p");
  BOOST_TEST((path.at(0.25).position - Vector3d(0.0025, -0.005, 0.1)).norm() <= 1e-17);
  BOOST_TEST((path.at(0.25).velocity - Vector3d(0.01, -0.02, 0)).norm() <= 1e-17);
  BOOST_TEST(path.at(0.99).button == 0);
  BOOST_TEST(path.at(1).button == 1);
  BOOST_TEST(path.at(7).velocity == Vector3d::Zero());
  const auto refused = [](const char* text, const char* where) {
    try {
      Hand_path::parse(text, "p");
      BOOST_ERROR("not refused: " << text);
    } catch (const Hand_path_error& error) {
      BOOST_TEST(std::string(error.what()).find(where) != std::string::npos, error.what() << " does not say " << where);
    }
  };
  refused("", "p: line 1");
  refused("t,x,y,z\n0,0,0,0\n", "line 1, column 1");
  refused("t,x,y,z,button\n", "line 2");
  refused("t,x,y,z,button\n0,0,zero,0,0\n", "line 2, column 5");
  refused("t,x,y,z,button\n0,0,nan,0,0\n", "line 2, column 5");
  refused("t,x,y,z,button\n0,0,0,0\n", "line 2, column 8");
  refused("t,x,y,z,button\n0,0,0,0,0,0\n", "line 2, column 10");
  refused("t,x,y,z,button\n0,0,0,0,3\n", "line 2");
  refused("t,x,y,z,button\n0,0,0,0,0\n0,0,0,0,0\n", "line 3");
}

BOOST_AUTO_TEST_CASE(a_hand_comes_to_rest_where_it_wants_to_be) {
  const Hand_path path({{0, {0.004, 0.002, 0.136}, 0}});
  for (const Simulated_hand& hand : {Simulated_hand::finger(), Simulated_hand::arm()}) {
    const Device_parameters<double> parameters = device(Device_form::ditetrahedral, 0.005);
    Simulated_device simulated(parameters, *home_pose(parameters), hand, path, 0.001, 0);
    Handle_motion handle(parameters, *home_pose(parameters), 0.001);
    Force_renderer renderer(Force_limits(), Virtual_coupling(), Gravity_compensation::spatial, 0.001);
    for (int k = 0; k < 3000; ++k) {
      handle.follow(simulated.read().theta);
      const Rendered_force rendered = renderer.render(handle, Vector3d::Zero());
      simulated.write(rendered.torque, rendered.interaction_torque);
    }
    BOOST_TEST((simulated.state().pose.position - path.at(0).position).norm() <= 1e-4);
  }
}

} // namespace
