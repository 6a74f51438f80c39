// SPDX-License-Identifier: GPL-3.0-or-later
// Which poses belong to the workspace, what force it has everywhere, and the angles and frames that a pose tells:
// beside geometry written out again from points, differences of the kinematics and forces in many directions.
#include "device/kinematics_of_tests.h"

#include <boost/test/unit_test.hpp>

#include <Eigen/SVD>

#include <cmath>
#include <set>
#include <string>

BOOST_AUTO_TEST_SUITE(device_workspace)

using namespace device_kinematics;

namespace {

using Matrix = Device_matrix<double>;

struct Posed {
  Device_parameters<double> parameters;
  Device_pose<double> pose;
};

/// Random devices in random poses, those that the kinematics can follow.
template <class Test>
void at_random_poses(int poses, const Test& test) {
  Random random(seed + 77);
  int made = 0;
  while (made < poses) {
    const Device_form form = made % 2 == 0 ? Device_form::ditetrahedral : Device_form::general;
    const Device_parameters<double> parameters(random_design(random, form));
    const auto pose = forward_kinematics(parameters, random_angles(random, -0.4, 2.4));
    if (!pose)
      continue;
    ++made;
    test(Posed{parameters, *pose}, random);
  }
}

/// The leg's own axes by sines and cosines of its place on the base: outward, along the base circle, up.
Matrix axes_of_leg(int leg) {
  const double a = 2 * M_PI * leg / 3;
  Matrix axes;
  axes << std::cos(a), -std::sin(a), 0, std::sin(a), std::cos(a), 0, 0, 0, 1;
  return axes;
}

/// The position Jacobian by differences of the forward kinematics.
Matrix jacobian_by_differences(const Posed& at) {
  const double step = 1e-6;
  Matrix columns;
  for (int joint = 0; joint < 3; ++joint) {
    Vector after = at.pose.theta, before = at.pose.theta;
    after[joint] += step, before[joint] -= step;
    const auto p = forward_kinematics(at.parameters, after, at.pose),
               q = forward_kinematics(at.parameters, before, at.pose);
    columns.col(joint) = p && q ? Vector((p->position - q->position) / (2 * step)) : Vector(Vector::Constant(NAN));
  }
  return columns;
}

} // namespace

BOOST_AUTO_TEST_CASE(frames_of_legs_and_angles_of_links_make_the_links) {
  at_random_poses(200, [](const Posed& at, Random& random) {
    const Vector beta = at.pose.beta(), gamma = at.pose.gamma(), any = random_vector(random, 1);
    for (int leg = 0; leg < 3; ++leg) {
      const Matrix axes = axes_of_leg(leg);
      const Vector radial = axes.col(0), tangential = axes.col(1), up = axes.col(2);
      BOOST_TEST((Leg_frame<double>::radial(leg) - radial).norm() <= 1e-15);
      BOOST_TEST((Leg_frame<double>::tangential(leg) - tangential).norm() <= 1e-15);
      BOOST_TEST(std::abs(Leg_frame<double>::along_radial(leg, any) - radial.dot(any)) <= 1e-15);
      BOOST_TEST(std::abs(Leg_frame<double>::along_tangential(leg, any) - tangential.dot(any)) <= 1e-15);
      const Vector in_plane = Leg_frame<double>::in_leg_plane(leg, any[0], any[2]);
      BOOST_TEST((in_plane - any[0] * radial - any[2] * up).norm() <= 1e-15);
      const Vector link = std::cos(gamma[leg]) * (std::cos(beta[leg]) * radial + std::sin(beta[leg]) * up) +
                          std::sin(gamma[leg]) * tangential;
      const Vector between = at.pose.joints.col(leg) - at.pose.elbows.col(leg);
      BOOST_TEST((link - between / at.parameters.secondary_length()).norm() <= 1e-9); // as the closure is solved
      BOOST_TEST(std::abs(gamma[leg]) <= M_PI / 2);
      Vector after = at.pose.theta, before = after;
      after[leg] += 1e-6, before[leg] -= 1e-6;
      const auto p = forward_kinematics(at.parameters, after, at.pose),
                 q = forward_kinematics(at.parameters, before, at.pose);
      if (p && q) {
        const Vector difference = (p->elbows.col(leg) - q->elbows.col(leg)) / 2e-6;
        BOOST_TEST((at.pose.elbow_rate(at.parameters, leg) - difference).norm() <= 1e-9);
      }
    }
  });
  BOOST_TEST(std::abs(half_sqrt_three<double>() - std::sin(M_PI / 3)) <= 1e-16);
}

