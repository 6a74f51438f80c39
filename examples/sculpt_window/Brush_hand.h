// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef HAPTIC_SCULPT_EXAMPLES_WINDOW_BRUSH_HAND_H
#define HAPTIC_SCULPT_EXAMPLES_WINDOW_BRUSH_HAND_H

#include "../brushes.h"
#include "Editor.h"

namespace haptic_sculpt::window_program {

/// A brush in the hand: dab after dab as long as the button is down, each in parts that a tick has time for.
class Brush_hand {
public:
  /// Vertices that are moved in a tick: some microseconds each where the way is free.
  static constexpr std::size_t vertices_a_tick = 48;
  /// Ticks from the begin of a dab to the next at least: some 60 a second.
  static constexpr int ticks_a_dab = 16;

  Brush_hand(Model& model, Editor& editor)
      : model_(&model)
      , editor_(&editor)
      , targets_(model.mesh.add_property_map<Vertex_index, Kernel::Point_3>("v:target_of_brush").first) {}

  void begin(const Brush& brush, const Eigen::Vector3d& centre) {
    end();
    brush_ = brush, centre_ = centre;
    wait_ = 0;
  }
  void end() { vertices_.clear(), next_ = 0; }

  bool is_under_way() const { return next_ < vertices_.size(); }
  std::size_t left() const { return vertices_.size() - next_; }
  /// To be asked once a tick.
  bool is_due() { return --wait_ <= 0; }
  bool follows_the_hand() const { return brush_.kind == Brush_kind::grab; }
  const Eigen::Vector3d& centre() const { return centre_; }

  /// The grab brush: what is about the centre goes with it.
  void pull_to(const Eigen::Vector3d& place) {
    const Eigen::Vector3d way = place - centre_;
    const double least = 1e-3; // of the radius: less is no motion of a hand
    if (way.norm() < least * brush_.radius)
      return;
    const auto direction = Kernel::Vector_3(way[0], way[1], way[2]);
    start({brushes::Kind::grab, internal::point_of<Kernel::Point_3>(centre_), brush_.radius, way.norm(), direction});
    centre_ = place;
  }
  /// The others: what is about `place`.
  void dab(const Eigen::Vector3d& place) {
    centre_ = place;
    const double share = brush_.kind == Brush_kind::inflate ? 0.03 * brush_.radius
                         : brush_.kind == Brush_kind::pinch ? 0.25
                                                            : 1.0;
    start({static_cast<brushes::Kind>(brush_.kind), internal::point_of<Kernel::Point_3>(place), brush_.radius,
           share * brush_.strength});
  }

  /// Moves the next part of a dab.
  void go_on() {
    if (!editor_->has_room(4 * vertices_a_tick))
      return;
    --wait_;
    const std::size_t size = std::min(vertices_a_tick, left());
    const auto first = vertices_.begin() + static_cast<std::ptrdiff_t>(next_);
    editor_->move(CGAL::make_range(first, first + static_cast<std::ptrdiff_t>(size)), targets_);
    next_ += size;
  }

private:
  Model* model_;
  Editor* editor_;
  Mesh::Property_map<Vertex_index, Kernel::Point_3> targets_;
  Brush brush_;
  Eigen::Vector3d centre_ = Eigen::Vector3d::Zero();
  std::vector<Vertex_index> vertices_;
  std::size_t next_ = 0;
  int wait_ = 0;

  void start(const brushes::Dab<Kernel>& dab) {
    wait_ = ticks_a_dab;
    next_ = 0;
    vertices_.clear();
    const Vertex_index nearest = model_->sculptor->nearest_vertex(dab.centre, dab.radius);
    if (!nearest.is_valid())
      return;
    vertices_ = brushes::touched(model_->mesh, dab, nearest);
    brushes::fill_targets_of(vertices_, model_->mesh, dab, targets_,
                             boost::static_property_map<double, Vertex_index>(1.0));
  }
};

} // namespace haptic_sculpt::window_program

#endif
