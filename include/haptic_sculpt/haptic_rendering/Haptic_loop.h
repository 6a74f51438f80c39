// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef HAPTIC_SCULPT_HAPTIC_RENDERING_HAPTIC_LOOP_H
#define HAPTIC_SCULPT_HAPTIC_RENDERING_HAPTIC_LOOP_H

#include <haptic_sculpt/haptic_rendering/Force_renderer.h>
#include <haptic_sculpt/haptic_rendering/check_coupling.h>
#include <haptic_sculpt/haptic_rendering/Inertia_rendering.h>
#include <haptic_sculpt/haptic_rendering/Passivity_controller.h>
#include <haptic_sculpt/haptic_rendering/Passivity_observer.h>
#include <haptic_sculpt/haptic_rendering/Tool.h>
#include <haptic_sculpt/haptic_rendering/Watchdog.h>

namespace haptic_sculpt {

/// How a loop runs.
struct Haptic_parameters {
  double tick = 0.001;       ///< s
  double delay = 0;          ///< from a command to its torque, ticks
  Virtual_coupling coupling; ///< between hand and tool; refused where it is not stable
  Force_limits limits;       ///< of what reaches the hand
  Watchdog_limits watchdog;  ///< beyond them the loop lets go
  Gravity_compensation gravity = Gravity_compensation::spatial; ///< by the full model, unless it is changed
  Inertia_parameters inertia;                                   ///< off by default
  double controller_damping = 0; ///< the most the passivity controller may damp, N s/m; 0: there is none
  double reach = 0.001;          ///< of a grab, m in the device
  std::size_t work = 400;        ///< pairs a drag may decide (doc/work.md)
};

/// What a tick did; places in the scene, forces on the hand in axes of the device.
struct Haptic_tick {
  Tool_step tool;                                     ///< what the tool did; after a fault nothing, at the last proxy
  Eigen::Vector3d coupling = Eigen::Vector3d::Zero(); ///< N, of the spring alone
  Rendered_force rendered;                            ///< what the motors are to give; fades at a fault
  Loop_fault fault = Loop_fault::none;                ///< why the loop has let go; stays until restart()
  bool is_new_fault = false;                          ///< true in the one tick in which the fault was found
};

/// What stands between a device and a sculpture: at each tick joint angles in, torques out. doc/haptic_rendering.md has
/// the way of a tick.
///
/// Deterministic: the same readings give the same mesh and torques, bit for bit. Reads no clock, waits for nothing, and
/// allocates only where edits do.
template <class Sculptor>
class Haptic_loop {
public:
  using Vertex_index = typename Sculptor::Vertex_index; ///< of the mesh that is sculpted

  /// \param probe an isolated vertex of the sculptor's mesh, outside of all solids \param start a pose near the first
  /// reading \throw Unstable_coupling if `limits`, of the same device and map, do not permit the
  /// coupling, the virtual mass or the passivity controller; Error for an inertia or a delay that cannot be used
  Haptic_loop(Sculptor& sculptor, Vertex_index probe, const Device_parameters<double>& device,
              const Device_pose<double>& start, const Workspace_map& map, const Haptic_parameters& parameters,
              const Passivity_limits& limits)
      : sculptor_(&sculptor)
      , parameters_(parameters)
      , map_(map)
      , handle_(device, start, parameters.tick)
      , tool_(sculptor, probe, map, parameters.reach, parameters.tick)
      , renderer_(parameters.limits, parameters.gravity, parameters.tick)
      , watchdog_(parameters.watchdog, parameters.tick, device.torque_limit())
      , observer_(parameters.delay, parameters.tick, device.viscous_friction(), device.encoder_step())
      , controller_(parameters.controller_damping, parameters.tick)
      , inertia_(parameters.inertia, device, parameters.tick, parameters.delay) {
    check_dynamics(parameters.coupling.damping, parameters.inertia, parameters.controller_damping, limits);
    check_coupling(parameters.coupling, limits);
    sculptor.set_work_limit(parameters.work);
  }

