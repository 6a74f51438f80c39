// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <boost/container/small_vector.hpp>

#include <cstdint>
#include <optional>

namespace haptic_sculpt {

/// Which rule an edit would break.
enum class Refusal_reason : std::uint8_t {
  unknown_element,   ///< a face, edge or vertex that is not in the mesh, or was removed
  coincident_vertex, ///< a vertex may not be created where one stands already
  tetrahedron,       ///< nothing can be removed from a tetrahedron
  doubled_edge,      ///< the link condition: an edge or face of the result would be there twice
  delta,             ///< a triangle of the result would be degenerate, or have an altitude below delta
  blocked,           ///< the new surface would touch or cross another part, or jump over it
  nothing_to_undo,
  nothing_to_redo,
  no_stroke, ///< there is none to be ended
  too_near,  ///< a probe would be nearer to a face than the clearance, or on it
  inside    ///< a probe would be inside of a solid; no vertices are named
};

/// The name used in reports, e.g. "coincident-vertex".
inline const char* name_of(Refusal_reason reason) {
  constexpr const char* names[] = {"unknown-element", "coincident-vertex", "tetrahedron",     "doubled-edge",   "delta",
                                   "blocked",         "nothing-to-undo",   "nothing-to-redo", "no-stroke",
                                   "too-near",        "inside"};
  return names[static_cast<int>(reason)];
}

/// Why an edit was refused. The mesh is exactly as it was.
template <class Mesh>
struct Refusal {
  /// Like a std::vector; allocates nothing for up to four.
  using Elements = boost::container::small_vector<typename Mesh::Vertex_index, 4>;

  Refusal_reason reason; ///< the rule that would be broken
  Elements elements;     ///< the vertices that stand in the way
};

/// The outcome of an edit.
template <class Mesh>
struct Edit_result {
  /// Where it was done: a vertex that is in the mesh now, and that the edit has made, moved or given other faces. One
  /// of these for each edit: the new one; the neighbour into which another was drawn; an end of the edge that a flip
  /// has made; of a shift the one with the largest index; of undo and redo that of the change made last; of a move its
  /// own, also where it stayed. None where nothing was done: of a refused edit, and of strokes.
  std::optional<typename Mesh::Vertex_index> vertex;
  std::optional<Refusal<Mesh>> refusal; ///< none: the edit was done

  explicit operator bool() const { return !refusal; } ///< the edit was done

  /// One that was done; v becomes `vertex`
  static Edit_result done(typename Mesh::Vertex_index v) {
    return {v, std::nullopt};
  }
  /// One that was refused.
  static Edit_result refused(Refusal_reason reason, typename Refusal<Mesh>::Elements elements = {}) {
    return {std::nullopt, Refusal<Mesh>{reason, std::move(elements)}};
  }
};

} // namespace haptic_sculpt
