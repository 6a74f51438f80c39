// SPDX-License-Identifier: GPL-3.0-or-later
#include "device/kinematics_of_tests.h"

#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

BOOST_AUTO_TEST_SUITE(device_kinematics)

namespace {

/// Newton's method on the literal nine equations for the platform joints: shares nothing with the three-angle form.
bool nine_equation_newton(const Device_parameters<double>& parameters, const Device_matrix<double>& elbows,
                          Device_matrix<double>& joints) {
  const double l2 = parameters.secondary_length();
  for (int iteration = 0; iteration < 60; ++iteration) {
    const Eigen::Matrix<double, 9, 1> f = nine_equation_residual(parameters, elbows, joints);
    Eigen::Matrix<double, 9, 9> a = Eigen::Matrix<double, 9, 9>::Zero();
    for (int i = 0; i < 3; ++i) {
      const int j = (i + 1) % 3, k = (i + 2) % 3;
      const Vector link = joints.col(i) - elbows.col(i), side = joints.col(j) - joints.col(k);
      a.block<1, 3>(i, 3 * i) = 2 * link.transpose();
      a.block<1, 3>(3 + i, 3 * j) = 2 * side.transpose();
      a.block<1, 3>(3 + i, 3 * k) = -2 * side.transpose();
      a.block<1, 3>(6 + i, 3 * i) = side.transpose();
      a.block<1, 3>(6 + i, 3 * j) = link.transpose();
      a.block<1, 3>(6 + i, 3 * k) = -link.transpose();
    }
    const Eigen::Matrix<double, 9, 1> step = (a / (l2 * l2)).partialPivLu().solve(-f);
    const double length = step.norm();
    if (!std::isfinite(length))
      return false;
    const double scale = std::min(1.0, l2 / length);
    for (int i = 0; i < 3; ++i)
      joints.col(i) += scale * step.segment<3>(3 * i);
    if (length < 1e-13 * l2)
      return nine_equation_residual(parameters, elbows, joints).cwiseAbs().maxCoeff() < 1e-12;
  }
  return false;
}

/// Joint positions of a mode.
Device_matrix<double> joints_of(const Device_parameters<double>& parameters, const Vector& theta,
                                const Link_angles<double>& mode) {
  const auto pose = general_forward_from_seed<double>(parameters, theta, mode.angles());
  return pose ? pose->joints : Device_matrix<double>::Constant(1e9);
}

} // namespace

BOOST_AUTO_TEST_CASE(all_assembly_modes_agree_with_a_multi_start_on_the_nine_equations) {
  Random random(seed + 3);
  int histogram[17] = {}, disagreements = 0, unfound = 0;
  for (int k = 0; k < 1000; ++k) {
    Device_description<double> d = random_design(random, Device_form::general);
    Vector theta = random_angles(random, -0.5, 2.5);
    if (k == 0) { // a pose with all sixteen modes
      d.base_radius = 0.0294, d.primary_length = 0.0501, d.secondary_length = 0.0999, d.platform_radius = 0.0117;
      theta = Vector(0.27996571178272395, 1.0618810578283944, 0.8095540682859562);
    }
    if (k % 10 == 1) // two legs alike: solutions share a cosine
      theta[1] = theta[2];
    const Device_parameters<double> parameters(d);
    const auto modes = assembly_modes(parameters, theta);
    BOOST_REQUIRE(static_cast<bool>(modes));
    ++histogram[modes->count];
    std::vector<Device_matrix<double>> ours, theirs;
    for (int m = 0; m < modes->count; ++m) {
      ours.push_back(joints_of(parameters, theta, modes->modes[m]));
      Device_pose<double> pose;
      internal::place_elbows(parameters, theta, pose);
      BOOST_TEST(nine_equation_residual(parameters, pose.elbows, ours.back()).cwiseAbs().maxCoeff() < 1e-9);
    }
    Device_pose<double> pose;
    internal::place_elbows(parameters, theta, pose);
    for (int start = 0; start < 4000 && (start < 100 || theirs.size() < ours.size()); ++start) {
      Device_matrix<double> joints;
      for (int leg = 0; leg < 3; ++leg)
        joints.col(leg) = pose.elbows.col(leg) + parameters.secondary_length() * random_vector(random, 1).normalized();
      if (!nine_equation_newton(parameters, pose.elbows, joints))
        continue;
      const auto same = [&](const Device_matrix<double>& other) {
        return (other - joints).norm() < 1e-7 * parameters.secondary_length();
      };
      if (std::none_of(theirs.begin(), theirs.end(), same)) {
        theirs.push_back(joints);
        disagreements += std::none_of(ours.begin(), ours.end(), same);
      }
    }
    unfound += theirs.size() < ours.size();
  }
  std::string shown;
  for (int n = 0; n <= 16; ++n)
    if (histogram[n])
      shown += " " + std::to_string(n) + ":" + std::to_string(histogram[n]);
  BOOST_TEST_MESSAGE("modes:" << shown << "; found by the multi-start alone " << disagreements
                              << ", cases where it found fewer " << unfound);
  BOOST_TEST(disagreements == 0);
  BOOST_TEST(unfound == 0);
  BOOST_TEST(histogram[16] > 0);
}

BOOST_AUTO_TEST_CASE(a_lost_mode_is_said_to_be_lost) {
  const Device_parameters<double> parameters(named_design<double>(Named_design::D2, Device_form::general));
  const auto home = general_forward(parameters, Vector(1, 1, 1));
  BOOST_REQUIRE(static_cast<bool>(home));
  const Vector nowhere(0.1904584149083411, 1.1809152650068884, 0.1780662577282751); // has no real mode
  const auto lost = general_forward(parameters, nowhere, *home);
  BOOST_TEST((lost.status() == Device_status::mode_lost));
  BOOST_TEST(lost.shortfall() > 0);
  BOOST_TEST((general_forward(parameters, nowhere).status() == Device_status::no_real_mode));
  BOOST_TEST(general_forward(parameters, nowhere).shortfall() > 0);
}

BOOST_AUTO_TEST_SUITE_END()
