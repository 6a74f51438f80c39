// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "populations.h"
#include <Eigen/Dense>

/// An oracle for the dynamics: seven free rigid bodies and Lagrange multipliers for every joint. Bodies 0-2 primary
/// links, 3-5 secondary links, 6 platform; six accelerations each (centre, angular). Shares only poses and first
/// velocities with the library.
namespace maximal_coordinates {

using namespace haptic_sculpt;
using Vector = Device_vector<double>;
using Matrix = Device_matrix<double>;

inline Matrix cross_matrix(const Vector& v) {
  Matrix m;
  m << 0, -v[2], v[1], v[2], 0, -v[0], -v[1], v[0], 0;
  return m;
}

inline Vector joint_accelerations(const Device_parameters<double>& parameters, const Device_pose<double>& pose,
                                  const Vector& rate, const Vector& torque) {
  const bool general = parameters.form() == Device_form::general;
  const double l1 = parameters.primary_length(), l2 = parameters.secondary_length();
  const auto motion = device_motion(parameters, pose, rate);
  const int bodies = 42, constraints = general ? 36 : 33;
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(bodies + constraints, bodies + constraints);
  Eigen::VectorXd b = Eigen::VectorXd::Zero(bodies + constraints);
  Vector spin[7];
  auto body = [&](int index, double mass, const Matrix& inertia, const Vector& moment) {
    a.block<3, 3>(6 * index, 6 * index) = mass * Matrix::Identity();
    a.block<3, 3>(6 * index + 3, 6 * index + 3) = inertia;
    b.segment<3>(6 * index) = Vector(0, 0, -mass * parameters.gravity());
    b.segment<3>(6 * index + 3) = moment - spin[index].cross(Vector(inertia * spin[index]));
  };
  int row = bodies;
  // sign times the acceleration of the point at `arm` from the body's centre
  auto point = [&](int index, const Vector& arm, double sign) {
    a.block<3, 3>(row, 6 * index) += sign * Matrix::Identity();
    a.block<3, 3>(row, 6 * index + 3) -= sign * cross_matrix(arm);
    b.segment<3>(row) -= sign * spin[index].cross(spin[index].cross(arm));
  };
  spin[6] = motion->velocity.angular;
  for (int leg = 0; leg < 3; ++leg) {
    const Vector e = Leg_frame<double>::radial(leg), t = Leg_frame<double>::tangential(leg), k = Vector::UnitZ();
    const Vector rod = pose.cos_theta[leg] * e + pose.sin_theta[leg] * k, u = pose.links.col(leg);
    spin[leg] = -rate[leg] * t;
    const Vector elbow_velocity = spin[leg].cross(Vector(l1 * rod));
    const Vector joint_velocity =
        motion->velocity.linear +
        (general ? Vector(spin[6].cross(Vector(pose.joints.col(leg) - pose.position))) : Vector(Vector::Zero()));
    spin[3 + leg] = u.cross(Vector(joint_velocity - elbow_velocity)) / l2;
    const double m1 = parameters.primary_mass(), m2 = parameters.secondary_mass(),
                 spin_inertia = 1e-6; // the links' own spin is 0 and stays 0
    body(leg, m1,
         m1 * l1 * l1 / 12 * (Matrix::Identity() - rod * rod.transpose()) +
             parameters.rotor_inertia() * t * t.transpose() + spin_inertia * rod * rod.transpose(),
         -torque[leg] * t);
    body(3 + leg, m2, m2 * l2 * l2 / 12 * (Matrix::Identity() - u * u.transpose()) + spin_inertia * u * u.transpose(),
         Vector::Zero());
    point(leg, -l1 / 2 * rod, 1); // shoulder
    row += 3;
    a.block<1, 3>(row++, 6 * leg + 3) = e.transpose();
    a.block<1, 3>(row++, 6 * leg + 3) = k.transpose();
    point(leg, l1 / 2 * rod, 1); // elbow
    point(3 + leg, -l2 / 2 * u, -1);
    row += 3;
    point(3 + leg, l2 / 2 * u, 1); // platform joint
    point(6, general ? Vector(pose.joints.col(leg) - pose.position) : Vector(Vector::Zero()), -1);
    row += 3;
    if (general) { // the link stays normal to the platform's axis
      const Vector q = pose.orientation * t, u_rate = spin[3 + leg].cross(u), q_rate = spin[6].cross(q);
      a.block<1, 3>(row, 6 * (3 + leg) + 3) = u.cross(q).transpose();
      a.block<1, 3>(row, 6 * 6 + 3) = q.cross(u).transpose();
      b[row] = -(spin[3 + leg].cross(u_rate).dot(q) + 2 * u_rate.dot(q_rate) + u.dot(spin[6].cross(q_rate)));
      ++row;
    }
  }
  const Matrix platform =
      general ? Matrix(pose.orientation * parameters.platform_inertia().asDiagonal() * pose.orientation.transpose())
              : Matrix(1e-6 * Matrix::Identity());
  body(6, parameters.platform_mass(), platform, Vector::Zero());
  a.topRightCorner(bodies, constraints) = a.bottomLeftCorner(constraints, bodies).transpose();
  const Eigen::VectorXd solution = a.fullPivLu().solve(b);
  Vector accelerations;
  for (int leg = 0; leg < 3; ++leg)
    accelerations[leg] = -solution.segment<3>(6 * leg + 3).dot(Leg_frame<double>::tangential(leg));
  return accelerations;
}

} // namespace maximal_coordinates
