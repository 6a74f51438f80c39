// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/haptic_rendering/loop/Interaction_loop.h>
#include <haptic_sculpt/haptic_rendering/loop/Pose_side.h>
#include <haptic_sculpt/haptic_rendering/check_coupling.h>

namespace haptic_sculpt {

/// How a loop on a device of pose and force runs.
struct Pose_loop_parameters {
  double tick = 0.001;       ///< s
  Virtual_coupling coupling; ///< its stiffness and that of the snap together at most passive_ and calm_stiffness()
  Vertex_snap snap;          ///< of a hand that holds no vertex; off by default
  Force_limits limits;       ///< of which cond(J) plays no role
  Pose_device device;        ///< what it does at its handle
  double delay = 0;          ///< from a command to its force, ticks
  double speed = 10;         ///< of a handle that is in order at most, along each axis, m/s; may be infinite
  double stall_time = 0.02;  ///< s between two ticks; without force 10 s, whatever it is
  Virtual_mass_parameters virtual_mass;     ///< of what is grabbed; off by default
  std::optional<double> controller_damping; ///< N s/m; nothing: half of what may be asked for
  double reach = 0.001;                     ///< of a grab, m in the device
  std::size_t work_limit = 400;             ///< pairs a drag may decide (doc/use/work.md)
  std::size_t work_of_a_face = 4;           ///< pairs more for each face about the vertex in hand
  /// For which the button has to be quiet before its next change counts, s (Debounced_button).
  double button_quiet_time = Debounced_button::default_quiet_time;

  /// For a device that dissipates so much at its handle, N s/m: with the delay it bounds the stiffness.
  explicit Pose_loop_parameters(double friction) : Pose_loop_parameters(Pose_device(friction)) {}
  explicit Pose_loop_parameters(const Pose_device& device) : device(device) {} ///< for a device
  /// For a device that gives no force, such as a mouse: nothing can swing, and ticks may come when they like.
  static Pose_loop_parameters without_force() { return Pose_loop_parameters(Pose_device::without_force()); }

  bool has_force() const { return device.has_force(); } ///< whether the device gives any
  /// 2 (friction - |b|) / (T (1 + 2 d)), N/m: up to it no hand can be given energy. Infinite without force.
  double passive_stiffness() const {
    const internal::Rounding_to_nearest rounding;
    return has_force() ? haptic_sculpt::passive_stiffness(device.friction, coupling.damping, tick, delay)
                       : std::numeric_limits<double>::infinity();
  }
  /// Beyond it steps of the position are felt, N/m. Infinite without force, or where it is exact.
  double calm_stiffness() const {
    const internal::Rounding_to_nearest rounding;
    return haptic_sculpt::calm_stiffness(has_force() ? device.resolution : 0, coupling.damping);
  }
  /// The damping of a passivity controller that may be asked for, N s/m. 0 without force.
  double largest_controller() const {
    const internal::Rounding_to_nearest rounding;
    return has_force()
               ? std::fmin(device.mass * largest_damping_rate(tick, delay, std::numeric_limits<double>::infinity()),
                           Passivity_controller::largest_damping)
               : 0;
  }

  /// The virtual mass that may be asked for, kg: a share of that of the handle. 0 without force.
  double largest_mass() const {
    const internal::Rounding_to_nearest rounding;
    return has_force() ? stable_share * device.mass * critical_mass_ratio(tick, delay, virtual_mass.cutoff) : 0;
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
    all.tick = tick, all.delay = delay, all.coupling = coupling, all.snap = snap, all.limits = limits,
    all.reach = reach;
    all.work_limit = work_limit, all.work_of_a_face = work_of_a_face, all.controller_damping = controller_damping;
    all.virtual_mass = virtual_mass, all.button_quiet_time = button_quiet_time;
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
