// SPDX-License-Identifier: GPL-3.0-or-later
#include "Sculpting_thread.h"

#include "Brush_task.h"
#include "Loop_thread.h"
#include "Options.h"

#include "../common/write_file.h"

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
  std::vector<Asked> asked;
  std::uint64_t answered = 0; ///< ticks before the last answer
  Status status;
  Pointed pointed;
  bool is_picking = false, is_pick_due = false; ///< another place, or maybe another face there
  Brush_task* brush = nullptr;                  ///< in the hand
  const Press* pressing = nullptr;              ///< asked for, and the button still down
  std::size_t vertices = 0, faces = 0;          ///< slots of the model entered last
  std::uint64_t failures = 0;                   ///< that were reported
  std::vector<Model*> models;                   ///< the loop's, in the order in which they are entered

  bool ask(Command::Kind kind, Edit_kind edit = Edit_kind::none) {
    Command command;
    command.kind = kind, command.edit.kind = edit;
    return loop->queue.ask(command);
  }
  template <class Task, class Tell>
  bool ask(std::shared_ptr<Task> task, const Tell& tell) {
    Command command;
    command.kind = Command::Kind::task, command.task = task.get();
    if (!loop->queue.ask(command))
      return false;
    Task* const raw = task.get();
    asked.push_back({std::move(task), [raw, tell](Report& report) { return tell(*raw, report); }});
    return true;
  }

  static bool tell_refusal(const Window_task& task, Report& report) {
    report.text = task.refusal;
    return !task.refusal.empty();
  }

  bool enter(Model* model) {
    vertices = model->mesh.num_vertices(), faces = model->mesh.num_faces();
    const Workspace_map map = model->map; // from here on the model is the loop's
    if (!loop) {
      loop.emplace(model);
    } else {
      Command command;
      command.kind = Command::Kind::enter, command.scene = model, command.journal = model->log.journal();
      if (!loop->queue.ask(command))
        return false;
    }
    models.push_back(model);
    let_go();
    mouse.enter(map);
    return true;
  }

  /// What the hand holds is the loop's to let go of; here nothing follows the mouse from now on.
  void let_go() {
    if (brush != nullptr)
      brush->end();
    brush = nullptr, pressing = nullptr;
    mouse.let_go();
    is_pick_due = true;
  }

  bool press(const Request& request) {
    mouse.point(request.pointer);
    mouse.press();
    const Mouse_reading reading = mouse.reading(); // the handle is at home before anything is anchored to it
    loop->mouse.put(reading);
    if (request.tool == Tool::brush) {
      const auto task = std::make_shared<Brush_task>(reading, request.brush, pointed.at, loop->reading());
      if (!ask(task, [this](const Brush_task& done, Report& report) {
            if (brush == &done)
              brush = nullptr;
            return tell_refusal(done, report);
          }))
        return false;
      brush = task.get();
      return true;
    }
    const auto task = std::make_shared<Press>(reading, request.tool, loop->reading());
    if (!ask(task, [this](const Press& done, Report& report) {
          if (pressing == &done) {
            pressing = nullptr;
            mouse.take(done.held);
            loop->mouse.put(mouse.reading());
          }
          return tell_refusal(done, report);
        }))
      return false;
    pressing = task.get();
    return true;
  }

  bool may_pick() const { return loop && brush == nullptr && pressing == nullptr && mouse.hold() != Hold::vertex; }
  void pick() {
    if (!is_pick_due || is_picking || !may_pick())
      return;
    is_picking = ask(std::make_shared<Pick>(mouse.pointer()), [this](const Pick& done, Report&) {
      is_picking = false;
      pointed = done.pointed;
      if (mouse.hold() == Hold::probe && pointed.size > 0) {
        mouse.aim(pointed.at);
        loop->mouse.put(mouse.reading());
      }
      return false;
    });
    is_pick_due = !is_picking;
  }

  bool save() {
    // While it is filled, and while this request waits, each tick may create a vertex, and two faces with it.
    const std::size_t v = std::max(vertices, status.vertex_slots), f = std::max(faces, status.face_slots);
    const std::size_t ticks = (v + f) / Save::copied_a_tick + 2048;
    auto task = std::make_shared<Save>(v + ticks, f + 2 * ticks);
    return ask(task, [weak = std::weak_ptr<Save>(task)](const Save& done, Report& report) {
      report.kind = Report::Kind::copied, report.edits = done.edits;
      report.copy = Saved_copy(weak.lock(), &done.copy);
      return true;
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
      return done.tell(report);
    }
    if (answer.left != nullptr) {
      report.kind = Report::Kind::left, report.model = &static_cast<Model&>(*answer.left);
      models.erase(std::find(models.begin(), models.end(), report.model));
      return true;
    }
    if (answer.done)
      return false;
    report.text = (answer.edit == Edit_kind::undo ? "nothing is undone: " : "nothing is redone: ") +
                  std::string(name_of(answer.reason));
    return true;
  }
};

