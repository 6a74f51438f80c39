// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <fuzz/Choices.h>
#include <meshes/generated_meshes.h>

namespace haptic_sculpt::fuzz {

/// A mesh of 4 to 48 faces with something to run into.
inline meshes::Triangle_list tiny_list(Choices& choices) {
  auto list = meshes::tetrahedron(), second = meshes::tetrahedron();
  switch (choices.below(9)) {
  case 0:
    return list;
  case 1:
    return meshes::cube();
  case 2:
    return meshes::box(2, 2); // coplanar faces
  case 3:                     // one in a cavity
    list = meshes::tetrahedron(4);
    return list += second.scale_and_move(0.5, 0.25, 0.25, 0.25).turn_inside_out();
  case 4: // two that touch nearly: a face and an edge
    return list += second.scale_and_move(1, 0x1p-50, 0x1p-50, -1 - 0x1p-40);
  case 5: // two apices that touch nearly
    return meshes::nearly_pinched(std::ldexp(1.0, -static_cast<int>(choices.below(53))));
  case 6: // a slab an ulp of its coordinates thick
    return meshes::sliver_stack(1 + choices.below(2), 0x1p-52).scale_and_move(1, 0, 0, 1);
  case 7:
    return meshes::bipyramid(3 + choices.below(14));
  default: // a row, coplanar bottoms
    for (int i = 1; i <= 2; ++i) {
      second = meshes::tetrahedron();
      list += second.scale_and_move(1, 1.25 * i, 0, 0);
    }
    return list;
  }
}

/// 1 half of the time, else a power of two from the least to the largest by which a tiny mesh can be multiplied.
inline double unit_length(Choices& choices) {
  return choices.flag() ? 1 : std::ldexp(1.0, static_cast<int>(choices.integer<std::uint16_t>() % 2072) - 1074);
}

} // namespace haptic_sculpt::fuzz
