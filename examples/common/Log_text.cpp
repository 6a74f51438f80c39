// SPDX-License-Identifier: GPL-3.0-or-later
#include "Log_text.h"

#include "Sha256.h"
#include "printable.h"

#include <algorithm>
#include <charconv>
#include <cstdio>

namespace haptic_sculpt::examples {
namespace {

using Kind = Command::Kind;

constexpr std::string_view version_word = "# haptic_sculpt log ", current_version = "1", pass_word = "# script ",
                           tick_word = "# tick ", after_word = " after line ", done_word = " done",
                           line_word = " # line ", refused_word = " # refused", checksum_word = " # ";
const std::string end_word = "end";
constexpr std::size_t checksum_size = 16; // digits: 64 bits

bool begins_with(std::string_view text, std::string_view start) {
  return text.substr(0, start.size()) == start;
}

bool ends_with(std::string_view text, std::string_view end) {
  return text.size() >= end.size() && text.substr(text.size() - end.size()) == end;
}

std::string hexadecimal(double x) {
  char text[40];
  std::snprintf(text, sizeof text, "%a", x);
  return text;
}

std::string text_of(const Command& command) {
  const Syntax& syntax = syntax_of(command);
  std::string text = syntax.name;
  const auto add = [&text](const std::array<double, 3>& point) {
    for (const double x : point)
      text += ' ' + hexadecimal(x);
  };
  for (const std::size_t v : vertices_of(command))
    text += ' ' + std::to_string(v);
  if (syntax.has_point)
    add(command.edit.point);
  if (syntax.last == Syntax::count)
    text += ' ' + std::to_string(command.edit.axis) + ' ' + std::to_string(command.edit.ways.size());
  if (syntax.last == Syntax::length && command.word.empty())
    text += ' ' + hexadecimal(command.length);
  if (!command.word.empty())
    text += ' ' + command.word;
  for (std::size_t i = 0; i < command.points.size(); ++i) {
    add(command.points[i]);
    if (syntax.last == Syntax::brush && i == 0)
      text += ' ' + hexadecimal(command.length) + ' ' + hexadecimal(command.strength);
  }
  return text;
}

std::optional<std::size_t> number(std::string_view text) {
  std::size_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size() ? std::optional(value) : std::nullopt;
}

std::string checksum_of(std::string_view before, std::string_view payload) {
  return Sha256().add(before).add(payload).digest().substr(0, checksum_size);
}

/// A line without its checksum.
struct Checked_line {
  std::string_view payload, checksum;
};

std::optional<Checked_line> split(std::string_view line) {
  if (line.size() < checksum_word.size() + checksum_size)
    return std::nullopt;
  const std::size_t at = line.size() - checksum_size - checksum_word.size();
  if (line.substr(at, checksum_word.size()) != checksum_word)
    return std::nullopt;
  return Checked_line{line.substr(0, at), line.substr(at + checksum_word.size())};
}

class Log_reader {
public:
  Log_reader(std::string_view text, const std::string& name, const std::string& mesh)
      : text_(text), name_(name), mesh_(mesh) {}

  std::optional<Log_contents> read() {
    while (read_line_here())
      ;
    contents_.unfinished = text_.substr(at_);
    check_unfinished();
    if (lines_.is_within_shift()) { // a killed process may leave part of it
      at_ = command_at_, checksum_ = command_checksum_;
      contents_.unfinished = "a shift without its end";
    }
    contents_.whole_size = at_;
    const std::size_t head = 1 + Settings().directives().size();
    if (contents_.commands.size() < head)
      return std::nullopt;
    contents_.writer = Log_writer(checksum_);
    return std::move(contents_);
  }

private:
  std::string_view text_;
  const std::string& name_;
  const std::string& mesh_;
  Log_contents contents_;
  std::string checksum_; ///< of the line before
  std::size_t at_ = 0, number_ = 0;
  Line_joiner lines_;
  Settings settings_;            ///< in force
  std::string command_checksum_; ///< before the command under way
  std::size_t command_at_ = 0;   ///< where that begins

  [[noreturn]] void fail(const std::string& what) const { throw Script_error(name_, number_, 1, what); }

