// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/surface/validate.h>

#include <meshes/generated_meshes.h>

namespace haptic_sculpt::test {

inline Face_soup soup_of(const meshes::Triangle_list& list) {
  Face_soup soup;
  soup.points = list.points;
  for (const auto& f : list.faces)
    soup.add_face(f);
  return soup;
}

} // namespace haptic_sculpt::test
