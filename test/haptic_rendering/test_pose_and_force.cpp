// SPDX-License-Identifier: GPL-3.0-or-later
// How what depends on the pose bounds the force while a hand moves along what it presses.
#include "haptic_rendering/devices_of_tests.h"

#include <haptic_sculpt/device/gravity_torque.h>
#include <haptic_sculpt/haptic_rendering/loop/Interaction.h>

#include <boost/test/unit_test.hpp>

#include <cmath>

namespace {

using namespace haptic_rendering_tests;

/// A hand in a plane wall through the home of the device. It gives and takes energy, J, by the angles of the joints.
class Wall_run {
public:
  Wall_run(const Device_parameters<double>& device, const Haptic_parameters& parameters, const Vector3d& normal)
      : device_(device)
      , parameters_(parameters)
      , normal_(normal)
      , home_(*home_pose(device))
      , pose_(home_)
      , place_(home_.position)
      , loop_(Joint_side(device, home_, parameters), parameters, 0) {}

  const Vector3d& home() const { return home_.position; }
  double given() const { return given_; } ///< to the hand, by the torques of the motors less the weight's
  double balance() const { return loop_.observer().balance(); } ///< of the observer, J
  double most_force() const { return most_force_; }
  Loop_fault fault() const { return loop_.fault(); }

  /// Straight, at 0.05 m/s.
  void go(const Vector3d& to) {
    const Vector3d from = place_;
    const int steps = std::max(1, int(std::ceil((to - from).norm() / 0.05 / parameters_.tick)));
    for (int k = 1; k <= steps; ++k)
      be_at(from + (to - from) * k / steps);
  }

  /// The wall goes away. \return the most by which the force rises in a tick, and changes
  std::pair<double, double> lose_the_wall() {
    has_wall_ = false;
    double rise = 0, change = 0;
    for (int k = 0; k < 100; ++k) {
      const Vector3d before = loop_.rendered().force;
      be_at(place_);
      rise = std::fmax(rise, loop_.rendered().force.norm() - before.norm());
      change = std::fmax(change, (loop_.rendered().force - before).norm());
    }
    BOOST_TEST(loop_.rendered().force == Vector3d::Zero());
    has_wall_ = true;
    return {rise, change};
  }

  double force() const { return loop_.rendered().force.norm(); }
  double most_force_since() const { return most_force_; } ///< the wall went
  void lose_the_wall_on_the_way_to(const Vector3d& to) {
    has_wall_ = false, most_force_ = 0;
    go(to);
  }

private:
  Device_parameters<double> device_;
  Haptic_parameters parameters_;
  Vector3d normal_;
  Device_pose<double> home_, pose_;
  Vector3d place_, torque_ = Vector3d::Zero();
  Interaction<Joint_side> loop_;
  bool is_first_ = true, has_wall_ = true;
  double given_ = 0, most_force_ = 0;

  void be_at(const Vector3d& place) {
    const Vector3d before = pose_.theta;
    const auto there = reach_position(device_, pose_, place, 30);
    BOOST_REQUIRE(static_cast<bool>(there));
    pose_ = *there, place_ = place;
    if (!is_first_)
      given_ += torque_.dot(pose_.theta - before);
    Joint_reading reading;
    reading.theta = pose_.theta, reading.torque = loop_.rendered().torque,
    reading.elapsed = is_first_ ? 0 : parameters_.tick;
    is_first_ = false;
    if (loop_.fault() == Loop_fault::none && loop_.follow(reading)) {
      Touch touch;
      const double depth = normal_.dot(home() - place);
      if (depth > 0 && has_wall_)
        touch.way = depth * normal_, touch.is_free = false, touch.span.add(normal_);
      loop_.render(touch);
    }
    loop_.end_tick();
    torque_ = loop_.rendered().interaction_torque;
    most_force_ = std::fmax(most_force_, loop_.rendered().force.norm());
  }
};

/// The force along a direction for which the motors have room beside the weight, N.
double room_at(const Device_parameters<double>& device, const Vector3d& place, const Vector3d& direction) {
  const auto pose = reach_position(device, *home_pose(device), place, 30);
  BOOST_REQUIRE(static_cast<bool>(pose));
  const auto J = jacobian(device, *pose);
  const Vector3d force = 5 * direction;
  return 5 * share_in_room(J->linear.transpose() * force, gravity_torque(device, *pose, *J), device.torque_limit());
}

/// Whose motors have room for any force. \param friction of a joint, N m s/rad
Device_parameters<double> strong_device(double friction) {
  Device_description<double> d = named_design<double>(Named_design::D1, Device_form::ditetrahedral);
  d.viscous_friction = friction, d.torque_limit = 10;
  return Device_parameters<double>(d);
}

} // namespace

BOOST_AUTO_TEST_SUITE(pose_and_force)

