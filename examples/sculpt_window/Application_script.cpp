// SPDX-License-Identifier: GPL-3.0-or-later
/// \file
/// Scripts of the window, and what it writes at the end.
#include "Application.h"

#include "../common/json_words.h"
#include "../common/write_file.h"

#include <haptic_sculpt/surface/Write_error.h>
#include <haptic_sculpt/version.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <thread>

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
  if (action.sets_something()) // hands note theirs where they come in
    note("%s", action.word.c_str());
  switch (action.kind) {
  case Kind::move: {
    const Eigen::Vector2d from = pixel_of(action.spot);
    const Eigen::Vector2d at =
        action.share > 0 ? Eigen::Vector2d(from + action.share * (pixel_of(action.to) - from)) : from;
    is_misplaced_ = !(at.allFinite() && at.cwiseAbs().maxCoeff() <= most_of_script);
    if (!is_misplaced_)
      on_move(at.x(), at.y());
    else
      refuse("the place is too far beside what the window shows, or behind the eye");
    return true;
  }
  case Kind::press: {
    if (is_misplaced_)
      return true;
    const auto has = [&](const char* word) { return action.word.find(word) != std::string::npos; };
    if (has("right") && button_ < 0 && thread_.is_pick_waiting()) // it turns about what the mouse points at
      return false;
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
    point();
    return true;
  case Kind::zoom:
    view_.camera().magnify(n[0], {view_.camera().width() / 2., view_.camera().height() / 2.});
    point();
    return true;
  case Kind::fit:
    view_.fit(), frame(), point();
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
               {"said", messages_.empty() ? "" : messages_.back().second},
               {"uploaded_bytes", view_.uploaded_bytes()},
               {"uploaded_faces", view_.uploaded_faces()}};
  if (s.hold == Status::Hold::vertex)
    json["vertex"] = s.vertex;
  std::cout << examples::text_of(json) << std::endl;
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
