// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/surface/broad_phase/Box_node.h>
#include <haptic_sculpt/surface/broad_phase/Box_scale.h>
#include <haptic_sculpt/surface/broad_phase/face_box.h>

#include <algorithm>
#include <cstdint>
#include <vector>

namespace haptic_sculpt::internal {

/// A face and the middle of its box, rounded: an order changes the speed of what is laid out by it, never an answer.
struct Face_middle {
  std::array<float, 3> middle;
  std::uint32_t face;
};

/// Orders [begin, end) so that any `capacity` successive faces from `begin` on, and within them any capacity / 8, and
/// so on, are near each other: halves what is there across its longest extent, at a multiple of the capacity.
inline void order_in_space(Face_middle* begin, Face_middle* end, std::size_t capacity) {
  const std::size_t count = end - begin;
  if (count <= Box_node::width)
    return; // the order within a node does not matter
  while (capacity >= count)
    capacity /= Box_node::width;
  std::array<float, 3> lower = begin->middle, upper = begin->middle;
  for (const Face_middle* f = begin; f != end; ++f)
    for (int i = 0; i < 3; ++i) {
      lower[i] = f->middle[i] < lower[i] ? f->middle[i] : lower[i];
      upper[i] = f->middle[i] > upper[i] ? f->middle[i] : upper[i];
    }
  int axis = 0;
  for (int i = 1; i < 3; ++i)
    axis = upper[i] - lower[i] > upper[axis] - lower[axis] ? i : axis;
  const std::size_t children = (count + capacity - 1) / capacity;
  Face_middle* const middle = begin + children / 2 * capacity;
  std::nth_element(begin, middle, end,
                   [axis](const Face_middle& a, const Face_middle& b) { return a.middle[axis] < b.middle[axis]; });
  order_in_space(begin, middle, capacity);
  order_in_space(middle, end, capacity);
}

/// Some faces of a mesh in such an order. Cost: n log n.
template <class Mesh, class Faces>
std::vector<Face_middle> faces_in_spatial_order(const Mesh& mesh, const Faces& given,
                                                const Box_scale& scale) {
  std::vector<Face_middle> faces;
  faces.reserve(given.size());
  for (const auto f : given) {
    const Box_3 box = face_box(mesh, f);
    Face_middle entry;
    for (int i = 0; i < 3; ++i)
      entry.middle[i] = static_cast<float>((box.lower[i] / 2 + box.upper[i] / 2) * scale.factor());
    entry.face = static_cast<std::uint32_t>(f);
    faces.push_back(entry);
  }
  std::size_t capacity = Box_node::width;
  while (capacity < faces.size())
    capacity *= Box_node::width;
  order_in_space(faces.data(), faces.data() + faces.size(), capacity);
  return faces;
}

} // namespace haptic_sculpt::internal
