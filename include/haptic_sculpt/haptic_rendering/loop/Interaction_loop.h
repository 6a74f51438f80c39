// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/haptic_rendering/loop/Interaction.h>
#include <haptic_sculpt/haptic_rendering/Tool.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <utility>

namespace haptic_sculpt {

/// What a tick did; places in the scene, forces on the hand in axes of the device.
struct Haptic_tick {
  Tool_step tool;                                     ///< what the tool did; after a fault nothing, at the last proxy
  Eigen::Vector3d coupling = Eigen::Vector3d::Zero(); ///< N, of the spring alone
  Rendered_force rendered;                            ///< what the device is to give; fades at a fault
  Loop_fault fault = Loop_fault::none;                ///< why the loop has let go; stays until restart()
  bool is_new_fault = false;                          ///< true in the one tick in which the fault was found
};

/// What stands between a device and a sculpture: at each tick a reading in, a force out. doc/use/haptic_rendering.md
/// has the way of a tick. Haptic_loop and Pose_loop are made of it.
///
/// Deterministic: the same readings give the same mesh and forces, bit for bit. Reads no clock, waits for nothing, and
/// allocates only where edits do.
/// \tparam Sculptor_ whose mesh is sculpted \tparam Side_ Joint_side or Pose_side
template <class Sculptor_, class Side_>
class Interaction_loop {
public:
  using Sculptor = Sculptor_;                           ///< whose mesh is sculpted
  using Side = Side_;                                   ///< towards the device
  using Vertex_index = typename Sculptor::Vertex_index; ///< of that mesh
  using Reading = typename Side::Reading;               ///< what tick() takes
  using Tick = Haptic_tick;                             ///< what tick() gives

  /// What throws in a tick is a fault, and failure() has what it says: a driver may call this from C.
  const Haptic_tick& tick(const Reading& reading) noexcept {
    const internal::Rounding_to_nearest rounding;
    tick_.is_new_fault = false;
    if (tick_.fault == Loop_fault::none)
      attempt([&] { run(reading); });
    else
      interaction_.let_pass(reading.elapsed);
    if (tick_.fault == Loop_fault::none && interaction_.fault() != Loop_fault::none)
      tick_.fault = interaction_.fault(), tick_.is_new_fault = has_to_let_go_ = true;
    if (has_to_let_go_) // where a tick is made within a call of the caller's, that goes on to its end
      attempt([&] { tool_.let_go(), has_to_let_go_ = false; });
    interaction_.end_tick();
    if (tick_.fault != Loop_fault::none) {
      const Eigen::Vector3d held = tick_.tool.proxy;
      tick_.tool = Tool_step();
      tick_.tool.target = tick_.tool.proxy = held;
    }
    tick_.coupling = interaction_.spring(), tick_.rendered = interaction_.rendered();
    return tick_;
  }

  /// Ends the run at the next tick, in order, for a reason that the loop itself does not see.
  void end_by(Loop_fault fault) { interaction_.report(fault); }
  /// Does what belongs to a tick: what it throws becomes a fault of the next one.
  template <class Function>
  void attempt(const Function& function) noexcept {
    try {
      function();
    } catch (const std::exception& error) {
      fail(error.what());
    } catch (...) { // of a visitor or a task: not of this library, and yet the force has to fade
      fail("something was thrown that is no std::exception");
    }
  }

  /// After a fault: forces come back slowly, from 0, from where everything is; a zoom that waits is forgotten. A fault
  /// that no tick has said yet is not over by that: the next tick says it. Under an open clutch a probe stays where it
  /// is; where a vertex was in hand the tool goes on from where the handle is.
  void restart() {
    tool_.let_go();
    begin_anew();
  }

  /// \name Clutch and zoom
  /// Between two ticks, in the thread that calls tick(). What is held stays in hand, where it is, and the spring begins
  /// again at 0 there: the force goes to 0 as fast as the slew limit lets it; under an open clutch a burst ends at
  /// once. The home of the map stays.
  ///@{

