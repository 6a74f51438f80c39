// SPDX-License-Identifier: GPL-3.0-or-later
#include "Action.h"

#include "exchange.h"
#include "keys.h"

#include "../common/contents_of.h"
#include "../common/numbers.h"

#include <cmath>
#include <optional>
#include <sstream>

namespace haptic_sculpt::window_program {
namespace {

using Kind = Action::Kind;

/// The words of a line.
class Line {
public:
  Line(const std::string& text, const std::string& name, std::size_t number)
      : words_(text.substr(0, text.find('#'))), name_(name), number_(number) {}

  [[noreturn]] void fail(const std::string& what) const {
    throw Action_error(name_ + ": line " + std::to_string(number_) + ": " + what);
  }
  std::optional<std::string> next() {
    std::string word;
    return words_ >> word ? std::optional(word) : std::nullopt;
  }
  std::string word(const std::string& expected) {
    const auto found = next();
    if (!found)
      fail("the line ends where " + expected + " is expected");
    return *found;
  }
  /// All that is left, blanks included: the name of a file.
  std::string rest(const std::string& expected) {
    std::string text;
    std::getline(words_ >> std::ws, text);
    while (!text.empty() && (text.back() == ' ' || text.back() == '\t' || text.back() == '\r'))
      text.pop_back();
    if (text.empty())
      fail("the line ends where " + expected + " is expected");
    return text;
  }
  double number(const std::string& expected) { return number(expected, word(expected)); }
  double number(const std::string& expected, const std::string& found) const {
    const auto value = examples::number_of(found);
    if (!value || !std::isfinite(*value))
      fail("'" + found + "' is not " + expected);
    return *value;
  }
  double bounded(const std::string& expected) { return bounded(expected, word(expected)); }
  double bounded(const std::string& expected, const std::string& found) const {
    const double value = number(expected, found);
    if (std::fabs(value) > most_of_script)
      fail("'" + found + "' is not " + expected + " from -1e6 to 1e6");
    return value;
  }
  double number_or(double otherwise, const std::string& expected) {
    const auto found = next();
    return found ? number(expected, *found) : otherwise;
  }
  /// X Y, or @X,Y,Z.
  Spot spot() {
    Spot spot;
    const std::string first = word("a place, as pixels X Y or @X,Y,Z,");
    spot.is_in_space = first[0] == '@';
    if (!spot.is_in_space) {
      spot.coordinates = {bounded("a pixel", first), bounded("a pixel"), 0};
      return spot;
    }
    const auto words = examples::words_of_place(first);
    if (!words)
      fail("'" + first + "' is not @X,Y,Z");
    for (std::size_t i = 0; i < 3; ++i)
      spot.coordinates[i] = number("a coordinate", (*words)[i]);
    return spot;
  }
  void end() {
    if (const auto more = next())
      fail("'" + *more + "' is more than the line takes");
  }
  /// \return which of them
  template <class Words>
  int one_of(const std::string& what, const Words& words) {
    std::string expected = what + ':';
    for (const char* const w : words)
      expected += std::string(w == words[0] ? " " : ", ") + w;
    const std::string found = word(expected);
    int which = 0;
    for (const char* const w : words)
      if (found == w)
        return which;
      else
        ++which;
    fail("'" + found + "' is not " + expected);
  }

private:
  std::istringstream words_;
  const std::string& name_;
  std::size_t number_;
};

constexpr const char* buttons[] = {"left", "right", "middle"};
constexpr const char* modifiers[] = {"shift", "ctrl", "alt"};

constexpr std::size_t most_actions = 1000000;
constexpr std::size_t most_bytes_of_line = 10000;

class Reader {
public:
  Reader(std::vector<Action>& actions, Line& line, std::size_t number)
      : actions_(actions), line_(line), number_(number) {}

  void read(const std::string& first) {
    if (first == "move")
      add(Kind::move).spot = line_.spot();
    else if (first == "press")
      press();
    else if (first == "release")
      add(Kind::release);
    else if (first == "click")
      click();
    else if (first == "drag")
      drag();
    else if (first == "scroll")
      scroll();
    else if (first == "key")
      key();
    else if (first == "view")
      view();
    else if (first == "orbit")
      add(Kind::orbit).numbers = {line_.bounded("degrees"), line_.bounded("degrees"), 0};
    else if (first == "zoom")
      add(Kind::zoom).numbers[0] = more_than_0("a factor");
    else if (first == "fit")
      add(Kind::fit);
    else if (first == "tool")
      add(Kind::tool).which = line_.one_of("a tool", tool_words);
    else if (first == "brush")
      brush();
    else if (first == "symmetry")
      symmetry();
    else if (first == "remesh")
      remesh();
    else if (first == "depth")
      add(Kind::depth).numbers[0] = line_.number("a length");
    else if (first == "wait")
      wait();
    else if (first == "settle")
      add(Kind::settle);
    else if (first == "screenshot" || first == "save" || first == "open" || first == "record")
      add(first == "screenshot" ? Kind::screenshot
          : first == "save"     ? Kind::save
          : first == "open"     ? Kind::open
                                : Kind::record)
          .word = line_.rest("the name of a file");
    else if (first == "print")
      add(Kind::print);
    else if (first == "where")
      add(Kind::where).spot = line_.spot();
    else if (first == "close")
      add(Kind::close);
    else if (first == "quit")
      add(Kind::quit);
    else
      line_.fail("'" + first + "' is not an action");
    line_.end();
  }

private:
  std::vector<Action>& actions_;
  Line& line_;
  std::size_t number_;

