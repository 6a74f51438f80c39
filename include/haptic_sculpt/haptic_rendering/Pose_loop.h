// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef HAPTIC_SCULPT_HAPTIC_RENDERING_POSE_LOOP_H
#define HAPTIC_SCULPT_HAPTIC_RENDERING_POSE_LOOP_H

#include <haptic_sculpt/haptic_rendering/Force_limit.h>
#include <haptic_sculpt/haptic_rendering/Pose_reading.h>
#include <haptic_sculpt/haptic_rendering/Refusal_burst.h>
#include <haptic_sculpt/haptic_rendering/Tool.h>
#include <haptic_sculpt/haptic_rendering/Velocity_estimate.h>
#include <haptic_sculpt/haptic_rendering/Watchdog.h>

#include <limits>

namespace haptic_sculpt {

/// How a loop on a device of pose and force runs.
struct Pose_loop_parameters {
  double tick = 0.001;       ///< s
  Virtual_coupling coupling; ///< its stiffness at most passive_stiffness()
  Force_limits limits;       ///< of which cond(J) plays no role
  /// What the device dissipates at the handle, N s/m: with the delay it bounds the stiffness. A device without
  /// force, such as a mouse, has no bound: infinite.
  double friction = std::numeric_limits<double>::infinity(),
         delay = 0;         ///< from a command to its force, ticks
  double mass = 0.05;       ///< of the free handle, kg: a refused edit is felt the less the lighter it is
  double speed = 10;        ///< of a handle that is in order at most, along each axis, m/s
  double stall_time = 0.02; ///< s between two ticks
  double reach = 0.001;     ///< of a grab, m in the device
  std::size_t work = 400;   ///< pairs a drag may decide (doc/work.md)

  /// 2 (friction - |b|) / (T (1 + 2 d)), N/m: up to it no hand can be given energy.
  double passive_stiffness() const { return 2 * (friction - std::abs(coupling.damping)) / (tick * (1 + 2 * delay)); }
};

/// What a tick did; places in the scene, forces on the hand in axes of the device, N.
struct Pose_tick {
  Tool_step tool;                                     ///< what the tool did; after a fault nothing, at the last proxy
  Eigen::Vector3d coupling = Eigen::Vector3d::Zero(); ///< of the spring alone
  Eigen::Vector3d force = Eigen::Vector3d::Zero();    ///< rendered
  Loop_fault fault = Loop_fault::none;                ///< why the loop has let go; stays until restart()
  bool is_new_fault = false;                          ///< true in the one tick in which the fault was found
};

/// What stands between a device of pose and force and a sculpture: at each tick a place in, a force out. Beneath
/// Haptic_loop, which has joints, and like it: deterministic, reads no clock, waits for nothing, allocates only where
/// edits do. A fault lets go, and the force fades to exactly 0.
template <class Sculptor_>
class Pose_loop {
public:
  using Sculptor = Sculptor_;                           ///< whose mesh is sculpted
  using Vertex_index = typename Sculptor::Vertex_index; ///< of that mesh
  using Reading = Pose_reading;                         ///< what tick() takes
  using Tick = Pose_tick;                               ///< what tick() gives

  /// \param probe an isolated vertex of the sculptor's mesh, outside of all solids
  /// \throw Error if the coupling is not passive on this device
  Pose_loop(Sculptor& sculptor, Vertex_index probe, const Workspace_map& map, const Pose_loop_parameters& parameters)
      : parameters_(parameters)
      , map_(map)
      , tool_(sculptor, probe, map, parameters.reach, parameters.tick)
      , velocity_(parameters.tick)
      , watchdog_({parameters.speed, parameters.stall_time}, parameters.tick, std::numeric_limits<double>::infinity())
      , burst_(parameters.tick) {
    if (!(parameters.coupling.stiffness <= parameters.passive_stiffness()))
      throw Error("the stiffness " + internal::number(parameters.coupling.stiffness) +
                  " N/m is not passive on this device: that ends at " +
                  internal::number(std::fmax(0.0, parameters.passive_stiffness())) +
                  "; ask for less, or for a higher rate");
    sculptor.set_work_limit(parameters.work);
  }