  /// Open: the handle moves alone, and the button waits. Closed again: the handle goes on from where the tool is.
  void open_clutch(bool is_open = true) {
    is_map_due_ = is_map_due_ || is_open || is_clutch_open_;
    is_clutch_open_ = is_open;
  }
  /// Units of the scene a metre of the device, times a factor, from the next tick with a closed clutch on, about where
  /// the tool is. \throw Error for a factor that makes no scale > 0, or none that can be kept where the tool is now
  void zoom(double factor) {
    const internal::Rounding_to_nearest rounding;
    const bool has_place = has_place_ || tool_.place();
    const Eigen::Vector3d handle = has_place ? interaction_.side().position() : map_.home();
    const Eigen::Vector3d place = has_place ? tool_place(handle) : map_.origin();
    const double zoom = zoom_ * factor;
    map_.pinned(handle, place, map_.scale() * zoom); // throws here, not in a tick
    zoom_ = zoom, is_map_due_ = true;
  }
  bool is_clutch_open() const { return is_clutch_open_; } ///< the tool does not follow the handle
  ///@}

  /// From here on in another sculpture, as after a restart(). The old one is let go of, and may be destroyed.
  void enter(Sculptor& sculptor, const Workspace_map& map) {
    tool_.enter(sculptor, map);
    sculptor_ = &sculptor, map_ = map, zoom_ = 1;
    begin_anew();
    tick_.tool = Tool_step(), has_place_ = false;
  }

  /// Whether a fault has let go of the hand altogether: the force is 0.
  bool has_stopped() const { return tick_.fault != Loop_fault::none && interaction_.has_faded(); }
  /// What was thrown where the fault is `error`; cut at some hundred letters, empty else.
  const char* failure() const { return failure_.data(); }
  const Tool<Sculptor>& tool() const { return tool_; } ///< what the hand does in the scene
  Tool<Sculptor>& tool() { return tool_; }             ///< for edits between two ticks, in the thread that calls tick()
  const Passivity_observer& observer() const { return interaction_.observer(); } ///< of all ticks that were no fault
  const Interaction<Side>& interaction() const { return interaction_; }          ///< all but the sculpture
  const Haptic_parameters& parameters() const { return parameters_; } ///< those that were given, and the controller's
  const Workspace_map& map() const { return map_; }                   ///< of the scene that is sculpted now

protected:
  /// \param controller what nothing in `parameters` stands for, N s/m
  Interaction_loop(Sculptor& sculptor, const Side& side, const Workspace_map& map,
                   const Haptic_parameters& parameters, double controller)
      : sculptor_(&sculptor)
      , parameters_(parameters)
      , map_(map)
      , interaction_(side, parameters, parameters.controller_damping.value_or(controller))
      , tool_(sculptor, map, parameters.reach, parameters.tick)
      , button_(parameters.button_quiet_time) {
    parameters_.controller_damping = parameters.controller_damping.value_or(controller);
  }

private:
  Sculptor* sculptor_;
  Haptic_parameters parameters_;
  Workspace_map map_;
  Interaction<Side> interaction_;
  Tool<Sculptor> tool_;
  Debounced_button button_;
  Haptic_tick tick_;
  std::array<char, 256> failure_{};
  bool is_clutch_open_ = false, is_map_due_ = false, has_place_ = false, has_to_let_go_ = false;
  double zoom_ = 1;                                 ///< asked for since the map was made
  Eigen::Vector3d place_ = Eigen::Vector3d::Zero(); ///< of the tool in the last tick, in the scene

  /// Where the tool is, in the scene: where what it holds is, as something may have been put into the hand since the
  /// last tick; else where it was then; else where the handle is.
  Eigen::Vector3d tool_place(const Eigen::Vector3d& handle) const {
    const auto held = tool_.place();
    return held ? *held : has_place_ ? place_ : map_.to_scene(handle);
  }

