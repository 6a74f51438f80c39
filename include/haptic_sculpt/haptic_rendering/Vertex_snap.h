// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/haptic_rendering/loop/require_number.h>

#include <Eigen/Core>

namespace haptic_sculpt {

/// Draws a hand that holds no vertex to the nearest one: the force grows with the distance up to half the length, and
/// ends at the length. Off by default. SI units, at the handle.
///
/// It has the potential min over all vertices of u(distance), whose second derivatives are at most stiffness(): a force
/// that is held for a tick gives at most half of that times the square of the handle's step, as a spring of that
/// stiffness does. So it counts as one where limits of passivity are checked. To take a vertex in hand, and to let go
/// of it, switches it off and on, and may give energy(). A loop allows for that once: without a controller
/// (`controller_damping` 0) a second time may be its fault `energy`.
struct Vertex_snap {
  static constexpr double least_length = 1e-5; ///< m, unless it is 0: below it are the counts of encoders
  double length = 0;                           ///< m; 0: no snap
  double force = 0.2;                          ///< N, at most

  /// Of the steepest part, N/m.
  double stiffness() const { return length > 0 ? 2 * force / length : 0; }
  /// How deep the potential is: what a hand is given that comes to a vertex, J.
  double energy() const { return length > 0 ? force * length / 2 : 0; }

  /// The force on the hand, N. \param way from the hand to the nearest vertex, m
  Eigen::Vector3d force_for(const Eigen::Vector3d& way) const {
    const double distance = way.norm();
    if (!(distance < length))
      return Eigen::Vector3d::Zero();
    const double slope = stiffness();
    return distance <= length / 2 ? Eigen::Vector3d(slope * way)
                                  : Eigen::Vector3d(slope * (length - distance) / distance * way);
  }

  /// \throw Error for a number that cannot be used
  void check() const {
    internal::require_number("Vertex_snap::length", "m", length, 0, 1);
    internal::require_number("Vertex_snap::force", "N", force, 0, 100);
    if (length > 0)
      internal::require_number("Vertex_snap::length, unless it is 0,", "m", length, least_length, 1);
  }
};

} // namespace haptic_sculpt
