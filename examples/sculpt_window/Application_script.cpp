// SPDX-License-Identifier: GPL-3.0-or-later
/// \file
/// Scripts and recordings of the window, and what it writes at the end.
#include "Application.h"

#include "../common/json_words.h"
#include "../common/write_file.h"

#include <haptic_sculpt/surface/Write_error.h>
#include <haptic_sculpt/version.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdarg>
#include <filesystem>
#include <iostream>
#include <thread>

#include <fcntl.h>
#include <unistd.h>

namespace haptic_sculpt::window_program {
namespace {

using Json = nlohmann::ordered_json;

Percentiles summary_of(const Tick_statistics& times) {
  return {times.percentile(0.5), times.percentile(0.99), times.percentile(0.999), times.largest()};
}

Json times_of(const Percentiles& p) {
  return {{"p50", p.p50}, {"p99", p.p99}, {"p999", p.p999}, {"max", p.largest}};
}

} // namespace

Eigen::Vector2d Application::pixel_of(const Spot& spot) const {
  const auto& x = spot.coordinates;
  return spot.is_in_space ? const_cast<Sculpture_view&>(view_).camera().pixel({x[0], x[1], x[2]})
                          : Eigen::Vector2d(x[0], x[1]);
}

bool Application::is_settled() const {
  return is_at_rest() && status_.dirty_faces == 0;
}

/// A drag that has not come to its end in a tick goes on in the next.
bool Application::is_on_the_way() const {
  const std::string end = status_.end;
  return end == "work-limit" || end == "leg-limit";
}

void Application::play() {
  if (is_done_ || (script_.empty() && options_.screenshot.empty()))
    return;
  frames_due_ = 3;
  if (next_action_ < script_.size()) {
    if (act(script_[next_action_]))
      ++next_action_;
    return;
  }
  if (options_.screenshot.empty() || !is_settled())
    return;
  if (++settled_frames_ == 3)
    screenshot_ = options_.screenshot;
  else if (settled_frames_ > 3)
    is_done_ = true;
}

/// \return whether it is done
bool Application::act(const Action& action) {
  using Kind = Action::Kind;
  const auto& n = action.numbers;
  // A press may have been beside the mesh, and then moves turn. Of a stroke a place is a dab.
  const bool is_waiting =
      thread_.is_press_waiting() ? action.kind == Kind::move : thread_.is_stroke_waiting() && action.kind != Kind::wait;
  if (is_waiting || is_leaving_)
    return false;
  if (background_.is_opening() || !has_status())
    return false; // what comes after an `open` is of that mesh
  if (action.kind >= Kind::view && action.kind <= Kind::depth) // hands note theirs where they come in
    note("%s", action.word.c_str());
  switch (action.kind) {
  case Kind::move: {
    const Eigen::Vector2d from = pixel_of(action.spot);
    const Eigen::Vector2d at =
        action.share > 0 ? Eigen::Vector2d(from + action.share * (pixel_of(action.to) - from)) : from;
    if (at.cwiseAbs().maxCoeff() <= most_of_script)
      on_move(at.x(), at.y());
    else
      refuse("the place is too far beside what the window shows");
    return true;
  }
  case Kind::press: {
    const auto has = [&](const char* word) { return action.word.find(word) != std::string::npos; };
    on_press(has("right") ? 1 : has("middle") ? 2 : 0, has("shift"), has("ctrl"), has("alt"));
    return true;
  }
  case Kind::release:
    if (button_ >= 0)
      on_release(button_);
    return true;
  case Kind::scroll:
    on_scroll(n[0], action.word == "ctrl", action.word == "shift");
    return true;
  case Kind::key:
    on_key(*key_named(action.word));
    return true;
  case Kind::view:
    look({n[0], n[1], n[2]});
    return true;
  case Kind::orbit:
    view_.camera().turn(n[0] * EIGEN_PI / 180, n[1] * EIGEN_PI / 180, Eigen::Vector3d::Zero());
    return true;
  case Kind::zoom:
    view_.camera().magnify(n[0], {view_.camera().width() / 2., view_.camera().height() / 2.});
    return true;
  case Kind::fit:
    view_.fit(), frame();
    return true;
  case Kind::tool:
    choose(static_cast<Tool>(action.which));
    return true;
  case Kind::brush:
    choices_.brush.radius = n[0], choices_.brush.strength = n[1];
    choose(static_cast<Brush_use>(action.which));
    return true;
  case Kind::symmetry:
    choose_symmetry({(action.which & 1) != 0, (action.which & 2) != 0, (action.which & 4) != 0});
    return true;
  case Kind::remesh:
    remesh(true, n[0]);
    return true;
  case Kind::depth:
    choices_.depth = n[0];
    point();
    return true;
  case Kind::wait:
    if (!waits_until_)
      waits_until_ = Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(n[0]));
    if (Clock::now() < *waits_until_)
      return false;
    waits_until_.reset();
    return true;
  case Kind::settle: {
    // For some frames on end: what is seen has been drawn since. A drag may creep for ever.
    const auto patience = std::chrono::seconds(1);
    if (!waits_until_)
      waits_until_ = Clock::now() + patience;
    settled_frames_ = is_settled() && (!is_on_the_way() || Clock::now() > *waits_until_) ? settled_frames_ + 1 : 0;
    if (settled_frames_ < 3)
      return false;
    settled_frames_ = 0;
    waits_until_.reset();
    return true;
  }
  case Kind::screenshot:
    if (!is_settled())
      return false;
    if (may_write(action.word, Written::picture))
      screenshot_ = action.word;
    return true;
  case Kind::save:
    save(action.word);
    return true;
  case Kind::open:
    if (button_ == 0) // what is opened waits for the release, and the script for that
      on_release(0);
    if (!is_at_rest())
      return false;
    open(action.word, true);
    return true;
  case Kind::record:
    record(action.word);
    return true;
  case Kind::print:
    print_status();
    return true;
  case Kind::where: {
    const Eigen::Vector2d at = pixel_of(action.spot);
    std::cout << Json{{"where", {at.x(), at.y()}}}.dump() << std::endl;
    return true;
  }
  case Kind::close:
    on_close();
    return true;
  case Kind::quit: // after what is asked for: files that are written and read, and the last picture
    if (!to_save_.empty() || background_.is_saving())
      return false;
    is_done_ = options_.screenshot.empty();
    script_.resize(next_action_ + 1);
    return true;
  }
  return true;
}

