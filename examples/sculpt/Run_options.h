// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef HAPTIC_SCULPT_EXAMPLES_RUN_OPTIONS_H
#define HAPTIC_SCULPT_EXAMPLES_RUN_OPTIONS_H

#include "Script.h"

#include <haptic_sculpt/sculpting.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <nlohmann/json.hpp>

#include <Eigen/Core>

#include <functional>

namespace haptic_sculpt::sculpt_program {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;
using Vertex_index = Mesh::Vertex_index;

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
  std::vector<Vertex_index> moved_vertices;  ///< those that are still there
  std::vector<Validity_report::Vertex_index> vertex_order; ///< by number, dead ones left out
  std::vector<double> nanoseconds; ///< of each edit
  Filter_counters filter;
};

/// Called after a command has been carried out.
using After_command = std::function<void(const Command&)>;

/// Carries out a script on a mesh. \throw Invalid_surface, Invalid_parameter, and what `after` throws
template <class Broad_phase>
Run_result run_script(Mesh& mesh, const std::vector<Command>& script, const Sculptor_parameters& parameters,
                      const After_command& after);

} // namespace haptic_sculpt::sculpt_program

#endif
