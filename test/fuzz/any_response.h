// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <fuzz/Choices.h>

#include <haptic_sculpt/sculpting/paper_1997.h>

namespace haptic_sculpt::fuzz {

/// One of all responses, as the choices say.
inline Response any_response(Choices& choices) {
  constexpr Response all[] = {Response::slide, Response::stop, Response::paper()};
  return all[choices.below(3)];
}

} // namespace haptic_sculpt::fuzz
