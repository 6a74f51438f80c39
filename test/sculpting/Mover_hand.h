// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "sculpting/scene_parts.h"

#include <haptic_sculpt/sculpting.h>

namespace haptic_sculpt::test {

/// Drags what a scene is about: a vertex, or a probe that begins where the scene has a vertex without faces.
class Mover_hand {
  Mesh surface_;
  Vertex_index moved_;

public:
  Mover_hand(const Mesh& scene, Vertex_index moved, const Sculptor_parameters& options)
      : surface_(without_probes(scene)), moved_(moved), mesh(scene), sculptor(surface_, options) {
    if (scene.is_isolated(moved))
      probe_.emplace(sculptor.probe(scene.point(moved), Probe_start::anywhere));
    else
      grab_.emplace(sculptor.grab(moved));
  }

  Mesh mesh; ///< the scene as it is now, for oracles: with the vertex without faces where the probe is
  Sculptor<Mesh> sculptor;

  const Mesh& surface() const { return surface_; }
  Drag_result<Mesh> drag_to(const Point_3& target) {
    std::vector<Point_3> path;
    return drag_to(target, path);
  }
  Drag_result<Mesh> drag_to(const Point_3& target, std::vector<Point_3>& path) {
    const auto result = probe_ ? probe_->drag_to(target, path) : grab_->drag_to(target, path);
    mesh.point(moved_) = result.position;
    return result;
  }
  /// The next drag begins without contacts.
  void release() { sculptor.release(); }

private:
  std::optional<Probe<Sculptor<Mesh>>> probe_;
  std::optional<Grab<Sculptor<Mesh>>> grab_;
};

} // namespace haptic_sculpt::test
