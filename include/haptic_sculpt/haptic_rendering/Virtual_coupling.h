// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/haptic_rendering/Workspace_map.h>
#include <haptic_sculpt/haptic_rendering/loop/require_number.h>

namespace haptic_sculpt {

/// The directions in which contacts push, in axes of the device: as many as span the space, the rest adds nothing.
class Contact_span {
public:
  /// So much of a normal of length 1 must be new for it to count: below it the normals of neighbouring facets of one
  /// smooth surface would span the plane along which the hand slides, and damp that too. The sine of 3 degrees.
  static constexpr double least_new_part = 0.05;

  /// Takes the normal of a contact, of any length; one that points nowhere new adds nothing.
  void add(const Eigen::Vector3d& normal) {
    Eigen::Vector3d rest = normal;
    for (int repeat = 0; repeat < 2; ++repeat) // once more, for what cancels in the first round
      for (int i = 0; i < size_; ++i)
        rest -= axes_[i].dot(rest) * axes_[i];
    const double length = rest.norm();
    if (size_ < 3 && length > least_new_part * normal.norm())
      axes_[size_++] = rest / length;
  }
  int size() const { return size_; } ///< dimension of the span, 0 to 3

  /// The part of a vector in the span.
  Eigen::Vector3d part(const Eigen::Vector3d& vector) const {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (int i = 0; i < size_; ++i)
      sum += axes_[i].dot(vector) * axes_[i];
    return sum;
  }

private:
  Eigen::Vector3d axes_[3];
  int size_ = 0;
};

/// A spring between the hand and what it holds, and a damper against what holds that. SI units, at the handle.
struct Virtual_coupling {
  static constexpr double most_stiffness = 1e7; ///< N/m
  double stiffness = 500;                       ///< k, N/m
  double damping = 0;                           ///< b, N s/m

  /// \throw Error for a number that no coupling has; whether a device can give it, its limits say
  void check() const {
    internal::require_number("Virtual_coupling::stiffness", "N/m", stiffness, 0, most_stiffness);
    internal::require_number("Virtual_coupling::damping", "N s/m", damping, 0, 1e5);
  }

  /// The force of the spring on the hand, N, in axes of the device: k R^T (proxy - target) / scale. Exactly 0 where the
  /// drag has reached its target.
  Eigen::Vector3d force(const Workspace_map& map, const Eigen::Vector3d& proxy, const Eigen::Vector3d& target,
                        bool reached) const {
    return reached ? Eigen::Vector3d(Eigen::Vector3d::Zero())
                   : Eigen::Vector3d(stiffness * map.way_to_device(proxy - target));
  }

  /// The force of the damper on the hand, N: -b times the handle's velocity, m/s, in the directions in which contacts
  /// push, and only while the target is not reached: free motion, and sliding, is not damped.
  Eigen::Vector3d damping_force(const Contact_span& contacts, const Eigen::Vector3d& velocity, bool reached) const {
    return reached ? Eigen::Vector3d(Eigen::Vector3d::Zero()) : Eigen::Vector3d(-damping * contacts.part(velocity));
  }
};

} // namespace haptic_sculpt
