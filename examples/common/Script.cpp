// SPDX-License-Identifier: GPL-3.0-or-later
#include "Script.h"

#include "contents_of.h"
#include "numbers.h"
#include "printable.h"

#include <haptic_sculpt/sculpting/brushes/Dab_3.h>
#include <haptic_sculpt/sculpting/paper_1997.h>
#include <haptic_sculpt/surface/coordinate_range.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <utility>

namespace haptic_sculpt::examples {
namespace {

using Kind = Command::Kind;

constexpr Syntax syntaxes[] = {{"drag", Kind::edit, Edit_kind::move, 1, true, Syntax::nothing},
                              {"release", Kind::release, Edit_kind::none, 0, false, Syntax::nothing},
                              {"probe", Kind::probe, Edit_kind::none, 0, false, Syntax::two_points},
                              {"move", Kind::move, Edit_kind::none, 1, true, Syntax::nothing},
                              {"insert_face", Kind::edit, Edit_kind::insert_on_face, 3, true, Syntax::nothing},
                              {"insert_edge", Kind::edit, Edit_kind::insert_on_edge, 2, true, Syntax::nothing},
                              {"remove", Kind::edit, Edit_kind::remove, 1, false, Syntax::nothing},
                              {"collapse", Kind::edit, Edit_kind::collapse, 2, false, Syntax::nothing},
                              {"flip", Kind::edit, Edit_kind::flip, 2, false, Syntax::nothing},
                              {"shift", Kind::edit, Edit_kind::shift, 0, false, Syntax::count},
                              {"brush", Kind::brush, Edit_kind::none, 0, false, Syntax::brush},
                              {"remesh", Kind::remesh, Edit_kind::none, 0, false, Syntax::length},
                              {"undo", Kind::edit, Edit_kind::undo, 0, false, Syntax::nothing},
                              {"redo", Kind::edit, Edit_kind::redo, 0, false, Syntax::nothing},
                              {"stroke", Kind::edit, Edit_kind::stroke, 0, false, Syntax::nothing},
                              {"end", Kind::edit, Edit_kind::end, 0, false, Syntax::nothing},
                              {"response", Kind::response, Edit_kind::none, 0, false, Syntax::word},
                              {"clearance", Kind::clearance, Edit_kind::none, 0, false, Syntax::length},
                              {"delta", Kind::delta, Edit_kind::none, 0, false, Syntax::length},
                              {"mesh", Kind::mesh, Edit_kind::none, 0, false, Syntax::word}};

class Line {
public:
  Line(const std::string& script, const std::string& text, std::size_t number)
    : script_(script), text_(text.substr(0, text.find('#'))), number_(number) {}

  std::optional<std::string> next_word() {
    const std::size_t begin = text_.find_first_not_of(" \t\r", end_);
    if (begin == std::string::npos)
      return std::nullopt;
    begin_ = begin;
    end_ = std::min(text_.find_first_of(" \t\r", begin), text_.size());
    return text_.substr(begin_, end_ - begin_);
  }

  std::string word(const std::string& expected) {
    if (auto found = next_word())
      return *found;
    begin_ = text_.size();
    fail("the line ends where " + expected + " is expected");
  }

  double number(const std::string& expected) { return number(expected, word(expected)); }
  std::size_t whole_number(const char* expected) { return index(word(expected), expected); }
  void end(const std::string& what = "this line") {
    if (const auto surplus = next_word())
      fail("'" + printable(*surplus) + "' is more than " + what + " takes");
  }

  /// The one place where a number is read. \param found the word just read
  double number(const std::string& expected, const std::string& found) const {
    const auto value = number_of(found);
    if (!value)
      fail("'" + printable(found) + "' is not " + expected + " (a decimal or hexadecimal number)");
    if (!std::isfinite(*value))
      fail("'" + printable(found) + "' is not a finite number");
    if (!is_in_range(*value))
      fail("'" + printable(found) + "' is out of range: numbers are of at most 2^1000, about 1.07e301");
    return *value;
  }

  std::array<double, 3> coordinates(const std::string& expected) {
    std::array<double, 3> point;
    for (double& coordinate : point)
      coordinate = number(expected);
    return point;
  }

