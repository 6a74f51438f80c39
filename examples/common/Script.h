// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/Error.h>
#include <haptic_sculpt/sculpting/Edit.h>
#include <haptic_sculpt/sculpting/Response.h>

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace haptic_sculpt::examples {

/// One line of a script: an edit by value, what takes more than that, or a directive.
struct Command {
  enum class Kind { edit, release, probe, move, brush, remesh, response, clearance, delta, mesh }; // directives last

  Command() = default;
  explicit Command(Edit what) : kind(Kind::edit), edit(std::move(what)) {}

  std::size_t line = 0;        ///< from 1
  bool is_logged = false;      ///< read from a log, not from a script
  /// Of what is logged: the line of the script that it came from; 0 where the log does not say.
  std::size_t script_line = 0;
  bool is_restored = false; ///< a setting that a script had when it broke off, and that others have changed
  bool is_refused = false;  ///< a setting that was not taken, as its log says: what was in force stays so
  Kind kind = Kind::release;
  Edit edit; ///< of a move, which none is by value: the vertex, and the way as `point`
  /// Of `edit.vertices`, or the ways of a shift, those that are yet to be found: the vertex nearest to a point when the
  /// line's turn comes.
  struct Place {
    std::size_t which;
    std::array<double, 3> point;
  };
  std::vector<Place> places;
  std::vector<std::array<double, 3>> points; ///< probe; brush: the centre, and the direction where one is given
  double length = 0;                         ///< clearance, delta; brush: the radius; remesh: of an edge
  double strength = 0;                       ///< brush
  std::string word; ///< response; brush: its kind; mesh: in lower case; clearance: "default", or empty for `length`
};

/// What follows the first word of a line.
struct Syntax {
  enum Last { nothing, two_points, length, word, brush, count };

  const char* name; ///< that word
  Command::Kind kind;
  Edit_kind edit;
  int vertices;   ///< of `Command::edit`
  bool has_point; ///< that of `Command::edit`
  Last last;
};
const Syntax& syntax_of(const Command& command);

/// The word that a line begins with.
inline const char* name_of(const Command& command) { return syntax_of(command).name; }
/// The vertices that a line names.
std::vector<std::size_t> vertices_of(const Command& command);

/// A script that cannot be read. Says line and column (both from 1).
class Script_error : public Error {
public:
  Script_error(const std::string& script, std::size_t line, std::size_t column, const std::string& what)
    : Error(script + ": line " + std::to_string(line) + ", column " + std::to_string(column) + ": " + what) {}
  explicit Script_error(const std::string& what) : Error(what) {}
};

/// Puts lines together: each is a command, but a shift, which goes on until its `end`.
class Line_joiner {
public:
  /// \param text of a line, without its end \param script how messages call the whole
  /// \return the command that the line completes, if any \throw Script_error
  std::optional<Command> take(const std::string& text, std::size_t number, const std::string& script);
  /// Lines of a shift have been taken, and not its `end`.
  bool is_within_shift() const { return shift_.has_value(); }
  /// \throw Script_error if it is
  void check_end(const std::string& script) const;

private:
  std::optional<Command> shift_;
  std::size_t shifted_ = 0; ///< how many vertices it moves
};

/// Edits and directives that a script may have; a shift is one. Each takes up to 500 bytes of memory while it runs.
constexpr std::size_t most_commands = 10'000'000;

/// Reads a whole script. \param name how messages call it. \throw Script_error
std::vector<Command> read_script(std::string_view text, const std::string& name);

/// The response that a script or an option may name: slide, stop or paper; else nothing.
std::optional<Response> response_by_name(const std::string& name);

/// How many strokes these lines begin and do not end.
std::size_t open_strokes(const std::vector<Command>& commands);

} // namespace haptic_sculpt::examples
