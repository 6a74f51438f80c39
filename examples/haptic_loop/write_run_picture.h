// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef HAPTIC_SCULPT_EXAMPLES_HAPTIC_LOOP_WRITE_RUN_PICTURE_H
#define HAPTIC_SCULPT_EXAMPLES_HAPTIC_LOOP_WRITE_RUN_PICTURE_H

#include "Run_samples.h"

#include "../drawing/write_figure.h"

namespace haptic_sculpt::loop_program {

/// One picture of a run: the ways of hand and proxy on the sculpted mesh; force and energy over time; the times of
/// ticks. \param scene the mesh \param energy_is_true of the simulation, else as the observer has it \return for
/// people: what of an old file could not be kept \throw drawing::Picture_error
inline std::string write_run_picture(drawing::Scene scene, const Run_samples& samples, bool energy_is_true,
                                     const std::string& path) {
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
  const auto curve = [&](const Color& color, const std::string& name, const auto& value) {
    Curve curve;
    curve.color = color, curve.name = name;
    for (const auto& sample : all)
      curve.points.push_back({sample.time, value(sample)});
    return curve;
  };
  using Sample = Run_samples::Sample;
  Plot force, energy, times;
  force.title = "Force on the hand, N", force.x_label = "s";
  force.curves = {curve(colors::orange, "coupling", [](const Sample& s) { return s.coupling; }),
                  curve(colors::blue, "rendered", [](const Sample& s) { return s.force; })};
  energy.title = energy_is_true ? "Energy from the hand, mJ" : "Energy from the hand, as observed, mJ",
  energy.x_label = "s";
  energy.curves = {
      curve(colors::orange, "with friction", [](const Sample& s) { return 1e3 * (s.port + s.dissipated); }),
      curve(colors::blue, "port", [](const Sample& s) { return 1e3 * s.port; })};
  times.title = "Ticks by CPU time", times.x_label = "us", times.has_logarithmic_x = times.has_logarithmic_y = true;
  times.curves.push_back({samples.histogram(), colors::blue, "", true});
  return write_figure(scene, {force, energy, times}, path);
}

} // namespace haptic_sculpt::loop_program

#endif
