// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef HAPTIC_SCULPT_EXAMPLES_READ_MESH_H
#define HAPTIC_SCULPT_EXAMPLES_READ_MESH_H

#include "Run_result.h"

namespace haptic_sculpt::sculpt_program {

/// Reads a surface whose faces may have more than three corners, and divides these into triangles: a face's vertices
/// stay, no vertex is added, and a polygon that folds over itself is refused. \param left_out receives what the file has and a mesh has not
/// \throw Read_error, Out_of_range; Invalid_surface for other faults, before or after it was divided
Mesh read_triangulated(const std::string& path, double delta, std::vector<std::string>& left_out);

} // namespace haptic_sculpt::sculpt_program

#endif
