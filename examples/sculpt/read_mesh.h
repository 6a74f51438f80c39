// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Arguments.h"
#include "Run_result.h"

#include <haptic_sculpt/surface/Validity_report.h>

#include <string>
#include <vector>

namespace haptic_sculpt::sculpt_program {

/// Reads a surface. With `--triangulate` its faces may have more than three corners, and these are divided into
/// triangles: a face's vertices stay, no vertex is added, and a polygon that folds over itself is refused. Where it is
/// refused, write_refusal() is called first.
/// \param left_out receives what the file has and a mesh has not \param found receives what validate() says of the
/// result \throw Read_error, Out_of_range; Invalid_surface for faults, before or after it was divided
Mesh read_mesh(const Arguments& arguments, std::vector<std::string>& left_out, Validity_report& found);

/// Reads what a file holds and repairs it; writes the report that was asked for, whatever comes of it.
/// \param left_out receives what the file has and a mesh has not, \param told the steps, in words
/// \throw Read_error, Out_of_range; Read_error also for what cannot be repaired, with what is left; Write_error
Mesh read_repaired(const Arguments& arguments, std::vector<std::string>& left_out, std::string& told);

} // namespace haptic_sculpt::sculpt_program
