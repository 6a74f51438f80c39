// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Stroke_task.h"

#include "../common/carry_out_line.h"

namespace haptic_sculpt::window_program {

/// An object in the hand: what is connected to where the mouse pointed goes with it, as far as nothing is in its way.
class Object_task : public Stroke_task {
public:
  using Stroke_task::Stroke_task;

private:
  std::vector<Vertex_index> object_;

  void begin(Scene& scene, Tool_type&, const Surface_hit<Mesh>& hit) override {
    object_ = examples::component_of(scene.mesh, scene.mesh.source(scene.mesh.halfedge(hit.face)));
  }

  void work_at(const Pointer& pointer, Scene&, Tool_type& tool) override {
    const Eigen::Vector3d way = way_to(pointer);
    if (way.isZero(0))
      return;
    const auto report = tool.edit_by([&](auto& edits) {
      return move_rigidly(
          edits, object_,
          CGAL::Aff_transformation_3<Kernel>(CGAL::TRANSLATION, Kernel::Vector_3(way[0], way[1], way[2])));
    });
    centre_ += report.share * way;
  }
};

} // namespace haptic_sculpt::window_program