BOOST_AUTO_TEST_CASE(a_pose_is_outside_of_the_workspace_for_the_limits_that_it_breaks) {
  std::array<int, 5> met{}; // limits, condition, tilt, knees, inside
  at_random_poses(600, [&](const Posed& at, Random& random) {
    Device_description<double> narrow = at.parameters.description();
    narrow.least_angle = random_angles(random, -0.4, 0.2), narrow.greatest_angle = random_angles(random, 1.5, 2.4);
    const Device_parameters<double> parameters(narrow);
    Workspace_limits<double> limits;
    limits.least_transmission = uniform(random, 0, 0.9), limits.greatest_tilt = uniform(random, 0, 0.3);
    limits.greatest_condition = uniform(random, 1, 12);
    const Workspace_verdict verdict = workspace_verdict(parameters, at.pose, limits);
    bool is_in_limits = true, has_knees = false;
    double least_transmission = 2;
    Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(6, 6); // velocity of the centre, and turning in units of l2
    for (int leg = 0; leg < 3; ++leg) {
      is_in_limits = is_in_limits && at.pose.theta[leg] >= narrow.least_angle[leg] &&
                     at.pose.theta[leg] <= narrow.greatest_angle[leg];
      const Vector shoulder = narrow.base_radius * axes_of_leg(leg).col(0), elbow = at.pose.elbows.col(leg),
                   link = (at.pose.joints.col(leg) - elbow).normalized(), primary = (elbow - shoulder).normalized();
      // What of the link is across the primary link in the leg's plane.
      const Vector across = primary.cross(link);
      least_transmission = std::fmin(least_transmission, std::abs(across.dot(axes_of_leg(leg).col(1))));
      const Vector arm = (elbow - at.pose.position) / narrow.secondary_length,
                   hinge = at.pose.orientation * axes_of_leg(leg).col(1);
      rows.row(leg) << link.transpose(), arm.cross(link).transpose();
      rows.row(3 + leg) << hinge.transpose(), arm.cross(hinge).transpose();
    }
    if (parameters.form() == Device_form::ditetrahedral)
      rows = rows.topLeftCorner(3, 3).eval();
    const Eigen::JacobiSVD<Eigen::MatrixXd> svd(rows);
    const double condition = svd.singularValues()[0] / svd.singularValues()[rows.rows() - 1],
                 tilt = std::acos(std::fmin(1, at.pose.orientation.col(2).dot(Vector(0, 0, 1))));
    has_knees = least_transmission < limits.least_transmission;
    const auto is_close = [](double a, double b) { return std::abs(a - b) <= 1e-6 * (1 + std::abs(b)); };
    if (is_close(condition, limits.greatest_condition) || is_close(tilt, limits.greatest_tilt) ||
        is_close(least_transmission, limits.least_transmission))
      return; // rounding may say either
    BOOST_TEST(verdict.joint_limits == !is_in_limits);
    BOOST_TEST(verdict.condition == (condition > limits.greatest_condition));
    BOOST_TEST(verdict.tilt == (parameters.form() == Device_form::general && tilt > limits.greatest_tilt));
    BOOST_TEST(verdict.knees == has_knees);
    BOOST_TEST(verdict.inside() == !(verdict.joint_limits || verdict.condition || verdict.tilt || verdict.knees));
    met[0] += verdict.joint_limits, met[1] += verdict.condition, met[2] += verdict.tilt, met[3] += verdict.knees;
    met[4] += verdict.inside();
  });
  for (const int number : met)
    BOOST_TEST(number > 20);
}

