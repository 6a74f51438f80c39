// SPDX-License-Identifier: GPL-3.0-or-later
#include "populations.h"
#include <array>
#include <boost/test/unit_test.hpp>

namespace {

using namespace device_populations;
using Vector = Device_vector<double>;
constexpr unsigned seed = 20240611;

double residual(const Device_parameters<double>& parameters, const Device_pose<double>& pose) {
  return nine_equation_residual(parameters, pose.elbows, pose.joints).cwiseAbs().maxCoeff();
}

/// Newton's method on the literal nine equations for the platform joints: shares nothing with the three-angle form.
bool nine_equation_newton(const Device_parameters<double>& parameters, const Device_matrix<double>& elbows, Device_matrix<double>& joints) {
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
Device_matrix<double> joints_of(const Device_parameters<double>& parameters, const Vector& theta, const Link_angles<double>& mode) {
  const auto pose = general_forward_from_seed<double>(parameters, theta, mode.angles());
  return pose ? pose->joints : Device_matrix<double>::Constant(1e9);
}

} // namespace

BOOST_AUTO_TEST_SUITE(device_kinematics)

BOOST_AUTO_TEST_CASE(nine_equations_hold_in_a_million_random_poses_of_each_form) {
  BOOST_TEST_MESSAGE("seed " << seed);
  Random random(seed);
  for (Device_form form : {Device_form::ditetrahedral, Device_form::general}) {
    int solved = 0, failed = 0;
    double worst = 0;
    for (int design = 0; design < 1000; ++design) {
      const Device_parameters<double> parameters(random_design(random, form));
      for (int k = 0; k < 1000; ++k) {
        const auto pose = forward_kinematics(parameters, random_angles(random, -0.5, 2.5));
        if (!pose) {
          ++failed;
          continue;
        }
        ++solved;
        const double r = residual(parameters, *pose);
        if (r > 1e-14) { // the condition number is at least 1, so below that there is nothing to divide by
          const auto c = conditioning(parameters, *pose);
          worst = std::max(worst, r / c->constraint_condition);
        } else
          worst = std::max(worst, r / 10);
      }
    }
    BOOST_TEST_MESSAGE((form == Device_form::general ? "general: " : "di-tetrahedral: ") << solved << " poses, " << failed << " refused, worst residual / condition " << worst);
    BOOST_TEST(worst <= 1e-14);
    BOOST_TEST(solved > 200000);
  }
}

BOOST_AUTO_TEST_CASE(there_and_back) {
  Random random(seed + 1);
  double worst_point = 0, worst_general = 0;
  int tried = 0, general_tried = 0, general_failed = 0;
  for (int k = 0; k < 20000; ++k) {
    const Device_parameters<double> parameters(random_design(random, Device_form::ditetrahedral));
    const Vector theta = random_angles(random, 0.2, 2);
    for (int mode : {1, -1}) {
      const auto pose = ditetrahedral_forward(parameters, theta, mode);
      if (!pose)
        continue;
      const auto c = conditioning(parameters, *pose);
      const auto all = ditetrahedral_inverse(parameters, pose->position);
      const Eigen::Vector3i knees = working_mode(parameters, *pose);
      const auto one = ditetrahedral_inverse(parameters, pose->position, knees);
      BOOST_REQUIRE((all && one));
      for (int leg = 0; leg < 3; ++leg) {
        const double sensitivity = c->constraint_condition / std::sqrt(std::max(all->one_minus_cosine[leg], 1e-15));
        worst_point = std::max(worst_point, std::abs(std::remainder((knees[leg] ? all->plus : all->minus)[leg] - theta[leg], 2 * std::acos(-1.0))) / sensitivity);
        worst_point = std::max(worst_point, std::abs(std::remainder(one->theta[leg] - theta[leg], 2 * std::acos(-1.0))) / sensitivity);
      }
      for (int choice = 0; choice < 8; ++choice) { // all eight bring the apex to the point, on one side or the other
        Vector angles;
        for (int leg = 0; leg < 3; ++leg)
          angles[leg] = (choice >> leg & 1 ? all->plus : all->minus)[leg];
        const auto again = ditetrahedral_forward(parameters, angles, ditetrahedral_mode(parameters, angles, pose->position));
        const auto c2 = again ? conditioning(parameters, *again) : Outcome<Conditioning<double>>();
        if (again && c2 && c2->constraint_condition < 1e6)
          BOOST_TEST(((again->position - pose->position).norm() <= 1e-14 * c2->constraint_condition * parameters.secondary_length() * 10));
      }
      ++tried;
    }
  }
  for (int k = 0; k < 5000; ++k) {
    const Device_parameters<double> parameters(random_design(random, Device_form::general));
    const Vector theta = random_angles(random, 0.5, 1.5);
    const auto pose = general_forward(parameters, theta), near = general_forward(parameters, Vector(theta + random_vector(random, 0.01)));
    if (!pose || !near)
      continue;
    const auto c = conditioning(parameters, *pose);
    const auto map = jacobian(parameters, *pose);
    const Device_matrix<double> inverse_map = map->linear.inverse();
    if (!c || c->constraint_condition > 30 || inverse_map.norm() * parameters.secondary_length() > 30)
      continue;
    ++general_tried;
    const auto back = general_inverse(parameters, pose->position, *near);
    if (!back) {
      ++general_failed;
      continue;
    }
    worst_general = std::max(worst_general, (back->theta - theta).cwiseAbs().maxCoeff() / c->constraint_condition);
  }
  BOOST_TEST_MESSAGE(tried << " apexes: worst angle error " << worst_point << " x condition; " << general_tried << " platforms: " << worst_general << " x condition");
  BOOST_TEST(worst_point <= 1e-14);
  BOOST_TEST(worst_general <= 1e-13);
  BOOST_TEST(general_failed == 0);
  BOOST_TEST(general_tried > 1000);
}

BOOST_AUTO_TEST_CASE(mirror_case_agrees_with_the_general_solver) {
  Random random(seed + 2);
  for (int k = 0; k < 2000; ++k) {
    Device_description<double> d = random_design(random, Device_form::general);
    d.platform_radius = d.base_radius;
    d.secondary_length = d.primary_length;
    const Device_parameters<double> parameters(d);
    BOOST_REQUIRE(parameters.is_mirror());
    const Vector theta = random_angles(random, 0.4, 1.6);
    const auto closed = mirror_forward(parameters, theta);
    BOOST_REQUIRE(static_cast<bool>(closed));
    const auto iterated = general_forward_from_seed<double>(parameters, theta, Vector(-theta + random_vector(random, 1e-4)));
    BOOST_REQUIRE(static_cast<bool>(iterated));
    BOOST_TEST((closed->position - iterated->position).norm() < 1e-12);
    BOOST_TEST((closed->orientation - iterated->orientation).norm() < 1e-11);
    const auto inverse = mirror_inverse(parameters, closed->position);
    BOOST_REQUIRE(static_cast<bool>(inverse));
    for (int leg = 0; leg < 3; ++leg)
      BOOST_TEST(std::min(std::abs(inverse->minus[leg] - theta[leg]), std::abs(inverse->plus[leg] - theta[leg])) < 1e-8);
  }
}

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
      const auto same = [&](const Device_matrix<double>& other) { return (other - joints).norm() < 1e-7 * parameters.secondary_length(); };
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
  BOOST_TEST_MESSAGE("modes:" << shown << "; found by the multi-start alone " << disagreements << ", cases where it found fewer " << unfound);
  BOOST_TEST(disagreements == 0);
  BOOST_TEST(unfound == 0);
  BOOST_TEST(histogram[16] > 0);
}

