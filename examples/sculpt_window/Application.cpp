// SPDX-License-Identifier: GPL-3.0-or-later
#include "Application.h"

#include "../common/mesh_program.h"

#include <iostream>

namespace haptic_sculpt::window_program {

using Hold = Status::Hold;

Application::Application(const Options& options, std::vector<Action> script)
    : options_(options), script_(std::move(script)) {
  choices_.name.fill(0);
}

Application::~Application() {
  if (record_ != nullptr)
    std::fclose(record_);
}

void Application::say(const std::string& text) {
  messages_.emplace_back(Clock::now(), text);
  while (messages_.size() > 6)
    messages_.pop_front();
  frames_due_ = 3;
}

/// \param text "refused: " is said before it
void Application::refuse(const std::string& text) {
  last_refusal_ = text;
  say("refused: " + text);
}

void Application::fail_to_write(const std::string& what) {
  say(what);
  std::cerr << "sculpt_window: " << what << '\n';
  has_failed_to_write_ = true;
}

Pointer Application::pointer_here() const {
  Pointer pointer = view_.pointer_at(mouse_);
  pointer.along_normal = is_along_normal_;
  return pointer;
}

void Application::point() {
  thread_.point(pointer_here(), choices_.depth);
  frames_due_ = 3;
}

void Application::on_move(double x, double y) {
  const Eigen::Vector2d before = mouse_;
  mouse_ = {x, y};
  has_moved_ = true;
  if (button_ > 0 || turns_ || is_playing()) // else one a frame: a mouse may tell a thousand a second
    note_move();
  if (!view_.has_mesh())
    return;
  const Eigen::Vector2d way = mouse_ - before;
  if (button_ == 2 || (button_ == 1 && shifts_)) {
    view_.camera().shift(way);
  } else if (button_ == 1 || turns_) {
    const double angle = 0.008; // a pixel, in radians
    view_.camera().turn(angle * way.x(), angle * way.y(), pivot_);
  }
  frames_due_ = 3;
  point();
  if (is_playing() && thread_.has_stroke())
    thread_.go_on(pointer_here());
}

void Application::on_press(int button, bool shift, bool ctrl, bool alt) {
  if (button_ >= 0 || !view_.has_mesh())
    return; // one at a time
  note("press %s%s%s%s",
       button == 0   ? "left"
       : button == 1 ? "right"
                     : "middle",
       shift ? " shift" : "", ctrl ? " ctrl" : "", alt ? " alt" : "");
  button_ = button, shifts_ = ctrl, turns_ = false;
  choices_.shows_hints = false;
  is_along_normal_ = button == 0 && (shift || alt);
  if (button == 0) {
    last_refusal_.clear();
    Brush brush = choices_.brush;
    if (shift && brush.use < Brush_use::mask)
      brush.use = Brush_use::smooth, brush.strength = std::fabs(brush.strength);
    if (ctrl)
      brush.strength = -brush.strength;
    thread_.press(pointer_here(), choices_.tool, brush);
    pivot_.setZero(); // of turning, where it is beside the mesh
  } else if (const Pointed& pointed = thread_.pointed(); pointed.size > 0) {
    pivot_ = view_.camera().scaled(vector(pointed.at));
  }
}

void Application::on_release(int button) {
  if (button_ != button)
    return; // another one, or pressed on a panel
  note("release");
  if (button == 0)
    thread_.let_go();
  button_ = -1;
  is_along_normal_ = turns_ = false;
}

void Application::on_scroll(double notches, bool ctrl, bool shift) {
  note("scroll %.17g%s", notches, ctrl ? " ctrl" : shift ? " shift" : "");
  if (!view_.has_mesh())
    return;
  if (ctrl)
    scale_tool(std::pow(1.1, notches));
  else if (shift)
    strengthen(0.05 * notches);
  else
    view_.camera().magnify(std::pow(1.15, notches), mouse_);
  point();
}

void Application::on_key(const Key& key) {
  if (choices_.question != Choices::Question::none && key.order != Order::let_go)
    return; // a dialogue is open
  // What a dialogue asks for is noted when it is answered; and a recording does not record.
  const bool asks_for_name =
      choices_.question == Choices::Question::name_to_save || choices_.question == Choices::Question::name_to_open;
  if (key.order != Order::record &&
      (is_playing() || (key.order != Order::save && key.order != Order::open && !asks_for_name)))
    note("key %s", key.name);
  obey(key.order);
}

void Application::on_drop(const std::vector<std::string>& paths) {
  if (paths.size() > 1)
    say("of " + std::to_string(paths.size()) + " files the first is opened");
  open(paths.front());
}

void Application::on_close() {
  note("close");
  quit();
}

void Application::on_resize(int width, int height) {
  view_size_ = {width, height};
  if (view_.has_mesh() && width > 0 && height > 0) {
    view_.frame(0); // while the panel fits in
    view_.camera().resize(width, height), frame();
  }
  frames_due_ = 3;
}

void Application::step() {
  if (record_ != nullptr)
    note_move();
  const Status before = status_;
  status_ = thread_.status();
  if (status_.hold != Hold::nothing || before.hold != Hold::nothing)
    frames_due_ = std::max(frames_due_, 2);
  if (status_.waits_for_disk && !before.waits_for_disk)
    say("the disk is behind with the log: the hand waits for it");
  if (status_.log_has_failed && !(before.log_has_failed && before.scene == status_.scene))
    say("what is done from here on is not in the log, which cannot be written: save the mesh");
  take_reports();
  if (!to_open_.empty() && is_at_rest())
    open(std::exchange(to_open_, {}));
  if (is_leaving_ && is_at_rest()) {
    is_leaving_ = false;
    if (is_unsaved())
      choices_.question = Choices::Question::leave_unsaved;
    else
      leave_window();
    frames_due_ = 3;
  }
  // What is held still goes on, a frame a dab; in a script only while that waits, so that it does the same each time,
  // and not behind it, where a picture waits for the end.
  const bool is_live = is_playing() ? script_[next_action_].kind == Action::Kind::wait : options_.screenshot.empty();
  if (is_live && thread_.has_stroke() && !thread_.is_stroke_waiting())
    thread_.go_on(pointer_here());
  play();
}

/// The mesh is seen in what the panel leaves free, if that is most of the window.
void Application::frame() {
  if (view_.has_mesh())
    view_.frame(choices_.shows_panels && view_size_[0] >= 3 * panel_width ? panel_width : 0);
}

bool Application::needs_frame() {
  const double slowly = 0.25; // s: figures in the panels
  if (frames_due_ > 0)
    --frames_due_;
  else if (Clock::now() - last_frame_ < std::chrono::duration<double>(slowly))
    return false;
  last_frame_ = Clock::now();
  return true;
}

void Application::draw() {
  Sculpture_view::Hand_marks marks;
  marks.shows_brush = choices_.tool == Tool::brush && !turns_;
  marks.brush = choices_.brush;
  try {
    view_.draw(status_, marks);
  } catch (const std::exception&) { // such as a graphics card without memory: the work goes on
    if (std::exchange(has_failed_to_draw_, true))
      return;
    const std::string why = "not all can be drawn: " + examples::message_of(std::current_exception());
    say(why);
    std::cerr << "sculpt_window: " << why << '\n';
  }
}

void Application::frame_done(const Frame_time& time) {
  frames_.add(time.elapsed);
  frames_of_thread_.add(time.thread);
  frames_of_process_.add(time.process);
}

} // namespace haptic_sculpt::window_program
