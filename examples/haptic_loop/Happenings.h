// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/haptic_rendering/Tool_step.h>

#include <array>
#include <limits>
#include <numeric>
#include <vector>

namespace haptic_sculpt::loop_program {

/// What has happened in a run, and when first.
class Happenings {
public:
  enum What {
    touched,
    slid,
    lifted_off,
    grabbed,
    created,
    held,
    pushed_into_another_part,
    released,
    removed,
    refused,
    number
  };
  static const char* name_of(What what) {
    constexpr const char* names[] = {
        "touched",  "slid",    "lifted_off", "grabbed", "created", "held", "pushed_into_another_part",
        "released", "removed", "refused"};
    return names[what];
  }
  /// How far a probe goes along a surface to be said to slide, and how far from it to be said to have lifted off, m in
  /// the device: more than a hand trembles.
  static constexpr double a_way = 1e-3;

  /// \param scale units of the scene a metre of the device
  template <class Sculptor>
  Happenings(const Sculptor& sculptor, double scale) : scale_(scale), part_(sculptor.number_of_ids()) {
    first_.fill(std::numeric_limits<double>::quiet_NaN());
    std::iota(part_.begin(), part_.end(), std::size_t{0});
    const auto& mesh = sculptor.mesh();
    for (const auto e : mesh.edges())
      part_[root(sculptor.id(mesh.vertex(e, 0)))] = root(sculptor.id(mesh.vertex(e, 1)));
    for (std::size_t name = 0; name < part_.size(); ++name)
      part_[name] = root(name);
  }

  /// \return when it happened first, s; NaN: it has not
  double first(What what) const { return first_[what]; }

  /// \param vertex what is held, or null \pre each vertex created since was held at the tick that created it
  template <class Sculptor>
  void add(double time, const Tool_step& step, const Sculptor& sculptor, typename Sculptor::Vertex_index vertex) {
    const auto note = [&](What what, bool has_happened) {
      if (has_happened && !(first_[what] == first_[what]))
        first_[what] = time;
    };
    note(grabbed, step.event == Tool_event::grabbed);
    const bool is_created = step.event == Tool_event::created_on_face || step.event == Tool_event::created_on_edge;
    note(created, is_created);
    if (is_created && vertex.is_valid())
      join(sculptor, vertex);
    note(released, step.event == Tool_event::released);
    note(removed, step.event == Tool_event::removed);
    note(refused, step.event == Tool_event::refused);
    if (vertex.is_valid()) {
      note(held, step.end == Drag_end::held);
      note(pushed_into_another_part, step.obstacle && is_another_part(sculptor, vertex, *step.obstacle));
      is_touching_ = has_touched_ = false;
      return;
    }
    const bool is_touching = step.contacts > 0 && !step.reached;
    note(touched, is_touching);
    way_ = is_touching && is_touching_ ? way_ + ((step.proxy - last_) / scale_).norm() : 0;
    note(slid, way_ > a_way);
    if (is_touching)
      touch_ = step.proxy, has_touched_ = true;
    note(lifted_off, has_touched_ && !is_touching && ((step.proxy - touch_) / scale_).norm() > a_way);
    is_touching_ = is_touching, last_ = step.proxy;
  }

private:
  double scale_, way_ = 0;
  std::vector<std::size_t> part_; ///< by number of vertex: that of one vertex of its part
  std::array<double, number> first_;
  bool is_touching_ = false, has_touched_ = false;
  Eigen::Vector3d last_ = Eigen::Vector3d::Zero(), touch_ = Eigen::Vector3d::Zero();

  std::size_t root(std::size_t name) {
    while (part_[name] != name)
      name = part_[name] = part_[part_[name]];
    return name;
  }

  /// One that has just been created is of the part of its neighbours, which were there before.
  template <class Sculptor>
  void join(const Sculptor& sculptor, typename Sculptor::Vertex_index vertex) {
    const std::size_t name = sculptor.id(vertex);
    while (part_.size() <= name)
      part_.push_back(part_.size());
    const auto& mesh = sculptor.mesh();
    part_[name] = root(sculptor.id(mesh.source(mesh.halfedge(vertex))));
  }

  template <class Sculptor>
  bool is_another_part(const Sculptor& sculptor, typename Sculptor::Vertex_index vertex, std::uint64_t obstacle) const {
    const std::size_t name = sculptor.id(vertex);
    return name < part_.size() && obstacle < part_.size() && part_[name] != part_[obstacle];
  }
};

} // namespace haptic_sculpt::loop_program
