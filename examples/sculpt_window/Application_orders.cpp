// SPDX-License-Identifier: GPL-3.0-or-later
/// \file
/// What keys and questions order.
#include "Application.h"

#include "../common/output_targets.h"

#include <haptic_sculpt/surface/Mesh_file_format.h>

namespace haptic_sculpt::window_program {

using Kind = Request::Kind;

void Application::choose(Tool tool) {
  if (button_ == 0)
    on_release(0);
  choices_.tool = tool;
  point();
}

void Application::scale_tool(double factor) {
  (choices_.tool == Tool::probe ? choices_.depth : choices_.brush.radius) *= factor;
}

void Application::look(const Eigen::Vector3d& direction) {
  view_.camera().look(direction, {0, 0, 1});
  point();
}

void Application::obey(Order order) {
  const double turn = 0.1; // rad
  drawing::Camera& camera = view_.camera();
  frames_due_ = 3;
  switch (order) {
  case Order::tool_drag:
    choose(Tool::drag);
    break;
  case Order::tool_probe:
    choose(Tool::probe);
    break;
  case Order::tool_create:
    choose(Tool::create);
    break;
  case Order::tool_remove:
    choose(Tool::remove);
    break;
  case Order::tool_brush:
    choose(Tool::brush);
    break;
  case Order::next_brush:
    choices_.brush.kind = static_cast<Brush_kind>((static_cast<int>(choices_.brush.kind) + 1) % 5);
    choose(Tool::brush);
    break;
  case Order::larger:
    scale_tool(1.25), point();
    break;
  case Order::smaller:
    scale_tool(0.8), point();
    break;
  case Order::stronger:
    choices_.brush.strength = std::fmin(1, choices_.brush.strength + 0.1);
    break;
  case Order::weaker:
    choices_.brush.strength = std::fmax(-1, choices_.brush.strength - 0.1);
    break;
  case Order::flip:
    ask(request_here(Kind::flip));
    break;
  case Order::collapse:
    ask(request_here(Kind::collapse));
    break;
  case Order::undo:
    ask(request_here(Kind::undo));
    break;
  case Order::redo:
    ask(request_here(Kind::redo));
    break;
  case Order::let_go:
    choices_.question = Choices::Question::none, choices_.shows_help = false;
    ask(request_here(Kind::let_go));
    break;
  case Order::response:
    choices_.response = 1 - choices_.response;
    ask(request_here(Kind::response));
    break;
  case Order::save:
    std::snprintf(choices_.name.data(), choices_.name.size(), "%s", options_.out.c_str());
    if (is_playing()) // a script types nothing
      save(options_.out);
    else
      choices_.question = Choices::Question::name_to_save;
    break;
  case Order::open:
    std::snprintf(choices_.name.data(), choices_.name.size(), "%s", path_.c_str());
    choices_.question = Choices::Question::name_to_open;
    break;
  case Order::record:
    record(record_ == nullptr ? "sculpt_window.actions" : "");
    break;
  case Order::screenshot:
    screenshot_ = "sculpt_window_" + std::to_string(++screenshots_) + ".png";
    break;
  case Order::quit:
    quit();
    break;
  case Order::fit:
    view_.fit();
    break;
  case Order::view_x:
    look({-1, 0, 0});
    break;
  case Order::view_y:
    look({0, 1, 0});
    break;
  case Order::view_z:
    look({0, 0, -1});
    break;
  case Order::view_back:
    look(camera.rotation().row(2));
    break;
  case Order::turn_left:
    camera.turn(-turn, 0, Eigen::Vector3d::Zero());
    break;
  case Order::turn_right:
    camera.turn(turn, 0, Eigen::Vector3d::Zero());
    break;
  case Order::turn_up:
    camera.turn(0, -turn, Eigen::Vector3d::Zero());
    break;
  case Order::turn_down:
    camera.turn(0, turn, Eigen::Vector3d::Zero());
    break;
  case Order::zoom_in:
    camera.magnify(1.25, {camera.width() / 2., camera.height() / 2.});
    break;
  case Order::zoom_out:
    camera.magnify(0.8, {camera.width() / 2., camera.height() / 2.});
    break;
  case Order::help:
    choices_.shows_help = !choices_.shows_help;
    break;
  case Order::panels:
    choices_.shows_panels = !choices_.shows_panels;
    break;
  }
}

/// Whether it is no other file of this run; where it is, that has been told, and in a script counts as not written.
/// \param is_mesh it is to be the sculpted mesh, which may take the place of the one that was read where no log begins
/// with that
bool Application::may_write(const std::string& path, bool is_mesh) {
  std::string why;
  std::vector<examples::Named_file> files = {{"the log", log_},
                                             {"the script", options_.script},
                                             {"the report", options_.report},
                                             {"the recording", recorded_to_}};
  if (!is_mesh || !log_.empty())
    files.push_back({"the mesh that is open", path_});
  if (!is_mesh)
    files.push_back({"where the sculpted mesh goes", options_.out});
  if (const auto* const other = examples::same_file(path, files))
    why = "'" + path + "' is " + other->role + (is_mesh && other->path == path_ ? ", which the log begins with" : "") +
          ": give another name";
  else if (is_mesh && !mesh_file_format(path))
    why = "'" + path + "' does not end in .off, .ply, .obj or .stl";
  if (!why.empty())
    is_playing() ? fail_to_write(why) : say(why);
  return why.empty();
}

void Application::save(const std::string& path, bool quits) {
  if (!may_write(path, true))
    return;
  to_save_.push_back({path, quits});
  if (to_save_.size() == 1)
    ask(request_here(Kind::copy));
}

void Application::open(const std::string& path) {
  if (background_.is_opening())
    return say("a mesh is being opened; wait for it");
  if (is_unsaved() && next_open_ != path) {
    next_open_ = path;
    return say("there is unsaved work: save it, or drop the file once more to leave it (the log has it)");
  }
  next_open_.clear();
  say("opening " + path);
  background_.open(path, options_.log_of(path));
}

void Application::quit() {
  if (is_unsaved() && choices_.question != Choices::Question::leave_unsaved)
    choices_.question = Choices::Question::leave_unsaved;
  else
    is_done_ = true;
  frames_due_ = 3;
}

} // namespace haptic_sculpt::window_program
