// SPDX-License-Identifier: GPL-3.0-or-later
/// \file
/// What is opened, saved and left, and what comes back from the loop and the files.
#include "Application.h"

#include "../common/mesh_program.h"

#include <haptic_sculpt/surface/Mesh_file_format.h>

#include <filesystem>
#include <iostream>
#include <system_error>

namespace haptic_sculpt::window_program {

void Application::open_first(int width, int height) {
  view_size_ = {width, height};
  enter(window_program::open(options_.mesh, options_.log_of(options_.mesh)));
  if (!options_.record.empty()) // the last to be refused
    record(options_.record);
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

void Application::enter(Opened opened) {
  const auto leave_it = [this](Opened* it) { destroy_unseen(std::move(*it)); };
  std::unique_ptr<Opened, decltype(leave_it)> unseen(&opened, leave_it); // where it cannot be shown
  view_.show(opened.faces, opened.middle, view_size_[0], view_size_[1]);
  frame();
  const double extent = view_.camera().unscaled(2.0);
  choices_.brush.radius = 0.12 * extent;
  choices_.depth = 0.03 * extent;
  if (!path_.empty()) {
    opened_before_.push_back({"a mesh that was open before", path_});
    opened_before_.push_back({"the log of '" + path_ + "'", log_});
    for (const auto& saved : std::exchange(written_[static_cast<std::size_t>(Written::mesh)], {}))
      opened_before_.push_back({"another mesh that was saved", saved.path});
  }
  path_ = opened.path, log_ = opened.log;
  for (const std::string& open : {path_, log_})
    while (const auto* const before = examples::same_file(open, opened_before_))
      opened_before_.erase(opened_before_.begin() + (before - opened_before_.data()));
  if (!options_.has_out)
    options_.out = Options::sculpted_beside(path_);
  kept_.push_back({log_, opened.resumed});
  ++scene_;
  pivot_.setZero();
  has_failed_to_draw_ = false;
  unseen.release();
  thread_.enter(std::move(opened.model));
  if (!choices_.slides)
    thread_.choose_response(false);
  frames_due_ = 3;
  say("opened " + path_);
  if (opened.resumed > 0)
    say("made " + std::to_string(opened.resumed) + " edits of " + log_ + " again");
  if (!opened.note.empty())
    say(opened.note);
}

/// A log stays that was asked for, or that has what nothing else has: what was done by the end, seen or not.
void Application::leave(Model* model) {
  const Kept kept = std::move(kept_.front());
  kept_.pop_front();
  const bool is_shown = kept_.empty(), was_asked_for = !options_.log.empty() && kept.log == options_.log;
  const bool keeps_log = was_asked_for || (kept.is_unsaved(number_of_edits(*model)) && !(is_shown && discards_));
  if (const std::string failure = destroy(model, keeps_log); keeps_log && !failure.empty())
    fail_to_write(failure);
}

/// Its log stays where there was something in it.
void Application::destroy_unseen(Opened opened) {
  destroy(opened.model.release(), opened.resumed > 0 || (!options_.log.empty() && opened.log == options_.log));
}

/// What has been opened when the window ends.
void Application::leave_unseen() {
  try {
    if (auto opened = background_.take_opened())
      destroy_unseen(std::move(*opened));
  } catch (const std::exception&) { // nobody waits for it any more
  }
}

/// Nothing is under way that could still change the mesh, or has its log.
bool Application::is_at_rest() const {
  return thread_.is_idle() && kept_.size() <= 1 && to_save_.empty() && !background_.is_opening() &&
         !background_.is_saving();
}

/// Of the loop.
void Application::take_answers() {
  for (Seen_face change; thread_.take(change);)
    if (change.scene + 1 == scene_)
      view_.change(change), frames_due_ = 3;
  for (Report report; thread_.take(report);) {
    switch (report.kind) {
    case Report::Kind::refused:
      refuse(report.text);
      break;
    case Report::Kind::beside:
      turns_ = button_ == 0;
      break;
    case Report::Kind::left:
      left_.push_back(report.model);
      break;
    case Report::Kind::copied: {
      Background::Saved saved = std::move(to_save_.front());
      to_save_.pop_front();
      saved.edits = report.edits;
      if (report.copy)
        background_.save(report.copy, std::move(saved));
      else if (report.outgrown && saved.scene == scene_) // in turn again, now that it is known how large it is
        ask_for_copy(std::move(saved));
      else
        fail_to_write("'" + saved.path + "' is not saved: " + report.text);
      break;
    }
    }
  }
  for (Model* const model : std::exchange(left_, {}))
    leave(model); // another was opened
}

void Application::take_reports() {
  take_answers();
  const auto keep_what_is_shown = [this] {
    fail_to_open("'" + opening_.front().path + "' is not opened: " + examples::message_of(std::current_exception()),
                 opens_for_script_);
  };
  try {
    const bool is_at_work = button_ == 0 || status_.hold != Status::Hold::nothing || !thread_.has_done_all() ||
                            !to_save_.empty() || background_.is_saving();
    if (auto opened = is_at_work ? std::nullopt : background_.take_opened()) { // else edits are yet to be counted
      const std::string path = opened->path;
      if (is_unsaved() && edits() != edits_when_opening_) {
        destroy_unseen(std::move(*opened));
        next_open_ = {path, edits()};
        note_file("open", path);
        fail_to_open("'" + path +
                         "' is not opened, for there is work since that was asked for: save it, or drop the file "
                         "once more to leave it",
                     opens_for_script_);
      } else {
        enter(std::move(*opened));
        note_file("open", path); // here: what the hand did meanwhile was done to the mesh before
      }
    }
  } catch (const drawing::Picture_error&) {
    keep_what_is_shown();
  } catch (const Error& error) { // names the file
    fail_to_open(examples::message_of(error), opens_for_script_);
  } catch (const std::exception&) { // such as no memory for it
    keep_what_is_shown();
  }
  if (!background_.is_opening() && to_open_.empty())
    opening_.clear();
  take_saved();
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

/// Of a file that is not there yet.
std::string Application::free_name(const std::string& extension) {
  std::string name = "sculpt_window" + extension;
  std::error_code unknown; // whether it is there: then writing it says why
  for (int i = 1; std::filesystem::exists(std::filesystem::symlink_status(name, unknown)) && !unknown; ++i)
    name = "sculpt_window_" + std::to_string(i) + extension;
  return name;
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

void Application::take_saved() {
  while (const auto saved = background_.take_saved()) {
    try {
      if (saved->error)
        std::rethrow_exception(saved->error);
      say("saved " + saved->path + (saved->lost.empty() ? "" : ": " + saved->lost));
      if (saved->scene != scene_)
        continue; // another was opened meanwhile
      kept_.back().is_saved = true, kept_.back().saved_edits = saved->edits;
      if (saved->quits) // where there is work since, it is asked once more
        note("close"), is_leaving_ = true, to_open_.clear();
    } catch (const Error& error) {
      fail_to_write(examples::message_of(error));
    } catch (const std::exception&) {
      fail_to_write("'" + saved->path + "' is not saved: " + examples::message_of(std::current_exception()));
    }
  }
}

} // namespace haptic_sculpt::window_program
