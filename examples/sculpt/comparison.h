// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Run_result.h"

#include <string>
#include <vector>

namespace haptic_sculpt::sculpt_program {

/// What a script makes of a mesh when every vertex goes where it is sent: without the guard.
/// \param name how messages call the script \throw Script_error for a line that does more than to move vertices
Mesh sculpted_without_guard(Mesh mesh, const std::vector<Command>& script, const std::string& name);

/// A picture of two meshes side by side, with the faces of self-intersecting pairs in red and their number below.
/// \param direction in which one looks; empty: the usual one
/// \return what of an old file could not be kept; empty if all was
/// \throw drawing::Picture_error
std::string write_comparison(const Mesh& without_guard, const Mesh& with_guard, const std::string& path,
                             const std::vector<double>& direction);

} // namespace haptic_sculpt::sculpt_program