  /// \param found the word just read: a vertex by index, or as @X,Y,Z \param which of its vertices the command has it
  /// for \return 0 where it is yet to be found
  std::size_t vertex(Command& command, std::size_t which, const std::string& found) const {
    if (found[0] != '@')
      return index(found, "a vertex index (0, 1, 2, ...), nor @X,Y,Z for the nearest vertex");
    command.places.push_back({which, place(found)});
    return 0;
  }
  std::size_t vertex(Command& command, std::size_t which) {
    return vertex(command, which, word("a vertex index, or @X,Y,Z,"));
  }

  [[noreturn]] void fail(const std::string& what) const { throw Script_error(script_, number_, begin_ + 1, what); }

private:
  std::size_t index(const std::string& found, const char* expected) const {
    std::size_t value = 0;
    const auto [end, error] = std::from_chars(found.data(), found.data() + found.size(), value);
    if (error == std::errc::invalid_argument || end != found.data() + found.size())
      fail("'" + printable(found) + "' is not " + expected);
    if (error == std::errc::result_out_of_range)
      fail("'" + printable(found) + "' is more than any mesh has");
    return value;
  }

  std::array<double, 3> place(const std::string& found) const {
    const auto words = words_of_place(found);
    if (!words)
      fail("'" + printable(found) + "' is not @X,Y,Z: three numbers, commas and no blanks between them");
    std::array<double, 3> point;
    for (std::size_t i = 0; i < 3; ++i)
      point[i] = number("a coordinate", (*words)[i]);
    return point;
  }

