// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Arguments.h"

#include <haptic_sculpt/surface/Validity_report.h>
#include <haptic_sculpt/surface/validity/Face_soup.h>

namespace haptic_sculpt::sculpt_program {

/// Calls do_this(key, list) for each kind of fault, by its key in JSON.
template <class Function>
void for_each_kind_of_fault(const Validity_report& report, const Function& do_this) {
  do_this("non_finite_vertices", report.non_finite_vertices);
  do_this("non_triangular_faces", report.non_triangular_faces);
  do_this("degenerate_faces", report.degenerate_faces);
  do_this("low_faces", report.low_faces);
  do_this("boundary_edges", report.boundary_edges);
  do_this("non_manifold_edges", report.non_manifold_edges);
  do_this("inconsistently_oriented_edges", report.inconsistently_oriented_edges);
  do_this("non_manifold_vertices", report.non_manifold_vertices);
  do_this("coincident_vertices", report.coincident_vertices);
  do_this("intersecting_faces", report.intersecting_faces);
}

/// Of a mesh that was refused: writes every fault as JSON where `--report` asks for it, and draws them in red where
/// `--picture` does; tells on standard error what cannot be written. Keys: doc/use/report.md.
/// \param soup what was validated, whose points and faces the report names
void write_refusal(const Arguments& arguments, const Face_soup& soup, const Validity_report& report);

} // namespace haptic_sculpt::sculpt_program