BOOST_AUTO_TEST_CASE(the_isotropic_force_can_be_given_in_every_direction_and_no_more_in_one) {
  at_random_poses(60, [](const Posed& at, Random& random) {
    const auto map = jacobian(at.parameters, at.pose);
    const Matrix columns = jacobian_by_differences(at);
    if (!map || !columns.allFinite() || !(conditioning(at.parameters, at.pose)->constraint_condition < 20))
      return; // differences are too coarse there
    const double force = isotropic_force(at.parameters, *map), limit = at.parameters.torque_limit();
    const auto share_of_limit = [&](const Vector& direction) {
      return (columns.transpose() * (force * direction.normalized())).cwiseAbs().maxCoeff() / limit;
    };
    double worst = 0, along = 0;
    for (int k = 0; k < 500; ++k)
      worst = std::fmax(worst, share_of_limit(random_vector(random, 1)));
    for (int joint = 0; joint < 3; ++joint)
      along = std::fmax(along, share_of_limit(columns.col(joint)));
    BOOST_TEST(worst <= 1 + 1e-5);
    BOOST_TEST(std::abs(along - 1) <= 1e-5);
  });
  const Device_parameters<double> parameters(named_design<double>(Named_design::D1, Device_form::ditetrahedral));
  Device_jacobian<double> still;
  still.linear.setZero(), still.angular.setZero();
  BOOST_TEST(isotropic_force(parameters, still) == std::numeric_limits<double>::infinity());
}

BOOST_AUTO_TEST_CASE(samples_of_a_workspace_are_all_poses_of_the_grid) {
  for (const Device_form form : {Device_form::ditetrahedral, Device_form::general}) {
    const Device_parameters<double> parameters(named_design<double>(Named_design::D1, form));
    constexpr int per_joint = 7;
    const auto samples = sample_workspace(parameters, per_joint);
    std::set<std::array<int, 3>> places;
    for (const auto& sample : samples) {
      std::array<int, 3> place;
      for (int joint = 0; joint < 3; ++joint) {
        const double low = parameters.least_angle()[joint], high = parameters.greatest_angle()[joint],
                     part = (sample.pose.theta[joint] - low) / (high - low) * (per_joint - 1);
        place[joint] = static_cast<int>(std::lround(part));
        BOOST_TEST(std::abs(part - place[joint]) <= 1e-12);
      }
      BOOST_TEST(places.insert(place).second);
      BOOST_TEST(residual(parameters, sample.pose) <= 1e-9);
      BOOST_TEST(!sample.verdict.joint_limits);
      BOOST_TEST(sample.condition >= 1);
      BOOST_TEST(sample.force > 0);
    }
    int poses = 0;
    for (int i = 0; i < per_joint * per_joint * per_joint; ++i) {
      const Vector part(i / per_joint / per_joint, i / per_joint % per_joint, i % per_joint);
      const Vector theta = parameters.least_angle() + 3.0 * part / (per_joint - 1); // from -0.5 to 2.5
      const auto pose = forward_kinematics(parameters, Vector(theta.cwiseMin(2.5)));
      poses += pose && jacobian(parameters, *pose);
    }
    BOOST_TEST(samples.size() == static_cast<std::size_t>(poses));
    BOOST_TEST(samples.size() > 50u);
    const auto by_all = sample_workspace(
        parameters, per_joint, Workspace_limits<double>(),
        [](const auto& p, const Vector& theta) { return forward_by_all_modes(p, theta); });
    BOOST_TEST(by_all.size() >= samples.size());
  }
}

