// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/sculpting/Drag_parameters.h>
#include <haptic_sculpt/sculpting/Drag_result.h>
#include <haptic_sculpt/sculpting/contact/check_arguments.h>

#include <utility>
#include <vector>

namespace haptic_sculpt {

/// A vertex in the hand: made by `Sculptor::grab()`, dragged as often as wanted, let go by `release()` or destruction.
///
/// A Sculptor has one hand: once another Grab has been made, and once the Sculptor has died, this one is stale for
/// good. It stays usable across edits; while its vertex is removed it is stale too, until undo or redo revives the
/// vertex. Drags of a stale Grab end as Drag_end::stale and move nothing.
template <class Sculptor>
class Grab {
public:
  using Mesh = typename Sculptor::Mesh_type;        ///< the one that is guarded
  using Point = typename Mesh::Point;               ///< of a target
  using Vertex_index = typename Mesh::Vertex_index; ///< of the vertex in hand

  Grab(Grab&& other) noexcept { take_over(other); } ///< has the hand in place of `other`, which is stale then
  /// Lets go of its own vertex first; then as above.
  Grab& operator=(Grab&& other) noexcept {
    if (this != &other) {
      let_go();
      take_over(other);
    }
    return *this;
  }
  ~Grab() { let_go(); }

  /// The vertex; the null descriptor while the Grab is stale. A vertex that was revived may have another descriptor.
  Vertex_index vertex() const { return sculptor_ != nullptr ? sculptor_->vertex(id_) : Vertex_index(); }

  /// Drags the vertex towards `target` in a straight line, until it is there or something would be touched.
  ///
  /// \post The mesh is embedded as before, exactly, and nothing was crossed on the way.
  /// \throw Out_of_range, Invalid_parameter, Mesh_changed; the mesh is then as it was.
  /// Cost: the candidates near the star times its valence; a look at the broad phase when the star leaves its region.
  /// Allocates nothing once it is warm: no list longer than any before, no more contacts than
  /// Drag_result::usual_contacts, at most 16,384 moves since the grab, and no delta rule so nearly broken
  /// that it takes rational numbers to decide.
  /// \param parameters unset: those of the Sculptor
  Drag_result<Mesh> drag_to(const Point& target, const std::optional<Drag_parameters>& parameters = std::nullopt) {
    return drag(target, nullptr, parameters);
  }

  /// The same, and says on which way: where the vertex was, and where it was after each of the `legs` of the result,
  /// each a straight motion that was proven free; `position` is the last point. Of a stale Grab none. \param path is
  /// written anew
  Drag_result<Mesh> drag_to(const Point& target, std::vector<Point>& path,
                            const std::optional<Drag_parameters>& parameters = std::nullopt) {
    const Point end = target; // it may be a point of the path
    path.clear();
    return drag(end, &path, parameters);
  }

  /// Lets go. The next drag takes the vertex again, without contacts.
  void release() {
    if (sculptor_ != nullptr)
      sculptor_->release();
  }

private:
  friend Sculptor;

  Sculptor* sculptor_ = nullptr; ///< whose hand this is; none once it is another's
  std::size_t id_ = 0;           ///< a number that lasts: the mesh's own indices are recycled
  Point place_;                  ///< where the vertex was at the grab, after the last drag, or when the hand was lost

  Grab(Sculptor& sculptor, std::size_t id)
      : sculptor_(&sculptor), id_(id), place_(sculptor.mesh().point(sculptor.vertex(id))) {
    sculptor_->set_hand(this);
  }

  /// Another Grab takes the hand, or a drag has thrown. Nothing is asked that may throw.
  void note_place() noexcept {
    if (sculptor_ == nullptr)
      return;
    const Vertex_index v = sculptor_->guarded_.editor().ids().vertex(id_);
    if (v.is_valid() && sculptor_->mesh().has_valid_index(v)) // it may be cleared
      place_ = sculptor_->mesh().point(v);
  }

  Drag_result<Mesh> drag(const Point& target, std::vector<Point>* path,
                         const std::optional<Drag_parameters>& parameters) {
    const Vertex_index v = vertex();
    if (!v.is_valid()) {
      const internal::Rounding_to_nearest rounding;
      internal::check_point("the target", target);
      return Drag_result<Mesh>::stale_at(place_);
    }
    Sculptor& sculptor = *sculptor_; // a visitor may move this Grab elsewhere meanwhile, or end it
    try {
      Drag_result<Mesh> result = sculptor.guarded_.drag(v, target, path, parameters);
      if (Grab* const hand = sculptor.holder_)
        hand->place_ = result.position;
      return result;
    } catch (...) { // a visitor's, for instance, after the vertex has moved
      if (Grab* const hand = sculptor.holder_)
        hand->note_place();
      throw;
    }
  }

  void take_over(Grab& other) noexcept {
    sculptor_ = std::exchange(other.sculptor_, nullptr);
    id_ = other.id_;
    place_ = other.place_;
    if (sculptor_ != nullptr)
      sculptor_->set_hand(this);
  }
  /// Allocates nothing: what comes next tells the broad phase.
  void let_go() noexcept {
    if (sculptor_ != nullptr)
      sculptor_->let_go();
    sculptor_ = nullptr;
  }
};

} // namespace haptic_sculpt