// In where the motors have room for little, along the wall, which costs nothing, and out where they have room for more.
BOOST_AUTO_TEST_CASE(no_energy_comes_of_where_the_motors_have_more_room) {
  const Device_parameters<double> parameters = device(Device_form::ditetrahedral);
  const Vector3d normal = Vector3d(0.279, 0.251, 0.927).normalized(), u = normal.unitOrthogonal(), v = normal.cross(u);
  Wall_run run(parameters, Haptic_parameters(), normal);
  const double radius = 0.8 * workspace_radius(parameters, *home_pose(parameters));
  Vector3d weak = run.home(), strong = weak;
  double least = 1e9, most = 0;
  for (int k = 0; k < 16; ++k) {
    const Vector3d place = run.home() + radius * (std::cos(k * EIGEN_PI / 8) * u + std::sin(k * EIGEN_PI / 8) * v);
    const double room = room_at(parameters, place, normal);
    if (room < least)
      least = room, weak = place;
    if (room > most)
      most = room, strong = place;
  }
  BOOST_REQUIRE(most > least + 1);
  const Vector3d air = 0.001 * normal, depth = -0.02 * normal;
  run.go(run.home() + air);
  for (int cycle = 0; cycle < 3; ++cycle)
    run.go(weak + air), run.go(weak + depth), run.go(strong + depth), run.go(strong + air);
  BOOST_TEST((run.fault() == Loop_fault::none));
  BOOST_TEST(run.given() < 0.0005); // J
  BOOST_TEST_MESSAGE("given to the hand: " << run.given() << " J");
  // Once nothing has been touched the force is whole again.
  BOOST_TEST(run.most_force() < least + 0.1);
  run.go(strong + depth);
  BOOST_TEST(run.most_force() > least + 0.5);
  // Where the proxy falls, what is left of the force does not rise to what the motors had no room for.
  run.go(strong + air), run.go(weak + air), run.go(weak + depth), run.go(strong + depth);
  const auto [rise, change] = run.lose_the_wall();
  BOOST_TEST(rise < 1e-12);   // N, by rounding
  BOOST_TEST(change < 0.301); // N: 300 N/s
}

// The same of the share by cond(J): fading from a stiff wall to a soft one gives nothing either.
BOOST_AUTO_TEST_CASE(no_energy_comes_of_where_the_force_fades_less) {
  const Device_parameters<double> parameters = strong_device(0.005);
  Haptic_parameters fading;
  fading.limits.full_condition = 1, fading.limits.no_condition = 3;
  const Vector3d normal = Vector3d::UnitZ();
  Wall_run run(parameters, fading, normal);
  const auto share = [&](const Vector3d& place) {
    const auto pose = reach_position(parameters, *home_pose(parameters), place, 30);
    return fading_by_condition(fading.limits, translation_conditioning(*jacobian(parameters, *pose)).condition);
  };
  const double radius = 0.8 * workspace_radius(parameters, *home_pose(parameters));
  const Vector3d away = run.home() + radius * Vector3d::UnitX(), depth = -0.008 * normal, air = 0.001 * normal;
  const bool is_home_strong = share(run.home()) > share(away);
  const Vector3d strong = is_home_strong ? run.home() : away, weak = is_home_strong ? away : run.home();
  BOOST_REQUIRE(share(strong + depth) > 1.2 * share(weak + depth));
  run.go(run.home() + air);
  for (int cycle = 0; cycle < 3; ++cycle)
    run.go(weak + air), run.go(weak + depth), run.go(strong + depth), run.go(strong + air);
  BOOST_TEST((run.fault() == Loop_fault::none));
  BOOST_TEST(run.given() < 0.001); // J
  BOOST_TEST_MESSAGE("given to the hand: " << run.given() << " J");
  run.go(weak + air), run.go(weak + depth), run.go(strong + depth);
  const auto [rise, change] = run.lose_the_wall();
  BOOST_TEST(rise < 1e-12);   // N, by rounding
  BOOST_TEST(change < 0.301); // N: 300 N/s
}

// Where it fades to nothing, whatever it was, nothing is left of it as the touch ends.
BOOST_AUTO_TEST_CASE(what_has_not_been_felt_does_not_come_when_the_touch_ends) {
  const Device_parameters<double> parameters = strong_device(0.005);
  const Device_pose<double> home = *home_pose(parameters);
  const double radius = 0.8 * workspace_radius(parameters, home);
  const Vector3d there = home.position + radius * Vector3d::UnitX(), depth(0, 0, -0.008), air(0, 0, 0.001);
  const auto condition = [&](const Vector3d& place) {
    return translation_conditioning(*jacobian(parameters, *reach_position(parameters, home, place, 30))).condition;
  };
  const bool is_home_good = condition(home.position + depth) < condition(there + depth);
  const Vector3d good = is_home_good ? home.position : there, bad = is_home_good ? there : home.position;
  const Vector3d back = 0.0001 * (good - bad).normalized();
  Haptic_parameters fading; // a tenth of a millimetre before the bad place all is lost
  fading.limits.full_condition = fading.limits.no_condition = condition(bad + depth + back);
  BOOST_REQUIRE(fading.limits.full_condition > std::fmax(condition(good), condition(good + depth)) + 0.1);
  Wall_run run(parameters, fading, Vector3d::UnitZ());
  run.go(home.position + air), run.go(good + air), run.go(good + depth);
  BOOST_TEST(run.force() > 1);
  run.go(bad + depth);
  BOOST_TEST(run.force() == 0);
  run.lose_the_wall_on_the_way_to(good + depth);
  BOOST_TEST(run.most_force_since() == 0);
}

// Beyond the clamp a spring gives back force times way, not half of stiffness times its square.
BOOST_AUTO_TEST_CASE(the_observer_keeps_no_more_of_friction_than_a_clamped_spring_gives_back) {
  const Device_parameters<double> parameters = strong_device(0.1);
  const Haptic_parameters defaults;
  Wall_run run(parameters, defaults, Vector3d::UnitZ());
  const double way = 0.025, force = defaults.limits.largest, stiffness = defaults.coupling.stiffness; // m
  BOOST_REQUIRE(stiffness * way > 2 * force);
  const Vector3d depth(0, 0, -way), aside(0.02, 0, 0);
  run.go(run.home() + depth);
  for (int pass = 0; pass < 8; ++pass)
    run.go(run.home() + depth + aside), run.go(run.home() + depth);
  const double reserve = 0.05 + 0.3 * force * force / defaults.limits.slew; // snap, burst and falls, J
  BOOST_TEST(std::abs(run.balance() - (reserve + force * way - 0.5 * force * force / stiffness)) < 0.002);
}

BOOST_AUTO_TEST_SUITE_END()
