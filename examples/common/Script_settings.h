// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Script.h"

#include <optional>
#include <string>
#include <vector>

namespace haptic_sculpt::examples {

/// What holds at the first edit, and how options and directives change it.
struct Settings {
  std::string response = "slide";
  std::optional<double> clearance; ///< unset: the default
  double delta = 0;

  /// Of commands other than settings, and of those that were refused: nothing.
  void follow(const Command& command);
  /// As directives.
  std::vector<Command> directives() const;
  /// The directives that make these of others.
  std::vector<Command> changes_from(const Settings& others) const;
};

inline void Settings::follow(const Command& command) {
  if (command.is_refused)
    return;
  if (command.kind == Command::Kind::response)
    response = command.word;
  else if (command.kind == Command::Kind::clearance)
    clearance = command.word.empty() ? std::optional(command.length) : std::nullopt;
  else if (command.kind == Command::Kind::delta)
    delta = command.length;
}

inline std::vector<Command> Settings::directives() const {
  std::vector<Command> all(3);
  all[0].kind = Command::Kind::response;
  all[0].word = response;
  all[1].kind = Command::Kind::clearance;
  all[1].word = clearance ? "" : "default";
  all[1].length = clearance.value_or(0);
  all[2].kind = Command::Kind::delta;
  all[2].length = delta;
  return all;
}

inline std::vector<Command> Settings::changes_from(const Settings& others) const {
  std::vector<Command> changes = directives(), theirs = others.directives();
  for (std::size_t i = theirs.size(); i-- > 0;)
    if (changes[i].word == theirs[i].word && changes[i].length == theirs[i].length)
      changes.erase(changes.begin() + static_cast<std::ptrdiff_t>(i));
  return changes;
}

} // namespace haptic_sculpt::examples
