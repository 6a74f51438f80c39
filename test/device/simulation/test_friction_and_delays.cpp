// SPDX-License-Identifier: GPL-3.0-or-later
// Friction of the joints, steps of the encoders, the delay of torques.
#include "device/simulation/coupled_hand.h"

#include <boost/test/unit_test.hpp>

#include <cmath>
#include <vector>

BOOST_AUTO_TEST_SUITE(device_simulation)

BOOST_AUTO_TEST_CASE(friction_encoders_and_delays_are_what_they_say) {
  Device_description<double> d =
      with_friction(named_design<double>(Named_design::D1, Device_form::general), 3e-4, 2e-3);
  d.encoder_step = 1.53e-4;
  const Device_parameters<double> parameters(d);
  Random random(seed + 2);
  for (int k = 0; k < 1000; ++k) {
    const Vector rate = random_vector(random, k % 2 ? 5 : 0.05), torque = joint_friction(parameters, rate),
                 theta = random_vector(random, 3);
    BOOST_TEST((torque + joint_friction(parameters, Vector(-rate))).norm() < 1e-17); // 0, unless products are fused
    const Vector measured = measured_angles(parameters, theta);
    for (int joint = 0; joint < 3; ++joint) {
      BOOST_TEST(torque[joint] * rate[joint] <= 0);
      BOOST_TEST(std::abs(torque[joint] + 3e-4 * rate[joint]) <= 2e-3);
      BOOST_TEST(std::abs(torque[joint] + 3e-4 * rate[joint] + 2e-3 * std::tanh(rate[joint] / 0.02)) < 1e-17);
      BOOST_TEST(std::abs(measured[joint] - theta[joint]) <= 1.53e-4 / 2 * (1 + 1e-9));
      const double count = measured[joint] / 1.53e-4;
      BOOST_TEST(std::abs(count - std::round(count)) < 1e-9);
    }
  }
  BOOST_TEST(coulomb_rate<double>() == 0.02);
  BOOST_TEST(joint_friction(parameters, Vector(HUGE_VAL, 1, -HUGE_VAL))[0] == -HUGE_VAL);
  for (const double finest : {5e-324, 1e-310}) { // more of them in an angle than there are doubles
    d.encoder_step = finest;
    BOOST_TEST((measured_angles(Device_parameters<double>(d), Vector(0.1, -0.2, 3)) == Vector(0.1, -0.2, 3)));
  }
  d.encoder_step = 1; // the doubles beside halves
  BOOST_TEST((measured_angles(Device_parameters<double>(d), Vector(0.49999999999999994, 0.5, -0.49999999999999994)) ==
              Vector(0, 1, 0)));
  BOOST_TEST((measured_angles(Device_parameters<double>(d), Vector(-0.5, 0x1p52 - 1.5, 1.4999999999999998)) ==
              Vector(0, 0x1p52 - 1, 1)));
  d.encoder_step = 0;
  BOOST_TEST((measured_angles(Device_parameters<double>(d), Vector(0.1, -0.2, 0.3)) - Vector(0.1, -0.2, 0.3)).norm() ==
             0);
  for (double Device_description<double>::*member :
       {&Device_description<double>::viscous_friction, &Device_description<double>::coulomb_friction,
        &Device_description<double>::encoder_step})
    for (double value : {-1e-9, double(HUGE_VAL), std::nan("")}) {
      Device_description<double> bad = d;
      bad.*member = value;
      BOOST_TEST(violations(bad).size() == 1u);
    }

  for (double delay : {0.0, 0.25, 0.999, 1.0, 1.6, 2.0, 15.5, 16.0}) { // against the torque as a function of time
    Torque_delay<double> held(delay);
    std::vector<Vector> commanded;
    const auto in_force = [&](double ticks) { // commanded at tick k, in force from k + delay to k + 1 + delay
      const double k = std::floor(ticks - delay);
      return k < 0 ? Vector(Vector::Zero()) : commanded[static_cast<std::size_t>(k)];
    };
    for (int tick = 0; tick < 100; ++tick) {
      commanded.push_back(random_vector(random, 1));
      held.command(commanded.back());
      const double fraction = held.fraction();
      BOOST_TEST(std::abs(delay - std::floor(delay) - fraction) == 0);
      Vector sum = Vector::Zero();
      for (int part = 0; part < 1000; ++part)
        sum += in_force(tick + (part + 0.5) / 1000) / 1000;
      BOOST_TEST((held.mean() - sum).norm() < 2e-3);
      BOOST_TEST((held.after() - in_force(tick + (1 + fraction) / 2)).norm() == 0);
      if (fraction > 0)
        BOOST_TEST((held.before() - in_force(tick + fraction / 2)).norm() == 0);
    }
  }
  for (double delay : {-1e-9, 16.001, double(HUGE_VAL), std::nan("")})
    BOOST_CHECK_THROW(Torque_delay<double>{delay}, Error);
}

BOOST_AUTO_TEST_SUITE_END()
