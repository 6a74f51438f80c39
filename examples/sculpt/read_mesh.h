// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Arguments.h"
#include "Run_result.h"

#include "../common/Mesh_file.h"
#include "../common/Result_writer.h"

#include <haptic_sculpt/surface/Validity_report.h>

#include <string>
#include <vector>

namespace haptic_sculpt::sculpt_program {

/// What a file holds, as it is sculpted.
struct Sculpted_mesh {
  Mesh mesh;
  std::vector<std::string> left_out; ///< what the file has and a mesh has not
  Validity_report found;             ///< what validate() says of it
  bool is_changed = false;           ///< other points or faces than those of the file
  std::string repair_report;         ///< JSON; empty where nothing was repaired
};

/// Reads a surface. With `--triangulate` its faces may have more than three corners, and these are divided into
/// triangles: a face's vertices stay, no vertex is added, and a polygon that folds over itself is refused. Where it is
/// refused, write_refusal() is called first.
/// \throw Read_error, Out_of_range; Invalid_surface for faults, before or after it was divided
Sculpted_mesh read_mesh(const examples::Mesh_file& file, const Arguments& arguments);

/// Writes the one that was asked for, if any. \pre the mesh was repaired
void write_repair_report(const Arguments& arguments, examples::Result_writer& writer, const Sculpted_mesh& read);

/// Reads what a file holds and repairs it; writes the report that was asked for where it cannot be.
/// \param told receives the steps, in words
/// \throw Read_error, Out_of_range; Read_error also for what cannot be repaired, with what is left
Sculpted_mesh read_repaired(const examples::Mesh_file& file, const Arguments& arguments,
                            examples::Result_writer& writer, std::string& told);

} // namespace haptic_sculpt::sculpt_program
