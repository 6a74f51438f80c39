// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/Error.h>

#include <array>
#include <string>
#include <vector>

namespace haptic_sculpt::window_program {

/// Pixels from 0, either way, and degrees: with much more a view would be no numbers.
constexpr double most_of_script = 1e6;

/// A place in the window: pixels from its upper left corner, or where a point of space is seen when its turn comes.
struct Spot {
  bool is_in_space = false;
  std::array<double, 3> coordinates{};
};

/// What a script does in one frame of the window, or what it waits for. The words are those of doc/use/window.md.
struct Action {
  enum class Kind {
    move,
    press,
    release,
    scroll,
    key, // what a hand does
    view,
    orbit,
    zoom,
    fit,
    tool,
    brush,
    symmetry,
    remesh,
    depth, // what it sets
    wait,
    settle, // until the time has passed; until all that was asked for is done and shown
    screenshot,
    save,
    open,
    record,
    print,
    where,
    close,
    quit
  };
  Kind kind = Kind::settle;
  std::size_t line = 0;
  Spot spot, to; ///< move: from `spot` by `share` of the way to `to`
  double share = 0;
  std::string word; ///< key, file; press: button and modifiers; scroll: its modifier; of what it sets: the line
  int which = 0;    ///< of the tools or brushes; symmetry: a bit for each axis
  std::array<double, 3> numbers{};

  bool sets_something() const { return kind >= Kind::view && kind <= Kind::depth; }
};

/// A script that cannot be read. Says the line.
struct Action_error : Error {
  using Error::Error;
};

/// \param name how messages call it \throw Action_error
std::vector<Action> read_actions(const std::string& text, const std::string& name);

} // namespace haptic_sculpt::window_program
