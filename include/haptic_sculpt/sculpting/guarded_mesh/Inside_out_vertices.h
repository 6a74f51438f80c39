// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/surface/validate.h>

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
    const auto first = std::find(turned.begin(), turned.end(), !turned.front());
    state_ = first != turned.end() ? State::some : turned.front() ? State::all : State::none;
    if (state_ != State::some)
      return;
    contained_.assign(soup.points.size(), false);
    for (std::size_t f = 0; f < turned.size(); ++f)
      for (const auto* corner = soup.begin(f); corner != soup.end(f); ++corner)
        contained_[*corner] = turned[f];
  }
};

} // namespace haptic_sculpt::internal
