// SPDX-License-Identifier: GPL-3.0-or-later
// The force of the spring and the damper, and how late it is when it is held from tick to tick.
#include "haptic_rendering/devices_of_tests.h"

#include <haptic_sculpt/haptic_rendering/Force_renderer.h>
#include <haptic_sculpt/haptic_rendering/Virtual_coupling.h>
#include <haptic_sculpt/device/simulation/Torque_delay.h>

#include <seeds_and_sizes.h>

#include <boost/test/unit_test.hpp>

#include <Eigen/SVD>

#include <algorithm>
#include <cmath>

using namespace haptic_sculpt;
using namespace haptic_rendering_tests;

namespace {

BOOST_AUTO_TEST_CASE(damping_acts_along_pushes_only_and_only_while_held) {
  Random random(haptic_sculpt::test::seed_from_environment(2));
  const Virtual_coupling coupling{1000, 2};
  for (int i = 0; i < 1000; ++i) {
    const Vector3d v = random_vector(random), n = random_vector(random).normalized(),
                   m = random_vector(random).normalized();
    if (n.cross(m).norm() < 2 * Contact_span::least_new_part)
      continue;
    Contact_span one, two, three;
    one.add(n), two.add(n), two.add(m), two.add((n + m).normalized());
    BOOST_TEST(one.size() == 1);
    BOOST_TEST(two.size() == 2);
    BOOST_TEST((coupling.damping_force(one, v, false) + 2 * n * n.dot(v)).norm() <= 1e-14 * v.norm());
    const Vector3d across = n.cross(m).normalized(); // the least-squares projection on the plane of n and m
    BOOST_TEST((coupling.damping_force(two, v, false) + 2 * (v - across * across.dot(v))).norm() <= 1e-12 * v.norm());
    three.add(n), three.add(m), three.add(across);
    BOOST_TEST((coupling.damping_force(three, v, false) + 2 * v).norm() <= 1e-12 * v.norm());
    BOOST_TEST(coupling.damping_force(one, v, true) == Vector3d::Zero());
  }
}

BOOST_AUTO_TEST_CASE(the_force_that_is_held_lags_by_no_more_than_the_rate_explains) {
  const Device_parameters<double> parameters = device(Device_form::ditetrahedral, 0.005);
  const auto home = home_pose(parameters);
  const double speed = 0.06, stiffness = 500;
  for (const double rate : {250.0, 1000.0, 4000.0, 10000.0})
    for (const double delay : {0.0, 0.5, 1.0}) {
      Handle_motion handle(parameters, *home, 1 / rate);
      Force_renderer renderer(no_limits(), Virtual_coupling(), Gravity_compensation::none, 1 / rate);
      Torque_delay<double> held(delay);
      double sum = 0, largest = 0;
      int samples = 0;
      Device_pose<double> pose = *home;
      const int ticks = static_cast<int>(0.1 * rate), parts = 8;
      for (int k = 0; k < ticks; ++k)
        for (int part = 0; part < parts; ++part) {
          const double fraction = (part + 0.5) / parts, time = (k + fraction) / rate;
          const auto depth_at = [&](double t) { return Vector3d(0, 0, -speed * t); };
          if (part == 0) {
            const auto now = reach_position(parameters, pose, Vector3d(home->position + depth_at(k / rate)));
            pose = *now;
            handle.follow(pose.theta);
            held.command(renderer.render(handle, -stiffness * (handle.position() - home->position)).interaction_torque);
          }
          if (k < 3)
            continue; // nothing has come through yet
          const auto there = reach_position(parameters, pose, Vector3d(home->position + depth_at(time)));
          const Vector3d torque = fraction < held.fraction() ? held.before() : held.after();
          const Vector3d felt = jacobian(parameters, *there)->linear.transpose().partialPivLu().solve(torque);
          const double error = (felt + stiffness * depth_at(time)).norm();
          sum += error, largest = std::max(largest, error), ++samples;
        }
      const double unit = stiffness * speed / rate;
      BOOST_TEST_MESSAGE(rate << " Hz, delay " << delay << ": mean error " << sum / samples << " N, "
                              << sum / samples / unit << " k v T; largest " << largest / unit << " k v T");
      // J turns while the torque is held: a few per cent of the force of that moment more.
      BOOST_TEST(sum / samples <= unit * (0.5 + delay) * 1.1);
      BOOST_TEST(largest <= unit * (1 + delay) * 1.2);
    }
}

BOOST_AUTO_TEST_CASE(the_part_of_a_vector_in_a_span_is_the_nearest_combination_of_the_normals) {
  Random random(haptic_sculpt::test::seed_from_environment(61));
  for (int i = 0; i < 300; ++i) {
    const int normals = 1 + i % 4;
    Contact_span span;
    const Vector3d any = random_vector(random, 1);
    BOOST_TEST(span.part(any) == Vector3d::Zero());
    Eigen::MatrixXd columns(3, normals);
    for (int k = 0; k < normals; ++k) { // the third in the plane of the two before
      const Vector3d normal = k == 2 ? Vector3d(columns.col(0) - 2 * columns.col(1)) : random_vector(random, 1);
      span.add(normal);
      columns.col(k) = normal.normalized();
    }
    const Eigen::JacobiSVD<Eigen::MatrixXd> svd(columns, Eigen::ComputeThinU);
    Vector3d nearest = Vector3d::Zero();
    bool is_clear = true; // no two of them nearly the same
    for (int k = 0; k < svd.singularValues().size(); ++k)
      if (const double value = svd.singularValues()[k]; value > 1e-9) {
        is_clear = is_clear && value > 0.2;
        nearest += svd.matrixU().col(k).dot(any) * svd.matrixU().col(k);
      }
    if (is_clear)
      BOOST_TEST((span.part(any) - nearest).norm() <= 1e-9);
  }
}

} // namespace
