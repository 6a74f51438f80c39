// SPDX-License-Identifier: GPL-3.0-or-later
/// \file
/// What keys and questions order.
#include "Application.h"

#include "../sculpt/output_targets.h"

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

void Application::save(const std::string& path) {
  if (!mesh_file_format(path)) {
    say("'" + path + "' does not end in .off, .ply, .obj or .stl");
    return;
  }
  if (!log_.empty() && (sculpt_program::are_one_file(path, path_) || sculpt_program::are_one_file(path, log_))) {
    say("'" + path + "' is what the log begins with: give the sculpted mesh another name");
    return;
  }
  names_to_save_.push_back(path);
  if (names_to_save_.size() == 1)
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
