// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef HAPTIC_SCULPT_EXAMPLES_READ_MESH_H
#define HAPTIC_SCULPT_EXAMPLES_READ_MESH_H

#include "Arguments.h"
#include "Run_result.h"

#include <haptic_sculpt/surface/Validity_report.h>

namespace haptic_sculpt::sculpt_program {

/// Reads and repairs what a file holds; writes the report that was asked for, whatever comes of it. \param told receives
/// the steps, in words
/// \throw Read_error, Out_of_range; Read_error also for what cannot be repaired, with what is left; Write_error
Mesh read_repaired(const Arguments& arguments, std::vector<std::string>& left_out, std::string& told);

/// Reads a surface whose faces may have more than three corners, and divides these into triangles by CGAL: a face's
/// vertices stay, no vertex is added. \param left_out receives what the file has and a mesh has not, \param found what validate() says of the result
/// \throw Read_error, Out_of_range; Invalid_surface for other faults, before or after it was divided
Mesh read_triangulated(const std::string& path, double delta, std::vector<std::string>& left_out, Validity_report& found);

} // namespace haptic_sculpt::sculpt_program

#endif
