// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/device/Device_pose.h>
#include <haptic_sculpt/device/linear_algebra/Small_lu.h>

/// \file
/// The linear equations that tie the platform's velocity to what the legs do, factored once a pose.
///
/// Rows `u_i.[v + w x (B_i - p)] = link_i` and `Q t_i.[v + w x (B_i - p)] = axis_i` (the second in the general form
/// only). In the platform's axes and units of l2 the axis rows read `t_i.v + x_i w_z - z_i e_i.w = axis_i` with x_i =
/// r/l2 + cos phi_i, z_i = sin phi_i. Because sum t_i t_i^T = 3/2 I and sum t_i = 0, two combinations of them give v's
/// horizontal part without a division and the third is free of v: four equations in (v_z, w) are left, and only those
/// are eliminated with pivots.

namespace haptic_sculpt {

/// Velocity (or acceleration) of the platform: of its centre, m/s, and its angular velocity, rad/s, world axes.
template <class S> struct Twist {
  using Scalar = S;        ///< of the components
  Device_vector<S> linear, ///< of the centre
      angular;             ///< 0 in the di-tetrahedral form
};

/// The factored equations of one pose.
template <class S> class Velocity_map {
public:
  /// Factors the equations; refers to neither argument afterwards. \pre the pose was made with these parameters
  Velocity_map(const Device_parameters<S>& parameters, const Device_pose<S>& pose) {
    if (parameters.form() == Device_form::ditetrahedral)
      factor_point(pose);
    else
      factor_platform(parameters, pose);
  }

  /// False at a singular pose: the apex in the elbow plane, or a platform that can move with its legs held.
  bool is_regular() const { return regular_; }

  /// The platform's motion for given right-hand sides. Horizontal `axis` is ignored in the di-tetrahedral form.
  /// \pre is_regular()
  Twist<S> solve(const Device_vector<S>& link, const Device_vector<S>& axis) const {
    Twist<S> twist;
    if (point_) {
      twist.linear = inverse_ * link;
      twist.angular.setZero();
      return twist;
    }
    const S third_root = half_sqrt_three<S>() * S(2) / S(3); // 1 / sqrt 3
    Eigen::Matrix<S, 4, 1> right;
    for (int i = 0; i < 3; ++i) {
      const int j = (i + 1) % 3, k = (i + 2) % 3;
      right[i] = link[i] + cosine_[i] * third_root * (axis[k] - axis[j]);
    }
    right[3] = axis[0] + axis[1] + axis[2];
    const Eigen::Matrix<S, 4, 1> found = lu_.solve(right);
    Device_vector<S> free;
    for (int i = 0; i < 3; ++i) {
      const S radial = Leg_frame<S>::along_radial(i, found.template segment<2>(1));
      free[i] = axis[i] - x_[i] * found[3] + z_[i] * radial;
    }
    const S h = half_sqrt_three<S>(), scale = S(2) / S(3);
    const Device_vector<S> linear(scale * h * (free[2] - free[1]), scale * (free[0] - (free[1] + free[2]) / S(2)),
                                  found[0]);
    twist.linear.noalias() = orientation_ * linear;
    twist.angular.noalias() = orientation_ * (found.template tail<3>() * inverse_length_);
    return twist;
  }

private:
  void factor_point(const Device_pose<S>& pose) {
    point_ = true;
    const Device_matrix<S> rows = pose.links.transpose();
    S determinant;
    internal::adjugate(rows, inverse_, determinant);
    using std::abs;
    // No unit: rows are unit vectors, so the determinant is their volume, and is off by less than 16 roundings.
    const S rounding_of_volume = S(16) * std::numeric_limits<S>::epsilon();
    regular_ = abs(determinant) > rounding_of_volume;
    if (regular_)
      inverse_ *= S(1) / determinant;
  }

  void factor_platform(const Device_parameters<S>& parameters, const Device_pose<S>& pose) {
    point_ = false;
    orientation_ = pose.orientation;
    inverse_length_ = parameters.inverse_secondary_length();
    const S ratio = parameters.platform_radius() * inverse_length_;
    const S third_root = half_sqrt_three<S>() * S(2) / S(3);
    cosine_ = pose.cos_phi;
    z_ = pose.sin_phi;
    x_ = (pose.cos_phi.array() + ratio).matrix();
    Eigen::Matrix<S, 4, 4> a; // unknowns v_z, l2 w_x, l2 w_y, l2 w_z
    S last_x(0), last_y(0);
    for (int i = 0; i < 3; ++i) {
      const int j = (i + 1) % 3, k = (i + 2) % 3;
      const Device_vector<S> radial_j = Leg_frame<S>::radial(j), radial_k = Leg_frame<S>::radial(k),
                             tangential = Leg_frame<S>::tangential(i);
      const S weight = -cosine_[i] * third_root, lever = ratio * z_[i];
      a(i, 0) = -z_[i];
      a(i, 1) = weight * (z_[k] * radial_k[0] - z_[j] * radial_j[0]) + lever * tangential[0];
      a(i, 2) = weight * (z_[k] * radial_k[1] - z_[j] * radial_j[1]) + lever * tangential[1];
      a(i, 3) = weight * (x_[j] - x_[k]);
      const Device_vector<S> radial = Leg_frame<S>::radial(i);
      last_x -= z_[i] * radial[0];
      last_y -= z_[i] * radial[1];
    }
    a.row(3) << S(0), last_x, last_y, x_[0] + x_[1] + x_[2];
    lu_.compute(a);
    const S rounding_of_pivots = S(16) * std::numeric_limits<S>::epsilon() * ratio; // no unit; `ratio` is their size
    regular_ = lu_.least_pivot() > rounding_of_pivots;
  }

  bool point_, regular_;
  Device_matrix<S> inverse_, orientation_;
  Device_vector<S> cosine_, x_, z_;
  S inverse_length_;
  internal::Small_lu<S, 4> lu_;
};

} // namespace haptic_sculpt
