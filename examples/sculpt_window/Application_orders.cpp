// SPDX-License-Identifier: GPL-3.0-or-later
/// \file
/// What keys and questions order.
#include "Application.h"

#include <algorithm>

namespace haptic_sculpt::window_program {

void Application::choose(Tool tool) {
  if (button_ == 0)
    on_release(0);
  choices_.tool = tool;
  point();
}

void Application::choose(Brush_use use) {
  choices_.brush.use = use;
  choose(Tool::brush);
}

void Application::choose_symmetry(const std::array<bool, 3>& axes) {
  if (button_ == 0)
    on_release(0);
  choices_.brush.symmetry = axes;
}

void Application::strengthen(double more) {
  double& strength = choices_.brush.strength;
  strength = std::fmin(1, std::fmax(-1, strength + more));
}

void Application::remesh(bool all, double length) {
  thread_.remesh(pointer_here(), all ? std::nullopt : std::optional(choices_.brush), length);
  frames_due_ = 3;
}

void Application::scale_tool(double factor) {
  double& length = choices_.tool == Tool::probe ? choices_.depth : choices_.brush.radius;
  if (const double scaled = factor * length; std::isnormal(scaled)) // else it could not be scaled back
    length = scaled;
}

void Application::look(const Eigen::Vector3d& direction) {
  view_.camera().look(direction, {0, 0, 1});
  point();
}

void Application::obey(Order order) {
  const double turn = 0.1; // rad
  drawing::Camera& camera = view_.camera();
  frames_due_ = 3;
  const auto counted_from = [order](Order first) { return static_cast<int>(order) - static_cast<int>(first); };
  if (order <= Order::tool_object)
    return choose(static_cast<Tool>(counted_from(Order::tool_drag)));
  if (order <= Order::brush_unmask)
    return choose(static_cast<Brush_use>(counted_from(Order::brush_grab)));
  if (order <= Order::symmetry_z) {
    auto axes = choices_.brush.symmetry;
    bool& axis = axes[static_cast<std::size_t>(counted_from(Order::symmetry_x))];
    axis = !axis;
    return choose_symmetry(axes);
  }
  switch (order) {
  case Order::next_brush:
    choose(static_cast<Brush_use>((static_cast<int>(choices_.brush.use) + 1) % brush_uses));
    break;
  case Order::unmask_all:
    thread_.unmask_all();
    break;
  case Order::remesh_here:
    remesh(false);
    break;
  case Order::remesh_all:
    remesh(true);
    break;
  case Order::remesh_always:
    choices_.brush.remeshes = !choices_.brush.remeshes;
    break;
  case Order::larger:
    scale_tool(1.25), point();
    break;
  case Order::smaller:
    scale_tool(0.8), point();
    break;
  case Order::stronger:
    strengthen(0.1);
    break;
  case Order::weaker:
    strengthen(-0.1);
    break;
  case Order::flip:
    thread_.edit_edge(pointer_here(), true);
    break;
  case Order::collapse:
    thread_.edit_edge(pointer_here(), false);
    break;
  case Order::undo:
    thread_.take_back(true);
    break;
  case Order::redo:
    thread_.take_back(false);
    break;
  case Order::let_go:
    // What is open over the scene is closed alone: what is under way behind it goes on.
    if (std::exchange(choices_.question, Choices::Question::none) == Choices::Question::none &&
        !std::exchange(choices_.shows_help, false))
      thread_.break_off();
    break;
  case Order::response:
    choices_.slides = !choices_.slides;
    thread_.choose_response(choices_.slides);
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
    record(record_ == nullptr ? free_name(".actions") : "");
    break;
  case Order::screenshot:
    if (const std::string name = free_name(".png"); may_write(name, Written::picture))
      screenshot_ = name;
    break;
  case Order::quit:
    quit();
    break;
  case Order::fit:
    view_.fit(), frame(), point();
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
    point();
    break;
  case Order::turn_right:
    camera.turn(turn, 0, Eigen::Vector3d::Zero());
    point();
    break;
  case Order::turn_up:
    camera.turn(0, -turn, Eigen::Vector3d::Zero());
    point();
    break;
  case Order::turn_down:
    camera.turn(0, turn, Eigen::Vector3d::Zero());
    point();
    break;
  case Order::zoom_in:
    camera.magnify(1.25, {camera.width() / 2., camera.height() / 2.});
    point();
    break;
  case Order::zoom_out:
    camera.magnify(0.8, {camera.width() / 2., camera.height() / 2.});
    point();
    break;
  case Order::help:
    choices_.shows_help = !choices_.shows_help;
    break;
  case Order::panels:
    choices_.shows_panels = !choices_.shows_panels;
    frame();
    break;
  case Order::figures:
    choices_.shows_figures = !choices_.shows_figures;
    break;
  case Order::edges:
    view_.show_edges(!view_.shows_edges());
    break;
  default:
    break; // a tool, a brush or a symmetry, done above
  }
}

/// After the picture at the end, if one was asked for; what is left of a script is left out.
void Application::leave_window() {
  choices_.question = Choices::Question::none;
  is_done_ = options_.screenshot.empty();
  script_.resize(std::min(next_action_, script_.size()));
}

void Application::quit() {
  if (choices_.question == Choices::Question::leave_unsaved)
    leave_window();
  else
    is_leaving_ = true, to_open_.clear();
  frames_due_ = 3;
}

} // namespace haptic_sculpt::window_program
