// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Journal_writer.h"
#include "Sha256.h"
#include "replay_log.h"

#include <algorithm>

namespace haptic_sculpt::examples {

/// The log of a run, if it is to have one: made again where it was left, then gone on with by a thread of its own.
class Run_log {
public:
  /// Changes nothing yet. \param path empty: none \throw Foreign_log, Script_error, Write_error
  Run_log(const std::string& path, const std::string& mesh) {
    if (path.empty())
      return;
    file_.emplace(path, mesh);
    file_->drop_unfinished_tick();
  }

  /// How many were in it; what changes nothing is not counted, such as what a click of the mouse leaves.
  std::size_t number_of_edits() const {
    std::size_t edits = 0;
    if (file_ && file_->contents())
      for (const Command& command : file_->contents()->commands)
        edits += changes_mesh(command);
    return edits;
  }

  /// Makes again what is in it. \return what people should know, or nothing
  template <class Scene>
  std::string resume(Scene& scene) {
    if (!file_ || !file_->contents())
      return "";
    replay_log(scene.sculptor, file_->contents()->commands);
    return file_->contents()->unfinished.empty() ? "" : "the end of the log, which is not whole, was dropped";
  }

  /// \param run what tells this run from others \param most_age, entries_a_tick as of the Edit_journal
  void begin(const std::string& run, std::uint64_t most_age, std::size_t entries_a_tick = 36) {
    if (!file_)
      return;
    run_ = Sha256().add(run).digest();
    // Legs are free motions: made again they stop nowhere, whatever slides did.
    Settings settings;
    settings.response = "stop";
    file_->begin(settings);
    file_->begin_pass(run_, 0);
    file_->append_tick(file_->contents() ? settings.directives() : std::vector<Command>(), 0);
    journal_.emplace(most_age, entries_a_tick);
    writer_.emplace(*file_, *journal_);
  }

  /// nullptr: there is no log
  Edit_journal* journal() { return journal_ ? &*journal_ : nullptr; }
  bool has_overrun() const { return journal_ && journal_->has_overrun(); }

  /// Of a run that is faster than time: the loop waits for the disk, as time would have.
  void let_catch_up(std::uint64_t tick) const {
    while (journal_ && !writer_->is_stalled() && !has_failed() && !journal_->has_overrun() &&
           journal_->age(tick) > journal_->most_age() / 2)
      std::this_thread::sleep_for(std::chrono::microseconds(100));
  }

  /// As if the disk did not answer any more.
  void stall() {
    if (writer_)
      writer_->stall();
  }

  /// Writes what is left, if the disk answers. \pre the session has ended
  void finish() {
    if (!writer_)
      return;
    writer_->finish();
    ticks_ = writer_->ticks(), unwritten_ = writer_->unwritten();
    writer_.reset();
    for (Edit left; journal_->take(left);)
      unwritten_ += left.kind != Edit_kind::none;
  }
  /// Edits that were not lost as long as the run went on, and are now. \pre finish()
  std::uint64_t unwritten() const { return unwritten_; }
  /// All results are written. What is in the log is all that was done.
  void end() {
    if (file_ && lost() == 0 && !has_overrun())
      file_->end_pass(run_);
  }

  /// Takes the file away. \pre finish()
  void remove() {
    if (file_)
      file_->remove();
  }

  /// Whether it had edits of other runs before: it is not this program's own. \pre it has begun
  bool is_of_others() const {
    const auto is_other = [this](const Log_contents::Pass& pass) { return pass.script != run_; };
    return file_ && file_->contents() &&
           std::any_of(file_->contents()->passes.begin(), file_->contents()->passes.end(), is_other);
  }

  std::uint64_t ticks() const { return ticks_; }
  std::uint64_t lost() const { return (journal_ ? journal_->lost() : 0) + unwritten_; }
  /// Whether it does not hold all: to be asked by any thread.
  bool has_failed() const { return file_ && file_->has_failed(); }
  std::string failure() const { return file_ ? file_->failure() : ""; }

private:
  static bool changes_mesh(const Command& command) {
    return command.kind == Command::Kind::edit
               ? command.edit.kind != Edit_kind::stroke && command.edit.kind != Edit_kind::end
               : command.kind < Command::Kind::response && command.kind != Command::Kind::release &&
                     command.kind != Command::Kind::probe;
  }

  std::optional<Log_file> file_;
  std::optional<Edit_journal> journal_;
  std::optional<Journal_writer> writer_; ///< last: it uses the others
  std::string run_;
  std::uint64_t ticks_ = 0, unwritten_ = 0;
};

} // namespace haptic_sculpt::examples
