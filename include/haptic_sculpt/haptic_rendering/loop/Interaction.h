// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/haptic_rendering/loop/Joint_side.h>
#include <haptic_sculpt/haptic_rendering/Passivity_controller.h>

#include <utility>

namespace haptic_sculpt {

/// What a scene does to the hand in a tick, in axes of the device.
struct Touch {
  Eigen::Vector3d way = Eigen::Vector3d::Zero(); ///< from where the hand wants what it holds to where that is, m
  Contact_span span;                             ///< of what pushes
  Eigen::Vector3d snap = Eigen::Vector3d::Zero(); ///< the force of a Vertex_snap, N
  bool is_free = true;                           ///< what is held is where it is wanted
  bool is_starved = false; ///< work was cut short before anything was found to push: no spring can be rendered
  bool holds = false;      ///< something that may have a virtual mass is in hand
};

/// A loop without the sculpture: what stands between the readings of a device and the force of a touch. Every loop has
/// this one chain: watchdog, motion of the handle, observer; spring, damper, virtual mass, controller; clamp, slew
/// limit, burst, ramp; what the side adds; and, after a fault, the fade. No allocation.
/// \tparam Side_ of the device: Joint_side or Pose_side
template <class Side_>
class Interaction {
public:
  using Side = Side_;                      ///< towards the device
  using Reading = typename Side_::Reading; ///< of the device

  /// \param controller_damping the most that the passivity controller may damp, N s/m
  /// \throw Error for parameters that cannot be used
  Interaction(const Side& side, const Haptic_parameters& parameters, double controller_damping)
      : side_(side)
      , coupling_(parameters.coupling)
      , stiffness_(parameters.stiffest().stiffness)
      , largest_(parameters.limits.largest)
      , reserve_(reserve_of(parameters.limits))
      , watchdog_(limits_for(side, parameters.watchdog), parameters.tick, side.effort_limit())
      , observer_(parameters.delay, parameters.tick, side.friction(), side.resolution(), parameters.snap.energy())
      , controller_(controller_damping, parameters.tick)
      , virtual_mass_(parameters.virtual_mass, parameters.tick, parameters.delay)
      , tick_(parameters.tick) {
    parameters.check();
  }

  /// Begins a tick. \return whether the reading may be used; false where there is a fault
  bool follow(const Reading& reading) {
    // At the first reading, as everywhere, it does not count; one that is no time is a fault below.
    const bool is_first = !std::exchange(has_last_, true);
    // Before a restart that came after a stall the device has let go: what it carried does not come back at once.
    if (is_first && std::exchange(is_restarted_, false) && reading.elapsed > watchdog_.limits().stall_time)
      side_.fade_out(std::numeric_limits<double>::infinity()), side_.restart();
    elapsed_ = is_first || !std::isfinite(reading.elapsed) ? tick_ : reading.elapsed;
    if (!watchdog_.check(Side::coordinates(reading), Side::efforts(reading), reading.elapsed) ||
        !watchdog_.check_condition(side_.follow(reading, reading.elapsed)))
      return false;
    if (!is_first) // no step leads to where a loop begins
      observer_.add_step(side_.effort_step(), stiffness_, side_.step(), elapsed_);
    if (side_.has_force() && observer_.is_blind()) // after a step that no hand makes
      watchdog_.report(Loop_fault::not_finite);
    if (side_.has_force() && observer_.is_active())
      watchdog_.report(Loop_fault::energy);
    return watchdog_.fault() == Loop_fault::none;
  }

  /// The force of a touch, after follow().
  void render(const Touch& touch) {
    const bool pulls = !touch.is_free && !touch.is_starved;
    const double share = paid_share(touch);
    spring_ = pulls ? Eigen::Vector3d(share * coupling_.stiffness * touch.way)
                    : Eigen::Vector3d(Eigen::Vector3d::Zero());
    wanted_ = spring_ + touch.snap + coupling_.damping_force(touch.span, side_.velocity(), !pulls);
    if (!touch.is_starved) // what the spring holds is not known then
      observer_.forget_beyond(reserve_ + (pulls ? held_energy(touch.way.norm()) : 0) +
                              virtual_mass_.held_energy(side_.velocity()));
    if (side_.has_force())
      wanted_ += virtual_mass_.force(side_.step(), elapsed_, touch.holds) +
                 controller_.force(observer_, side_.step(), elapsed_);
    render_wanted(touch.is_starved ? 0 : side_.step().norm(), !touch.is_free || !touch.snap.isZero(0));
  }
  /// No force is wanted, after follow(): what is left goes as fast as the slew limit lets it. Neither burst nor virtual
  /// mass nor controller has a say.
  void render_nothing() {
    is_paid_ = side_.next_ramp() == 1;
    spring_.setZero(), wanted_.setZero();
    side_.cut_burst(), virtual_mass_.restart();
    observer_.forget_beyond(reserve_);
    render_wanted(side_.step().norm(), false);
  }

  /// While a force fades readings are not followed, but a stall counts. \param elapsed since the last one, s
  void let_pass(double elapsed) {
    if (elapsed > watchdog_.limits().stall_time)
      elapsed_ = elapsed;
  }

