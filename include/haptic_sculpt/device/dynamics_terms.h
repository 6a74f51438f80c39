// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/device/jacobian.h>
#include <haptic_sculpt/device/linear_algebra/Small_lu.h>
#include <Eigen/LU>

namespace haptic_sculpt {

/// The equation of motion `M thetadd + C thetad + gravity = tau` at one state, and the energies.
template <class S> struct Dynamics_terms {
  using Scalar = S;           ///< what `Outcome` measures a shortfall in
  Device_matrix<S> mass;      ///< M, symmetric, positive definite unless links and rotors have no mass; kg m^2
  Device_matrix<S> coriolis;  ///< C with Christoffel's symbols, so that dM/dt = C + C^T; kg m^2/s
  Device_vector<S> gravity;   ///< gradient of the potential energy, N m
  S kinetic;                  ///< J
  S potential;                ///< J, zero with everything at the base's height

  /// Torques for given joint accelerations.
  Device_vector<S> torque(const Device_vector<S>& rate, const Device_vector<S>& acceleration) const {
    return mass * acceleration + coriolis * rate + gravity;
  }
  /// Joint accelerations for given torques; not finite where the mass matrix is singular.
  Device_vector<S> acceleration(const Device_vector<S>& rate, const Device_vector<S>& torque) const {
    return solve_mass(torque - coriolis * rate - gravity);
  }
  /// Why `acceleration()` is not finite: `singular`, or `not_finite` where it overflows.
  Device_status acceleration_failure() const {
    internal::Small_lu<S, 3> lu;
    lu.compute(mass);
    return lu.least_pivot() > S(0) ? Device_status::not_finite : Device_status::singular;
  }
  /// M^-1 times a vector.
  Device_vector<S> solve_mass(const Device_vector<S>& right) const {
    internal::Small_lu<S, 3> lu;
    lu.compute(mass);
    return lu.solve(right);
  }
};

/// A triple of joint torques, N m.
template <class S> struct Joint_torques {
  using Scalar = S;        ///< what `Outcome` measures a shortfall in
  Device_vector<S> torque; ///< N m; entry i turns joint i towards greater angles where positive
};

/// A triple of joint accelerations, rad/s^2.
template <class S> struct Joint_accelerations {
  using Scalar = S;              ///< what `Outcome` measures a shortfall in
  Device_vector<S> acceleration; ///< rad/s^2; entry i is of joint i
};

/// The mass the hand feels: J^-T M J^-1 with J the position Jacobian, kg. \pre the position Jacobian is regular
template <class S>
Device_matrix<S> apparent_mass(const Device_matrix<S>& mass, const Device_matrix<S>& linear_jacobian) {
  const Device_matrix<S> inverse = linear_jacobian.inverse();
  return inverse.transpose() * mass * inverse;
}

namespace internal {

/// Adds a slender rod between two moving points, whose Jacobians are `a` and `b` with time derivatives `da`, `db`:
/// a uniform rod's kinetic energy is m/6 (|a'|^2 + a'.b' + |b'|^2).
template <class S>
void add_rod(const S& mass, const Device_matrix<S>& a, const Device_matrix<S>& b, const Device_matrix<S>& da,
             const Device_matrix<S>& db, Dynamics_terms<S>& terms) {
  const S third = mass / S(3);
  const Device_matrix<S> heavy_a = third * (a + b / S(2)), heavy_b = third * (b + a / S(2));
  terms.mass.noalias() += a.transpose() * heavy_a + b.transpose() * heavy_b;
  const Device_matrix<S> drift_a = third * (da + db / S(2)), drift_b = third * (db + da / S(2));
  terms.coriolis.noalias() += a.transpose() * drift_a + b.transpose() * drift_b;
}

/// Primary links, rotors and the platform: the part the two models share.
template <class S>
void shared_terms(const Device_parameters<S>& parameters, const Device_motion<S>& motion, Dynamics_terms<S>& terms) {
  const S& g = parameters.gravity();
  const S& platform = parameters.platform_mass();
  const S primary = parameters.primary_mass() * parameters.primary_length() * parameters.primary_length() / S(3) +
                    parameters.rotor_inertia();
  const S primary_moment = parameters.primary_mass() * g * parameters.primary_length() / S(2);
  const Device_jacobian<S>& j = motion.jacobian;
  const Device_jacobian<S>& dj = motion.jacobian_rate;
  terms.mass = platform * j.linear.transpose() * j.linear;
  terms.mass.diagonal().array() += primary;
  terms.coriolis = platform * j.linear.transpose() * dj.linear;
  terms.gravity = platform * g * j.linear.row(2).transpose();
  terms.potential = platform * g * motion.pose.position[2];
  for (int leg = 0; leg < 3; ++leg) {
    terms.gravity[leg] += primary_moment * motion.pose.cos_theta[leg];
    terms.potential += primary_moment * motion.pose.sin_theta[leg];
  }
  if (parameters.form() == Device_form::general) {
    const Device_matrix<S>& q = motion.pose.orientation;
    const Device_vector<S>& moments = parameters.platform_inertia();
    const Device_matrix<S> inertia = q * moments.asDiagonal() * q.transpose();
    // Integral of r r^T dm: what gives the rotation's Coriolis matrix in Christoffel's form.
    const Device_vector<S> spreads = (moments.sum() / S(2) - moments.array()).matrix();
    const Device_matrix<S> spread = q * spreads.asDiagonal() * q.transpose();
    Device_matrix<S> drift = inertia * dj.angular;
    for (int column = 0; column < 3; ++column)
      drift.col(column) -= motion.velocity.angular.cross(Device_vector<S>(spread * j.angular.col(column)));
    terms.mass.noalias() += j.angular.transpose() * inertia * j.angular;
    terms.coriolis.noalias() += j.angular.transpose() * drift;
  }
}

/// Symmetrizes the mass matrix's rounding away and closes the kinetic energy.
template <class S> void finish_terms(const Device_motion<S>& motion, Dynamics_terms<S>& terms) {
  terms.mass = ((terms.mass + terms.mass.transpose()) / S(2)).eval();
  terms.kinetic = motion.rate.dot(terms.mass * motion.rate) / S(2);
}

template <class S> Device_matrix<S> single_column(const Device_vector<S>& column, int leg) {
  Device_matrix<S> m = Device_matrix<S>::Zero();
  m.col(leg) = column;
  return m;
}

} // namespace internal
} // namespace haptic_sculpt
