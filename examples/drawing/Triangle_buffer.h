// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "mark_triangles.h"

namespace haptic_sculpt::drawing {

/// Triangles in the memory of the graphics card, three corners each, and shared by none: so a triangle is changed
/// alone.
///
/// \pre of all functions: the OpenGL context is current in which `create()` was called
class Triangle_buffer {
public:
  void create();
  void destroy();

  /// Replaces all. \throw Picture_error if there is no memory, or more than can be drawn at once: all is as it was then
  void set(const std::vector<Corner>& corners);
  /// Room for this many triangles; those that are there stay, new ones have no area. Cost: that of copying what is
  /// there within the card. \throw as set()
  void resize(std::size_t triangles);
  /// Replaces triangles from `first` on. \pre they are there
  void write(std::size_t first, const Corner* corners, std::size_t triangles);

  std::size_t size() const { return size_ / 3; }
  void draw() const;

private:
  unsigned vertex_array_ = 0, buffer_ = 0;
  std::size_t size_ = 0; ///< corners

  void allocate(const Corner* corners, std::size_t given, std::size_t size);
  unsigned replace(const Corner* corners, std::size_t given, std::size_t size);
  void lay_out() const;
};

} // namespace haptic_sculpt::drawing
