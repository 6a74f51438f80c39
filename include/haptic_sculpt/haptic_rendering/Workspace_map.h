// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/Error.h>
#include <haptic_sculpt/collision/arithmetic/unit_of.h>

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace haptic_sculpt {

/// How places of the device, in metres, and places of the scene, in its own unit, belong together:
/// `scene = origin + scale * R (device - home)`.
class Workspace_map {
public:
  /// \param scale units of the scene a metre of the device, > 0
  /// \param rotation the rotation vector of R, rad
  /// \param origin where `home` is in the scene
  /// \param home the place in the middle of the device's workspace, m
  /// \throw Error for a scale that is not positive, or a number that is not finite
  Workspace_map(double scale, const Eigen::Vector3d& rotation, const Eigen::Vector3d& origin,
                const Eigen::Vector3d& home)
      : scale_(scale), rotation_vector_(rotation), origin_(origin), home_(home) {
    if (!(scale > 0) || !std::isfinite(scale))
      throw Error("the scale of the workspace map must be a finite number > 0, not " + internal::number(scale));
    const double angle = rotation.norm();
    if (!std::isfinite(angle) || !origin.allFinite() || !home.allFinite())
      throw Error("the rotation and the places of the workspace map must be finite numbers, and the angle below 1e154");
    if (angle > 0)
      rotation_ = Eigen::AngleAxisd(angle, rotation / angle).toRotationMatrix();
  }

  /// The map without rotation under which a ball of the device about `home` holds a box of the scene.
  /// \throw Error for a box or ball without extent
  static Workspace_map fitted(const Eigen::Vector3d& lower, const Eigen::Vector3d& upper, const Eigen::Vector3d& home,
                              double radius) {
    if (!(radius > 0))
      throw Error("a ball of the device with the radius " + internal::number(radius) + " m holds no scene");
    const Eigen::Vector3d extent = upper - lower;
    const double unit = internal::unit_of(extent.lpNorm<Eigen::Infinity>()); // squares stay in the range of doubles
    return Workspace_map(0.5 * ((unit * extent).norm() / unit) / radius, Eigen::Vector3d::Zero(), 0.5 * (lower + upper),
                         home);
  }

  /// The map with this rotation and home and another scale under which a place of the device is a place of the scene:
  /// what a hand that was moved with the clutch open takes up again, and about what it zooms. \throw Error for a scale
  /// that is not a finite number > 0
  Workspace_map pinned(const Eigen::Vector3d& device, const Eigen::Vector3d& scene, double scale) const {
    return Workspace_map(scale, rotation_vector_, scene - scale * (rotation_ * (device - home_)), home_);
  }

  /// The same numbers.
  bool operator==(const Workspace_map& other) const {
    return scale_ == other.scale_ && rotation_vector_ == other.rotation_vector_ && origin_ == other.origin_ &&
           home_ == other.home_;
  }

  double scale() const { return scale_; }                       ///< units of the scene a metre of the device
  const Eigen::Matrix3d& rotation() const { return rotation_; } ///< R: from axes of the device to those of the scene
  const Eigen::Vector3d& rotation_vector() const { return rotation_vector_; } ///< of R, as given, rad
  const Eigen::Vector3d& origin() const { return origin_; }                   ///< where `home` is in the scene
  const Eigen::Vector3d& home() const { return home_; }                       ///< in the device, m

  /// Where a place of the device, m, is in the scene.
  Eigen::Vector3d to_scene(const Eigen::Vector3d& device) const {
    return origin_ + scale_ * (rotation_ * (device - home_));
  }
  /// Where a place of the scene is in the device, m.
  Eigen::Vector3d to_device(const Eigen::Vector3d& scene) const {
    return home_ + rotation_.transpose() * (scene - origin_) / scale_;
  }
  /// A difference of two places of the scene, in metres and axes of the device.
  Eigen::Vector3d way_to_device(const Eigen::Vector3d& way) const { return rotation_.transpose() * way / scale_; }
  /// A direction of the scene in axes of the device; lengths stay.
  Eigen::Vector3d direction_to_device(const Eigen::Vector3d& direction) const {
    return rotation_.transpose() * direction;
  }

private:
  double scale_;
  Eigen::Vector3d rotation_vector_, origin_, home_;
  Eigen::Matrix3d rotation_ = Eigen::Matrix3d::Identity();
};

} // namespace haptic_sculpt