BOOST_AUTO_TEST_CASE(parameters_are_those_of_the_description) {
  Random random(seed + 78);
  for (int i = 0; i < 20; ++i) {
    const Device_form form = i % 2 == 0 ? Device_form::general : Device_form::ditetrahedral;
    Device_description<double> d = random_design(random, form);
    d.rotor_inertia = 1e-6 * (1 + i), d.gravity = 9 + i, d.torque_limit = 0.1 + i, d.viscous_friction = 0.01 * i;
    d.coulomb_friction = 0.02 * i, d.encoder_step = 1e-4 * i;
    d.least_angle = random_angles(random, -1, 0), d.greatest_angle = random_angles(random, 1, 2);
    if (i % 4 == 0)
      d.platform_radius = d.base_radius, d.secondary_length = d.primary_length;
    const Device_parameters<double> p(d);
    BOOST_TEST((p.form() == d.form && p.description().gravity == d.gravity));
    BOOST_TEST((p.base_radius() == d.base_radius && p.platform_radius() == d.platform_radius));
    BOOST_TEST((p.primary_length() == d.primary_length && p.secondary_length() == d.secondary_length));
    BOOST_TEST((p.primary_mass() == d.primary_mass && p.secondary_mass() == d.secondary_mass));
    BOOST_TEST((p.platform_mass() == d.platform_mass && p.platform_inertia() == d.platform_inertia));
    BOOST_TEST((p.rotor_inertia() == d.rotor_inertia && p.gravity() == d.gravity));
    BOOST_TEST((p.torque_limit() == d.torque_limit && p.viscous_friction() == d.viscous_friction));
    BOOST_TEST((p.coulomb_friction() == d.coulomb_friction && p.encoder_step() == d.encoder_step));
    BOOST_TEST((p.least_angle() == d.least_angle && p.greatest_angle() == d.greatest_angle));
    BOOST_TEST(p.is_mirror() == (i % 4 == 0)); // those are of the general form
    const double l2 = d.secondary_length, r = d.platform_radius;
    BOOST_TEST(std::abs(p.inverse_secondary_length() * l2 - 1) <= 1e-15);
    BOOST_TEST(std::abs(p.inverse_secondary_length_squared() * l2 * l2 - 1) <= 1e-15);
    BOOST_TEST(std::abs(p.closure_linear() - 3 * r / l2) <= 1e-15 * (1 + p.closure_linear()));
    BOOST_TEST(std::abs(p.closure_constant() - 2 - 3 * r * r / (l2 * l2)) <= 1e-14);
  }
}

BOOST_AUTO_TEST_CASE(the_mode_beside_a_seed_is_the_one_that_the_seed_was_taken_from) {
  int found = 0;
  at_random_poses(400, [&](const Posed& at, Random& random) {
    if (at.parameters.form() != Device_form::general)
      return;
    const Vector phi = at.pose.phi();
    const Vector beside = phi + random_vector(random, 1e-4);
    const auto again = general_forward_from_seed(at.parameters, at.pose.theta, beside);
    BOOST_TEST((again || again.status() == Device_status::undecided || again.status() == Device_status::singular));
    if (!again)
      return;
    ++found;
    BOOST_TEST(residual(at.parameters, *again) <= 1e-9);
    BOOST_TEST((again->position - at.pose.position).norm() <= 1e-7 * at.parameters.secondary_length());
  });
  BOOST_TEST(found > 150);
  const Device_parameters<double> parameters(named_design<double>(Named_design::D1, Device_form::general));
  const Vector one = Vector::Ones();
  BOOST_TEST((general_forward_from_seed(parameters, one, Vector(0, NAN, 0)).status() == Device_status::not_finite));
  BOOST_TEST((general_forward_from_seed(parameters, Vector(NAN, 1, 1), one).status() == Device_status::not_finite));
}