BOOST_AUTO_TEST_CASE(eigenvalues_of_companion_matrices_are_the_roots_they_were_made_of) {
  Random random(seed + 7);
  double worst = 0;
  for (int k = 0; k < 20000; ++k) {
    std::array<double, 8> real, imaginary; // four pairs: conjugate, or two real ones; every third time two of them equal
    std::array<double, 9> coefficients{1};
    for (int pair = 0; pair < 4; ++pair) {
      const bool complex = random() % 2;
      const double a = uniform(random, -1, 1), b = complex ? uniform(random, 0.1, 1) : k % 3 == 0 && pair == 0 ? 0 : uniform(random, 0.1, 1);
      real[2 * pair] = complex ? a : a + b, real[2 * pair + 1] = complex ? a : a - b;
      imaginary[2 * pair] = complex ? b : 0, imaginary[2 * pair + 1] = complex ? -b : 0;
      const double linear = -2 * a, constant = complex ? a * a + b * b : a * a - b * b;
      for (int n = 2 * pair + 2; n > 0; --n)
        coefficients[n] += (n >= 1 ? linear * coefficients[n - 1] : 0) + (n >= 2 ? constant * coefficients[n - 2] : 0);
    }
    Eigen::Matrix<double, 8, 8> companion = Eigen::Matrix<double, 8, 8>::Zero();
    for (int n = 0; n < 8; ++n)
      companion(0, n) = -coefficients[n + 1];
    for (int n = 1; n < 8; ++n)
      companion(n, n - 1) = 1;
    internal::Hessenberg_eigenvalues<double, 8> found;
    BOOST_REQUIRE(found.compute(companion));
    for (int root = 0; root < 8; ++root) { // how near each root comes to an eigenvalue, over how well it is determined
      double nearest = HUGE_VAL, separation = 1;
      for (int n = 0; n < 8; ++n) {
        nearest = std::min(nearest, std::hypot(found.real[n] - real[root], found.imaginary[n] - imaginary[root]));
        if (n != root)
          separation *= std::hypot(real[n] - real[root], imaginary[n] - imaginary[root]);
      }
      // A backward error of some roundings moves a simple root by that over the product of the distances, a double one by its square root.
      worst = std::max(worst, std::min(nearest * separation / 1e-14, nearest / 1e-6));
    }
  }
  BOOST_TEST_MESSAGE("roots off by at most " << worst << " of what rounding may do");
  BOOST_TEST(worst < 1);
}