  void begin_anew() {
    const internal::Rounding_to_nearest rounding;
    const Loop_fault unsaid = tick_.fault == Loop_fault::none ? interaction_.fault() : Loop_fault::none;
    interaction_.restart(), has_to_let_go_ = false;
    has_place_ = has_place_ && is_clutch_open_ && tool_.holds_probe(); // it goes on from there
    const Tool_step last = std::exchange(tick_, Haptic_tick()).tool;
    tick_.tool.target = tick_.tool.proxy = last.proxy;
    zoom_ = 1, is_map_due_ = is_clutch_open_;
    if (unsaid != Loop_fault::none)
      interaction_.report(unsaid);
    else
      failure_[0] = '\0';
  }

  void run(const Reading& reading) {
    if (!interaction_.follow(reading))
      return;
    const Eigen::Vector3d handle = interaction_.side().position();
    if (!map_.to_scene(handle).allFinite()) // a tick has finite places alone
      return interaction_.report(Loop_fault::not_finite);
    const int button = button_.next(reading.button, reading.elapsed);
    if (is_clutch_open_) {
      tick_.tool = Tool_step();
      tick_.tool.target = tick_.tool.proxy = tool_place(handle);
      if (tool_.place()) // it stays there when that is let go of
        place_ = tick_.tool.proxy, has_place_ = true;
      interaction_.render_nothing();
      return;
    }
    if (is_map_due_) {
      map_ = map_.pinned(handle, tool_place(handle), map_.scale() * zoom_);
      tool_.change_map(map_);
      zoom_ = 1, is_map_due_ = false;
    }
    tick_.tool = tool_.move(handle, button, Drag_parameters(sculptor_->parameters().drag).work_limit(work()));
    const Tool_step& tool = tick_.tool;
    place_ = tool.proxy, has_place_ = true;
    if (tool.event == Tool_event::refused)
      interaction_.refuse(map_.direction_to_device(tool_.last_push()));
    Touch touch;
    touch.way = map_.way_to_device(tool.proxy - tool.target), touch.span = tool.span;
    touch.is_free = tool.reached, touch.is_starved = tool.starved, touch.holds = tool_.holds_vertex();
    if (tool_.holds_probe())
      touch.snap = snap_at(tool.target);
    interaction_.render(touch);
  }

  /// The force that draws the hand from a place in the scene, N.
  Eigen::Vector3d snap_at(const Eigen::Vector3d& place) const {
    const Vertex_snap& snap = parameters_.snap;
    if (snap.length == 0)
      return Eigen::Vector3d::Zero();
    const Vertex_index v = internal::nearest_vertex(*sculptor_, place, snap.length * map_.scale());
    return v.is_valid() ? snap.force_for(map_.way_to_device(internal::vector_of(sculptor_->mesh().point(v)) - place))
                        : Eigen::Vector3d(Eigen::Vector3d::Zero());
  }

  /// Of the drag of a tick: to decide whether a step of a vertex is free takes some of each face about it, one far from
  /// others. A tick that takes another vertex in hand does not move it.
  std::size_t work() const {
    const Vertex_index v = tool_.vertex();
    if (v.is_valid())
      internal::Sculptor_access::guarded(*sculptor_).check_counts(); // by others it may be beyond the end
    const std::size_t faces = v.is_valid() ? sculptor_->mesh().degree(v) : 0;
    return parameters_.work_limit +
           std::min(parameters_.work_of_a_face * faces, std::max(faces, Haptic_parameters::most_work_of_faces));
  }

  void fail(const char* what) {
    if (interaction_.fault() != Loop_fault::none)
      return; // what ended the run is said, not what came of it
    std::strncpy(failure_.data(), what, failure_.size() - 1);
    interaction_.report(Loop_fault::error);
  }
};

} // namespace haptic_sculpt
