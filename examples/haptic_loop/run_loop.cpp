// SPDX-License-Identifier: GPL-3.0-or-later
#include "Fault_injection.h"
#include "Real_time.h"
#include "Row_file.h"
#include "Run_conditions.h"
#include "Tick_clock.h"
#include "Trace.h"
#include "write_run_picture.h"

#include "../common/Mesh_file.h"
#include "../common/Run_log.h"
#include "../common/numbers.h"
#include "../common/process_state.h"
#include "../common/told_loss.h"
#include "../common/write_file.h"
#include "../drawing/surface_mesh_arrays.h"

#include <haptic_sculpt/haptic_rendering.h>
#include <haptic_sculpt/surface.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <memory>

namespace haptic_sculpt::loop_program {
namespace {

using Mesh = CGAL::Surface_mesh<CGAL::Exact_predicates_inexact_constructions_kernel::Point_3>;

using Scene = Loop_scene<Mesh>;
using Loop = Haptic_loop<Scene::Sculptor_type>;
using Session = Loop_session<Loop, Scene>;

/// One run.
class Run {
public:
  Run(const Plan& plan, examples::Result_writer& writer)
      : plan_(plan)
      , settings_(plan.settings)
      , writer_(writer)
      , conditions_(plan)
      , faults_(plan.fault, device_, tick_) {}

  Run_result run() {
    const examples::Mesh_file file(plan_.mesh);
    const std::string hash = file.hash();
    if (plan_.replay && plan_.replay->mesh != hash)
      throw Foreign_recording("the recording is of a mesh with the SHA-256 " + plan_.replay->mesh + ", but that of '" +
                              plan_.mesh + "' is " + hash);
    if (plan_.replay && plan_.replay->is_cut)
      writer_.note("the recording ends within a reading, which is left out");
    log_.emplace(plan_.log, hash);
    if (log_->number_of_edits() > 0 && (plan_.replay || !plan_.record.empty()))
      throw Usage_error("a recording is of a run that begins with the mesh itself; give a log that has no edits, or is "
                        "not there yet");
    std::vector<std::string> left_out;
    Mesh mesh = file.surface<Mesh>(&left_out);
    const auto placed = [&](const Eigen::Vector3d& lower, const Eigen::Vector3d& upper) {
      return conditions_.map(lower, upper);
    };
    // Not on the stack: where that cannot grow any more the system ends the program.
    const auto made_scene = std::make_unique<Scene>(std::move(mesh), placed);
    Scene& scene = *made_scene;
    if (const std::string loss = examples::told_loss(plan_.mesh, plan_.out, scene.mesh, left_out); !loss.empty())
      writer_.note(loss);
    keep_vertex_attributes(scene.sculptor);
    if (const std::string told = log_->resume(scene); !told.empty())
      writer_.note(told);
    const Haptic_parameters parameters = conditions_.parameters();
    const Passivity_limits limits = conditions_.limits(parameters, scene.map, scene.lower, scene.upper);
    tell(limits, parameters);
    const Device_pose<double> start = conditions_.start();
    conditions_.check(parameters, limits);
    const auto made = conditions_.of_settings(
        [&] { return std::make_unique<Loop>(scene.sculptor, device_, start, scene.map, parameters, limits); });
    Loop& loop = *made;
    examples::end_in_order_by_signals();
    trace_.open(plan_.trace, is_interrupted_), record_.open(plan_.record, is_interrupted_);
    log_->begin(recording_head(hash, settings_), static_cast<std::uint64_t>(std::fmax(2, most_lost / tick_)));
    trace_.begin(), record_.begin(); // nothing is refused any more
    Session session(loop, scene, nullptr, nullptr, log_->journal());
    session_ = &session;
    Happenings happenings(scene.sculptor, scene.map.scale());
    happenings_ = &happenings;
    if (plan_.is_real_time)
      for (const std::string& refused : ask_for_real_time())
        writer_.note(refused);
    if (record_.get() != nullptr)
      std::fputs(recording_head(hash, settings_).c_str(), record_.get());
    if (trace_.get() != nullptr)
      write_columns(trace_.get());
    carry_on([&] {
      if (plan_.replay)
        replay(loop);
      else
        simulate(loop, start);
    });
    session.end();
    if (plan_.is_real_time)
      leave_real_time();
    carry_on([&] { finish(loop, scene); });
    carry_on([&] {
      if (*loop.failure() != '\0')
        writer_.note(std::string("the fault `error`: ") + loop.failure());
    });
    carry_on([&] { result_.is_valid = validate(scene.mesh).is_valid(); }); // last: it needs memory
    return std::move(result_);
  }

private:
  const Plan& plan_;
  const Settings& settings_;
  examples::Result_writer& writer_;
  const std::atomic<bool>& is_interrupted_ = examples::process::is_ended();
  static constexpr double most_lost = 0.1;           ///< by a kill, s
  static constexpr double most_late = most_lost / 2; ///< what is made up for, s: no more than the log can take
  const Run_conditions conditions_;
  const Device_parameters<double>& device_ = conditions_.device();
  const double tick_ = conditions_.tick();
  Fault_injection faults_;
  std::optional<examples::Run_log> log_;
  Session* session_ = nullptr;
  Happenings* happenings_ = nullptr;
  Run_samples samples_;
  Run_result result_;
  double free_since_ = 0;
  Row_file trace_, record_;