BOOST_AUTO_TEST_CASE(jacobian_and_its_derivative_against_differences) {
  using Long = long double;
  Random random(seed + 4);
  double worst = 0, worst_rate = 0;
  for (Device_form form : {Device_form::ditetrahedral, Device_form::general})
    for (int k = 0; k < 300; ++k) {
      const Device_description<double> design = random_design(random, form);
      const Device_parameters<double> parameters(design);
      const Device_parameters<Long> fine(description_as<Long>(design));
      const Vector theta = random_angles(random, 0.5, 1.5), rate = random_vector(random, 3);
      const auto pose = forward_kinematics(parameters, theta);
      if (!pose || conditioning(parameters, *pose)->constraint_condition > 20)
        continue;
      const auto motion = device_motion(parameters, *pose, rate);
      const auto start = forward_kinematics(fine, vector_as<Long>(theta));
      const Long h = 2e-5L; // fourth-order differences: truncation about h^4
      Device_matrix<Long> difference = Device_matrix<Long>::Zero();
      Eigen::Matrix<Long, 6, 3> jacobian_difference = Eigen::Matrix<Long, 6, 3>::Zero();
      for (int joint = 0; joint < 3; ++joint) {
        Device_vector<Long> column = Device_vector<Long>::Zero();
        for (int step : {-2, -1, 1, 2}) {
          const Long weight = (step == 1 || step == -1 ? 8.0L : -1.0L) * (step > 0 ? 1 : -1) / (12 * h);
          Device_vector<Long> moved = vector_as<Long>(theta);
          moved[joint] += step * h;
          column += weight * forward_kinematics(fine, moved, *start)->position;
        }
        difference.col(joint) = column;
      }
      for (int step : {-2, -1, 1, 2}) {
        const Long weight = (step == 1 || step == -1 ? 8.0L : -1.0L) * (step > 0 ? 1 : -1) / (12 * h);
        const auto moved = forward_kinematics(fine, Device_vector<Long>(vector_as<Long>(theta) + step * h * vector_as<Long>(rate)), *start);
        const auto map = jacobian(fine, *moved);
        jacobian_difference.topRows<3>() += weight * map->linear;
        jacobian_difference.bottomRows<3>() += weight * map->angular;
      }
      worst = std::max(worst, (difference.cast<double>() - motion->jacobian.linear).norm() / motion->jacobian.linear.norm());
      Eigen::Matrix<double, 6, 3> rates;
      rates << motion->jacobian_rate.linear, motion->jacobian_rate.angular;
      worst_rate = std::max(worst_rate, (jacobian_difference.cast<double>() - rates).norm() / rates.norm());
    }
  BOOST_TEST_MESSAGE("Jacobian differs from differences by " << worst << ", its derivative by " << worst_rate << " (relative)");
  BOOST_TEST(worst < 1e-8);
  BOOST_TEST(worst_rate < 1e-7);
}

BOOST_AUTO_TEST_CASE(inverse_of_the_general_form_finds_what_a_denser_search_finds) {
  Random random(seed + 5);
  for (int k = 0; k < 6; ++k) {
    const Device_parameters<double> parameters(named_design<double>(k % 2 ? Named_design::D1 : Named_design::D2, Device_form::general));
    const auto pose = general_forward(parameters, random_angles(random, 0.6, 1.2));
    const std::vector<Device_pose<double>> all = general_inverse_all(parameters, pose->position);
    BOOST_TEST(!all.empty());
    int missed = 0, found = 0;
    for (int start = 0; start < 4000; ++start) {
      Device_pose<double> trial;
      trial.theta = random_angles(random, -0.5, 2.5);
      trial.orientation = (Eigen::AngleAxisd(uniform(random, 0, 1.5), random_vector(random, 1).normalized())).toRotationMatrix();
      if (!internal::inverse_newton<double>(parameters, pose->position, trial, 60))
        continue;
      internal::reduce_angles(trial.theta);
      if (!within_joint_limits<double>(parameters, trial.theta) || !platform_above_elbows(trial))
        continue;
      ++found;
      missed += std::none_of(all.begin(), all.end(), [&](const Device_pose<double>& other) {
        return (other.theta - trial.theta).norm() < 1e-6 && (other.orientation - trial.orientation).norm() < 1e-6;
      });
    }
    BOOST_TEST_MESSAGE(all.size() << " solutions; random starts reached " << found << " times, " << missed << " times an unknown one");
    BOOST_TEST(missed == 0);
  }
  const Device_parameters<double> parameters(named_design<double>(Named_design::D1, Device_form::general));
  BOOST_TEST(general_inverse_all(parameters, Vector(0, 0, 0.4)).empty());
  const auto start = general_forward(parameters, Vector(1, 1, 1));
  const auto far = general_inverse(parameters, Vector(0, 0, 0.4), *start);
  BOOST_TEST((far.status() == Device_status::unreachable));
  BOOST_TEST(far.shortfall() > 0.2);
}

