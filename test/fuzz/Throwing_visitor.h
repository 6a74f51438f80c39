// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>

namespace haptic_sculpt::fuzz {

/// What a visitor or a progress function throws.
struct Thrown {};

/// Throws in the call that makes `*left` 0; never where it is 0 already.
struct Throwing_visitor {
  std::size_t* left;

  template <class... Arguments>
  void told(const Arguments&...) {
    if (*left != 0 && --*left == 0)
      throw Thrown();
  }
  template <class Vertex>
  void vertex_moved(Vertex v) {
    told(v);
  }
  template <class Vertex>
  void vertex_dies(Vertex v, std::size_t number) {
    told(v, number);
  }
  template <class Edge>
  void edge_dies(Edge e) {
    told(e);
  }
  template <class Face>
  void face_dies(Face f) {
    told(f);
  }
  template <class Vertex>
  void vertex_created(Vertex v, std::size_t number) {
    told(v, number);
  }
  template <class Edge>
  void edge_created(Edge e) {
    told(e);
  }
  template <class Face>
  void face_created(Face f) {
    told(f);
  }
};

} // namespace haptic_sculpt::fuzz
