// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

/// \file
/// Which meshes are the same to the bit. In the namespace of the suite, for others have helpers of these names, too.

#include <haptic_sculpt/surface/validate.h>

#include <meshes/generated_meshes.h>

#include <array>
#include <cstdint>
#include <cstring>
#include <vector>

namespace reading_and_writing {

using haptic_sculpt::face_soup;
using haptic_sculpt::Face_soup;
using meshes::Mesh;
using V = Mesh::Vertex_index;
using F = Mesh::Face_index;

inline std::vector<std::array<std::uint64_t, 3>> bits(const std::vector<meshes::Point_3>& points) {
  std::vector<std::array<std::uint64_t, 3>> found;
  for (const auto& p : points) {
    const double x[3] = {p.x(), p.y(), p.z()};
    std::memcpy(found.emplace_back().data(), x, sizeof x);
  }
  return found;
}

/// Same points to the bit and same faces, in the same order, each from the same corner on.
inline bool identical(const Face_soup& a, const Face_soup& b) {
  return bits(a.points) == bits(b.points) && a.corners == b.corners && a.first_corner == b.first_corner;
}
inline bool identical(const Mesh& a, const Mesh& b) {
  return identical(face_soup(a), face_soup(b));
}

} // namespace reading_and_writing
