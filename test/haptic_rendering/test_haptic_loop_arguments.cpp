// SPDX-License-Identifier: GPL-3.0-or-later
// What a loop and its parts are given: limits that are made, arguments and couplings that are refused.
#include "haptic_rendering/map_of_tests.h"
#include "meshes/generated_meshes.h"

#include <haptic_sculpt/haptic_rendering.h>

#include <boost/test/unit_test.hpp>

#include <cmath>
#include <limits>
#include <string>

using namespace haptic_sculpt;
using haptic_rendering_tests::map_of_tests;
using Eigen::Vector3d;
using Mesh = meshes::Mesh;

BOOST_AUTO_TEST_CASE(a_loop_that_is_given_no_limits_makes_them_for_the_box_of_the_mesh_and_a_tenth_beyond) {
  for (const double unit : {1.0, 0x1p900, 0x1p-900}) {
    Mesh mesh = meshes::to_mesh(meshes::box(1, 1)); // [0, unit]^3
    for (const auto v : mesh.vertices())
      mesh.point(v) = {unit * mesh.point(v).x(), unit * mesh.point(v).y(), unit * mesh.point(v).z()};
    Sculptor<Mesh> sculptor(mesh);
    Device_description<double> description = named_design<double>(Named_design::D1, Device_form::ditetrahedral);
    description.viscous_friction = 0.005, description.encoder_step = 1.53e-4;
    const Device_parameters<double> device(description);
    const auto home = home_pose(device);
    const Workspace_map map(40 * unit, Vector3d::Zero(), unit * Vector3d(0.5, 0.5, 0.5), home->position);
    const double half = (0.5 + 0.1 * std::sqrt(3.0)) / 40; // m
    const Worst_pose worst = worst_pose(device, Force_limits(), [&](const Vector3d& p) {
      return (p - home->position).lpNorm<Eigen::Infinity>() <= half;
    });
    const double passive = 2 * 0.005 / (worst.greatest * worst.greatest * worst.fading) / 0.001;
    BOOST_TEST(passive > 1000);
    Haptic_parameters parameters;
    parameters.limits.ramp_time = 0;
    const auto loop = [&](double share) {
      parameters.coupling.stiffness = share * passive;
      return Haptic_loop<Sculptor<Mesh>>(sculptor, device, *home, map, parameters);
    };
    BOOST_CHECK_THROW(loop(1.001), Unstable_coupling);
    auto made = loop(0.999);
    Joint_reading reading;
    reading.theta = home->theta;
    BOOST_TEST((made.tick(reading).fault == Loop_fault::none));
    BOOST_TEST(*made.parameters().controller_damping > 0); // half of the largest, of the limits
  }
}

