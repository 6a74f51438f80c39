// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/sculpting/Sculptor.h>

#include <memory>

namespace haptic_sculpt {

/// For CGAL's named parameter `allow_move_functor`: allows those moves to which there is a free way, and makes them.
///
/// CGAL asks after it has written the new point into the mesh; if the answer is no, it writes another one and asks
/// again, and what it leaves at last it has either asked about or it is the old point. So this puts the old point back,
/// lets the Sculptor move the vertex, which sees nothing of what went on, and answers whether it did. It works with the
/// mesh's own point map only; with a guarded_point_map() nothing needs to be asked.
template <class Sculptor>
class Allow_embedded_move {
public:
  using Mesh = typename Sculptor::Mesh_type;        ///< the one that is guarded
  using Point = typename Mesh::Point;               ///< with double coordinates
  using Vertex_index = typename Mesh::Vertex_index; ///< of the mesh

  /// \param mesh the one that the Sculptor guards  \throw Invalid_parameter if it is another one
  Allow_embedded_move(Sculptor& sculptor, Mesh& mesh)
      : sculptor_(&sculptor), mesh_(&mesh), refused_(std::make_shared<std::size_t>(0)) {
    if (&mesh != &sculptor.mesh())
      throw Invalid_parameter("Allow_embedded_move: give the mesh that the Sculptor guards, not another one");
  }
  // No move, which would leave one that has no count: what is moved is copied.
  Allow_embedded_move(const Allow_embedded_move&) = default;            ///< which counts with it
  Allow_embedded_move& operator=(const Allow_embedded_move&) = default; ///< likewise

  /// A target that is not finite or out of range is refused, too. \throw Mesh_changed
  /// By value: CGAL passes a reference to the point in the mesh, which is put back here.
  bool operator()(Vertex_index v, Point source, Point target) const {
    mesh_->point(v) = source;
    const bool is_free = is_in_range(internal::coordinates(target)) && sculptor_->move_if_free(v, target);
    *refused_ += !is_free;
    return is_free;
  }

  /// How many moves were refused; copies count together.
  std::size_t refused() const { return *refused_; }

private:
  Sculptor* sculptor_;
  Mesh* mesh_;
  std::shared_ptr<std::size_t> refused_;
};

/// Makes one. \throw Invalid_parameter for a mesh that the Sculptor does not guard
template <class Sculptor>
Allow_embedded_move<Sculptor> allow_embedded_move(Sculptor& sculptor, typename Sculptor::Mesh_type& mesh) {
  return Allow_embedded_move<Sculptor>(sculptor, mesh);
}

} // namespace haptic_sculpt