void Application::print_status() const {
  const Status& s = status_;
  const char* const holds[] = {"nothing", "vertex", "probe", "brush", "object"};
  Json contacts = Json::array();
  for (int i = 0; i < s.contacts; ++i) {
    const Contact_view& c = s.contact[std::size_t(i)];
    Json points = Json::array(), names = Json::array();
    for (int j = 0; j < c.still; ++j)
      points.push_back(c.points[std::size_t(j)]), names.push_back(c.ids[std::size_t(j)]);
    contacts.push_back({{"kind", c.kind}, {"names", names}, {"points", points}, {"normal", c.normal}});
  }
  Json json = {{"hold", holds[int(s.hold)]},
               {"target", s.target},
               {"proxy", s.proxy},
               {"force", s.force},
               {"reached", s.reached},
               {"end", s.end},
               {"contacts", contacts},
               {"pointed", s.pointed.feature},
               {"pointed_at", s.pointed.at},
               {"vertices", s.vertices},
               {"faces", s.faces},
               {"undo", s.undo_steps},
               {"redo", s.redo_steps},
               {"edits", s.edits},
               {"refused", last_refusal_},
               {"uploaded_bytes", view_.uploaded_bytes()},
               {"uploaded_faces", view_.uploaded_faces()}};
  if (s.hold == Status::Hold::vertex)
    json["vertex"] = s.vertex;
  std::cout << examples::text_of(json) << std::endl;
}

void Application::record(const std::string& path) {
  if (button_ >= 0)
    on_release(button_); // a recording has what belongs to a press, or none of it
  if (record_ != nullptr) {
    std::fclose(record_);
    record_ = nullptr, recorded_to_.clear();
    say("the recording has ended");
  }
  if (path.empty() || !may_write(path, Written::recording))
    return;
  const int file =
      ::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC | O_NONBLOCK, 0666); // waits for no pipe
  record_ = file < 0 ? nullptr : ::fdopen(file, "w");
  if (record_ == nullptr && file >= 0)
    ::close(file);
  if (record_ == nullptr)
    return fail_to_write("cannot write the recording '" + path + "': " + std::strerror(errno));
  std::fprintf(record_, "# sculpt_window of haptic_sculpt %s, a window of %d x %d\n", HAPTIC_SCULPT_VERSION,
               view_size_[0], view_size_[1]);
  note_choices();
  last_recorded_ = Clock::now();
  recorded_to_ = path, has_moved_ = false;
  say("recording to " + path);
  flush_record();
}

/// What is set when a recording begins, but for the view and masks, and where the mouse is.
void Application::note_choices() {
  const Brush& brush = choices_.brush;
  if (brush.radius > 0)
    std::fprintf(record_, "brush %s %.17g %.17g\n", brush_words[static_cast<int>(brush.use)], brush.radius,
                 brush.strength);
  std::fprintf(record_, "tool %s\nsymmetry", tool_words[static_cast<int>(choices_.tool)]);
  bool has_any = false;
  for (std::size_t axis = 0; axis < 3; ++axis)
    if (brush.symmetry[axis])
      std::fprintf(record_, " %c", "xyz"[axis]), has_any = true;
  std::fprintf(record_, "%s\ndepth %.17g\n", has_any ? "" : " none", choices_.depth);
  if (!choices_.slides)
    std::fputs("key t\n", record_);
  if (brush.remeshes)
    std::fputs("key ctrl+d\n", record_);
  std::fprintf(record_, "move %.17g %.17g\n", mouse_.x(), mouse_.y());
}

