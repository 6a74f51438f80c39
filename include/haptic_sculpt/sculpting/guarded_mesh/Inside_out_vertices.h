// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/surface/validate.h>

#include <algorithm>
#include <vector>

namespace haptic_sculpt::internal {

/// Which vertices are of components whose normals point into the solid. Looked at when first asked for. No motion under
/// the guard turns a component over, and no edit either, so it has to be looked at again after edits only where
/// components differ: indices are used again.
template <class Mesh>
class Inside_out_vertices {
public:
  using Vertex_index = typename Mesh::Vertex_index;

  explicit Inside_out_vertices(const Mesh& mesh) : mesh_(&mesh) {}

  /// \pre the mesh is embedded, arithmetic rounds to nearest. Cost: constant, or n log n where it has to be looked at.
  bool contain(Vertex_index v) {
    if (state_ == State::unknown)
      look();
    return state_ == State::some ? contained_[static_cast<std::size_t>(v)] : state_ == State::all;
  }

  /// Vertices have come or gone.
  void forget() {
    if (state_ == State::some)
      state_ = State::unknown;
  }

  /// Bytes held, capacity included.
  std::size_t memory() const { return contained_.capacity() / 8; }

private:
  enum class State { unknown, none, some, all };

  const Mesh* mesh_;
  State state_ = State::unknown;
  std::vector<bool> contained_;

  void look() {
    const Face_soup soup = face_soup(*mesh_);
    const std::vector<bool> turned = Component_orientation(soup).faces_inside_out();
    const auto number = static_cast<std::size_t>(std::count(turned.begin(), turned.end(), true));
    if (number == 0 || number == turned.size()) {
      state_ = number == 0 ? State::none : State::all;
      return;
    }
    std::vector<bool> contained(soup.points.size(), false);
    for (std::size_t f = 0; f < turned.size(); ++f)
      for (const auto* corner = soup.begin(f); corner != soup.end(f); ++corner)
        contained[*corner] = turned[f];
    contained_.swap(contained);
    state_ = State::some; // last: memory may have run out
  }
};

} // namespace haptic_sculpt::internal
