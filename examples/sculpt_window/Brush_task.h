// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef HAPTIC_SCULPT_EXAMPLES_WINDOW_BRUSH_TASK_H
#define HAPTIC_SCULPT_EXAMPLES_WINDOW_BRUSH_TASK_H

#include "Tasks.h"

namespace haptic_sculpt::window_program {

/// A brush in the hand: dab after dab as long as the button is down, each in parts that a tick has time for, the
/// vertices of a part all at once; all of it one step of undo.
class Brush_task : public Press_task {
public:
  /// Vertices that are moved in a tick: some microseconds each where the way is free.
  static constexpr std::size_t vertices_a_tick = 128;
  /// Ticks from the begin of a dab to the next at least: some 60 a second.
  static constexpr int ticks_a_dab = 16;

  /// \param centre where it is until the first dab
  Brush_task(const Mouse_reading& press, const Brush& brush, const Place& centre, const Mouse_reading& now)
      : Press_task(press, now), brush_(brush) {
    told_centre_.put(centre);
  }

  /// \name While it is under way, for the window's thread
  ///@{
  void end() { ends_ = true; }                         ///< the button is released: the rest of a dab is not made
  std::size_t left() const { return left_; }           ///< vertices of the dab under way
  const Place& centre() { return told_centre_.get(); } ///< of the dab under way
  ///@}

private:
  Brush brush_;
  std::atomic<bool> ends_{false};
  std::atomic<std::size_t> left_{0};
  Latest<Place> told_centre_;
  bool has_begun_ = false;
  Eigen::Vector3d centre_ = Eigen::Vector3d::Zero();
  std::vector<Vertex_index> vertices_;
  std::size_t next_ = 0;
  int wait_ = 0;

  bool work(Scene& scene, Tool_type& tool) override {
    if (!has_begun_) {
      if (!is_at_home())
        return false;
      const Hit hit = hit_of(scene, pointer_);
      if (!hit)
        return refuse("there is nothing to take hold of: point at the surface");
      centre_ = drawing::to_eigen(hit->point);
      tool.begin_stroke();
      has_begun_ = true;
    }
    if (ends_) {
      tool.let_go();
      return true;
    }
    --wait_;
    if (next_ < vertices_.size())
      move_some(scene, tool);
    else if (wait_ <= 0)
      begin_dab(scene);
    left_ = vertices_.size() - next_;
    told_centre_.put(place(centre_));
    return false;
  }

  static Model::Targets& targets(Scene& scene) { return static_cast<Model&>(scene).targets; }

  void move_some(Scene& scene, Tool_type& tool) {
    const std::size_t size = std::min(vertices_a_tick, vertices_.size() - next_);
    const auto first = vertices_.begin() + static_cast<std::ptrdiff_t>(next_);
    tool.move_many(CGAL::make_range(first, first + static_cast<std::ptrdiff_t>(size)), targets(scene));
    next_ += size;
  }

  void begin_dab(Scene& scene) {
    const Pointer& pointer = pointer_now();
    if (brush_.kind == Brush_kind::grab) { // what is about the centre goes with the mouse
      const Eigen::Vector3d way = on_plane(pointer, centre_) - centre_;
      const double least = 1e-3; // of the radius: less is no motion of a hand
      if (way.stableNorm() < least * brush_.radius)
        return;
      find({Brush_kind::grab, Kernel::Point_3(centre_[0], centre_[1], centre_[2]), brush_.radius, way.stableNorm(),
            Kernel::Vector_3(way[0], way[1], way[2])},
           scene);
      centre_ += way;
    } else if (const Hit hit = hit_of(scene, pointer)) {
      centre_ = drawing::to_eigen(hit->point);
      const double share = brush_.kind == Brush_kind::inflate ? 0.03 * brush_.radius
                           : brush_.kind == Brush_kind::pinch ? 0.25
                                                              : 1.0;
      find({brush_.kind, hit->point, brush_.radius, share * brush_.strength}, scene);
    }
  }

  /// The vertices that a dab touches, and where it wants them.
  void find(const Dab_3<Kernel>& dab, Scene& scene) {
    wait_ = ticks_a_dab;
    next_ = 0;
    vertices_.clear();
    const Vertex_index nearest = scene.sculptor.nearest_vertex(dab.centre, dab.radius);
    if (!nearest.is_valid())
      return;
    vertices_ = touched_vertices(scene.mesh, dab, nearest);
    fill_brush_targets(vertices_, scene.mesh, dab, targets(scene),
                             boost::static_property_map<double, Vertex_index>(1.0));
  }
};

} // namespace haptic_sculpt::window_program

#endif
