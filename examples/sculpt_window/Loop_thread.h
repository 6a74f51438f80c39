// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Tasks.h"

#include <haptic_sculpt/haptic_rendering/Pose_loop.h>
#include <haptic_sculpt/haptic_rendering/Tick_statistics.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <ctime>
#include <optional>
#include <thread>

namespace haptic_sculpt::window_program {

/// A thousand ticks a second of a Loop_session, and what it tells the window: changed faces through its Scene_feed; of
/// the Status the newest counts.
class Loop_thread {
public:
  /// \name For the window's thread
  ///@{
  Command_queue<Scene> queue;
  Latest<Mouse_reading> mouse;
  Latest<Status> latest;
  Basic_scene_feed<Seen_face> feed{std::size_t(1) << 16, 1}; ///< faces alone: of ticks the newest Status counts

  /// For tasks: what the mouse says in the tick under way.
  const Mouse_reading& reading() const { return reading_; }

  explicit Loop_thread(Model* first) : model_(first), status_(status_of_first(*first)) {
    loop_.emplace(first->sculptor, first->map, parameters());
    loop_->tool().carry_probe(false);
    session_.emplace(*loop_, *first, &queue, &feed, first->log.journal());
    thread_ = std::thread([this] { run(); });
  }
  ~Loop_thread() { end(); }
  /// Lets go, and ends. What it has told is there yet.
  void end() {
    ends_ = true;
    if (thread_.joinable())
      thread_.join();
    session_.reset(), loop_.reset(); // before the models that they work on
  }
  ///@}

private:
  using Loop = Pose_loop<Scene::Sculptor_type>;
  using Session = Loop_session<Loop, Scene>;
  static constexpr std::uint64_t tick_time = 1000000; // ns
  static constexpr std::size_t entries_a_tick = 4096; // of a journal: more than a tick makes

  Model* model_;
  std::atomic<bool> ends_{false};
  Status status_;
  Mouse_reading reading_;
  Tick_statistics work_, lateness_;
  std::optional<Loop> loop_; ///< made in the window's thread, where what it throws ends in order
  std::optional<Session> session_;
  std::thread thread_; ///< last: it uses the others

  Status status_of_first(const Model& model) {
    Status status;
    count(model, status);
    status.scene = 1;
    latest.put(status); // the window may ask before the first tick
    return status;
  }
  static void count(const Model& model, Status& status) {
    status.vertices = model.mesh.number_of_vertices(), status.faces = model.mesh.number_of_faces();
    status.vertex_slots = model.mesh.num_vertices(), status.face_slots = model.mesh.num_faces();
  }

  /// A mouse may jump, and dissipates nothing: it has no force.
  static Pose_loop_parameters parameters() {
    Pose_loop_parameters parameters = Pose_loop_parameters::without_force();
    parameters.speed = std::numeric_limits<double>::infinity();
    return parameters;
  }

  static std::uint64_t now() {
    timespec time;
    clock_gettime(CLOCK_MONOTONIC, &time);
    return static_cast<std::uint64_t>(time.tv_sec) * 1000000000u + static_cast<std::uint64_t>(time.tv_nsec);
  }
  static void wait_until(std::uint64_t due) {
    const timespec until{static_cast<std::time_t>(due / 1000000000u), static_cast<long>(due % 1000000000u)};
    while (clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &until, nullptr) == EINTR)
      ;
  }
  static Percentiles percentiles_of(const Tick_statistics& times) {
    return {times.percentile(0.5), times.percentile(0.99), times.percentile(0.999), times.largest()};
  }

  void run() {
    Loop& loop = *loop_;
    Session& session = *session_;
    std::uint64_t due = now();
    while (!ends_) {
      const std::uint64_t begin = now();
      lateness_.add(begin > due ? begin - due : 0);
      if (const Loop_fault fault = tick(session, loop); fault != Loop_fault::none) {
        ++status_.failures; // such as a target out of range: the mesh is as it was
        const char* const failure = *loop.failure() != '\0' ? loop.failure() : name_of(fault);
        *std::copy_n(failure, std::min(std::strlen(failure), status_.failure.size() - 1), status_.failure.data()) =
            '\0';
        loop.restart();
      }
      const std::uint64_t end = now();
      work_.add(end - begin);
      ++status_.ticks;
      status_.missed_by_work += end - begin > tick_time;
      status_.woken_late += begin > due + tick_time;
      if (status_.ticks % 256 == 1)
        status_.work = percentiles_of(work_), status_.lateness = percentiles_of(lateness_);
      latest.put(status_);
      due += tick_time;
      if (due + 20 * tick_time < end)
        due = end; // what was missed is not made up for
      wait_until(due);
    }
    session.end();
    status_.work = percentiles_of(work_), status_.lateness = percentiles_of(lateness_);
    latest.put(status_);
  }

