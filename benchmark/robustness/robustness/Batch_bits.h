// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "robustness_meshes.h"

#include <haptic_sculpt/sculpting.h>

#include <cstring>

namespace haptic_sculpt::robustness {

/// A number of 64 bits made of all that came of a batch, to the last bit: two batches that differ anywhere have the
/// same number with a chance of 2^-64 (FNV-1a, eight bytes a step).
class Batch_bits {
public:
  void add(std::uint64_t bits) { value_ = (value_ ^ bits) * 0x100000001b3u, value_ ^= value_ >> 32; }
  void add(double x) {
    std::uint64_t bits = 0;
    std::memcpy(&bits, &x, sizeof bits);
    add(bits);
  }
  void add(const Point_3& p) { add(p.x()), add(p.y()), add(p.z()); }

  void add(const Drag_result<Mesh>& result) {
    add(result.position);
    for (const double x : {result.stop_error, result.stop_error_along_path, result.kkt_residual})
      add(x);
    add(static_cast<std::uint64_t>(result.end)), add(static_cast<std::uint64_t>(result.legs));
    for (const auto& contact : result.contacts) {
      add(contact.normal.x()), add(contact.normal.y()), add(contact.normal.z());
      add(static_cast<std::uint64_t>(contact.kind));
      for (const Vertex_index v : contact.vertices)
        add(std::uint64_t{static_cast<Mesh::size_type>(v)});
    }
  }
  /// The points and faces of a mesh.
  void add(const Mesh& mesh) {
    for (const Vertex_index v : mesh.vertices())
      add(std::uint64_t{static_cast<Mesh::size_type>(v)}), add(mesh.point(v));
    for (const Face_index f : mesh.faces())
      for (const Vertex_index v : mesh.vertices_around_face(mesh.halfedge(f)))
        add(std::uint64_t{static_cast<Mesh::size_type>(v)});
  }

  std::uint64_t value() const { return value_; }

private:
  std::uint64_t value_ = 0xcbf29ce484222325u;
};

} // namespace haptic_sculpt::robustness
