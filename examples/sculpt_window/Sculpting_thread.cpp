// SPDX-License-Identifier: GPL-3.0-or-later
#include "Sculpting_thread.h"

#include "Brush_task.h"
#include "Loop_thread.h"
#include "Object_task.h"

#include <deque>
#include <functional>

namespace haptic_sculpt::window_program {

using Hold = Status::Hold;

struct Sculpting_thread::Parts {
  using Command = Loop_command<Scene>;
  /// What is asked for, until it is answered.
  struct Asked {
    std::shared_ptr<Loop_task<Scene>> task;
    std::function<bool(Report&)> tell; ///< what came of it; false: nothing that the window has to know
  };

  std::optional<Loop_thread> loop;
  Mouse mouse;
  std::deque<Command> waiting; ///< that found the queue full
  std::vector<Asked> asked;
  std::uint64_t answered = 0; ///< ticks before the last answer
  Status status;
  Pointed pointed;
  bool is_picking = false, is_pick_due = false; ///< another place, or maybe another face there
  Stroke_task* stroke = nullptr;                ///< in the hand: a brush or an object
  Hold stroke_hold = Hold::brush;               ///< which of them
  const Press* pressing = nullptr;              ///< asked for, and the button still down
  std::size_t vertices = 0, faces = 0;          ///< slots of the model entered last
  std::uint64_t failures = 0;                   ///< that were reported
  std::vector<Model*> models;                   ///< the loop's, in the order in which they are entered
  std::size_t entered = 0;                      ///< how many have been so far

  void ask(const Command& command) {
    waiting.push_back(command);
    ask_waiting();
  }
  void ask_waiting() {
    while (!waiting.empty() && loop->queue.ask(waiting.front()))
      waiting.pop_front();
  }
  void ask(Command::Kind kind, Edit_kind edit = Edit_kind::none) {
    Command command;
    command.kind = kind, command.edit.kind = edit;
    ask(command);
  }
  template <class Task, class Tell>
  void ask(std::shared_ptr<Task> task, const Tell& tell) {
    Command command;
    command.kind = Command::Kind::task, command.task = task.get();
    Task* const raw = task.get();
    asked.push_back({std::move(task), [raw, tell](Report& report) { return tell(*raw, report); }});
    ask(command);
  }
  void ask(std::shared_ptr<Window_task> task) { ask(std::move(task), tell_refusal); }

  static bool tell_refusal(const Window_task& task, Report& report) {
    report.text = task.refusal;
    report.kind = task.is_beside ? Report::Kind::beside : Report::Kind::refused;
    return task.is_beside || !task.refusal.empty();
  }

  /// What the hand holds is the loop's to let go of; here nothing follows the mouse from now on.
  void let_go() {
    if (stroke != nullptr)
      stroke->end();
    stroke = nullptr, pressing = nullptr;
    mouse.let_go();
    is_pick_due = true;
  }

  void begin_stroke(std::shared_ptr<Stroke_task> task, Hold hold) {
    stroke = task.get(), stroke_hold = hold;
    ask(std::move(task), [this](const Stroke_task& done, Report& report) {
      const bool is_down = stroke == &done; // else another press, or none, came after it
      if (is_down)
        stroke = nullptr;
      return tell_refusal(done, report) && (is_down || !done.is_beside);
    });
  }

  void press(const Mouse_reading& reading, Tool tool) {
    const auto task = std::make_shared<Press>(reading, tool, loop->reading());
    pressing = task.get();
    ask(task, [this](const Press& done, Report& report) {
      const bool is_down = pressing == &done;
      if (is_down) {
        pressing = nullptr;
        mouse.take(done.held);
        loop->mouse.put(mouse.reading());
      }
      return tell_refusal(done, report) && (is_down || !done.is_beside);
    });
  }

