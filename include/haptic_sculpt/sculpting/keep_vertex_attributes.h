// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/sculpting/Property_origin.h>
#include <haptic_sculpt/surface/vertex_attributes.h>

namespace haptic_sculpt {

/// Keeps what the file of a mesh had for each vertex, such as colours, through all edits from now on: a new vertex gets
/// the weighted mean of what it comes from. \param sculptor of a mesh. Cost: that of Sculptor::keep() for each of them
template <class Sculptor>
void keep_vertex_attributes(Sculptor& sculptor) {
  for (const auto& attribute : vertex_attributes(sculptor.mesh()))
    sculptor.keep(attribute.map, Interpolate_property());
}

} // namespace haptic_sculpt