BOOST_AUTO_TEST_CASE(whatever_comes_in_nothing_but_numbers_comes_out) {
  Random random(seed + 6);
  const double odd[] = {0.0, -0.0, 5e-324, 1e-310, 1e-200, 1e200, 1e308, -1, HUGE_VAL, -HUGE_VAL, std::nan(""), 0.03, 0.07, 1.5707963267948966, 3.141592653589793};
  auto pick = [&] { return odd[random() % (sizeof(odd) / sizeof(*odd))]; };
  int accepted = 0, solved = 0;
  for (int k = 0; k < 200000; ++k) {
    Device_description<double> d = random_design(random, k % 2 ? Device_form::general : Device_form::ditetrahedral);
    double* fields[] = {&d.base_radius, &d.primary_length, &d.secondary_length, &d.platform_radius, &d.platform_mass, &d.rotor_inertia};
    if (k % 4 < 2)
      *fields[random() % 6] = pick();
    if (!violations(d).empty())
      continue;
    ++accepted;
    const Device_parameters<double> parameters(d);
    const Vector theta(k % 3 ? uniform(random, -4, 4) : pick(), pick(), pick()), rate(pick(), uniform(random, -1, 1), pick());
    const auto pose = k % 2 ? general_forward(parameters, theta) : ditetrahedral_forward(parameters, theta, 1);
    BOOST_TEST_REQUIRE(std::isfinite(pose.shortfall()));
    if (pose) {
      ++solved;
      BOOST_REQUIRE((pose->position.allFinite() && pose->orientation.allFinite() && pose->links.allFinite()));
      BOOST_REQUIRE(residual(parameters, *pose) < 1e-3);
      const auto motion = device_motion(parameters, *pose, rate);
      if (motion)
        BOOST_REQUIRE((motion->jacobian.linear.allFinite() && motion->jacobian_rate.linear.allFinite()));
      const auto torque = spatial_inverse_dynamics(parameters, *pose, rate, Vector(pick(), 0, 1));
      if (torque)
        BOOST_REQUIRE(torque->torque.allFinite());
    }
    const Vector point(pick(), uniform(random, -0.2, 0.2), pick());
    const auto inverse = ditetrahedral_inverse(parameters, point);
    if (inverse)
      BOOST_REQUIRE((inverse->minus.allFinite() && inverse->plus.allFinite()));
  }
  BOOST_TEST_MESSAGE(accepted << " descriptions accepted, " << solved << " poses solved");
  Device_description<double> bad;
  bad.base_radius = -1, bad.primary_length = std::nan(""), bad.platform_mass = -2, bad.torque_limit = 0;
  try {
    Device_parameters<double> parameters(bad);
    BOOST_TEST(false);
  } catch (const Invalid_device_parameters& error) {
    BOOST_TEST(error.violations().size() == 4u);
  }
}

BOOST_AUTO_TEST_CASE(elbows_on_a_line_or_in_one_point_are_named_singular) {
  Device_description<double> d;
  d.base_radius = 0.02;
  const Device_parameters<double> point(d);
  const double inward = 2.6004931276326473, outward = 0.5410995259571459; // x = -0.04 for all three elbows
  BOOST_TEST((ditetrahedral_forward(point, Vector(inward, outward, outward), 1).status() == Device_status::singular));
  BOOST_TEST((ditetrahedral_forward(point, Vector(inward + 1e-4, outward, outward), 1).status() == Device_status::unreachable));
  d.form = Device_form::general;
  const Device_parameters<double> platform(d);
  BOOST_TEST((general_forward(platform, Vector(inward, outward, outward)).status() == Device_status::singular));
  BOOST_TEST((general_forward(platform, Vector(inward + 1e-4, outward, outward)).status() == Device_status::success));
  d.form = Device_form::ditetrahedral;
  d.primary_length = 0.04; // acos(-1/2): all elbows on the axis
  const double together = 2.0943951023931957;
  BOOST_TEST((ditetrahedral_forward(Device_parameters<double>(d), Vector(together, together, together), 1).status() == Device_status::singular));
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
