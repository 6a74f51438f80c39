// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Script_settings.h"

#include <string>
#include <string_view>
#include <vector>

namespace haptic_sculpt::examples {

/// A file that is no log, or a log or script of another mesh.
struct Foreign_log : Error {
  using Error::Error;
};

/// Makes the lines of a log. Each ends with a checksum of all that stands before it, as a comment, so that a log is a
/// script and a line that is changed, moved or gone is found. doc/use/log.md says what the lines are.
class Log_writer {
public:
  Log_writer() = default;
  /// Goes on after a line with this checksum.
  explicit Log_writer(std::string checksum) : checksum_(std::move(checksum)) {}

  /// What a new log begins with: the version, the hash of the mesh, the settings.
  std::string head(const std::string& mesh, const Settings& settings);
  /// An edit or directive, and the line of the script that it comes from.
  std::string command(const Command& command, std::size_t script_line);
  /// Ends the strokes that are left open by a pass that broke off.
  std::string ends(std::size_t open);
  /// What follows comes from the script with this hash, from the lines after this one.
  std::string pass(const std::string& script, std::size_t after);
  /// The script has been carried out to its end, and the results are written.
  std::string done(const std::string& script);
  /// A comment: what stands before it is the state after this tick of a loop.
  std::string tick(std::size_t number);

private:
  std::string checksum_; ///< of the line before

  std::string line(const std::string& payload);
};

/// What a log says.
struct Log_contents {
  /// A run through a script.
  struct Pass {
    std::string script;        ///< its hash
    std::size_t last_line = 0; ///< the last that was carried out
    bool is_done = false;      ///< to the end of the script, results written
    Settings settings;         ///< what its next line has to find in force, whatever came between
  };

  std::vector<Command> commands; ///< `mesh` is the first
  std::vector<Pass> passes;
  std::size_t whole_size = 0; ///< bytes up to the end of the last whole line
  std::string unfinished;     ///< what follows: a killed process may leave part of a line
  /// Between two lines.
  struct Place {
    std::size_t size, commands; ///< size: in bytes, commands: this many stand before it
    std::string checksum;       ///< of the line before
  };
  /// Where the state of a tick ends.
  struct Tick {
    std::size_t number;
    Place end;
  };
  std::optional<Tick> last_tick; ///< of the last pass, if that was a loop's
  /// Where what comes from the last line of the last pass's script begins, and the line that came before it.
  struct Last_line {
    Place begin;
    std::size_t before;
  };
  std::optional<Last_line> last_line; ///< none where nothing of the last pass says where it comes from
  Log_writer writer;                  ///< goes on after the last whole line

  /// What held at the first edit.
  Settings first_settings() const;
  /// What holds at the end.
  Settings last_settings() const;
};

/// \param text of a log, the first line at least \param name how messages call it
/// \throw Foreign_log if it does not begin as a log does
void check_begin_of_log(std::string_view text, const std::string& name);

/// Of a log the commands that end: a killed process may have left part of a line, which reads as another command, or of
/// a shift. Any other text as it is.
std::string_view whole_commands_of(std::string_view text);

/// Returns none where the text ends within the head: no edit is in it.
/// \param name how messages call the log \param mesh the hash that it has to begin with
/// \throw Foreign_log if the first line is not that of a log, or the log is of another mesh; Script_error for a line
/// that has been changed or cannot be read
std::optional<Log_contents> read_log(std::string_view text, const std::string& name, const std::string& mesh);

} // namespace haptic_sculpt::examples