  bool may_pick() const { return loop && stroke == nullptr && pressing == nullptr && mouse.hold() != Hold::vertex; }
  void pick() {
    if (!is_pick_due || is_picking || !may_pick())
      return;
    is_picking = true, is_pick_due = false;
    ask(std::make_shared<Pick>(mouse.pointer()), [this, of = entered](const Pick& done, Report&) {
      is_picking = false;
      if (of != entered) // of the mesh before
        return false;
      pointed = done.pointed;
      if (mouse.hold() == Hold::probe && pointed.size > 0) {
        mouse.aim(pointed.at);
        loop->mouse.put(mouse.reading());
      }
      return false;
    });
  }

  /// \return whether the report has something to tell
  bool take(const Loop_answer<Scene>& answer, Report& report) {
    report = Report();
    answered = answer.tick;
    if (answer.task != nullptr) {
      const auto found =
          std::find_if(asked.begin(), asked.end(), [&](const Asked& a) { return a.task.get() == answer.task; });
      const Asked done = std::move(*found);
      asked.erase(found);
      const bool has_something = done.tell(report);
      if (answer.failure[0] == '\0')
        return has_something;
      const bool was_copy = report.kind == Report::Kind::copied;
      report = Report(); // such as no memory
      report.kind = was_copy ? Report::Kind::copied : Report::Kind::refused;
      report.text = answer.failure.data();
      return true;
    }
    if (answer.left != nullptr) {
      report.kind = Report::Kind::left, report.model = answer.left;
      models.erase(std::find(models.begin(), models.end(), report.model));
      return true;
    }
    if (answer.done)
      return false;
    report.text = (answer.edit == Edit_kind::undo ? "nothing is undone: " : "nothing is redone: ") +
                  (answer.failure[0] != '\0' ? std::string(answer.failure.data()) : name_of(answer.reason));
    return true;
  }
};

Sculpting_thread::Sculpting_thread() : parts_(std::make_unique<Parts>()) {}

Sculpting_thread::~Sculpting_thread() {
  for (Model* const model : end())
    destroy(model, true);
}

void Sculpting_thread::enter(std::unique_ptr<Model, Destroy_with_log> opened) {
  Parts& p = *parts_;
  p.models.push_back(opened.get());
  Model* const model = opened.release();
  p.vertices = model->mesh.num_vertices(), p.faces = model->mesh.num_faces();
  const Workspace_map map = model->map; // from here on the model is the loop's
  if (!p.loop) {
    p.loop.emplace(model);
  } else {
    Parts::Command command;
    command.kind = Parts::Command::Kind::enter, command.scene = model, command.journal = model->log.journal();
    p.ask(command);
  }
  p.let_go();
  p.mouse.enter(map);
  p.pointed = Pointed(), ++p.entered;
}

void Sculpting_thread::press(const Pointer& pointer, Tool tool, const Brush& brush) {
  Parts& p = *parts_;
  p.let_go();
  p.mouse.point(pointer);
  p.mouse.press();
  const Mouse_reading reading = p.mouse.reading(); // the handle is at home before anything is anchored to it
  p.loop->mouse.put(reading);
  if (tool == Tool::brush)
    p.begin_stroke(std::make_shared<Brush_task>(pointer, brush, p.pointed), Hold::brush);
  else if (tool == Tool::object)
    p.begin_stroke(std::make_shared<Object_task>(pointer, p.pointed), Hold::object);
  else
    p.press(reading, tool);
}

void Sculpting_thread::let_go() {
  parts_->let_go();
  parts_->ask(Parts::Command::Kind::let_go);
}

void Sculpting_thread::break_off() {
  for (Model* const model : parts_->models)
    ++model->times_broken_off;
  let_go();
}

void Sculpting_thread::edit_edge(const Pointer& pointer, bool flips) {
  parts_->let_go();
  parts_->ask(std::make_shared<Edge_edit>(pointer, flips));
}

void Sculpting_thread::take_back(bool undo) {
  parts_->let_go();
  parts_->ask(Parts::Command::Kind::edit, undo ? Edit_kind::undo : Edit_kind::redo);
}

void Sculpting_thread::choose_response(bool slides) {
  parts_->let_go();
  parts_->ask(std::make_shared<Choose_response>(slides ? Response::slide : Response::stop));
}

void Sculpting_thread::remesh(const Pointer& pointer, const std::optional<Brush>& brush, double length) {
  parts_->let_go();
  parts_->ask(std::make_shared<Remesh>(pointer, brush, length, parts_->models.back()->times_broken_off));
}

void Sculpting_thread::unmask_all() {
  parts_->let_go();
  parts_->ask(std::make_shared<Unmask_all>());
}

void Sculpting_thread::copy() {
  const Parts& p = *parts_;
  // While it is filled, and while this waits, each tick may create a vertex, and two faces with it.
  const std::size_t v = std::max(p.vertices, p.status.vertex_slots), f = std::max(p.faces, p.status.face_slots);
  const std::size_t ticks = (v + f) / Save::copied_a_tick + 2048;
  auto task = std::make_shared<Save>(v + ticks, f + 2 * ticks);
  parts_->ask(task, [weak = std::weak_ptr<Save>(task)](const Save& done, Report& report) {
    report.kind = Report::Kind::copied, report.edits = done.edits;
    report.outgrown = !done.copy.is_whole();
    if (report.outgrown)
      report.text = "the mesh has grown meanwhile; save again";
    else
      report.copy = weak.lock();
    return true;
  });
}

void Sculpting_thread::point(const Pointer& pointer, double depth) {
  Parts& p = *parts_;
  p.is_pick_due = true;
  p.mouse.point(pointer), p.mouse.set_depth(depth);
  if (p.loop)
    p.loop->mouse.put(p.mouse.reading());
  p.pick();
}

bool Sculpting_thread::has_stroke() const {
  return parts_->stroke != nullptr;
}

bool Sculpting_thread::is_stroke_waiting() const {
  return has_stroke() && parts_->stroke->is_waiting();
}

bool Sculpting_thread::is_press_waiting() const {
  return parts_->pressing != nullptr || (has_stroke() && parts_->stroke->is_press_waiting());
}

void Sculpting_thread::go_on(const Pointer& pointer) {
  parts_->stroke->add(pointer);
}

const Status& Sculpting_thread::status() {
  Parts& p = *parts_;
  if (!p.loop)
    return p.status;
  p.status = p.loop->latest.get();
  if (p.stroke != nullptr)
    p.status.hold = p.stroke_hold, p.status.pointed = p.stroke->spot();
  else if (p.status.hold == Hold::nothing)
    p.status.pointed = p.pointed;
  return p.status;
}

bool Sculpting_thread::take(Seen_face& change) {
  return parts_->loop && parts_->loop->feed.take(change);
}

bool Sculpting_thread::take(Report& report) {
  Parts& p = *parts_;
  if (!p.loop)
    return false;
  p.ask_waiting();
  for (Loop_answer<Scene> answer; p.loop->queue.take(answer);)
    if (p.take(answer, report))
      return true;
  p.pick();
  if (p.failures == p.status.failures)
    return false;
  p.failures = p.status.failures;
  p.let_go();
  report = Report();
  report.text = p.status.failure.data();
  return true;
}

bool Sculpting_thread::has_done_all() const {
  const Parts& p = *parts_;
  return p.loop && p.waiting.empty() && !is_stroke_waiting() && p.loop->queue.waiting() == (p.stroke != nullptr) &&
         p.status.made > p.answered;
}

const Pointed& Sculpting_thread::pointed() const {
  return parts_->pointed;
}

bool Sculpting_thread::is_pick_waiting() const {
  const Parts& p = *parts_;
  return p.is_picking || (p.is_pick_due && p.may_pick());
}

bool Sculpting_thread::is_idle() const {
  return has_done_all() && !is_pick_waiting() && parts_->status.mouse == parts_->mouse.number();
}

std::vector<Model*> Sculpting_thread::end() {
  for (Model* const model : parts_->models)
    model->ends = true;
  if (parts_->loop) {
    parts_->loop->end();
    parts_->status = parts_->loop->latest.get();
  }
  parts_->loop.reset();
  return std::exchange(parts_->models, {});
}

} // namespace haptic_sculpt::window_program