  /// Ends a tick: after a fault the force is what is left of the last one; none where the device has let go meanwhile,
  /// by its own timeout: what came back would push.
  void end_tick() {
    if (watchdog_.fault() != Loop_fault::none) {
      const bool has_let_go = watchdog_.fault() == Loop_fault::stall || elapsed_ > watchdog_.limits().stall_time;
      rendered_ = side_.fade_out(has_let_go ? std::numeric_limits<double>::infinity() : elapsed_);
      if (watchdog_.fault() != Loop_fault::late) // no reading is followed any more, and a stall counts once
        elapsed_ = 0;
      spring_.setZero();
    }
    observer_.command(rendered_.interaction_torque);
  }

  /// A refused edit is felt along a direction.
  void refuse(const Eigen::Vector3d& direction) { side_.refuse(direction); }
  void report(Loop_fault fault) { watchdog_.report(fault); }             ///< one found elsewhere
  Loop_fault fault() const { return watchdog_.fault(); }                 ///< the first since the last restart()
  bool has_faded() const { return side_.has_faded(); }                   ///< after a fault: the force has come to 0
  const Eigen::Vector3d& spring() const { return spring_; }              ///< of the last tick, N
  const Eigen::Vector3d& wanted() const { return wanted_; }              ///< of the last touch, before all limits, N
  const Rendered_force& rendered() const { return rendered_; }           ///< in the last tick
  const Side& side() const { return side_; }                             ///< towards the device
  const Passivity_observer& observer() const { return observer_; }       ///< of all ticks so far that were no fault
  const Passivity_controller& controller() const { return controller_; } ///< tells what it has damped
  const Virtual_mass& virtual_mass() const { return virtual_mass_; }     ///< tells its energy

  /// After a fault: forces come back slowly, from 0. What the observer missed is forgotten.
  void restart() {
    if (watchdog_.fault() == Loop_fault::energy || observer_.is_blind())
      observer_.restart();
    watchdog_.reset(), side_.restart(), virtual_mass_.restart();
    spring_.setZero(), rendered_ = Rendered_force(), is_paid_ = false, has_last_ = false, is_restarted_ = true;
  }

private:
  Side side_;
  Virtual_coupling coupling_;
  double stiffness_; ///< of all that a scene does, N/m
  double largest_;   ///< force, N
  double reserve_;   ///< what may come back beside the spring, J
  Watchdog watchdog_;
  Passivity_observer observer_;
  Passivity_controller controller_;
  Virtual_mass virtual_mass_;
  Eigen::Vector3d spring_ = Eigen::Vector3d::Zero(), wanted_ = Eigen::Vector3d::Zero();
  Rendered_force rendered_;
  double tick_, elapsed_ = 0; ///< s
  bool has_last_ = false;     ///< a reading, since the last restart()
  bool is_restarted_ = false; ///< and no reading since
  bool is_paid_ = false;  ///< the spring has been whole ever since nothing was touched

  /// \param way of the handle that made it what it is, m
  void render_wanted(double way, bool is_touched) {
    rendered_ = side_.render(wanted_, way, elapsed_, is_touched);
    if (rendered_.is_overloaded)
      watchdog_.report(Loop_fault::torque);
    if (!rendered_.is_finite)
      watchdog_.report(Loop_fault::not_finite);
  }

  /// What the spring gives back at most as a hand comes out, its force clamped. \param way of the spring, m \return J
  double held_energy(double way) const {
    const double force = std::fmin(stiffness_ * way, largest_);
    return stiffness_ > 0 ? force * (way - 0.5 * force / stiffness_) : 0;
  }

  /// The share of the spring that is rendered. Where it gets stiffer while a hand presses it, under a ramp, or is back
  /// after work was cut short, nobody has put in what it holds: it holds no more than hand and friction have paid then,
  /// until nothing is touched.
  double paid_share(const Touch& touch) {
    if (touch.is_starved || is_paid_ || !side_.has_force()) {
      is_paid_ = !touch.is_starved;
      return 1;
    }
    const double ramp = side_.next_ramp(), paid = observer_.balance(); // J
    const double held = 0.5 * ramp * coupling_.stiffness * touch.way.squaredNorm(); // J
    is_paid_ = ramp == 1 && touch.is_free;
    return touch.is_free || held <= paid ? 1 : paid > 0 ? paid / held : 0;
  }

  /// Snap and burst hold some mJ; and where a proxy falls, the slew limit leaves a force for a while, in which a hand
  /// at 0.3 m/s is given half of what is taken here: 13 mJ by default.
  static double reserve_of(const Force_limits& limits) {
    return 0.05 + 0.3 * limits.largest * limits.largest / limits.slew;
  }

  /// A device that gives no force may come when it likes.
  static Watchdog_limits limits_for(const Side& side, Watchdog_limits limits) {
    if (!side.has_force())
      limits.late_ticks = std::numeric_limits<double>::infinity(), limits.stall_time = Watchdog_limits::longest_stall;
    return limits;
  }
};

} // namespace haptic_sculpt
