// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/sculpting/many_vertices/Input_surface.h>

#include <optional>

namespace haptic_sculpt::internal {

/// Projects onto the faces as they were at first, each vertex onto those of its patch, or nowhere.
template <class Mesh>
class Projection_onto_input {
public:
  using Vertex_index = typename Mesh::Vertex_index;
  using Face_index = typename Mesh::Face_index;

  template <class Patches>
  Projection_onto_input(const Mesh& mesh, const Scaled_points<Mesh>& points, std::vector<Face_index> faces,
                        const Patches& patches, bool is_on) {
    if (!is_on)
      return;
    std::stable_sort(faces.begin(), faces.end(),
                     [&](Face_index f, Face_index g) { return patches(f) < patches(g); });
    surface_.emplace(mesh, points, faces, patches);
    near_.assign(mesh.num_vertices(), 0);
    typename Input_surface<Mesh>::Place place = 0;
    for (const Face_index f : faces) {
      for (const Vertex_index v : corners_of_face(mesh, f))
        near_[static_cast<std::size_t>(v)] = place;
      ++place;
    }
  }

  /// \param p and what comes out in the unit of the points
  Coordinates operator()(Vertex_index v, const Coordinates& p, std::size_t patch) {
    return surface_ ? surface_->project(p, patch, near_[static_cast<std::size_t>(v)]) : p;
  }

  void created(Vertex_index v, Vertex_index beside) {
    if (!surface_)
      return;
    near_.resize(std::max(near_.size(), static_cast<std::size_t>(v) + 1), 0);
    near_[static_cast<std::size_t>(v)] = near_[static_cast<std::size_t>(beside)];
  }

private:
  std::optional<Input_surface<Mesh>> surface_;
  std::vector<typename Input_surface<Mesh>::Place> near_; ///< by vertex, where it was projected to last
};

/// The caller's: it is asked for a vertex, which has to be where it is to be projected from. So relaxation comes first,
/// in drags of its own.
template <class Mesh, class Function>
class Projection_by_function {
public:
  using Vertex_index = typename Mesh::Vertex_index;

  explicit Projection_by_function(const Function& function) : function_(&function) {}

  Coordinates operator()(Vertex_index, const Coordinates& p, std::size_t) const { return p; }
  /// Of the mesh, in no unit.
  Coordinates of_vertex(Vertex_index v) const { return coordinates((*function_)(v)); }
  void created(Vertex_index, Vertex_index) {}

private:
  const Function* function_;
};

template <class Projection>
struct Comes_after_relaxation : std::false_type {};
template <class Mesh, class Function>
struct Comes_after_relaxation<Projection_by_function<Mesh, Function>> : std::true_type {};

} // namespace haptic_sculpt::internal
