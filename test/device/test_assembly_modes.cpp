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
  const auto pose = forward_by_all_modes<double>(parameters, theta, mode.angles());
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
  const auto straight = general_forward(parameters, nowhere);
  BOOST_TEST((straight.status() == Device_status::undecided));
  BOOST_TEST(straight.shortfall() > 0);
  BOOST_TEST((forward_by_all_modes(parameters, nowhere).status() == Device_status::no_real_mode));
  BOOST_TEST(forward_by_all_modes(parameters, nowhere).shortfall() > 0);
}

/// The sign of the determinant of the closure's derivative, by differences.
bool is_on_positive_sheet(const internal::Platform_closure<double>& closure, const Vector& phi) {
  Device_matrix<double> derivative;
  for (int j = 0; j < 3; ++j) {
    const Vector step = 1e-6 * Vector::Unit(j);
    derivative.col(j) = closure.residual(Link_angles<double>::from(phi + step)) -
                        closure.residual(Link_angles<double>::from(phi - step));
  }
  return derivative.determinant() > 0;
}

/// The same of the symmetric pose at the mean angle; where the links do not close there, of one with longer links.
bool is_home_positive(const Device_parameters<double>& parameters, const Vector& theta) {
  Device_pose<double> pose;
  internal::place_elbows(parameters, Vector::Constant(theta.mean()).eval(), pose);
  Link_angles<double> x;
  if (!internal::symmetric_home(parameters, theta.mean(), x))
    return parameters.base_radius() + parameters.primary_length() * std::cos(theta.mean()) > 0;
  return is_on_positive_sheet({parameters, pose.elbows}, x.angles());
}

// Where the elbows stand crosswise the home sheet is the other one, and its platform is above them as well.
BOOST_AUTO_TEST_CASE(with_crosswise_elbows_the_platform_stays_above_them) {
  auto description = named_design<double>(Named_design::D1, Device_form::general);
  description.base_radius = 0.03, description.primary_length = 0.09;
  description.secondary_length = 0.06, description.platform_radius = 0.02;
  const Device_parameters<double> parameters(description);
  const Vector theta(2.1, 1.54, 2.41);
  BOOST_REQUIRE((forward_kinematics(parameters, theta).status() == Device_status::undecided));
  const auto pose = forward_by_all_modes(parameters, theta);
  BOOST_REQUIRE(static_cast<bool>(pose));
  const Vector normal = (pose->elbows.col(1) - pose->elbows.col(0)).cross(pose->elbows.col(2) - pose->elbows.col(0));
  const double height = std::abs(normal.normalized().dot(pose->position - pose->elbows.col(0)));
  BOOST_TEST(height > 0.038);
  BOOST_TEST(height < 0.0382);
}

BOOST_AUTO_TEST_CASE(what_is_undecided_is_decided_by_all_modes) {
  BOOST_TEST_MESSAGE("seed " << seed + 4);
  Random random(seed + 4);
  int straight = 0, decided = 0, none = 0, again = 0, twins = 0; // twins: the other mode about a fold
  int crosswise = 0;                                             // beyond the elbows' meeting in the middle
  for (int k = 0; k < 20000; ++k) {
    const Device_parameters<double> parameters(k % 2 ? random_design(random, Device_form::general)
                                                     : named_design<double>(Named_design::D2, Device_form::general));
    const Vector theta = random_angles(random, -0.5, 2.5);
    const auto followed = forward_kinematics(parameters, theta), best = forward_by_all_modes(parameters, theta);
    BOOST_REQUIRE((best.status() != Device_status::undecided));
    if (followed) {
      ++straight;
      BOOST_REQUIRE((best && best->position == followed->position && best->orientation == followed->orientation));
      continue;
    }
    BOOST_REQUIRE((followed.status() == Device_status::undecided));
    Device_pose<double> pose;
    internal::place_elbows(parameters, theta, pose);
    const internal::Platform_closure<double> closure(parameters, pose.elbows);
    const auto modes = assembly_modes(parameters, theta);
    BOOST_REQUIRE(static_cast<bool>(modes));
    const bool is_positive = is_home_positive(parameters, theta);
    crosswise += best && !is_positive;
    int at_home = 0;
    for (int m = 0; m < modes->count; ++m) {
      const Vector phi = modes->modes[m].angles();
      at_home += is_on_positive_sheet(closure, phi) == is_positive;
      const auto there = forward_by_all_modes<double>(parameters, theta, phi); // a mode is the one nearest to itself
      BOOST_REQUIRE(static_cast<bool>(there));
      BOOST_TEST(residual(parameters, *there) < 1e-9);
      const Link_angles<double> found{there->cos_phi, there->sin_phi};
      ++(internal::angular_distance(found, modes->modes[m]) < 1e-6 ? again : twins);
    }
    if (best) {
      ++decided;
      BOOST_TEST(residual(parameters, *best) < 1e-9);
      BOOST_TEST((at_home > 0 && is_on_positive_sheet(closure, best->phi()) == is_positive));
    } else {
      ++none;
      BOOST_TEST((best.status() == Device_status::no_real_mode && best.shortfall() > 0));
      BOOST_TEST(at_home == 0);
    }
  }
  BOOST_TEST_MESSAGE(straight << " straight, " << decided << " by all modes, " << crosswise
                              << " of them with crosswise elbows, " << none << " none; " << again
                              << " modes found again, " << twins << " twins");
  BOOST_TEST(twins * 1000 < again);
  BOOST_TEST((straight > 5000 && decided > 500 && none > 1000 && crosswise > 5));
}

