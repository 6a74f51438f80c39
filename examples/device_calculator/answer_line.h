// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "json_line.h"

namespace haptic_sculpt::examples {

/// A message quotes what it complains of, which may be a whole line.
constexpr std::size_t longest_message = 1000;

/// One object: the answer to the request in that line, its numbers finite, or why there is none; and the keys that mean
/// nothing.
/// \throw std::bad_alloc
nlohmann::json answer_line(const Line_reader& reader);

} // namespace haptic_sculpt::examples
