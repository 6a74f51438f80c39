// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/Error.h>
#include <haptic_sculpt/sculpting/Edit.h>

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace haptic_sculpt::sculpt_program {

/// One line of a script: an edit or a directive.
struct Command {
  enum class Kind {
    drag,
    insert_face,
    insert_edge,
    remove,
    collapse,
    flip,
    shift,
    undo,
    redo,
    stroke,
    end, // as Edit_kind has them
    release,
    probe,
    move,
    brush,
    remesh, // what takes more than an Edit
    response,
    clearance,
    delta,
    mesh // directives
  };

  std::size_t line = 0;        ///< from 1
  bool is_logged = false;      ///< read from a log, not from a script
  std::size_t script_line =
      0; ///< of what is logged: the line of the script that it came from; 0 where the log does not say
  Kind kind = Kind::release;
  std::vector<std::size_t> indices;        ///< of vertices; of a shift, the axis
  /// Of `indices` those that are yet to be found: the vertex nearest to a point when the line's turn comes.
  struct Place {
    std::size_t which;
    std::array<double, 3> point;
  };
  std::vector<Place> places;
  std::vector<std::array<double, 3>> points; ///< brush: the centre, and the direction where one is given
  double length = 0;                         ///< clearance, delta; brush: the radius; remesh: of an edge
  double strength = 0;                       ///< brush
  std::vector<std::pair<std::size_t, double>> ways; ///< shift
  std::string word; ///< response; brush: its kind; mesh: in lower case; clearance: "default", or empty for `length`
};

/// The word that a line of this kind begins with.
const char* name_of(Command::Kind kind);

/// Of a line that is an edit by value.
std::optional<Edit> edit_of(const Command& command);
/// The line of an edit. \pre it is not of kind `none`, and straight: as a loop's journal has them
Command command_of(const Edit& edit);

/// A script that cannot be read. Says line and column (both from 1).
class Script_error : public Error {
public:
  Script_error(const std::string& script, std::size_t line, std::size_t column, const std::string& what)
    : Error(script + ": line " + std::to_string(line) + ", column " + std::to_string(column) + ": " + what) {}
  explicit Script_error(const std::string& what) : Error(what) {}
};

/// Reads a line, without its end. \param script how messages call the whole. \return none of a line that holds a
/// comment only, or nothing \throw Script_error
std::optional<Command> read_line(const std::string& text, std::size_t number, const std::string& script);

/// Puts lines together: each is a command, but a shift, which goes on until its `end`.
class Line_joiner {
public:
  /// \return the command that the line completes, if any \throw Script_error
  std::optional<Command> take(const std::string& text, std::size_t number, const std::string& script);
  /// Lines of a shift have been taken, and not its `end`.
  bool is_within_shift() const { return shift_.has_value(); }
  /// \throw Script_error if it is
  void check_end(const std::string& script) const;

private:
  std::optional<Command> shift_;
};

/// Edits and directives that a script may have; a shift is one. Each takes up to 500 bytes of memory while it runs.
constexpr std::size_t most_commands = 10'000'000;

/// Reads a whole script. \param name how messages call it. \throw Script_error
std::vector<Command> read_script(std::string_view text, const std::string& name);

/// How many strokes these lines begin and do not end.
std::size_t open_strokes(const std::vector<Command>& commands);

} // namespace haptic_sculpt::sculpt_program