  /// \throw what drags throw: Mesh_changed, Out_of_range
  const Pose_tick& tick(const Pose_reading& reading) {
    const internal::Rounding_to_nearest rounding;
    tick_.is_new_fault = false;
    if (tick_.fault == Loop_fault::none) {
      Joint_reading coordinates; // of the handle instead of joints: what the watchdog looks at is the same
      coordinates.theta = reading.position, coordinates.elapsed = reading.elapsed;
      if (watchdog_.check(coordinates)) {
        render(reading);
      } else {
        tick_.fault = watchdog_.fault(), tick_.is_new_fault = true;
        tool_.let_go();
        at_fault_ = tick_.force;
      }
    }
    if (tick_.fault != Loop_fault::none) {
      tick_.force = fade_.next(parameters_.tick / parameters_.limits.fade_time) * at_fault_;
      tick_.coupling.setZero();
      const Eigen::Vector3d held = tick_.tool.proxy;
      tick_.tool = Tool_step();
      tick_.tool.target = tick_.tool.proxy = held;
    }
    return tick_;
  }

  /// Ends the run at the next tick, in order, for a reason that the loop itself does not see.
  void end_by(Loop_fault fault) { watchdog_.report(fault); }

  /// After a fault: forces come back slowly, from 0, from where everything is.
  void restart() {
    watchdog_.reset(), velocity_.reset(), slew_.reset(), burst_.cut(), tool_.let_go();
    is_first_ = true, ramp_ = 0, fade_.reset();
    tick_ = Pose_tick();
  }
  /// From here on in another sculpture; forces begin at 0. The old one is let go of, and may be destroyed.
  void enter(Sculptor& sculptor, Vertex_index probe, const Workspace_map& map) {
    tool_.enter(sculptor, probe, map);
    map_ = map;
    sculptor.set_work_limit(parameters_.work);
    restart();
  }

  /// Whether a fault has let go of the hand altogether: the force is 0.
  bool has_stopped() const { return tick_.fault != Loop_fault::none && fade_.is_over(); }
  const Tool<Sculptor>& tool() const { return tool_; } ///< what the hand does in the scene
  Tool<Sculptor>& tool() { return tool_; }             ///< for edits between two ticks, in the thread that calls tick()
  const Pose_loop_parameters& parameters() const { return parameters_; } ///< those that were given
  const Workspace_map& map() const { return map_; }                      ///< of the scene that is sculpted now

private:
  Pose_loop_parameters parameters_;
  Workspace_map map_;
  Tool<Sculptor> tool_;
  Velocity_estimate velocity_;
  Watchdog watchdog_;
  Refusal_burst burst_;
  Slew_limit slew_;
  Pose_tick tick_;
  Eigen::Vector3d last_ = Eigen::Vector3d::Zero(), at_fault_ = Eigen::Vector3d::Zero();
  bool is_first_ = true;
  double ramp_ = 0;
  Fade_out fade_;

  void render(const Pose_reading& reading) {
    velocity_.add(is_first_ ? Eigen::Vector3d(Eigen::Vector3d::Zero()) : Eigen::Vector3d(reading.position - last_));
    last_ = reading.position, is_first_ = false;
    tick_.tool = tool_.move(reading.position, reading.button);
    const Tool_step& step = tick_.tool;
    if (step.event == Tool_event::refused)
      burst_.begin(map_.direction_to_device(tool_.last_push()), 1 / parameters_.mass);
    tick_.coupling = parameters_.coupling.force(map_, step.proxy, step.target, step.reached);
    const Force_limits& limits = parameters_.limits;
    const Eigen::Vector3d wanted =
        tick_.coupling + parameters_.coupling.damping_force(step.span, velocity_.value(), step.reached);
    const Eigen::Vector3d followed = slew_.follow(clamped(wanted, limits.largest), limits.slew * parameters_.tick);
    ramp_ = std::fmin(1.0, ramp_ + parameters_.tick / limits.ramp_time);
    tick_.force = ramp_ * clamped(followed + burst_.next(), limits.largest);
  }
};

} // namespace haptic_sculpt

#endif
