// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "../common/run_program.h"

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace haptic_sculpt::sculpt_program {

using namespace examples;

/// How `--picture` shows the mesh.
struct Picture_arguments {
  std::vector<double> view; ///< the direction in which one looks; empty: the usual one
  std::string at;           ///< a vertex's number, @X,Y,Z, or "edit"; empty: the whole mesh
  double zoom = 0;          ///< 0: 1, or 8 where `at` is given
  std::string color;        ///< displacement, altitude, or empty
  bool before = false, numbers = false;
};

/// What `--repair` may do.
struct Repair_arguments {
  bool is_asked = false;
  std::string report;
  std::optional<double> gap;
  std::optional<std::size_t> largest_hole;
};

/// The command line. Names that were not given are empty.
struct Arguments {
  std::string mesh, script, out, report, log, response, broad_phase = "tree", picture, comparison;
  std::optional<double> clearance, delta;
  bool append = false, triangulate = false, orient = false;
  Repair_arguments repair;
  Picture_arguments shown;
  std::optional<std::array<double, 3>> nearest;
};

/// Reads the command line. Where the program is to end now, people have read why: by what they asked for (true:
/// `--help`,
/// `--version`), or by what is wrong (false).
std::optional<bool> read_arguments(int argc, char** argv, Arguments& arguments);

} // namespace haptic_sculpt::sculpt_program