BOOST_AUTO_TEST_CASE(link_angles_turn_to_second_order_and_stay_on_the_circle) {
  Random random(seed + 79);
  for (int i = 0; i < 200; ++i) {
    const Vector phi = random_vector(random, 1.5), step = random_vector(random, i % 2 == 0 ? 0.1 : 1e-3);
    Link_angles<double> angles = Link_angles<double>::from(phi);
    BOOST_TEST((angles.angles() - phi).norm() <= 4e-15);
    angles.turn(step);
    for (int leg = 0; leg < 3; ++leg) {
      BOOST_TEST(std::abs(std::hypot(angles.cosine[leg], angles.sine[leg]) - 1) <= 1e-15);
      const double turned = angles.angles()[leg] - phi[leg];
      BOOST_TEST(std::abs(turned - step[leg]) <= std::pow(std::abs(step[leg]), 3) / 10 + 1e-15);
    }
    angles.cosine *= 1 + 1e-5, angles.sine *= 1 + 1e-5;
    angles.normalize();
    for (int leg = 0; leg < 3; ++leg)
      BOOST_TEST(std::abs(std::hypot(angles.cosine[leg], angles.sine[leg]) - 1) <= 2e-10); // 3/2 of its square
  }
}

BOOST_AUTO_TEST_CASE(motions_of_joints_and_links_are_differences_of_poses) {
  int compared = 0;
  at_random_poses(200, [&](const Posed& at, Random& random) {
    const auto regular = conditioning(at.parameters, at.pose);
    if (!regular || !(regular->constraint_condition < 10))
      return;
    const Vector rate = random_vector(random, 2);
    const double h = 1e-5; // s, or rad
    const auto moved = [&](const Vector& way) {
      return forward_kinematics(at.parameters, Vector(at.pose.theta + way), at.pose);
    };
    const auto after = moved(h * rate), before = moved(-h * rate);
    const auto motion = device_motion(at.parameters, at.pose, rate);
    if (!motion || !after || !before)
      return;
    const auto later = device_motion(at.parameters, *after, rate),
               earlier = device_motion(at.parameters, *before, rate);
    const auto links = projected_links(at.parameters, *motion);
    if (!later || !earlier || !links || at.pose.gamma().cwiseAbs().maxCoeff() > 1.2)
      return;
    const auto links_later = projected_links(at.parameters, *later),
               links_earlier = projected_links(at.parameters, *earlier);
    BOOST_REQUIRE((links_later && links_earlier));
    ++compared;
    for (int leg = 0; leg < 3; ++leg) {
      BOOST_TEST((motion->lever(leg) - (at.pose.joints.col(leg) - at.pose.position)).norm() <= 1e-15);
      for (int joint = 0; joint < 3; ++joint) {
        const auto p = moved(h * Vector::Unit(joint)), q = moved(-h * Vector::Unit(joint));
        if (!p || !q)
          continue;
        const Vector joints = (p->joints.col(leg) - q->joints.col(leg)) / (2 * h);
        BOOST_TEST((motion->joint_jacobian(leg).col(joint) - joints).norm() <= 1e-6);
        const double turned = std::remainder(p->beta()[leg] - q->beta()[leg], 2 * M_PI) / (2 * h);
        BOOST_TEST(std::abs(links->jacobian(leg, joint) - turned) <= 1e-5);
      }
      const Matrix change = (later->joint_jacobian(leg) - earlier->joint_jacobian(leg)) / (2 * h);
      BOOST_TEST((motion->joint_jacobian_rate(leg) - change).norm() <= 1e-5);
    }
    const Matrix change = (links_later->jacobian - links_earlier->jacobian) / (2 * h);
    BOOST_TEST((links->jacobian_rate - change).norm() <= 1e-3 * (1 + change.norm()));
    BOOST_TEST((links->rate - links->jacobian * rate).norm() <= 1e-12);
    // Either model: torques for an acceleration make that acceleration.
    for (const auto& terms : {*planar_dynamics(at.parameters, *motion), spatial_dynamics(at.parameters, *motion)}) {
      const Vector acceleration = random_vector(random, 10);
      const Vector again = terms.acceleration(rate, terms.torque(rate, acceleration));
      BOOST_TEST((again - acceleration).norm() <= 1e-8);
    }
  });
  BOOST_TEST(compared > 40);
  const Invalid_device_parameters error({"this is wrong", "and this"});
  BOOST_TEST(error.violations().size() == 2u);
  BOOST_TEST(std::string(error.what()) == "The device description cannot be used: this is wrong; and this.");
}

BOOST_AUTO_TEST_SUITE_END()