  /// Keeps what it throws beside the results so far, which are not lost.
  template <class Step>
  void carry_on(const Step& step) {
    try {
      step();
    } catch (const std::exception&) {
      if (!result_.failure)
        result_.failure = std::current_exception();
    }
  }

  void tell(const Passivity_limits& limits, const Haptic_parameters& parameters) {
    result_.friction = limits.friction;
    result_.passive_stiffness = limits.passive_stiffness, result_.calm_stiffness = limits.calm_stiffness;
    result_.largest_damping = limits.largest_damping, result_.largest_mass = limits.largest_mass;
    result_.largest_controller = limits.largest_controller;
    const double stiffness = parameters.stiffest().stiffness;
    if (limits.permits(parameters.stiffest()) && settings_.damping == 0 && stiffness > limits.recommended_stiffness())
      writer_.note("the stiffness " + examples::decimal(stiffness) +
                   (parameters.snap.length > 0 ? " N/m, the snap's with it," : " N/m") +
                   " is passive, but a handle that nobody holds rings on it; recommended are at most " +
                   examples::decimal(limits.recommended_stiffness()) + " N/m, or a damping");
  }

  void replay(Loop& loop) {
    double passed = 0; // ticks, those included in which nobody came
    for (const Joint_reading& reading : plan_.replay->readings) {
      if (is_interrupted_)
        return;
      log_->let_catch_up(session_->ticks());
      passed += std::round(reading.elapsed / tick_);
      if (!tick(loop, reading, passed * tick_))
        return;
    }
  }

  void simulate(Loop& loop, const Device_pose<double>& start) {
    const double seconds = plan_.seconds > 0 ? plan_.seconds : plan_.path->end();
    Simulated_device device(device_, start, settings_.hand, *plan_.path, tick_, settings_.delay);
    Tick_clock clock(tick_, most_late);
    Haptic_tick last;
    while (device.time() < seconds && !is_interrupted_) {
      if (plan_.waits)
        clock.wait(is_interrupted_, result_.wakeup, result_.missed_by_wakeup);
      else
        log_->let_catch_up(session_->ticks());
      if (faults_.is_log() && faults_.is_due(device.time()))
        log_->stall();
      if (faults_.is_stall() && faults_.is_due(device.time()) && !faults_.has_begun() && !stall(device, last))
        break;
      Joint_reading reading = device.read();
      reading.elapsed += std::exchange(stalled_, 0.0);
      if (!faults_.is_stall() && faults_.is_due(device.time()))
        faults_.spoil(reading, device.state().pose);
      if (!tick(loop, reading, device.time()))
        break;
      last = *tick_made_;
      if (!is_moved(device, last.rendered.torque, last.rendered.interaction_torque))
        break;
    }
    result_.has_true_energy = true;
    result_.port = device.port(), result_.dissipated = device.dissipated();
  }

  /// \return whether the mechanism is whole
  bool is_moved(Simulated_device& device, const Eigen::Vector3d& torque, const Eigen::Vector3d& interaction_torque) {
    const Device_status moved = device.write(torque, interaction_torque);
    if (moved == Device_status::success)
      return true;
    writer_.note("at " + std::to_string(device.time()) + " s the mechanism has been torn (" + name_of(moved) +
                 "); give the hand a path within the workspace and a stiffness that its masses can follow, and a "
                 "device with friction a higher --rate");
    result_.faults.emplace_back(device.time(), "torn");
    return false;
  }

  /// Nobody comes for 50 ms. The device lets go by itself after 20. \return whether the mechanism is whole
  bool stall(Simulated_device& device, const Haptic_tick& last) {
    faults_.begin();
    const double begin = device.time();
    const Eigen::Vector3d none = Eigen::Vector3d::Zero();
    while (device.time() < begin + 0.05) {
      const bool holds = device.time() < begin + 0.02;
      if (!is_moved(device, holds ? last.rendered.torque : none, holds ? last.rendered.interaction_torque : none))
        return false;
    }
    stalled_ = device.time() - begin;
    return true;
  }

  double stalled_ = 0;
  const Haptic_tick* tick_made_ = nullptr;