  Action& add(Kind kind) {
    if (actions_.size() == most_actions)
      line_.fail("a script has at most " + std::to_string(most_actions) + " actions, each step of a drag being one");
    actions_.emplace_back();
    actions_.back().kind = kind;
    actions_.back().line = number_;
    return actions_.back();
  }
  void three(Action& action, const std::string& expected) {
    for (double& x : action.numbers)
      x = line_.number(expected);
  }
  double more_than_0(const std::string& expected) {
    const double x = line_.number(expected);
    if (!(x > 0))
      line_.fail("it takes " + expected + " of more than 0");
    return x;
  }
  void view() {
    Action& action = add(Kind::view);
    three(action, "a component of the direction");
    if (action.numbers == std::array<double, 3>{})
      line_.fail("0 0 0 is no direction");
  }
  void wait() {
    const double most = 1e6; // s, eleven days
    if (const double seconds = add(Kind::wait).numbers[0] = line_.number("seconds"); !(seconds >= 0 && seconds <= most))
      line_.fail("it waits 0 to 1e6 seconds");
  }
  void press() {
    std::string word = buttons[line_.one_of("a button", buttons)];
    while (const auto more = line_.next())
      word += '+' + modifier(*more);
    add(Kind::press).word = word;
  }
  std::string modifier(const std::string& word) {
    for (const char* const m : modifiers)
      if (word == m)
        return word;
    line_.fail("'" + word + "' is not shift, ctrl or alt");
  }
  void click() {
    add(Kind::move).spot = line_.spot();
    add(Kind::press).word = "left";
    add(Kind::release);
  }
  /// drag PLACE PLACE [STEPS] [normal|ctrl|right|middle]
  void drag() {
    const Spot from = line_.spot(), to = line_.spot();
    double steps = 20;
    std::string button = "left";
    while (const auto more = line_.next()) {
      if (*more == "normal")
        button = "left+shift";
      else if (*more == "ctrl")
        button = "left+ctrl";
      else if (*more == "right" || *more == "middle")
        button = *more;
      else
        steps = line_.number("a number of steps, 'normal', 'ctrl', 'right' or 'middle'", *more);
    }
    if (!(steps >= 1 && steps <= 100000))
      line_.fail("a drag has 1 to 100000 steps");
    add(Kind::move).spot = from;
    add(Kind::press).word = button;
    for (int i = 1; i <= int(steps); ++i) {
      Action& step = add(Kind::move);
      step.spot = from, step.to = to, step.share = i / std::floor(steps);
    }
    add(Kind::settle);
    add(Kind::release);
  }
  /// scroll NOTCHES [ctrl|shift]
  void scroll() {
    Action& action = add(Kind::scroll);
    action.numbers[0] = line_.number("a number of notches");
    if (const auto more = line_.next()) {
      action.word = modifier(*more);
      if (action.word == "alt")
        line_.fail("a wheel is turned with 'ctrl' or 'shift'");
    }
  }
  void key() {
    Action& action = add(Kind::key);
    action.word = line_.word("a key");
    if (!key_named(action.word))
      line_.fail("'" + action.word + "' is no key: --help lists them");
    if (key_named(action.word)->order == Order::open)
      line_.fail("the key 'o' asks for a name, which a script cannot type: `open FILE` opens one");
  }
  void brush() {
    Action& action = add(Kind::brush);
    action.which = line_.one_of("a brush", brush_words);
    action.numbers = {line_.number("a radius"), line_.number_or(0.5, "a strength"), 0};
    if (!(action.numbers[0] > 0))
      line_.fail("the radius must be more than 0");
  }
  void symmetry() {
    Action& action = add(Kind::symmetry);
    const std::string first = line_.word("x, y or z, or none");
    for (std::optional<std::string> word = first; word && first != "none"; word = line_.next()) {
      if (*word != "x" && *word != "y" && *word != "z")
        line_.fail("'" + *word + "' is not x, y or z");
      action.which |= 1 << ((*word)[0] - 'x');
    }
  }
  void remesh() {
    Action& action = add(Kind::remesh);
    if (const auto word = line_.next()) { // else 0: the length that is kept
      action.numbers[0] = line_.number("a length", *word);
      if (!(action.numbers[0] > 0))
        line_.fail("the length must be more than 0");
    }
  }
};

} // namespace

std::vector<Action> read_actions(const std::string& text, const std::string& name) {
  std::vector<Action> actions;
  std::istringstream lines{std::string(examples::without_byte_order_mark(text))};
  std::string line;
  for (std::size_t number = 1; std::getline(lines, line); ++number) {
    if (line.size() > most_bytes_of_line)
      throw Action_error(name + ": line " + std::to_string(number) + " is longer than " +
                         std::to_string(most_bytes_of_line) + " bytes");
    if (line.find('\0') != std::string::npos)
      throw Action_error(name + ": line " + std::to_string(number) + " has a byte 0, which is no text");
    Line words(line, name, number);
    if (const auto first = words.next())
      Reader(actions, words, number).read(*first);
    if (!actions.empty() && actions.back().line == number && actions.back().sets_something())
      actions.back().word = line.substr(0, line.find('#')); // as it is recorded
  }
  return actions;
}

} // namespace haptic_sculpt::window_program
