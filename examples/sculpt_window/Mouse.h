// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "exchange.h"

#include <haptic_sculpt/haptic_rendering/Workspace_map.h>

namespace haptic_sculpt::window_program {

/// What a press of the button has taken.
struct Held {
  Status::Hold hold = Status::Hold::nothing;
  Place home{},  ///< of the vertex; of the probe: where it was put, in front of the surface
      normal{},  ///< of the vertex
      pressed{}; ///< of the probe: where the mouse pointed
};

/// The mouse as a device of pose and force, whose force one sees. In the window's thread.
///
/// The loop anchors what it takes, so only the way since then counts: at a press the handle is at home, and once
/// something is taken it goes from there by what the mouse wants.
class Mouse {
public:
  /// Between the device and the scene. No way is lost in the map: its origin is that of the scene.
  static Workspace_map map_for(double extent) {
    const double diagonal = 0.1; // m
    return Workspace_map(std::fmax(extent, 1e-300) / diagonal, Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(),
                         Eigen::Vector3d::Zero());
  }

  void enter(const Workspace_map& map) { map_ = map, let_go(); }
  void point(const Pointer& pointer) { pointer_ = pointer; }
  void set_depth(double depth) { depth_ = depth; } ///< by which a probe is pressed in
  void press() {
    let_go();
    pressed_ = pointer_;
    handle_.setZero();
    ++press_;
  }
  void take(const Held& held) {
    held_ = held;
    aim_ = vector(held.pressed);
    along_ = 0;
    along_ = nearest_on_normal(pressed_);
  }
  /// The probe is pressed in there.
  void aim(const Place& place) { aim_ = vector(place); }
  /// The handle stays: the loop may hold yet what it is to let go of.
  void let_go() { held_ = Held(); }
  Status::Hold hold() const { return held_.hold; }
  const Pointer& pointer() const { return pointer_; }

  Mouse_reading reading() {
    if (held_.hold != Status::Hold::nothing)
      if (const Eigen::Vector3d handle = map_.way_to_device(way()); handle.allFinite()) // not along the plane looked at
        handle_ = handle;
    Mouse_reading reading;
    reading.pose.position = handle_;
    reading.pointer = pointer_;
    reading.number = ++number_, reading.press = press_;
    return reading;
  }
  std::uint64_t number() const { return number_; } ///< of the last reading

private:
  Workspace_map map_ = map_for(1);
  Pointer pointer_, pressed_;
  double depth_ = 0, along_ = 0; ///< along_: where the mouse pointed on the line along the normal
  Held held_;
  Eigen::Vector3d aim_ = Eigen::Vector3d::Zero(), handle_ = Eigen::Vector3d::Zero();
  std::uint64_t number_ = 0, press_ = 0;

  /// By how much the mouse wants what is held away from where it was taken. \pre something is
  Eigen::Vector3d way() const {
    const Eigen::Vector3d home = vector(held_.home);
    if (held_.hold == Status::Hold::probe)
      return aim_ + depth_ * vector(pointer_.view) - home;
    if (pointer_.along_normal)
      return (nearest_on_normal(pointer_) - along_) * vector(held_.normal);
    return on_plane(pointer_, home) - on_plane(pressed_, home);
  }

  /// The parameter on the line from home along the normal that is nearest to the mouse's line.
  double nearest_on_normal(const Pointer& pointer) const {
    const Eigen::Vector3d from = vector(pointer.from), line = (vector(pointer.to) - from).stableNormalized();
    const Eigen::Vector3d apart = vector(held_.home) - from, normal = vector(held_.normal);
    const double cosine = normal.dot(line), sine = 1 - cosine * cosine;
    const double least_sine = 0.01; // looked at along the normal nearly: a pixel would be too far a way
    return sine > least_sine ? (cosine * apart.dot(line) - apart.dot(normal)) / sine : along_;
  }
};

} // namespace haptic_sculpt::window_program