BOOST_AUTO_TEST_CASE(arguments_are_refused_by_name_where_they_are_given) {
  const auto refuses = [](const std::string& name, const auto& make) {
    BOOST_CHECK_EXCEPTION(make(), Error, [&](const Error& error) {
      BOOST_TEST_MESSAGE(error.what());
      return std::string(error.what()).find(name) != std::string::npos;
    });
  };
  Mesh mesh = meshes::to_mesh(meshes::box(1, 1));
  Sculptor<Mesh> sculptor(mesh);
  const Device_parameters<double> device(named_design<double>(Named_design::D1, Device_form::ditetrahedral));
  const auto home = home_pose(device);
  const Haptic_parameters parameters;
  const Vector3d one(1, 1, 1);
  const auto limits = [&](const Vector3d& lower, const Vector3d& upper, double b, double tick, double delay,
                          double cutoff, const Force_limits& forces = Force_limits()) {
    passivity_limits(device, forces, map_of_tests, lower, upper, b, tick, delay, cutoff);
  };
  const double inf = std::numeric_limits<double>::infinity();
  for (const double bad : {std::nan(""), inf, -1.0}) {
    refuses("delay of the torques", [&] { Passivity_observer(bad, 0.001, 0.005, 0); });
    refuses("tick of a Passivity_observer", [&] { Passivity_observer(0, bad, 0.005, 0); });
    refuses("friction of a Passivity_observer", [&] { Passivity_observer(0, 0.001, bad, 0); });
    refuses("encoder step of a Passivity_observer", [&] { Passivity_observer(0, 0.001, 0.005, bad); });
    refuses("damping of a Passivity_controller", [&] { Passivity_controller(bad, 0.001); });
    refuses("tick of a Passivity_controller", [&] { Passivity_controller(1, bad); });
    refuses("damping of a Passivity_controller",
            [&] { Interaction<Joint_side>(Joint_side(device, *home, parameters), parameters, bad); });
    refuses("reach of a Tool", [&] { Tool<Sculptor<Mesh>>(sculptor, map_of_tests, bad, 0.001); });
    refuses("tick of a Tool", [&] { Tool<Sculptor<Mesh>>(sculptor, map_of_tests, 0.001, bad); });
    refuses("damping of passivity_limits()", [&] { limits(-one, one, bad, 0.001, 0, 100); });
    refuses("tick of passivity_limits()", [&] { limits(-one, one, 0, bad, 0, 100); });
    refuses("delay of passivity_limits()", [&] { limits(-one, one, 0, 0.001, bad, 100); });
    refuses("cutoff of passivity_limits()", [&] { limits(-one, one, 0, 0.001, 0, bad); });
    Force_limits forces;
    forces.full_condition = bad;
    refuses("Force_limits::full_condition", [&] { limits(-one, one, 0, 0.001, 0, 100, forces); });
  }
  refuses("tick of a Passivity_observer", [] { Passivity_observer(0, 0, 0.005, 0); });
  refuses("tick of a Passivity_controller", [] { Passivity_controller(1, 0); });
  refuses("tick of passivity_limits()", [&] { limits(-one, one, 0, 0, 0, 100); });
  refuses("box of passivity_limits()", [&] { limits(Vector3d(0, 0, NAN), one, 0, 0.001, 0, 100); });
  refuses("box of passivity_limits()", [&] { limits(-one, Vector3d(0, inf, 0), 0, 0.001, 0, 100); });
  refuses("box of passivity_limits()", [&] { limits(Vector3d(0, 0, 1.1), one, 0, 0.001, 0, 100); });
}

BOOST_AUTO_TEST_CASE(a_coupling_that_is_not_passive_is_refused) {
  Passivity_limits limits;
  limits.passive_stiffness = 400;
  BOOST_CHECK_THROW(check_coupling({401, 0}, limits), Unstable_coupling);
  BOOST_CHECK_THROW(check_coupling({NAN, 0}, limits), Unstable_coupling);
  check_coupling({400, 0}, limits);
  limits.calm_stiffness = 300; // where it ends first, which a higher rate does not change
  BOOST_CHECK_EXCEPTION(check_coupling({500, 0}, limits), Unstable_coupling, [](const Unstable_coupling& error) {
    const std::string what = error.what();
    return what.find("not calm") != std::string::npos && what.find("finer encoders") != std::string::npos;
  });
}

// What a message names, can be done: a snap is weakened, a damping that the friction bounds is lessened.
BOOST_AUTO_TEST_CASE(a_refusal_names_what_is_too_much) {
  Passivity_limits limits;
  limits.passive_stiffness = 800, limits.friction = limits.largest_damping = 0.5;
  Haptic_parameters parameters;
  parameters.coupling = {500, 0};
  check_forces(parameters, limits);
  const auto is_said = [&](const std::string& words) {
    BOOST_CHECK_EXCEPTION(check_forces(parameters, limits), Unstable_coupling, [&](const Unstable_coupling& error) {
      return std::string(error.what()).find(words) != std::string::npos;
    });
  };
  parameters.snap.length = 0.004, parameters.snap.force = 1;
  is_said("the stiffness 1000 N/m, of which the snap has 500 (2 force / length), is not passive");
  parameters.snap.length = 0, parameters.coupling = {500, 0.6};
  is_said("its friction at the handle, 0.5 N s/m");
  parameters.coupling = {900, 0.1};
  is_said("a smaller damping");
}
