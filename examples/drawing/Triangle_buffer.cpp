// SPDX-License-Identifier: GPL-3.0-or-later
#include "Triangle_buffer.h"
#include <epoxy/gl.h>
#include <limits>
#include <utility>

namespace haptic_sculpt::drawing {

static_assert(sizeof(Corner) == 9 * sizeof(float), "a corner is nine floats without padding");

void Triangle_buffer::create() {
  glGenVertexArrays(1, &vertex_array_);
  glGenBuffers(1, &buffer_);
  lay_out();
}

void Triangle_buffer::lay_out() const {
  glBindVertexArray(vertex_array_);
  glBindBuffer(GL_ARRAY_BUFFER, buffer_);
  for (int i = 0; i < 3; ++i) { // position, normal, colour: three floats each
    glEnableVertexAttribArray(i);
    glVertexAttribPointer(i, 3, GL_FLOAT, GL_FALSE, sizeof(Corner),
                          reinterpret_cast<const void*>(i * 3 * sizeof(float)));
  }
}

void Triangle_buffer::allocate(const Corner* corners, std::size_t given, std::size_t size) {
  if (size > std::size_t(std::numeric_limits<int>::max()))
    throw Picture_error("There are " + std::to_string(size / 3) +
                        " triangles, more than OpenGL draws at once (715827882). Draw a part.");
  while (glGetError() != GL_NO_ERROR) { // so that an error found below is this call's own
  }
  glBindBuffer(GL_ARRAY_BUFFER, buffer_);
  glBufferData(GL_ARRAY_BUFFER, GLsizeiptr(size * sizeof(Corner)), given == size ? corners : nullptr,
               given == size ? GL_STATIC_DRAW : GL_DYNAMIC_DRAW);
  if (glGetError() != GL_NO_ERROR)
    throw Picture_error("The OpenGL driver has no memory for " + std::to_string(size / 3) +
                        " triangles. Draw a coarser mesh.");
  size_ = size;
}

/// \return the buffer before, to be deleted, which stays where there is no memory for both
unsigned Triangle_buffer::replace(const Corner* corners, std::size_t given, std::size_t size) {
  const unsigned old = std::exchange(buffer_, 0u);
  glGenBuffers(1, &buffer_);
  try {
    allocate(corners, given, size);
  } catch (...) {
    glDeleteBuffers(1, &buffer_);
    buffer_ = old;
    throw;
  }
  lay_out();
  return old;
}

void Triangle_buffer::set(const std::vector<Corner>& corners) {
  const unsigned old = replace(corners.data(), corners.size(), corners.size());
  glDeleteBuffers(1, &old);
}

void Triangle_buffer::resize(std::size_t triangles) {
  const std::size_t kept = std::min(size_, 3 * triangles);
  const std::vector<Corner> none(3 * triangles - kept, Corner{{0, 0, 0}, {0, 0, 1}, {0, 0, 0}});
  const unsigned old = replace(nullptr, 0, 3 * triangles);
  glBindBuffer(GL_COPY_READ_BUFFER, old);
  glCopyBufferSubData(GL_COPY_READ_BUFFER, GL_ARRAY_BUFFER, 0, 0, GLsizeiptr(kept * sizeof(Corner)));
  if (!none.empty())
    glBufferSubData(GL_ARRAY_BUFFER, GLintptr(kept * sizeof(Corner)), GLsizeiptr(none.size() * sizeof(Corner)),
                    none.data());
  glDeleteBuffers(1, &old);
}

void Triangle_buffer::write(std::size_t first, const Corner* corners, std::size_t triangles) {
  glBindBuffer(GL_ARRAY_BUFFER, buffer_);
  glBufferSubData(GL_ARRAY_BUFFER, GLintptr(3 * first * sizeof(Corner)), GLsizeiptr(3 * triangles * sizeof(Corner)),
                  corners);
}

void Triangle_buffer::draw() const {
  glBindVertexArray(vertex_array_);
  // Software fills the triangles of one part while this thread is at the corners of the next.
  const int size = int(size_), part = 3 * 25000;
  for (int first = 0; first < size; first += std::min(part, size - first)) {
    if (first > 0)
      glFlush();
    glDrawArrays(GL_TRIANGLES, first, std::min(part, size - first));
  }
}

void Triangle_buffer::destroy() {
  glDeleteBuffers(1, &buffer_);
  glDeleteVertexArrays(1, &vertex_array_);
}

} // namespace haptic_sculpt::drawing
