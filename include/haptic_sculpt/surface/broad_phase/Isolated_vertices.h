// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef HAPTIC_SCULPT_SURFACE_ISOLATED_VERTICES_H
#define HAPTIC_SCULPT_SURFACE_ISOLATED_VERTICES_H

#include <haptic_sculpt/surface/broad_phase/Box_scale.h>
#include <haptic_sculpt/surface/broad_phase/Growing_box_tree.h>
#include <haptic_sculpt/surface/vertex_coordinates.h>

namespace haptic_sculpt {
namespace internal {

/// The vertices without faces, probes, which no face may pass over: a broad phase of their own, beside that of the
/// faces.
///
/// They neither come nor go while the mesh is guarded; they move. Mostly there are none, or one. Cost: a query log n
/// plus its answer, a move log n.
template <class Mesh>
class Isolated_vertices {
public:
  using Vertex_index = typename Mesh::Vertex_index;

  explicit Isolated_vertices(const Mesh& mesh) : mesh_(&mesh) {
    for (const Vertex_index v : mesh.vertices())
      if (mesh.is_isolated(v))
        vertices_.push_back(v);
    if (is_empty())
      return;
    scale_ = Box_scale::of(mesh);
    places_.resize(vertices_.size());
    for (std::uint32_t i = 0; i < vertices_.size(); ++i)
      tree_.insert(i, box(i), [this](std::uint32_t item, std::uint32_t place) { places_[item] = place; });
    tree_.reserve(0); // queries allocate nothing
  }

  bool is_empty() const { return vertices_.empty(); }

  /// In the order of their indices.
  const std::vector<Vertex_index>& all() const { return vertices_; }

  /// v has moved. Nothing where it has faces.
  void moved(Vertex_index v) {
    const auto found = std::lower_bound(vertices_.begin(), vertices_.end(), v);
    if (found == vertices_.end() || *found != v)
      return;
    const auto i = static_cast<std::uint32_t>(found - vertices_.begin());
    tree_.set(places_[i], box(i));
  }

  /// Appends those in a closed box, in the order of their indices. Exact.
  void query(const Box_3& region, std::vector<Vertex_index>& found) {
    if (is_empty())
      return;
    const std::size_t first = found.size();
    const Float_box around = scale_.query(region);
    tree_.visit([&around](const Box_node& node) { return node.meeting(around); },
                [&](std::uint32_t i) {
                  if (contains(region, vertex_coordinates(*mesh_, vertices_[i])))
                    found.push_back(vertices_[i]);
                });
    std::sort(found.begin() + static_cast<std::ptrdiff_t>(first), found.end());
  }

  /// Bytes held, capacity included.
  std::size_t memory() const {
    return vertices_.capacity() * sizeof(Vertex_index) + places_.capacity() * sizeof(std::uint32_t) + tree_.memory();
  }

private:
  const Mesh* mesh_;
  Box_scale scale_;
  std::vector<Vertex_index> vertices_;
  std::vector<std::uint32_t> places_; ///< in the tree
  Growing_box_tree tree_;

  Float_box box(std::uint32_t i) const { return scale_.around(Box_3(vertex_coordinates(*mesh_, vertices_[i]))); }
};

} // namespace internal
} // namespace haptic_sculpt

#endif
