// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef HAPTIC_SCULPT_EXAMPLES_WINDOW_MODEL_H
#define HAPTIC_SCULPT_EXAMPLES_WINDOW_MODEL_H

#include "Mouse.h"

#include "../drawing/surface_mesh_arrays.h"
#include "../haptic_loop/Run_log.h"

#include <haptic_sculpt/haptic_rendering/exchange/Loop_scene.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <memory>

namespace haptic_sculpt::window_program {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;
using Vertex_index = Mesh::Vertex_index;
using Face_index = Mesh::Face_index;

/// Which faces have changed since the window heard, each once, in the order in which they changed first.
class Dirty_faces {
public:
  void mark(std::size_t face) {
    if (face >= is_dirty_.size())
      is_dirty_.resize(face + 1, false);
    if (is_dirty_[face])
      return;
    is_dirty_[face] = true;
    waiting_.push_back(static_cast<std::uint32_t>(face));
  }
  std::size_t size() const { return waiting_.size() - next_; }
  std::uint32_t front() const { return waiting_[next_]; }
  void pop() {
    is_dirty_[waiting_[next_++]] = false;
    if (next_ == waiting_.size())
      waiting_.clear(), next_ = 0;
  }
  void clear() { is_dirty_.clear(), waiting_.clear(), next_ = 0; }

private:
  std::vector<bool> is_dirty_;
  std::vector<std::uint32_t> waiting_;
  std::size_t next_ = 0;
};

/// What the Sculptor tells besides what copies need: faces become dirty, ticks that change something are counted.
struct Face_watch : Scene_teller<Mesh> {
  Dirty_faces dirty;
  std::uint64_t edits = 0; ///< ticks that changed the mesh

  explicit Face_watch(const Mesh& mesh) : Scene_teller<Mesh>(mesh), mesh_(&mesh) {}

  void end_tick() { edits += std::exchange(has_changed_, false); }
  /// What was changed so far is known.
  void forget() { dirty.clear(), edits = 0, has_changed_ = false; }

  void vertex_moved(Vertex_index v) {
    Scene_teller<Mesh>::vertex_moved(v);
    for (const Face_index f : mesh_->faces_around_target(mesh_->halfedge(v)))
      mark(f);
  }
  void face_dies(Face_index f) {
    Scene_teller<Mesh>::face_dies(f);
    mark(f);
  }
  void face_created(Face_index f) {
    Scene_teller<Mesh>::face_created(f);
    mark(f);
  }

private:
  const Mesh* mesh_;
  bool has_changed_ = false;

  void mark(Face_index f) {
    dirty.mark(f);
    has_changed_ = true;
  }
};

using Scene = Loop_scene<Mesh, Face_watch>;

/// A mesh, its Sculptor and its log. Made by a thread that may take its time, then the loop's alone.
struct Model : Scene {
  /// Where a brush wants the vertices of a dab.
  using Targets = Mesh::Property_map<Vertex_index, Kernel::Point_3>;

  std::string path;
  std::string log_path; ///< empty: there is none
  loop_program::Run_log log;
  std::size_t resumed = 0; ///< edits of the log that were there
  std::string note;        ///< for people: what of the log was not made again
  Targets targets = mesh.add_property_map<Vertex_index, Kernel::Point_3>("v:target_of_brush").first;

  /// \throw what reading meshes and logs throws
  Model(const std::string& path, const std::string& log);

  Face_change face(std::uint32_t index) const {
    Face_change change;
    change.index = index;
    const Face_index f(index);
    change.is_there = index < mesh.num_faces() && !mesh.is_removed(f);
    if (!change.is_there)
      return change;
    auto h = mesh.halfedge(f);
    for (Place& corner : change.corners) {
      const auto& p = mesh.point(mesh.source(h));
      corner = {p.x(), p.y(), p.z()};
      h = mesh.next(h);
    }
    return change;
  }

  double extent() const { return (upper - lower).stableNorm(); }
};

} // namespace haptic_sculpt::window_program

#endif