namespace {

/// Derivative of the closure by differences.
Device_matrix<double> slopes(const internal::Platform_closure<double>& closure, const Vector& phi) {
  Device_matrix<double> g;
  for (int j = 0; j < 3; ++j) {
    const Vector step = 1e-5 * Vector::Unit(j);
    g.col(j) = (closure.residual(Link_angles<double>::from(phi + step)) -
                closure.residual(Link_angles<double>::from(phi - step))) /
               2e-5;
  }
  return g;
}

Vector by_newton(const internal::Platform_closure<double>& closure, Vector phi) {
  for (int iteration = 0; iteration < 5; ++iteration)
    phi -= slopes(closure, phi).partialPivLu().solve(closure.residual(Link_angles<double>::from(phi)));
  return phi;
}

/// The difference of angles, the short way round.
Vector way_between(const Vector& from, const Vector& to) {
  constexpr double turn = 6.283185307179586;
  return (to - from).unaryExpr([](double x) { return std::remainder(x, turn); });
}

double distance_of(const Vector& a, const Vector& b) {
  return way_between(a, b).cwiseAbs().maxCoeff();
}

/// The least part of a way at which the sheet has changed.
double part_to_the_fold(const internal::Platform_closure<double>& closure, const Vector& start, const Vector& way) {
  const bool home = is_on_positive_sheet(closure, start);
  double low = 0, high = 1;
  for (int k = 1; k <= 200 && high == 1; ++k)
    if (is_on_positive_sheet(closure, start + k / 200.0 * way) != home)
      low = (k - 1) / 200.0, high = k / 200.0;
  for (int k = 0; k < 40; ++k) {
    const double middle = (low + high) / 2;
    (is_on_positive_sheet(closure, start + middle * way) == home ? low : high) = middle;
  }
  return low;
}

/// Whether two modes are about a fold: elbows are moved so that the one goes straight towards the other, as far as the
/// singular pose between them, and the other has to come to meet it.
bool merge(const internal::Platform_closure<double>& closure, const Vector& one, const Vector& other) {
  const Vector way = way_between(one, other);
  const double fold = part_to_the_fold(closure, one, way);
  Vector goes = one, comes = other;
  for (int k = 1; k < 100; ++k) {
    goes = one + fold * (1 - std::pow(1 - k / 100.0, 2)) * way;
    internal::Platform_closure<double> moved = closure;
    moved.separation_squared += closure.residual(Link_angles<double>::from(goes));
    comes = by_newton(moved, comes);
  }
  return distance_of(goes, comes) < 0.1 * distance_of(one, other);
}

} // namespace

