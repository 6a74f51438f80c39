// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "sculpting/Random_scene.h"

#include "oracle/embedding_oracle.h"

namespace haptic_sculpt::test {

/// The same mesh as the independent decision of embedding takes it.
inline oracle::Mesh_list to_oracle(const meshes::Triangle_list& list) {
  oracle::Mesh_list result;
  for (const Point_3& p : list.points)
    result.points.push_back({p.x(), p.y(), p.z()});
  for (const auto& f : list.faces)
    result.faces.push_back({static_cast<int>(f[0]), static_cast<int>(f[1]), static_cast<int>(f[2])});
  return result;
}

} // namespace haptic_sculpt::test