Sculpting_thread::Sculpting_thread() : parts_(std::make_unique<Parts>()) {}

Sculpting_thread::~Sculpting_thread() {
  for (Model* const model : end())
    destroy(model, true);
}

bool Sculpting_thread::ask(const Request& request) {
  using Kind = Request::Kind;
  using Asked_kind = Parts::Command::Kind;
  Parts& p = *parts_;
  if (request.kind == Kind::enter)
    return p.enter(request.model);
  if (request.kind == Kind::copy)
    return p.save();
  p.let_go();
  switch (request.kind) {
  case Kind::press:
    return p.press(request);
  case Kind::flip:
  case Kind::collapse:
    return p.ask(std::make_shared<Edge_edit>(request.pointer, request.kind == Kind::flip), Parts::tell_refusal);
  case Kind::response:
    return p.ask(std::make_shared<Choose_response>(request.response == 0 ? Response::slide : Response::stop),
                 Parts::tell_refusal);
  case Kind::undo:
    return p.ask(Asked_kind::edit, Edit_kind::undo);
  case Kind::redo:
    return p.ask(Asked_kind::edit, Edit_kind::redo);
  default:
    return p.ask(Asked_kind::let_go);
  }
}

void Sculpting_thread::point(const Pointer& pointer, double depth) {
  Parts& p = *parts_;
  p.is_pick_due = true;
  p.mouse.point(pointer), p.mouse.set_depth(depth);
  if (p.loop)
    p.loop->mouse.put(p.mouse.reading());
  p.pick();
}

const Status& Sculpting_thread::status() {
  Parts& p = *parts_;
  if (!p.loop)
    return p.status;
  p.status = p.loop->latest.get();
  if (p.brush != nullptr) {
    p.status.hold = Hold::brush, p.status.brush_left = p.brush->left();
    p.status.pointed.at = p.brush->centre();
  } else if (p.status.hold == Hold::nothing) {
    p.status.pointed = p.pointed;
  }
  return p.status;
}

bool Sculpting_thread::take(Face_change& change) {
  return parts_->loop && parts_->loop->feed.take(change);
}

bool Sculpting_thread::take(Report& report) {
  Parts& p = *parts_;
  if (!p.loop)
    return false;
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

bool Sculpting_thread::is_idle() const {
  const Parts& p = *parts_;
  return p.loop && p.loop->queue.waiting() == (p.brush != nullptr) && !(p.is_pick_due && p.may_pick()) &&
         p.status.mouse == p.mouse.number() && p.status.made > p.answered;
}

std::vector<Model*> Sculpting_thread::end() {
  parts_->loop.reset();
  return std::exchange(parts_->models, {});
}

namespace {

/// What is done about a log that cannot be used depends on who has asked for it.
std::string with_advice(const char* what, const std::string& path, const std::string& log) {
  const bool was_asked_for = log != Options::log_beside(path);
  return std::string(what) + (was_asked_for ? "; --no-log keeps none"
                                            : ". It is the log that the window keeps beside a mesh: --log FILE keeps "
                                              "another one, --no-log none; or move it away");
}

std::unique_ptr<Model> model_of(const std::string& path, const std::string& log) {
  try {
    return std::make_unique<Model>(path, log);
  } catch (const sculpt_program::Foreign_log& error) {
    throw sculpt_program::Foreign_log(with_advice(error.what(), path, log));
  } catch (const Write_error& error) {
    throw Write_error(with_advice(error.what(), path, log));
  }
}

} // namespace

Opened open(const std::string& path, const std::string& log) {
  auto model = model_of(path, log);
  Opened opened;
  opened.path = path, opened.log = log;
  opened.resumed = model->resumed, opened.note = model->note;
  opened.faces.reserve(model->mesh.num_faces());
  for (std::uint32_t f = 0; f < model->mesh.num_faces(); ++f)
    opened.faces.push_back(model->face(f));
  model->sculptor.visitor().changed.clear();
  opened.model = model.release();
  return opened;
}

std::string destroy(Model* model, bool keeps_log) {
  model->log.finish();
  const std::string failure = model->log.failure(), log = keeps_log ? "" : model->log_path;
  delete model;
  if (!log.empty())
    std::remove(log.c_str());
  return failure;
}

std::string write_copy(const Scene_copy& copy, const std::string& path) {
  if (!copy.is_whole())
    throw Error("the copy of the mesh, which was to be saved as '" + path + "', has no room for all of it; save again");
  return examples::write_mesh(path, copy.mesh<Mesh>());
}

} // namespace haptic_sculpt::window_program