BOOST_AUTO_TEST_CASE(of_a_far_seed_the_nearest_mode_is_found_but_for_a_twin_about_a_fold) {
  BOOST_TEST_MESSAGE("seed " << seed + 5);
  Random random(seed + 5);
  int nearest = 0, twins = 0;
  for (int k = 0; k < 2000; ++k) {
    const Device_parameters<double> parameters(k % 2 ? random_design(random, Device_form::general)
                                                     : named_design<double>(Named_design::D1, Device_form::general));
    const Vector theta = random_angles(random, 0.3, 1.8), phi = random_vector(random, 3.14);
    const auto modes = assembly_modes(parameters, theta);
    const auto found = forward_by_all_modes<double>(parameters, theta, phi);
    BOOST_REQUIRE(static_cast<bool>(modes));
    BOOST_REQUIRE(static_cast<bool>(found) == (modes->count > 0));
    if (!found)
      continue;
    Vector best = modes->modes[0].angles();
    for (int m = 1; m < modes->count; ++m)
      if (distance_of(modes->modes[m].angles(), phi) < distance_of(best, phi))
        best = modes->modes[m].angles();
    if (distance_of(found->phi(), best) < 1e-6) {
      ++nearest;
      continue;
    }
    ++twins;
    Device_pose<double> pose;
    internal::place_elbows(parameters, theta, pose);
    const internal::Platform_closure<double> closure(parameters, pose.elbows);
    const bool is_positive = is_home_positive(parameters, theta);
    BOOST_TEST(is_on_positive_sheet(closure, found->phi()) == is_positive);
    BOOST_TEST(is_on_positive_sheet(closure, best) != is_positive);
    BOOST_TEST(distance_of(found->phi(), best) < distance_of(best, phi));
    BOOST_TEST(merge(closure, best, found->phi()));
  }
  BOOST_TEST_MESSAGE(nearest << " nearest modes, " << twins << " twins");
  BOOST_TEST((twins > 20 && twins * 20 < nearest));
}

BOOST_AUTO_TEST_CASE(about_a_fold_the_home_sheet_is_taken_unless_the_seed_is_closer_than_the_twin) {
  BOOST_TEST_MESSAGE("seed " << seed + 6);
  Random random(seed + 6);
  int tried[3] = {};
  for (int k = 0; k < 600; ++k) {
    const double half = std::pow(10.0, -2 - 2 * (k % 3)); // of the way between the two, rad
    const Device_parameters<double> parameters(random_design(random, Device_form::general));
    const Vector theta = random_angles(random, 0.3, 1.8);
    const internal::Home_sheet<double> sheet(parameters, theta.mean());
    const bool is_positive = is_home_positive(parameters, theta);
    Device_pose<double> pose;
    internal::place_elbows(parameters, theta, pose);
    internal::Platform_closure<double> closure(parameters, pose.elbows);
    const Vector start = random_vector(random, 3), way = random_vector(random, 3);
    const double part = part_to_the_fold(closure, start, way);
    if (part > 0.99)
      continue;
    const Vector fold = start + part * way;
    const Device_matrix<double> g = slopes(closure, fold).transpose();
    Vector null = g.col(0).cross(g.col(1));
    for (int j = 0; j < 2; ++j)
      if (const Vector other = g.col(j).cross(g.col(2)); other.norm() > null.norm())
        null = other;
    null /= null.cwiseAbs().maxCoeff();
    // Such elbows that there is a mode at one side of the fold.
    const Vector one = fold + half * null;
    closure.separation_squared += closure.residual(Link_angles<double>::from(one));
    const Vector other = by_newton(closure, fold - half * null);
    const bool one_at_home = is_on_positive_sheet(closure, one) == is_positive;
    if (!(distance_of(other, fold - half * null) < 0.2 * half) ||
        (is_on_positive_sheet(closure, other) == is_positive) ==
            one_at_home) // no plain fold, or further ones beside it
      continue;
    const auto modes = internal::assembly_modes(closure);
    BOOST_REQUIRE(static_cast<bool>(modes));
    int near = 0;
    for (int m = 0; m < modes->count; ++m)
      near += distance_of(modes->modes[m].angles(), fold) < 30 * half;
    if (near != 2)
      continue;
    ++tried[k % 3];
    const Vector home = one_at_home ? one : other, away = one_at_home ? other : one, outward = away - home;
    for (const double distance : {0.2, 5.0}) {
      Link_angles<double> x;
      const auto seed_angles = Link_angles<double>::from(away + distance * outward);
      BOOST_REQUIRE(internal::nearest_mode(closure, sheet, *modes, seed_angles, x));
      BOOST_TEST(distance_of(x.angles(), distance < 1 ? away : home) < 0.1 * half);
    }
  }
  BOOST_TEST_MESSAGE(tried[0] << ", " << tried[1] << " and " << tried[2] << " folds");
  for (const int folds : tried)
    BOOST_TEST(folds > 100);
}

BOOST_AUTO_TEST_SUITE_END()
