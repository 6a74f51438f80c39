// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Happenings.h"
#include "Recording.h"

#include "../common/Result_writer.h"

#include <haptic_sculpt/haptic_rendering/Tick_statistics.h>

#include <cstdint>
#include <exception>

namespace haptic_sculpt::loop_program {

/// How often this program's thread has asked for memory so far.
std::size_t allocations();

/// What is to be done.
struct Plan {
  std::string mesh, out, log, picture, trace, record; ///< names of files; empty: none
  Settings settings;
  std::optional<Recording> replay;
  std::optional<Hand_path> path; ///< none in a replay
  std::optional<Injected_fault> fault;
  double seconds = 0;        ///< 0: as long as path or recording
  bool waits = false;        ///< for the time of each tick
  bool is_real_time = false; ///< the system is asked for it
};

/// What came of it.
struct Run_result {
  std::uint64_t ticks = 0, missed = 0, missed_by_cpu = 0, allocations = 0;
  std::uint64_t missed_by_wakeup = 0; ///< begun more than a tick after their time, or left out in a pause
  Tick_statistics cpu, wall, wakeup;
  double largest_force = 0,
         largest_free_force = 0; ///< N; free: nothing is touched, and the slew limit has had its time
  bool has_true_energy = false;
  double port = 0, dissipated = 0, observed = 0, least_observed = 0; ///< J
  double friction = 0, passive_stiffness = 0, calm_stiffness = 0;
  double largest_damping = 0, largest_mass = 0, largest_controller = 0; ///< that serve
  double mass_energy = 0; ///< taken by the virtual mass, J
  std::size_t grabbed = 0, created = 0, removed = 0, released = 0, refused = 0;
  std::vector<std::pair<double, std::string>> faults; ///< s
  std::array<double, Happenings::number> happened{};  ///< when first, s; NaN: not
  std::uint64_t ticks_written = 0, log_lost = 0;      ///< ticks with edits; entries that found no room
  std::string log_failure;                            ///< why the log does not hold all; empty if it does
  std::vector<double> map;                            ///< scale, origin, rotation vector, home
  std::optional<bool> is_valid;                       ///< none where memory did not suffice to look
  bool is_cut_short = false;
  std::exception_ptr failure; ///< what ended the run by an exception: the results are those so far
};

/// Reads the mesh, runs, and writes sculpted mesh, picture and rows. \param writer gets what people should know
/// Signals end it at once until the log is begun, and in order from then on.
/// \throw before the first tick what reading meshes and opening files throws; Unstable_coupling; Foreign_recording;
/// Usage_error; Foreign_log, Script_error
Run_result run_loop(const Plan& plan, examples::Result_writer& writer);

} // namespace haptic_sculpt::loop_program