  /// False at the end of the whole lines.
  bool read_line_here() {
    const std::size_t end = text_.find('\n', at_);
    ++number_;
    if (number_ == 1)
      check_begin_of_log(text_, name_);
    if (end == std::string_view::npos)
      return false;
    const std::string_view line = text_.substr(at_, end - at_);
    if (!lines_.is_within_shift())
      command_at_ = at_, command_checksum_ = checksum_;
    if (number_ == 1)
      read_version(line);
    else
      read_checked(line);
    at_ = end + 1;
    return true;
  }

  void read_version(std::string_view line) {
    checksum_ = Sha256().digest(); // of nothing
    const std::string_view payload = check(line); // the blank that ends the word may begin the checksum
    const std::string_view version = payload.substr(std::min(payload.size(), version_word.size()));
    if (version != current_version)
      throw Foreign_log("'" + name_ + "' is a log of format '" + printable(version) + "'" +
                        ", which this program is too old for");
  }

  /// The line without its checksum. \throw Script_error
  std::string_view check(std::string_view line) {
    const auto parts = split(line);
    if (!parts || checksum_of(checksum_, parts->payload) != parts->checksum)
      fail("this line does not agree with its checksum: it has been changed, or lines before it are gone. Give a copy "
           "of the log that is sound; as a script (--script) it would be read without looking at checksums");
    checksum_ = parts->checksum;
    return parts->payload;
  }

  void read_checked(std::string_view line) {
    const std::string_view payload = check(line);
    if (lines_.is_within_shift() && begins_with(payload, "#"))
      fail("a shift stands here without its end");
    if (begins_with(payload, pass_word)) {
      read_pass(payload.substr(pass_word.size()));
      return;
    }
    if (begins_with(payload, tick_word)) {
      read_tick(payload.substr(tick_word.size()),
                static_cast<std::size_t>(line.data() - text_.data()) + line.size() + 1);
      return;
    }
    const std::size_t from = payload.rfind(line_word);
    if (from == std::string_view::npos) {
      read_command(payload, 0);
      return;
    }
    const auto script_line = number(payload.substr(from + line_word.size()));
    if (!script_line || *script_line == 0 || contents_.passes.empty())
      fail("the line of the script is not understood");
    std::size_t& last = contents_.passes.back().last_line;
    if (*script_line != last)
      contents_.last_line = {{command_at_, contents_.commands.size(), command_checksum_}, last};
    last = *script_line;
    read_command(payload.substr(0, from), *script_line);
  }

  void read_tick(std::string_view text, std::size_t size) {
    const auto tick = number(text);
    if (!tick)
      fail("the number of the tick is not understood");
    contents_.last_tick = {*tick, {size, contents_.commands.size(), checksum_}};
  }

  void read_pass(std::string_view text) {
    contents_.last_tick.reset(), contents_.last_line.reset();
    Log_contents::Pass pass;
    pass.script = text.substr(0, 64);
    const std::string_view rest = text.substr(pass.script.size());
    const auto line = begins_with(rest, after_word) ? number(rest.substr(after_word.size())) : std::nullopt;
    const bool is_done =
        rest == done_word && !contents_.passes.empty() && contents_.passes.back().script == pass.script;
    if (!is_sha256(pass.script) || !(line || is_done))
      fail("what is said of a script is not understood");
    if (is_done) {
      contents_.passes.back().is_done = true;
      return;
    }
    pass.last_line = *line;
    pass.settings = settings_;
    if (pass.last_line != 0) { // it goes on with what was in force when it broke off
      const auto before = std::find_if(contents_.passes.rbegin(), contents_.passes.rend(),
                                       [&](const Log_contents::Pass& other) { return other.script == pass.script; });
      if (before != contents_.passes.rend())
        pass.settings = before->settings;
    }
    contents_.passes.push_back(pass);
  }

  void read_command(std::string_view text, std::size_t script_line) {
    const bool is_refused = ends_with(text, refused_word);
    auto command = lines_.take(std::string(text), number_, name_);
    if (!command)
      return;
    command->is_logged = true, command->is_refused = is_refused;
    command->script_line = script_line;
    if (contents_.commands.empty() && (command->kind != Kind::mesh || command->word != mesh_))
      throw Foreign_log("the log '" + name_ + "' does not begin with the hash of this mesh, " + mesh_ +
                        ": give the mesh it was begun with (of sculpt, with the same --repair, --triangulate and "
                        "--orient), or another log");
    settings_.follow(*command);
    if (!contents_.passes.empty())
      contents_.passes.back().settings.follow(*command);
    contents_.commands.push_back(std::move(*command));
  }

