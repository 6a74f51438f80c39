// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef HAPTIC_SCULPT_ERROR_H
#define HAPTIC_SCULPT_ERROR_H

#include <stdexcept>
#include <string>

namespace haptic_sculpt {

/// The base of every exception this library throws. What it says names the offending element and what to do.
///
/// A blocked drag, a refused edit or an unreachable pose is a result, never an exception.
class Error : public std::runtime_error {
public:
  explicit Error(const std::string& message) : std::runtime_error(message) {}
};

} // namespace haptic_sculpt

#endif
