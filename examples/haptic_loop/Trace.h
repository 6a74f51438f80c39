// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/haptic_rendering.h>

#include <cstdio>

namespace haptic_sculpt::loop_program {

/// The first line of a trace; doc/use/haptic_loop.md says what is in the columns.
inline void write_columns(std::FILE* file) {
  std::fputs("t,theta1,theta2,theta3,tx,ty,tz,x,y,z,fcx,fcy,fcz,fx,fy,fz,tau1,tau2,tau3,end,contacts,pairs,cpu_ns\n",
             file);
}

/// How the drag of a tick ended.
inline const char* end_of(const Tool_step& tool) {
  return tool.starved ? "starved" : tool.end ? name_of(*tool.end) : "none";
}

/// A tick. \param time s \param cpu ns
inline void write_row(std::FILE* file, const Joint_reading& reading, const Haptic_tick& made, double time,
                      std::uint64_t cpu) {
  const auto put = [&](const Eigen::Vector3d& v) { std::fprintf(file, ",%.17g,%.17g,%.17g", v[0], v[1], v[2]); };
  std::fprintf(file, "%.17g", time);
  put(reading.theta), put(made.tool.target), put(made.tool.proxy), put(made.coupling), put(made.rendered.force),
      put(made.rendered.torque);
  std::fprintf(file, ",%s,%d,%zu,%llu\n", end_of(made.tool), made.tool.contacts,
               made.tool.pairs, static_cast<unsigned long long>(cpu));
}

} // namespace haptic_sculpt::loop_program