  /// A process that is killed leaves part of a line. A whole one and a byte more is a line whose end has been changed.
  void check_unfinished() const {
    const std::string_view tail = text_.substr(at_);
    if (tail.empty())
      return;
    const auto parts = split(tail.substr(0, tail.size() - 1));
    if (parts && checksum_of(checksum_, parts->payload) == parts->checksum)
      fail("the end of this line has been changed; it should be the end of a line");
  }
};

} // namespace

std::string Log_writer::line(const std::string& payload) {
  checksum_ = checksum_of(checksum_, payload);
  return payload + std::string(checksum_word) + checksum_ + '\n';
}

std::string Log_writer::head(const std::string& mesh, const Settings& settings) {
  checksum_ = Sha256().digest(); // of nothing
  std::string text = line(std::string(version_word) + std::string(current_version));
  Command hash;
  hash.kind = Kind::mesh;
  hash.word = mesh;
  text += line(text_of(hash));
  for (const Command& setting : settings.directives())
    text += line(text_of(setting));
  return text;
}

std::string Log_writer::command(const Command& command, std::size_t script_line) {
  std::string lines, last = text_of(command);
  if (command.edit.kind == Edit_kind::shift) {
    lines = line(last);
    for (const auto& [vertex, coordinate] : command.edit.ways)
      lines += line(std::to_string(vertex) + ' ' + hexadecimal(coordinate));
    last = end_word;
  }
  if (command.is_refused)
    last += refused_word;
  return lines + line(last + std::string(line_word) + std::to_string(script_line));
}

std::string Log_writer::ends(std::size_t open) {
  std::string text;
  for (; open != 0; --open)
    text += line(end_word);
  return text;
}

std::string Log_writer::pass(const std::string& script, std::size_t after) {
  return line(std::string(pass_word) + script + std::string(after_word) + std::to_string(after));
}

std::string Log_writer::done(const std::string& script) {
  return line(std::string(pass_word) + script + std::string(done_word));
}

std::string Log_writer::tick(std::size_t number) {
  return line(std::string(tick_word) + std::to_string(number));
}

Settings Log_contents::first_settings() const {
  Settings settings;
  for (std::size_t i = 1; i <= settings.directives().size(); ++i) // of the head, after the mesh
    settings.follow(commands[i]);
  return settings;
}

Settings Log_contents::last_settings() const {
  Settings settings;
  for (const Command& command : commands)
    settings.follow(command);
  return settings;
}

std::string_view whole_commands_of(std::string_view text) {
  if (!begins_with(text, version_word))
    return text;
  const std::string_view whole = text.substr(0, text.rfind('\n') + 1);
  for (std::size_t end = whole.size(); end > 0;) { // of a shift the lines of its vertices begin with digits
    const std::size_t begin = end > 1 ? whole.rfind('\n', end - 2) + 1 : 0;
    if (begins_with(whole.substr(begin), "shift "))
      return whole.substr(0, begin);
    if (whole[begin] < '0' || whole[begin] > '9')
      break;
    end = begin;
  }
  return whole;
}

void check_begin_of_log(std::string_view text, const std::string& name) {
  if (begins_with(text, version_word))
    return;
  // The first line of a script that a log might be made of.
  const auto is_mesh_line = [&](std::string_view line) {
    try {
      const auto command = Line_joiner().take(std::string(line), 1, name);
      return command && command->kind == Kind::mesh;
    } catch (const Script_error&) {
      return false;
    }
  };
  throw Foreign_log("'" + name + "' is not a log, for line 1 is not the first line of one; it is left as it is. " +
                    (is_mesh_line(text.substr(0, text.find('\n')))
                         ? "Its lines are a script: give it as --script, and with --log a name that is not there yet"
                         : "Give the name of a log, or one that is not there yet"));
}

std::optional<Log_contents> read_log(std::string_view text, const std::string& name, const std::string& mesh) {
  return Log_reader(text, name, mesh).read();
}

} // namespace haptic_sculpt::examples