  /// \return the fault that it says
  Loop_fault tick(Session& session, const Loop& loop) {
    status_.waits_for_disk = !has_room(session);
    if (status_.waits_for_disk) {
      session.pass_faces_on(); // all stands still until the log is written
      return Loop_fault::none;
    }
    const Mouse_reading& newest = mouse.get();
    if (newest.press == reading_.press || (!loop.tool().holds_vertex() && !loop.tool().holds_probe()))
      reading_ = newest;                      // else what is held is yet to be let go of, and stays where it is
    reading_.pose.elapsed = 1e-9 * tick_time; // a mouse has no clock of its own, and has said nothing yet at first
    const Pose_tick& made = session.tick(reading_.pose);
    status_.scene += model_ != &session.scene();
    model_ = &session.scene();
    model_->end_tick(loop.tool().vertex());
    tell(made, loop.tool());
    status_.made = session.ticks(), status_.mouse = reading_.number;
    return made.fault;
  }

  static bool has_room(Session& session) {
    const Edit_journal* const journal = session.journal();
    return journal == nullptr ||
           (journal->room() >= entries_a_tick && journal->age(session.ticks()) <= journal->most_age() / 2);
  }

  void tell(const Pose_tick& made, const Loop_task<Scene>::Tool_type& tool) {
    const Model& model = *model_;
    using Hold = Status::Hold;
    status_.hold = tool.holds_vertex() ? Hold::vertex : tool.holds_probe() ? Hold::probe : Hold::nothing;
    const bool pulls = status_.hold != Hold::nothing;
    status_.vertex = tool.holds_vertex() ? model.sculptor.id(tool.vertex()) : 0;
    status_.target = place(made.tool.target), status_.proxy = place(made.tool.proxy);
    status_.force = pulls ? place(made.rendered.force) : Place{}; // what fades after that is not felt
    status_.reached = made.tool.reached;
    status_.end = made.tool.end ? name_of(*made.tool.end) : "";
    status_.contacts = 0;
    if (tool.last_drag())
      for (const auto& contact : tool.last_drag()->contacts) {
        if (status_.contacts == Status::most_contacts || contact.kind == Contact_kind::delta)
          break;
        status_.contact[static_cast<std::size_t>(status_.contacts++)] = view_of(contact);
      }
    const auto history = model.sculptor.history();
    status_.undo_steps = history.number_of_undo_steps(), status_.redo_steps = history.number_of_redo_steps();
    count(model, status_);
    status_.edits = model_->edits;
    status_.log_has_failed = model_->log.has_failed() || model_->log.has_overrun();
    status_.dirty_faces = model_->sculptor.visitor().changed.size();
  }

  template <class Contact>
  Contact_view view_of(const Contact& contact) const {
    Contact_view view;
    view.kind = name_of(contact.kind);
    // Of the three vertices those that are the feature which is met: all, the edge's two, or the one.
    const int first = contact.kind == Contact_kind::vertex_face ? 0 : contact.kind == Contact_kind::edge_edge ? 1 : 2;
    view.still = 3 - first;
    for (int i = 0; i < view.still; ++i) {
      const Vertex_index v = contact.vertices[static_cast<std::size_t>(first + i)];
      view.points[static_cast<std::size_t>(i)] = place(drawing::to_eigen(model_->mesh.point(v)));
      view.ids[static_cast<std::size_t>(i)] = model_->sculptor.id(v);
    }
    view.normal = {contact.normal.x(), contact.normal.y(), contact.normal.z()};
    return view;
  }
};

} // namespace haptic_sculpt::window_program
