// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Stroke_task.h"
#include "under_brush.h"

namespace haptic_sculpt::window_program {

/// A brush in the hand: a dab at each place, and where it is symmetric on the other sides, too.
class Brush_task : public Stroke_task {
public:
  Brush_task(const Pointer& press, const Brush& brush, const Pointed& spot) : Stroke_task(press, spot), brush_(brush) {}

private:
  static constexpr int dabs_a_remeshing = 6;

  Brush brush_;
  int dabs_ = 0;

  void begin(Scene& scene, Tool_type& tool, const Surface_hit<Mesh>& hit) override {
    if (brush_.use != Brush_use::grab)
      dab(scene, tool, dab_at(hit.point));
  }

  void work_at(const Pointer& pointer, Scene& scene, Tool_type& tool) override {
    if (brush_.use == Brush_use::grab) { // what is about the centre goes with the mouse
      const Eigen::Vector3d way = way_to(pointer);
      const double least = 1e-3; // of the radius: less is no motion of a hand
      if (way.stableNorm() < least * brush_.radius)
        return;
      dab(scene, tool,
          {Brush_kind::grab, point(place(centre_)), brush_.radius, way.stableNorm(),
           Kernel::Vector_3(way[0], way[1], way[2])});
      centre_ += way;
    } else if (const Hit hit = hit_of(scene, pointer)) {
      meet(scene, *hit);
      dab(scene, tool, dab_at(hit->point));
    }
  }

  Dab_3<Kernel> dab_at(const Kernel::Point_3& centre) const {
    const double share = brush_.use == Brush_use::inflate ? 0.03 * brush_.radius
                         : brush_.use == Brush_use::pinch ? 0.25
                                                          : 1.0;
    return {static_cast<Brush_kind>(brush_.use), centre, brush_.radius, share * brush_.strength};
  }

  void dab(Scene& scene, Tool_type& tool, const Dab_3<Kernel>& dab) {
    const auto dabs = with_mirrored(scene, dab, brush_.symmetry);
    if (brush_.use >= Brush_use::mask)
      return paint(scene, dabs);
    tool.edit_by([&](auto& edits) { return apply_brush(edits, dabs, share_left_free(scene)); });
    if (brush_.remeshes && ++dabs_ % dabs_a_remeshing == 0)
      remesh(scene, tool, faces_under(scene, dabs), brush_.edge_length(scene.edge_length), scene.times_broken_off);
  }

  /// A dab in the middle of a brush of half strength masks or unmasks all of it.
  void paint(Scene& scene, const std::vector<Dab_3<Kernel>>& dabs) const {
    const double sign = brush_.use == Brush_use::mask ? 2 : -2;
    for_each_touched(scene, dabs, [&](Vertex_index v, double square) {
      const double masked = scene.mask[v] + sign * brush_.strength * (1 - square) * (1 - square);
      scene.mask[v] = std::fmin(1, std::fmax(0, masked));
      scene.show_again(v);
    });
  }
};

} // namespace haptic_sculpt::window_program
