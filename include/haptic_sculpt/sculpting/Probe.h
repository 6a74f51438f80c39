// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/sculpting/Drag_parameters.h>
#include <haptic_sculpt/sculpting/Drag_result.h>
#include <haptic_sculpt/sculpting/Edit_result.h>
#include <haptic_sculpt/sculpting/contact/check_arguments.h>

#include <algorithm>
#include <vector>

namespace haptic_sculpt {

/// Where a probe may begin.
enum class Probe_start {
  outside, ///< not inside of a solid
  anywhere ///< wherever no face is within the clearance
};

/// A point that touches a surface and that nothing touches: made by `Sculptor::probe()`, dragged as often as wanted.
///
/// A value: a copy goes on from where this one is. Any change of the mesh ends it, be it a drag, an edit, undo or redo:
/// then drags end as Drag_end::stale and move nothing, and another probe is to be made. Refers to its Sculptor, which
/// must outlive it.
template <class Sculptor>
class Probe {
public:
  using Mesh = typename Sculptor::Mesh_type; ///< that is touched
  using Point = typename Mesh::Point;        ///< of a place

  /// Whether drags may move it: it was not refused, and the mesh has not changed since.
  explicit operator bool() const { return !refusal_ && changes_ == sculptor_->guarded_.changes(); }
  /// Why it could not begin: Refusal_reason::too_near, with the corners of a face, or Refusal_reason::inside.
  const std::optional<Refusal<Mesh>>& refusal() const { return refusal_; }
  /// Where it is, or was when the mesh changed.
  const Point& position() const { return position_; }

  /// Drags it as Grab::drag_to drags a vertex; contacts are carried on. Of a probe that was refused `end` is
  /// Drag_end::refused, and a contact names the face that is too near; of one that has ended it is Drag_end::stale.
  /// \param parameters unset: those of the Sculptor
  /// \throw Out_of_range, Invalid_parameter, Mesh_changed
  Drag_result<Mesh> drag_to(const Point& target, const std::optional<Drag_parameters>& parameters = std::nullopt) {
    return drag(target, nullptr, parameters);
  }
  /// The same, and says on which way, as Grab::drag_to does. Of one that cannot be dragged none. \param path is written
  /// anew
  Drag_result<Mesh> drag_to(const Point& target, std::vector<Point>& path,
                            const std::optional<Drag_parameters>& parameters = std::nullopt) {
    const Point end = target; // it may be a point of the path
    path.clear();
    return drag(end, &path, parameters);
  }

private:
  friend Sculptor;

  Sculptor* sculptor_;
  Point position_;
  std::optional<Refusal<Mesh>> refusal_;
  std::uint64_t changes_; ///< of the mesh by then

  Probe(Sculptor& sculptor, const Point& p, std::optional<Refusal<Mesh>> refusal)
      : sculptor_(&sculptor), position_(p), refusal_(std::move(refusal)), changes_(sculptor.guarded_.changes()) {}

  Drag_result<Mesh> drag(const Point& target, std::vector<Point>* path,
                         const std::optional<Drag_parameters>& parameters) {
    if (*this) {
      Drag_result<Mesh> result = sculptor_->guarded_.drag_probe(position_, target, path, parameters);
      position_ = result.position;
      return result;
    }
    const internal::Rounding_to_nearest rounding;
    internal::check_point("the target", target);
    Drag_result<Mesh> result = Drag_result<Mesh>::stale_at(position_);
    if (refusal_)
      result.end = Drag_end::refused;
    if (refusal_ && refusal_->reason == Refusal_reason::too_near && refusal_->elements.size() >= 3) {
      Contact_3<Mesh> contact;
      std::copy_n(refusal_->elements.begin(), 3, contact.vertices.begin());
      contact.is_flat = true;
      result.contacts.push_back(contact);
    }
    return result;
  }
};

} // namespace haptic_sculpt
