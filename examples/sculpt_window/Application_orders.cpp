// SPDX-License-Identifier: GPL-3.0-or-later
/// \file
/// What keys and questions order.
#include "Application.h"

#include "../common/mesh_program.h"

#include <haptic_sculpt/surface/Mesh_file_format.h>

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <system_error>

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

/// Of a file that is not there yet.
std::string Application::free_name(const std::string& extension) {
  std::string name = "sculpt_window" + extension;
  std::error_code unknown; // whether it is there: then writing it says why
  for (int i = 1; std::filesystem::exists(std::filesystem::symlink_status(name, unknown)) && !unknown; ++i)
    name = "sculpt_window_" + std::to_string(i) + extension;
  return name;
}

/// Whether it is no other file of this run; where it is, that has been told, and in a script counts as not written. The
/// sculpted mesh may take the place of the one that was read where no log begins with that; a file may take the place
/// of one that held the same before. Where it may be written it counts as a file of this run from here on.
bool Application::may_write(const std::string& path, Written what) {
  const bool is_mesh = what == Written::mesh;
  std::string why;
  std::vector<examples::Named_file> files = {{"the log", log_},
                                             {"the script", options_.script},
                                             {"the report", options_.report},
                                             {"the recording", recorded_to_}};
  if (!is_mesh || !log_.empty())
    files.push_back({"the mesh that is open", path_});
  if (!is_mesh)
    files.push_back({"where the sculpted mesh goes", options_.out});
  if (what != Written::picture)
    files.push_back({"the picture at the end", options_.screenshot});
  for (const auto* const others : {&opened_before_, &opening_})
    files.insert(files.end(), others->begin(), others->end());
  for (std::size_t i = 0; i < written_.size(); ++i)
    if (i != static_cast<std::size_t>(what))
      files.insert(files.end(), written_[i].begin(), written_[i].end());
  if (const auto* const other = examples::same_file(path, files))
    why = "'" + path + "' is " + other->role + (is_mesh && other->path == path_ ? ", which the log begins with" : "") +
          ": give another name";
  else if (const char* const stream = examples::standard_stream_at(path); stream != nullptr)
    why = "'" + path + "' is the file of standard " + stream + ": give another name";
  else if (is_mesh && !mesh_file_format(path))
    why = "'" + path + "' does not end in .off, .ply, .obj or .stl";
  else if (what == Written::picture && !examples::is_picture_name(path))
    why = "'" + path + "' does not end in .png: give another name";
  if (!why.empty())
    is_playing() ? fail_to_write(why) : say(why);
  else
    written_[static_cast<std::size_t>(what)].push_back({is_mesh                    ? "a mesh that was saved"
                                                        : what == Written::picture ? "a screenshot"
                                                                                   : "a recording",
                                                        path});
  return why.empty();
}

void Application::save(const std::string& path, bool quits) {
  if (!may_write(path, Written::mesh))
    return;
  Background::Saved saved;
  saved.path = path, saved.scene = scene_, saved.quits = quits;
  ask_for_copy(std::move(saved));
}

void Application::ask_for_copy(Background::Saved saved) {
  to_save_.push_back(std::move(saved));
  try {
    thread_.copy();
  } catch (const std::exception&) { // such as no memory for it: nothing was asked for
    const std::string path = std::exchange(to_save_.back().path, {});
    to_save_.pop_back();
    fail_to_write("'" + path + "' is not saved: " + examples::message_of(std::current_exception()));
  }
}

/// Nothing is under way that could still change the mesh, or has its log.
bool Application::is_at_rest() const {
  return thread_.is_idle() && kept_.size() <= 1 && to_save_.empty() && !background_.is_opening() &&
         !background_.is_saving();
}

void Application::open(const std::string& path, bool for_script) {
  const std::string log = options_.log_of(path);
  const std::vector<examples::Named_file> names = {{"a mesh that is being opened", path},
                                                   {"the log of '" + path + "'", log}};
  if (!is_at_rest()) {
    to_open_ = path;
    opening_.insert(opening_.end(), names.begin(), names.end());
    return say(path + " is opened as soon as what is under way has ended");
  }
  opening_.clear();
  if (!log_.empty() && examples::same_file(path, {{"open", path_}}))
    return say(path + " is open");
  const std::vector<examples::Named_file> outputs = {{"the report", options_.report},
                                                     {"the recording", recorded_to_},
                                                     {"the picture at the end", options_.screenshot}};
  for (const std::string& name : {path, log})
    if (const auto* const other = examples::same_file(name, outputs))
      return fail_to_open("'" + path + "' is not opened: " + (name == log ? "its log '" + log + "' is " : "it is ") +
                              other->role,
                          for_script);
  // What was done since is not to be left by it.
  const bool is_wanted = next_open_.second == edits() && examples::same_file(path, {{"", next_open_.first}}) != nullptr;
  if (is_unsaved() && !is_wanted) {
    next_open_ = {path, edits()};
    if (for_script)
      unopened_.push_back({"", path});
    note_file("open", path); // twice leaves it
    return say(std::string("there is unsaved work: save it, or drop the file once more to leave it") +
               (log_.empty() ? "" : " (the log has it)"));
  }
  next_open_ = {};
  while (const auto* const before = examples::same_file(path, unopened_))
    unopened_.erase(unopened_.begin() + (before - unopened_.data()));
  say("opening " + path);
  opening_ = names;
  std::error_code unknown;
  is_log_new_ = !log.empty() && !std::filesystem::exists(log, unknown);
  opens_for_script_ = for_script, edits_when_opening_ = edits();
  background_.open(path, log);
}

void Application::fail_to_open(const std::string& why, bool for_script) {
  say(why);
  std::cerr << "sculpt_window: " << why << '\n';
  has_failed_to_open_ = has_failed_to_open_ || for_script; // a slip of the hand is no failure of the run
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