  const std::string& script_;
  std::string text_;
  std::size_t number_, begin_ = 0, end_ = 0;
};

/// KIND X Y Z RADIUS STRENGTH [NX NY NZ]
void read_brush(Line& line, Command& command) {
  command.word = line.word("grab, inflate, smooth, flatten or pinch");
  if (!brush_kind(command.word))
    line.fail("'" + printable(command.word) + "' is not a brush: grab, inflate, smooth, flatten or pinch");
  command.points.push_back(line.coordinates("a coordinate of the centre"));
  command.length = line.number("a radius");
  if (!(command.length > 0))
    line.fail("the radius must be more than 0");
  command.strength = line.number("a strength");
  if (const auto first = line.next_word())
    command.points.push_back({line.number("a coordinate of the direction", *first),
                              line.number("a coordinate of the direction"),
                              line.number("a coordinate of the direction")});
  if (command.points.back() == std::array<double, 3>{} && command.points.size() == 2)
    line.fail("the direction must not be 0 0 0; leave it out for the mean normal");
}

void read_last(Line& line, const Syntax& syntax, Command& command, std::size_t& shifted) {
  if (syntax.last == Syntax::two_points) {
    for (int i = 0; i < 2; ++i)
      command.points.push_back(line.coordinates("a coordinate"));
  } else if (syntax.last == Syntax::brush) {
    read_brush(line, command);
  } else if (syntax.last == Syntax::count) {
    const std::size_t axis = line.whole_number("an axis (0, 1 or 2)");
    if (axis > 2)
      line.fail("the axis must be 0, 1 or 2");
    command.edit.axis = static_cast<int>(axis);
    shifted = line.whole_number("a number of vertices");
  } else if (syntax.last == Syntax::length) {
    const bool may_be_default = command.kind == Kind::clearance;
    const std::string expected = may_be_default ? "a length, or 'default'" : "a length";
    const std::string found = line.word(expected);
    if (may_be_default && found == "default") {
      command.word = found;
      return;
    }
    command.length = line.number(expected, found);
    if (command.length < 0 || (command.length == 0 && command.kind != Kind::delta))
      line.fail(std::string("the ") + (command.kind == Kind::remesh ? "length of edges" : syntax.name) + " must be " +
                (command.kind == Kind::delta ? "at least 0" : "more than 0"));
  } else if (syntax.last == Syntax::word && command.kind == Kind::response) {
    command.word = line.word("slide, stop or paper");
    if (!response_by_name(command.word))
      line.fail("'" + printable(command.word) + "' is not a response: slide, stop or paper");
  } else if (syntax.last == Syntax::word) {
    command.word = line.word("the SHA-256 of the mesh file");
    std::transform(command.word.begin(), command.word.end(), command.word.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    if (command.word.size() != 64 || command.word.find_first_not_of("0123456789abcdef") != std::string::npos)
      line.fail("'" + printable(command.word) + "' is not a SHA-256 (64 hexadecimal digits)");
  }
}

/// \param shifted gets how many lines follow a shift \return none of a line that holds a comment only, or nothing
std::optional<Command> read_line(const std::string& text, std::size_t number, const std::string& script,
                                 std::size_t& shifted) {
  Line line(script, text, number);
  const auto first = line.next_word();
  if (!first)
    return std::nullopt;
  const auto syntax =
      std::find_if(std::begin(syntaxes), std::end(syntaxes), [&](const Syntax& s) { return *first == s.name; });
  if (syntax == std::end(syntaxes))
    line.fail("'" + printable(*first) + "' is not an edit or a directive");
  Command command;
  command.line = number;
  command.kind = syntax->kind, command.edit.kind = syntax->edit;
  for (std::size_t i = 0; i < static_cast<std::size_t>(syntax->vertices); ++i)
    command.edit.vertices[i] = line.vertex(command, i);
  if (syntax->has_point)
    command.edit.point = line.coordinates("a coordinate");
  read_last(line, *syntax, command, shifted);
  line.end("'" + *first + "'");
  return command;
}

} // namespace

const Syntax& syntax_of(const Command& command) {
  return *std::find_if(std::begin(syntaxes), std::end(syntaxes), [&](const Syntax& s) {
    return s.kind == command.kind && (s.kind != Kind::edit || s.edit == command.edit.kind);
  });
}

std::vector<std::size_t> vertices_of(const Command& command) {
  const auto& all = command.edit.vertices;
  return {all.begin(), all.begin() + syntax_of(command).vertices};
}

std::optional<Command> Line_joiner::take(const std::string& text, std::size_t number, const std::string& script) {
  if (!shift_) {
    auto command = read_line(text, number, script, shifted_);
    if (!command || command->edit.kind != Edit_kind::shift)
      return command;
    shift_ = std::move(command);
    return std::nullopt;
  }
  Line line(script, text, number);
  const bool is_whole = shift_->edit.ways.size() == shifted_;
  const auto first = line.next_word();
  if (!first)
    return std::nullopt;
  if (is_whole && *first != "end")
    line.fail("'" + printable(*first) + "' stands where the shift of line " + std::to_string(shift_->line) +
              " has to end");
  if (!is_whole) {
    const std::size_t vertex = line.vertex(*shift_, shift_->edit.ways.size(), *first);
    shift_->edit.ways.emplace_back(vertex, line.number("a coordinate"));
  }
  line.end();
  return is_whole ? std::exchange(shift_, std::nullopt) : std::nullopt;
}

void Line_joiner::check_end(const std::string& script) const {
  if (shift_)
    throw Script_error(script, shift_->line, 1,
                       "this shift of " + std::to_string(shifted_) + " vertices has " +
                           std::to_string(shift_->edit.ways.size()) +
                           " lines of a vertex and a coordinate, and no `end`");
}

std::vector<Command> read_script(std::string_view text, const std::string& name) {
  std::vector<Command> commands;
  Line_joiner lines;
  text = without_byte_order_mark(text);
  for (std::size_t number = 1; !text.empty(); ++number) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    if (auto command = lines.take(std::string(text.substr(0, end)), number, name)) {
      if (commands.size() == most_commands)
        throw Script_error(name, number, 1,
                           "a script has at most " + std::to_string(most_commands) +
                               " edits and directives: give what follows as another script, with the same --log; "
                               "a log of any length is replayed as --log");
      commands.push_back(std::move(*command));
    }
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  lines.check_end(name);
  return commands;
}

std::optional<Response> response_by_name(const std::string& name) {
  return response_named(name, {Response::paper()});
}

std::size_t open_strokes(const std::vector<Command>& commands) {
  std::size_t open = 0;
  for (const Command& command : commands)
    if (command.edit.kind == Edit_kind::stroke)
      ++open;
    else if (command.edit.kind == Edit_kind::end && open != 0)
      --open;
  return open;
}

} // namespace haptic_sculpt::examples
