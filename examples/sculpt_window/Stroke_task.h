// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Tasks.h"

namespace haptic_sculpt::window_program {

/// What is done along a way of the mouse, from the button's press to its release: something at each place that the
/// window's thread adds, in their order, so that the same places do the same whatever the clock says. All of it is one
/// step of undo.
class Stroke_task : public Window_task {
public:
  /// \param press where the mouse pointed when the button was pressed \param spot what it pointed at, until that is met
  Stroke_task(const Pointer& press, const Pointed& spot) : press_(press) { told_spot_.put(spot); }

  /// \name While it is under way, for the window's thread
  ///@{
  void add(const Pointer& pointer) { added_ += places_.push(pointer); } ///< \pre is_waiting() is false
  bool is_waiting() const { return done_ != added_; }                   ///< the press or a place is yet to be worked at
  bool is_press_waiting() const { return added_ == 1 && done_ == 0; }   ///< whether it meets the mesh is not known yet
  void end() { ends_ = true; }                                          ///< the button is released
  const Pointed& spot() { return told_spot_.get(); }
  ///@}

protected:
  /// \pre the mesh is met there
  virtual void begin(Scene& scene, Tool_type& tool, const Surface_hit<Mesh>& hit) = 0;
  virtual void work_at(const Pointer& pointer, Scene& scene, Tool_type& tool) = 0;

  Eigen::Vector3d centre_ = Eigen::Vector3d::Zero(); ///< where it is now
  void meet(const Scene& scene, const Surface_hit<Mesh>& hit) {
    centre_ = drawing::to_eigen(hit.point);
    normal_ = normal_at(scene, hit);
  }
  /// How far the mouse has gone from where it is now, across the view.
  Eigen::Vector3d way_to(const Pointer& pointer) const { return on_plane(pointer, centre_) - centre_; }

private:
  Pointer press_;
  Place normal_{};
  bool has_begun_ = false;
  boost::lockfree::spsc_queue<Pointer, boost::lockfree::capacity<4>> places_;
  std::size_t added_ = 1; ///< the press, and places
  std::atomic<std::size_t> done_{0};
  std::atomic<bool> ends_{false};
  Latest<Pointed> told_spot_;

  bool work(Scene& scene, Tool_type& tool) final {
    const bool ends = ends_; // asked before the places: what was added before the end is worked at
    Pointer pointer;
    if (!has_begun_) {
      const Hit hit = hit_of(scene, press_);
      if (!hit)
        return miss();
      meet(scene, *hit);
      tool.begin_stroke();
      has_begun_ = true;
      begin(scene, tool, *hit);
      ++done_;
    } else if (places_.pop(pointer)) {
      work_at(pointer, scene, tool);
      ++done_;
    } else if (ends) {
      tool.let_go();
      return true;
    }
    Pointed spot;
    spot.at = place(centre_), spot.normal = normal_;
    told_spot_.put(spot);
    return false;
  }
};

} // namespace haptic_sculpt::window_program
