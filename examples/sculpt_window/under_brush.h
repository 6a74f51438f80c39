// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Tasks.h"

#include <boost/property_map/function_property_map.hpp>

#include <algorithm>
#include <thread>

/// \file
/// What is under a brush, on all sides where it is symmetric; and remeshing of that, or of all.

namespace haptic_sculpt::window_program {

/// A dab and its mirror images, in planes through the middle of the mesh's box as it came.
inline std::vector<Dab_3<Kernel>> with_mirrored(const Scene& scene, const Dab_3<Kernel>& dab,
                                                const std::array<bool, 3>& symmetry) {
  const Eigen::Vector3d middle = 0.5 * scene.lower + 0.5 * scene.upper;
  std::vector<Dab_3<Kernel>> dabs{dab};
  for (int axis = 0; axis < 3; ++axis) {
    const Kernel::Plane_3 plane(Kernel::Point_3(middle[0], middle[1], middle[2]),
                                Kernel::Vector_3(axis == 0, axis == 1, axis == 2));
    for (std::size_t i = symmetry[std::size_t(axis)] ? dabs.size() : 0; i > 0; --i)
      dabs.push_back(mirrored(dabs[i - 1], plane));
  }
  return dabs;
}

/// Calls `function(v, square)` for the vertices that dabs touch, with how far each is from the centre, in radii,
/// squared; for each dab.
template <class Function>
void for_each_touched(Scene& scene, const std::vector<Dab_3<Kernel>>& dabs, const Function& function) {
  for (const auto& dab : dabs)
    if (const Vertex_index nearest = scene.sculptor.nearest_vertex(dab.centre, dab.radius); nearest.is_valid())
      for (const Vertex_index v : touched_vertices(scene.mesh, dab, nearest))
        function(v, dab.squared_share(scene.mesh.point(v)));
}

/// Faces of which a dab touches a corner, and those about the vertex nearest to its centre, which may be too large to
/// have any within the radius; each once.
inline std::vector<Face_index> faces_under(Scene& scene, const std::vector<Dab_3<Kernel>>& dabs) {
  std::vector<Face_index> faces;
  const auto add = [&](Vertex_index v, double) {
    for (const Face_index f : scene.mesh.faces_around_target(scene.mesh.halfedge(v)))
      faces.push_back(f);
  };
  for_each_touched(scene, dabs, add);
  for (const auto& dab : dabs)
    add(scene.sculptor.nearest_vertex(dab.centre, std::numeric_limits<double>::infinity()), 0);
  std::sort(faces.begin(), faces.end());
  faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
  return faces;
}

/// How much of a vertex takes part in what brushes do.
inline auto share_left_free(const Scene& scene) {
  return boost::make_function_property_map<Vertex_index>([&mask = scene.mask](Vertex_index v) {
    return std::fmin(1, std::fmax(0, 1 - mask[v])); // rounded where it was interpolated, a mask may be more than 1
  });
}

/// The edges between masked vertices, as a property map: what a remeshing makes is not among them.
struct Masked_edges {
  using key_type = Mesh::Edge_index;
  using value_type = bool;
  using reference = bool;
  using category = boost::read_write_property_map_tag;
  const Scene* scene;

  friend bool get(const Masked_edges& edges, key_type e) {
    const Mesh& mesh = edges.scene->mesh;
    return edges.scene->mask[mesh.vertex(e, 0)] > 0 && edges.scene->mask[mesh.vertex(e, 1)] > 0;
  }
  friend void put(const Masked_edges&, key_type, bool) {}
};

/// Remeshes faces to edges of about a length; masked vertices stay, and edges between them. Waits for the disk where
/// the log has no room. \param times_broken_off Scene's, when it was asked for \return false: it was broken off
/// \throw Invalid_parameter where it would be more triangles than can be worked with
inline bool remesh(Scene& scene, Loop_task<Scene>::Tool_type& tool, std::vector<Face_index> faces, double length,
                   unsigned times_broken_off) {
  constexpr std::size_t most_faces = 5000000;
  bool goes_on = true;
  const auto may_go_on = [&, journal = scene.log.journal()](const Remeshing_progress&) {
    const std::size_t room = 8 * Remeshing_parameters::operations_between_calls;
    const auto is_wanted = [&] { return !scene.ends && scene.times_broken_off == times_broken_off; };
    while (is_wanted() && journal != nullptr && journal->room() < room && !journal->has_overrun())
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    return goes_on = is_wanted();
  };
  const auto is_masked =
      boost::make_function_property_map<Vertex_index>([&mask = scene.mask](Vertex_index v) { return mask[v] > 0; });
  faces.erase(std::remove_if(faces.begin(), faces.end(), // each would be a patch of its own
                             [&](Face_index f) {
                               const auto corners = scene.mesh.vertices_around_face(scene.mesh.halfedge(f));
                               return std::all_of(corners.begin(), corners.end(),
                                                  [&](Vertex_index v) { return get(is_masked, v); });
                             }),
              faces.end());
  try {
    tool.edit_by([&](auto& edits) {
      return isotropic_remeshing(faces, edits, length,
                                 CGAL::parameters::number_of_iterations(2)
                                     .vertex_is_constrained_map(is_masked)
                                     .edge_is_constrained_map(Masked_edges{&scene})
                                     .protect_constraints(true),
                                 Remeshing_parameters().most_faces(most_faces).progress(may_go_on));
    });
  } catch (const Invalid_parameter&) {
    if (scene.mesh.number_of_faces() <= most_faces)
      throw;
    throw Invalid_parameter("the mesh has " + std::to_string(scene.mesh.number_of_faces()) + " triangles, and above " +
                            std::to_string(most_faces) +
                            " no new ones are made: remeshing can only make fewer, of a length that no edge exceeds");
  }
  return goes_on;
}

/// Remeshes what is under a brush, or all of the mesh.
class Remesh : public Window_task {
public:
  /// \param brush under it, where the mouse points; none: all \param length of edges; 0: as the brush needs them, of
  /// all as they were when the mesh came \param times_broken_off the scene's, now
  Remesh(const Pointer& pointer, const std::optional<Brush>& brush, double length, unsigned times_broken_off)
      : pointer_(pointer), brush_(brush), length_(length), times_broken_off_(times_broken_off) {}

private:
  Pointer pointer_;
  std::optional<Brush> brush_;
  double length_;
  unsigned times_broken_off_;

  bool work(Scene& scene, Tool_type& tool) override {
    tool.let_go();
    if (!brush_)
      return told(remesh(scene, tool, {scene.mesh.faces().begin(), scene.mesh.faces().end()},
                         length_ > 0 ? length_ : scene.edge_length, times_broken_off_));
    const Hit hit = hit_of(scene, pointer_);
    if (!hit)
      return refuse("there is nothing to remesh here: point at the surface");
    const Dab_3<Kernel> dab{Brush_kind::smooth, hit->point, brush_->radius, 0};
    return told(remesh(scene, tool, faces_under(scene, with_mirrored(scene, dab, brush_->symmetry)),
                       length_ > 0 ? length_ : brush_->edge_length(scene.edge_length), times_broken_off_));
  }
  bool told(bool is_whole) { return is_whole || refuse("remeshing was broken off: undo takes back what was done"); }
};

/// Nothing is masked any more.
class Unmask_all : public Window_task {
  bool work(Scene& scene, Tool_type& tool) override {
    tool.let_go();
    for (const Vertex_index v : scene.mesh.vertices())
      if (std::exchange(scene.mask[v], 0) > 0)
        scene.show_again(v);
    return true;
  }
};

} // namespace haptic_sculpt::window_program
