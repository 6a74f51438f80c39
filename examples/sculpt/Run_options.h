// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef HAPTIC_SCULPT_EXAMPLES_RUN_OPTIONS_H
#define HAPTIC_SCULPT_EXAMPLES_RUN_OPTIONS_H

#include "Script.h"

#include <haptic_sculpt/sculpting.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <nlohmann/json.hpp>

#include <Eigen/Core>

namespace haptic_sculpt::sculpt_program {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;

/// A drag that did not arrive, for the picture and the table.
struct Blocked_drag {
  std::size_t line;
  Eigen::Vector3d start, stop, target;
  std::string what;
  std::array<double, 3> normal;
};

/// What a script did.
struct Run_result {
  nlohmann::ordered_json edits = nlohmann::ordered_json::array();
  std::size_t reached = 0, blocked = 0, refused = 0;
  std::vector<Blocked_drag> blocked_drags;
  std::vector<std::size_t> moved_vertices;
  std::vector<double> nanoseconds; ///< of each edit
  Filter_counters filter;
};

/// Carries out a script on a mesh. \throw Invalid_surface, Invalid_parameter
template <class Broad_phase>
Run_result run_script(Mesh& mesh, const std::vector<Command>& script, const Sculptor_parameters& parameters);

} // namespace haptic_sculpt::sculpt_program

#endif
