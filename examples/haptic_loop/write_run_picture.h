// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Run_samples.h"

#include "../drawing/write_picture.h"

namespace haptic_sculpt::loop_program {

/// The ways of hand and proxy on the sculpted mesh. \param scene the mesh \return for people: what of an old file could
/// not be kept \throw drawing::Picture_error
inline std::string write_run_picture(drawing::Scene scene, const Run_samples& samples, const std::string& path) {
  using namespace drawing;
  const auto& all = samples.samples();
  const Color hand = colors::red, proxy = colors::blue;
  for (std::size_t i = 1; i < all.size(); ++i) {
    scene.segments.push_back({all[i - 1].proxy, all[i].proxy, proxy, 1.6});
    if (all[i].is_blocked && all[i - 1].is_blocked)
      scene.segments.push_back({all[i - 1].target, all[i].target, hand, 1.4});
  }
  for (const auto& event : samples.events) {
    scene.balls.push_back({event.place, colors::orange, 5});
    scene.labels.push_back({event.place, event.what});
  }
  scene.legend = {{Legend_entry::Mark::line, proxy, "proxy"},
                  {Legend_entry::Mark::line, hand, "hand, where held back"},
                  {Legend_entry::Mark::ball, colors::orange, "button"}};
  return write_picture(scene, path);
}

} // namespace haptic_sculpt::loop_program