  /// \return whether the run goes on
  bool tick(Loop& loop, const Joint_reading& reading, double time) {
    // No reading is the cause of these faults: in a replay the hand would go on where the run let go.
    const Loop_fault fault = loop.interaction().fault();
    if (record_.get() != nullptr && fault != Loop_fault::log && fault != Loop_fault::error)
      write_reading(record_.get(), reading);
    if (log_->has_failed()) // what is done from here on would be in no log
      log_->journal()->break_off();
    const std::size_t allocated = allocations();
    const std::uint64_t cpu = nanoseconds(CLOCK_THREAD_CPUTIME_ID), wall = nanoseconds(CLOCK_MONOTONIC);
    const Haptic_tick& made = session_->tick(reading);
    const std::uint64_t cpu_taken = nanoseconds(CLOCK_THREAD_CPUTIME_ID) - cpu,
                        wall_taken = nanoseconds(CLOCK_MONOTONIC) - wall;
    result_.allocations += allocations() - allocated;
    tick_made_ = &made;
    ++result_.ticks;
    result_.cpu.add(cpu_taken), result_.wall.add(wall_taken);
    result_.missed += static_cast<double>(wall_taken) > 1e9 * tick_;
    result_.missed_by_cpu += static_cast<double>(cpu_taken) > 1e9 * tick_;
    const auto held = loop.tool().holds_vertex() ? loop.tool().vertex() : Mesh::Vertex_index();
    happenings_->add(time, made.tool, session_->scene().sculptor, held);
    const double force = made.rendered.force.norm();
    if (!plan_.picture.empty())
      sample(made.tool);
    result_.largest_force = std::fmax(result_.largest_force, force);
    if (!made.tool.reached || made.tool.event == Tool_event::refused || made.fault != Loop_fault::none)
      free_since_ = time;
    if (time - free_since_ > loop.parameters().limits.largest / loop.parameters().limits.slew + Refusal_burst::duration)
      result_.largest_free_force = std::fmax(result_.largest_free_force, force);
    if (made.is_new_fault)
      result_.faults.emplace_back(time, name_of(made.fault));
    if (trace_.get() != nullptr)
      write_row(trace_.get(), reading, made, time, cpu_taken);
    return !loop.has_stopped();
  }

  void sample(const Tool_step& tool) {
    samples_.add({tool.target, tool.proxy, !tool.reached});
    constexpr const char* words[] = {"", "grabbed", "created", "created", "released", "removed", "refused"};
    if (tool.event != Tool_event::none && samples_.events.size() < Run_samples::most_events)
      samples_.events.push_back({tool.proxy, words[static_cast<int>(tool.event)]});
  }

  void finish(const Loop& loop, const Scene& scene) {
    const auto& sculptor = scene.sculptor;
    const Workspace_map& map = scene.map;
    result_.observed = loop.observer().energy();
    result_.least_observed = loop.observer().least();
    result_.mass_energy = loop.interaction().virtual_mass().energy();
    if (!result_.has_true_energy)
      result_.port = loop.observer().port(), result_.dissipated = loop.observer().dissipated();
    const Tool_edits& edits = loop.tool().edits();
    result_.grabbed = edits.grabbed, result_.created = edits.created, result_.removed = edits.removed;
    result_.released = edits.released, result_.refused = edits.refused;
    result_.is_cut_short = is_interrupted_;
    result_.map = {map.scale(),
                   map.origin()[0],
                   map.origin()[1],
                   map.origin()[2],
                   map.rotation_vector()[0],
                   map.rotation_vector()[1],
                   map.rotation_vector()[2],
                   map.home()[0],
                   map.home()[1],
                   map.home()[2]};
    log_->finish();
    const auto lacking = [&] {
      return "the log '" + plan_.log + "' lacks the last edits of this run" +
             (plan_.out.empty() ? "" : ", which '" + plan_.out + "' has");
    };
    if (log_->has_overrun() && !result_.faults.empty()) // which is one
      writer_.note(lacking());
    else if (log_->has_overrun() || log_->unwritten() > 0) // the run has ended before that
      writer_.fail(lacking());
    writer_.write(plan_.out, [&](const std::string& path) {
      Write_parameters parameters;
      for (std::size_t name = 0; name < sculptor.number_of_ids(); ++name)
        if (const auto v = sculptor.vertex(name); v.is_valid())
          parameters.vertices_order.emplace_back(static_cast<Mesh::size_type>(v));
      return examples::write_mesh(path, scene.mesh, parameters);
    });
    writer_.write(plan_.picture, [&](const std::string& path) {
      return write_run_picture(drawing::scene_of(scene.mesh), samples_, path);
    });
    for (Row_file* const rows : {&trace_, &record_})
      writer_.write(rows == &trace_ ? plan_.trace : plan_.record, [&](const std::string&) {
        rows->close();
        return std::string();
      });
    if (writer_.all_written() && !result_.failure)
      log_->end();
    for (int what = 0; what < Happenings::number; ++what)
      result_.happened[what] = happenings_->first(static_cast<Happenings::What>(what));
    result_.ticks_written = log_->ticks(), result_.log_lost = log_->lost();
    result_.log_failure = log_->failure();
  }
};

} // namespace

Run_result run_loop(const Plan& plan, examples::Result_writer& writer) {
  examples::end_at_once_by_signals();
  return std::make_unique<Run>(plan, writer)->run(); // large, as the scene is
}

} // namespace haptic_sculpt::loop_program
