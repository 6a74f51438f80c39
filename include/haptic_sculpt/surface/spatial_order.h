// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef HAPTIC_SCULPT_SURFACE_SPATIAL_ORDER_H
#define HAPTIC_SCULPT_SURFACE_SPATIAL_ORDER_H

#include <haptic_sculpt/surface/face_box.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

namespace haptic_sculpt {
namespace internal {

/// Puts two zero bits before each of the lowest 21 bits.
inline std::uint64_t spread_bits(std::uint64_t x) {
  x &= 0x1fffff;
  x = (x | x << 32) & 0x1f00000000ffff;
  x = (x | x << 16) & 0x1f0000ff0000ff;
  x = (x | x << 8) & 0x100f00f00f00f00f;
  x = (x | x << 4) & 0x10c30c30c30c30c3;
  x = (x | x << 2) & 0x1249249249249249;
  return x;
}

/// The faces of a mesh along a Morton curve through the middles of their boxes. The order changes the speed of what is laid
/// out by it, never an answer, so it may be rounded.
template <class Mesh>
std::vector<std::uint32_t> faces_in_spatial_order(const Mesh& mesh) {
  Box_3 scene;
  for (const auto v : mesh.vertices())
    scene.include(vertex_coordinates(mesh, v));
  constexpr double cells = 0x1fffff;
  std::array<double, 3> scale;
  for (int i = 0; i < 3; ++i) {
    const double extent = scene.upper[i] / 2 - scene.lower[i] / 2;
    scale[i] = extent > 0 && std::isfinite(cells / extent) ? cells / extent : 0;
  }
  std::vector<std::pair<std::uint64_t, std::uint32_t>> order;
  order.reserve(mesh.number_of_faces());
  for (const auto f : mesh.faces()) {
    const Box_3 box = face_box(mesh, f);
    std::uint64_t code = 0;
    for (int i = 0; i < 3; ++i) {
      const double middle = box.lower[i] / 4 + box.upper[i] / 4 - scene.lower[i] / 2; // half of the way; never overflows
      const double cell = std::fmin(cells, std::fmax(0.0, middle * scale[i]));
      code |= spread_bits(static_cast<std::uint64_t>(cell)) << i;
    }
    order.emplace_back(code, static_cast<std::uint32_t>(f));
  }
  std::sort(order.begin(), order.end());
  std::vector<std::uint32_t> faces;
  faces.reserve(order.size());
  for (const auto& entry : order)
    faces.push_back(entry.second);
  return faces;
}

} // namespace internal
} // namespace haptic_sculpt

#endif
