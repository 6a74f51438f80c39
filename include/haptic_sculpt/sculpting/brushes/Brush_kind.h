// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef HAPTIC_SCULPT_SCULPTING_BRUSH_KIND_H
#define HAPTIC_SCULPT_SCULPTING_BRUSH_KIND_H

#include <cstdint>
#include <optional>
#include <string>

namespace haptic_sculpt {

/// Where a brush wants what it touches.
enum class Brush_kind : std::uint8_t {
  grab,    ///< along the direction, by the strength as a length
  inflate, ///< along each vertex's normal, by the strength as a length
  smooth,  ///< towards the mean of the neighbours, by the strength as a share
  flatten, ///< onto the plane across the direction through the mean of what is touched, by the strength as a share
  pinch    ///< towards the line through the centre along the direction, by the strength as a share
};

/// "grab", "inflate", "smooth", "flatten", "pinch", or nothing.
inline std::optional<Brush_kind> brush_kind_named(const std::string& name) {
  const char* const names[] = {"grab", "inflate", "smooth", "flatten", "pinch"};
  for (int i = 0; i < 5; ++i)
    if (name == names[i])
      return static_cast<Brush_kind>(i);
  return std::nullopt;
}

} // namespace haptic_sculpt

#endif