  /// \throw what drags throw: Mesh_changed, Out_of_range
  const Haptic_tick& tick(const Joint_reading& reading) {
    const internal::Rounding_to_nearest rounding;
    tick_.is_new_fault = false;
    if (tick_.fault == Loop_fault::none)
      run(reading);
    if (tick_.fault == Loop_fault::none && watchdog_.fault() != Loop_fault::none) {
      tick_.fault = watchdog_.fault();
      tick_.is_new_fault = true;
      tool_.let_go();
    }
    if (tick_.fault != Loop_fault::none) {
      tick_.rendered = renderer_.fade_out();
      tick_.coupling.setZero();
      const Eigen::Vector3d held = tick_.tool.proxy;
      tick_.tool = Tool_step();
      tick_.tool.target = tick_.tool.proxy = held;
    }
    observer_.command(tick_.rendered.interaction_torque);
    return tick_;
  }

  /// Ends the run at the next tick, in order, for a reason that the loop itself does not see.
  void end_by(Loop_fault fault) { watchdog_.report(fault); }

  /// After a fault: forces come back slowly, from 0, from where everything is.
  void restart() {
    watchdog_.reset(), handle_.restart(), renderer_.restart(), inertia_.restart(), tool_.let_go();
    tick_ = Haptic_tick();
  }

  /// From here on in another sculpture; forces begin at 0. The old one is let go of, and may be destroyed.
  void enter(Sculptor& sculptor, Vertex_index probe, const Workspace_map& map) {
    tool_.enter(sculptor, probe, map);
    sculptor_ = &sculptor, map_ = map;
    sculptor.set_work_limit(parameters_.work);
    restart();
  }

  /// Whether a fault has let go of the hand altogether.
  bool has_stopped() const { return tick_.fault != Loop_fault::none && renderer_.has_faded(); }
  const Tool<Sculptor>& tool() const { return tool_; } ///< what the hand does in the scene
  Tool<Sculptor>& tool() { return tool_; }             ///< for edits between two ticks, in the thread that calls tick()
  const Handle_motion& handle() const { return handle_; }             ///< where the handle was in the last tick
  const Passivity_observer& observer() const { return observer_; }    ///< of all ticks so far that were no fault
  const Inertia_rendering& inertia() const { return inertia_; }       ///< of the virtual mass; tells its energies
  const Haptic_parameters& parameters() const { return parameters_; } ///< those that were given
  const Workspace_map& map() const { return map_; }                   ///< of the scene that is sculpted now

private:
  Sculptor* sculptor_;
  Haptic_parameters parameters_;
  Workspace_map map_;
  Handle_motion handle_;
  Tool<Sculptor> tool_;
  Force_renderer renderer_;
  Watchdog watchdog_;
  Passivity_observer observer_;
  Passivity_controller controller_;
  Inertia_rendering inertia_;
  Haptic_tick tick_;

  /// Stops where the watchdog finds a fault.
  void run(const Joint_reading& reading) {
    if (!watchdog_.check(reading) || !watchdog_.check_condition(handle_.follow(reading.theta)))
      return;
    const Virtual_coupling& coupling = parameters_.coupling;
    observer_.add_step(handle_.joint_step(), coupling.stiffness, handle_.step());
    tick_.tool = tool_.move(handle_.position(), reading.button);
    const Tool_step& tool = tick_.tool;
    if (tool.event == Tool_event::refused)
      renderer_.refuse(handle_, map_.direction_to_device(tool_.last_push()));
    tick_.coupling = coupling.force(map_, tool.proxy, tool.target, tool.reached);
    tick_.rendered = renderer_.render(
        handle_, tick_.coupling + coupling.damping_force(tool.span, handle_.velocity(), tool.reached) +
                     inertia_.force(handle_, tool_.holds_vertex()) + controller_.force(observer_, handle_));
    if (tick_.rendered.is_overloaded)
      watchdog_.report(Loop_fault::torque);
  }
};

} // namespace haptic_sculpt

#endif
