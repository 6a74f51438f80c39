// SPDX-License-Identifier: GPL-3.0-or-later
#include "haptic_rendering/devices_of_tests.h"

#include <haptic_sculpt/haptic_rendering/Force_renderer.h>
#include <haptic_sculpt/haptic_rendering/Refusal_burst.h>
#include <haptic_sculpt/haptic_rendering/simulation/Simulated_device.h>

#include <seeds_and_sizes.h>

#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <cmath>

using namespace haptic_sculpt;
using namespace haptic_rendering_tests;

namespace {

constexpr double rates[] = {250, 333, 500, 1000, 4000, 10000};

Vector3d random_direction(Random& random) {
  std::normal_distribution<double> number;
  const double x = number(random), y = number(random), z = number(random);
  return Vector3d(x, y, z).normalized();
}

BOOST_AUTO_TEST_CASE(a_burst_has_no_mean_and_no_first_moment) {
  for (const double rate : rates)
    for (const double mass : {0.005, 0.03, 0.2}) {
      Refusal_burst burst(1 / rate);
      burst.begin(Vector3d(0, 0, 2), 1 / mass);
      double sum = 0, moment = 0, largest = 0, velocity = 0, place = 0, farthest = 0;
      for (int k = 0; !burst.is_over(); ++k) {
        const Vector3d force = burst.next();
        sum += force[2], moment += force[2] * k, largest = std::max(largest, std::abs(force[2]));
        for (int part = 0; part < 16; ++part) { // a free mass, the force held
          place += velocity / rate / 16 + force[2] / mass / rate / rate / 512;
          velocity += force[2] / mass / rate / 16;
          farthest = std::max(farthest, std::abs(place));
        }
      }
      BOOST_TEST(std::abs(sum) <= 1e-12);
      BOOST_TEST(std::abs(moment) <= 1e-9);
      BOOST_TEST(std::abs(place) <= 1e-12); // it is back
      BOOST_TEST(largest <= 1);
      BOOST_TEST(farthest <= 1.0001 * Refusal_burst::farthest);
      BOOST_TEST((largest >= 0.9 || farthest >= 0.95 * Refusal_burst::farthest)); // no less than is needed
      BOOST_TEST(burst.next() == Vector3d::Zero());
      BOOST_TEST_MESSAGE(rate << " Hz, " << mass << " kg: burst of " << largest << " N moves it by " << 1e3 * farthest
                              << " mm");
    }
}

BOOST_AUTO_TEST_CASE(a_refused_edit_moves_the_handle_by_less_than_a_tenth_of_a_millimetre) {
  Random random(haptic_sculpt::test::seed_from_environment(21));
  std::uniform_real_distribution<double> angle(0.4, 1.6);
  Simulated_hand open_hand; // touches nothing
  open_hand.stages = 1;
  for (const Device_form form : {Device_form::ditetrahedral, Device_form::general}) {
    const Device_parameters<double> parameters = device(form);
    for (const double rate : rates) {
      double farthest = 0, least_peak = 10;
      for (int round = 0; round < 12;) {
        const double a = angle(random), b = angle(random), c = angle(random);
        const auto pose = forward_kinematics(parameters, Vector3d(a, b, c));
        if (!pose || !(translation_conditioning(*jacobian(parameters, *pose)).condition <= 10))
          continue;
        const Hand_path path({{0, pose->position, 0}});
        const Simulated_hand hands[] = {Simulated_hand::finger(), Simulated_hand::arm(), open_hand};
        Simulated_device with(parameters, *pose, hands[round % 3], path, 1 / rate, 0), without = with;
        Handle_motion handle(parameters, *pose, 1 / rate), other = handle;
        Force_renderer renderer(Force_limits(), Virtual_coupling(), Gravity_compensation::spatial, 1 / rate),
            quiet = renderer;
        for (int k = 0; k < 0.5 * rate; ++k)
          handle.follow(pose->theta), renderer.render(handle, Vector3d::Zero()); // the ramp is over
        renderer.refuse(handle, random_direction(random));
        double peak = 0;
        for (int k = 0; k < 0.1 * rate; ++k) {
          handle.follow(with.read().theta), other.follow(without.read().theta);
          const Rendered_force felt = renderer.render(handle, Vector3d::Zero()),
                               nothing = quiet.render(other, Vector3d::Zero());
          BOOST_REQUIRE((with.write(felt.torque, felt.interaction_torque) == Device_status::success));
          BOOST_REQUIRE((without.write(nothing.torque, nothing.interaction_torque) == Device_status::success));
          peak = std::max(peak, felt.force.norm());
          farthest = std::max(farthest, (with.state().pose.position - without.state().pose.position).norm());
        }
        least_peak = std::min(least_peak, peak);
        ++round;
      }
      BOOST_TEST_MESSAGE((form == Device_form::general ? "general" : "di-tetrahedral")
                         << ", " << rate << " Hz: a refused edit moves the handle by at most " << 1e3 * farthest
                         << " mm; bursts of at least " << least_peak << " N");
      BOOST_TEST(farthest <= 1e-4);
      BOOST_TEST(least_peak >= 0.1);
    }
  }
}

BOOST_AUTO_TEST_CASE(a_burst_under_way_is_not_felt_after_a_restart) {
  const Device_parameters<double> parameters = device(Device_form::general, 0.005);
  const auto pose = forward_kinematics(parameters, Vector3d(1, 1, 1));
  BOOST_REQUIRE(static_cast<bool>(pose));
  Handle_motion handle(parameters, *pose, 0.001);
  Force_renderer renderer(Force_limits(), Virtual_coupling(), Gravity_compensation::spatial, 0.001);
  for (int k = 0; k < 500; ++k)
    handle.follow(pose->theta), renderer.render(handle, Vector3d::Zero()); // the ramp is over
  for (const bool restarts : {false, true}) {
    renderer.refuse(handle, Vector3d::UnitZ());
    double most = 0;
    for (int k = 0; k < 500; ++k) {
      if (k == 20) {
        BOOST_TEST(most > 0.01);
        most = 0;
        if (restarts)
          renderer.restart();
      }
      most = std::max(most, renderer.render(handle, Vector3d::Zero()).force.norm());
    }
    BOOST_TEST((most == 0) == restarts);
  }
}

BOOST_AUTO_TEST_CASE(a_hand_that_turns_with_a_burst_takes_what_the_documents_say) {
  const auto given = [](double tick) { // J, at 1 m/s
    const Refusal_burst burst(tick);
    double sum = 0;
    for (int k = 0; k < burst.samples(); ++k)
      sum += std::abs(burst.sample(k)) * tick;
    return sum;
  };
  for (double tick = 1e-5; tick <= 0.0125; tick *= 1.01)
    BOOST_TEST(given(tick) <= 0.025, "a tick of " << tick << " s: " << given(tick) << " J");
  BOOST_TEST(std::abs(given(1e-3) - 0.016) < 5e-4); // as at 1 kHz
}

BOOST_AUTO_TEST_CASE(a_burst_gives_its_samples_and_none_once_it_is_cut) {
  for (const double tick : {0.0001, 0.001, 0.004}) {
    Refusal_burst burst(tick);
    BOOST_TEST(std::abs(burst.samples() * tick - Refusal_burst::duration) <= tick / 2 + 1e-12);
    const Vector3d up(0, 0, 1);
    burst.begin(up, 1e-9); // as good as immovable: the whole amplitude
    for (int k = 0; k < burst.samples() / 2; ++k) {
      BOOST_TEST((burst.next() - burst.sample(k) * up).norm() <= 1e-15);
      BOOST_TEST(burst.sample(k) == burst.sample(burst.samples() - 1 - k));
    }
    BOOST_TEST(!burst.is_over());
    burst.cut();
    BOOST_TEST(burst.is_over());
    BOOST_TEST(burst.next() == Vector3d::Zero());
  }
}

} // namespace
