// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/haptic_rendering/loop/Interaction_loop.h>
#include <haptic_sculpt/haptic_rendering/loop/Pose_side.h>
#include <haptic_sculpt/haptic_rendering/check_coupling.h>

namespace haptic_sculpt {

/// How a loop on a device of pose and force runs. The stiffness of coupling and snap together is at most passive_ and
/// calm_stiffness(); of the limits that of cond(J) plays no role.
struct Pose_loop_parameters : Loop_parameters {
  Pose_device device;       ///< what it does at its handle
  double speed = 10;        ///< of a handle that is in order at most, along each axis, m/s; may be infinite
  double stall_time = 0.02; ///< s between two ticks; without force 10 s, whatever it is

  /// For a device that dissipates so much at its handle, N s/m: with the delay it bounds the stiffness.
  explicit Pose_loop_parameters(double friction) : Pose_loop_parameters(Pose_device(friction)) {}
  explicit Pose_loop_parameters(const Pose_device& device) : device(device) {} ///< for a device
  /// For a device that gives no force, such as a mouse: nothing can swing, and ticks may come when they like.
  static Pose_loop_parameters without_force() { return Pose_loop_parameters(Pose_device::without_force()); }

  bool has_force() const { return device.has_force(); } ///< whether the device gives any
  /// 2 (friction - |b|) / (T (1 + 2 d)), N/m: up to it no hand can be given energy. Infinite without force.
  double passive_stiffness() const {
    const internal::Rounding_to_nearest rounding;
    return internal::kept(has_force() ? haptic_sculpt::passive_stiffness(device.friction, coupling.damping, tick, delay)
                                      : std::numeric_limits<double>::infinity());
  }
  /// Beyond it steps of the position are felt, N/m. Infinite without force, or where it is exact.
  double calm_stiffness() const {
    const internal::Rounding_to_nearest rounding;
    return internal::kept(haptic_sculpt::calm_stiffness(has_force() ? device.resolution : 0, coupling.damping));
  }
  /// The damping of a passivity controller that may be asked for, N s/m. 0 without force.
  double largest_controller() const {
    const internal::Rounding_to_nearest rounding;
    return internal::kept(
        has_force()
            ? std::fmin(device.mass * largest_damping_rate(tick, delay, std::numeric_limits<double>::infinity()),
                        Passivity_controller::largest_damping)
            : 0);
  }

  /// The virtual mass that may be asked for, kg: a share of that of the handle. 0 without force.
  double largest_mass() const {
    const internal::Rounding_to_nearest rounding;
    return internal::kept(
        has_force() ? stable_share * device.mass * critical_mass_ratio(tick, delay, virtual_mass.cutoff) : 0);
  }

  /// As all loops have them. \throw Error naming what cannot be used
  Haptic_parameters checked() const {
    device.check();
    using Limits = Watchdog_limits;
    constexpr double none = std::numeric_limits<double>::infinity();
    internal::require_number("Pose_loop_parameters::speed, the speed that is a jump,", "m/s", speed, Limits::least_rate,
                             none);
    if (has_force())
      internal::require_number("Pose_loop_parameters::stall_time, the time that is a stall,", "s", stall_time,
                               Limits::shortest_stall, Limits::longest_stall);
    Haptic_parameters all;
    static_cast<Loop_parameters&>(all) = *this;
    all.watchdog.joint_rate = speed, all.watchdog.stall_time = has_force() ? stall_time : Limits::longest_stall;
    all.check();
    return all;
  }
};

/// What a tick of it did.
using Pose_tick = Haptic_tick;

/// A loop on a device of pose and force: at each tick a place in, a force out, `rendered.force`. No torques.
template <class Sculptor_>
class Pose_loop : public Interaction_loop<Sculptor_, Pose_side> {
public:
  using Base = Interaction_loop<Sculptor_, Pose_side>; ///< what all loops do
  using Vertex_index = typename Base::Vertex_index;    ///< of the mesh that is sculpted

  /// \throw Unstable_coupling if the coupling is not passive on this device, or the controller too strong; Error for
  /// parameters that cannot be used
  Pose_loop(Sculptor_& sculptor, const Workspace_map& map, const Pose_loop_parameters& parameters)
      : Pose_loop(sculptor, map, parameters, internal::Rounding_to_nearest()) {}

private:
  // The mode lives while the loop is made.
  Pose_loop(Sculptor_& sculptor, const Workspace_map& map, const Pose_loop_parameters& parameters,
            const internal::Rounding_to_nearest& /*rounding*/)
      : Base(sculptor, Pose_side(parameters.device, parameters.checked()), map, parameters.checked(),
             0.5 * parameters.largest_controller()) {
    if (!parameters.has_force())
      return;
    Passivity_limits limits;
    limits.friction = parameters.device.friction, limits.passive_stiffness = parameters.passive_stiffness();
    limits.calm_stiffness = parameters.calm_stiffness();
    limits.largest_damping = std::fmin(limits.friction, parameters.device.mass *
                                                            largest_damping_rate(parameters.tick, parameters.delay));
    limits.largest_controller = parameters.largest_controller(), limits.largest_mass = parameters.largest_mass();
    check_forces(parameters.checked(), limits);
  }
};

} // namespace haptic_sculpt