/// Where the mouse has come to.
void Application::note_move() {
  if (std::exchange(has_moved_, false))
    note("move %.17g %.17g", mouse_.x(), mouse_.y());
}

void Application::note(const char* format, ...) {
  if (record_ == nullptr)
    return;
  note_move();            // before it
  if (record_ == nullptr) // that could not be written
    return;
  const auto now = Clock::now();
  const double seconds = std::chrono::duration<double>(now - std::exchange(last_recorded_, now)).count();
  if (seconds > 0.02) // less is a frame
    std::fprintf(record_, "wait %.3f\n", seconds);
  std::va_list arguments;
  va_start(arguments, format);
  std::vfprintf(record_, format, arguments);
  va_end(arguments);
  std::fputc('\n', record_);
  flush_record();
}

void Application::note_file(const char* what, const std::string& path) {
  const bool can_be_named =
      std::none_of(path.begin(), path.end(), [](unsigned char c) { return c < ' ' || c == '#'; }) && !path.empty() &&
      path.front() != ' ' && path.back() != ' ';
  can_be_named ? note("%s %s", what, path.c_str()) : note("# %s: a file whose name stands in no script", what);
}

void Application::flush_record() {
  if (std::fflush(record_) == 0 && std::ferror(record_) == 0)
    return;
  const int error = errno;
  fail_to_write("cannot write the recording '" + recorded_to_ + "': " + std::strerror(error));
  std::fclose(record_);
  record_ = nullptr, recorded_to_.clear();
}

int Application::finish() {
  if (!unopened_.empty())
    fail_to_open("'" + unopened_.front().path +
                     "' was not opened, for there was unsaved work: save that before, or give `open` twice to leave it",
                 true);
  while (!to_save_.empty() || background_.is_saving()) {
    status_ = thread_.status(); // how large the mesh is by now: for what is copied again
    take_answers(), take_saved();
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  for (Model* const model : thread_.end())
    leave(model);
  const Status last = thread_.status();
  const Percentiles frames = summary_of(frames_), of_process = summary_of(frames_of_process_);
  const auto ms = [](std::uint64_t ns) { return double(ns) / 1e6; };
  std::printf("%llu frames: median %.2f ms, 99 %% within %.2f ms, longest %.2f ms (%.2f, %.2f, %.2f ms of all "
              "processors); %zu bytes uploaded for %zu changed faces\n",
              static_cast<unsigned long long>(frames_.number()), ms(frames.p50), ms(frames.p99), ms(frames.largest),
              ms(of_process.p50), ms(of_process.p99), ms(of_process.largest), view_.uploaded_bytes(),
              view_.uploaded_faces());
  std::printf(
      "%llu ticks: median %.3f ms, 99 %% within %.3f ms, longest %.3f ms; %llu missed by work, %llu woken late\n",
      static_cast<unsigned long long>(last.ticks), ms(last.work.p50), ms(last.work.p99), ms(last.work.largest),
      static_cast<unsigned long long>(last.missed_by_work), static_cast<unsigned long long>(last.woken_late));
  if (!options_.report.empty()) {
    const Json report = {{"version", HAPTIC_SCULPT_VERSION},
                         {"frames", frames_.number()},
                         {"frame_ns", times_of(frames)},
                         {"frame_thread_cpu_ns", times_of(summary_of(frames_of_thread_))},
                         {"frame_process_cpu_ns", times_of(of_process)},
                         {"uploaded", {{"bytes", view_.uploaded_bytes()}, {"faces", view_.uploaded_faces()}}},
                         {"ticks", last.ticks},
                         {"tick_ns", times_of(last.work)},
                         {"lateness_ns", times_of(last.lateness)},
                         {"missed", {{"by_work", last.missed_by_work}, {"woken_late", last.woken_late}}},
                         {"vertices", last.vertices},
                         {"faces", last.faces},
                         {"edits", last.edits}};
    try {
      if (const std::string lost = examples::write_file(options_.report, examples::text_of(report, 2) + '\n');
          !lost.empty())
        std::cerr << "sculpt_window: " << lost << '\n';
    } catch (const Write_error& error) {
      fail_to_write(error.what());
    }
  }
  const int code = has_failed_to_open_ ? 3 : has_failed_to_write_ ? 5 : 0;
  leave_unseen();
  std::error_code unknown;
  while (background_.is_opening() && is_log_new_ && std::filesystem::exists(opening_[1].path, unknown)) {
    std::this_thread::sleep_for(std::chrono::milliseconds(1)); // the log comes last, and goes with its mesh
    leave_unseen();
  }
  if (background_.is_opening()) { // reading a mesh and a log may take minutes, and has written nothing
    const bool is_said = std::fflush(stdout) == 0 && std::ferror(stdout) == 0;
    std::_Exit(code == 0 && !is_said ? 5 : code);
  }
  return code;
}

} // namespace haptic_sculpt::window_program
