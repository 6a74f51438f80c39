// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/Part_runner.h>
#include <haptic_sculpt/surface/broad_phase/Star_filter.h>
#include <haptic_sculpt/surface/broad_phase/face_box.h>
#include <haptic_sculpt/surface/broad_phase/spatial_order.h>

#include <algorithm>
#include <limits>

namespace haptic_sculpt {

namespace internal {
struct Broad_phase_access;
}

/// What every broad phase has without doing anything for it: each model of BroadPhase derives from this, and writes its
/// own members in place of those here that it can do better.
///
/// \tparam Mesh_ the mesh \tparam Derived the broad phase itself: it has `query(box, faces)`
template <class Mesh_, class Derived>
class Broad_phase_base {
public:
  using Face_index = typename Mesh_::Face_index; ///< what queries append

  /// Appends the faces whose boxes pass the filter of the star (doc/proofs/broad_phase.md, "Which faces count"), no
  /// others, in any order: at least all faces that meet one of the tetrahedra that the star sweeps. Gives up where
  /// there are more than `most`. Returns whether the answer is whole. Cost: here that of the query for a box, all of
  /// whose answer is read.
  bool query_star(const Swept_star_3& star, std::vector<Face_index>& faces, std::size_t most = unlimited) {
    const internal::Star_filter filter(star, scale_);
    const std::size_t first = faces.size();
    derived().query(filter.holding_what_passes(), faces);
    internal::Box_node node; // of one box
    const auto end = std::remove_if(faces.begin() + static_cast<std::ptrdiff_t>(first), faces.end(), [&](Face_index f) {
      node.set(0, scale_.around(face_box(*mesh_, f)));
      return (filter.meeting(node) & 1u) == 0;
    });
    faces.erase(end, faces.end());
    return faces.size() - first <= most;
  }

  /// Visits at least the faces that count: `visit(face)` returns the limit from then on, and a face counts where a
  /// lower bound of its box is not above the limit. Here all whose boxes meet the region are visited. \param region
  /// holds all that counts at first \param bound `bound(node, lowest)` writes a lower bound for each of the eight boxes
  /// of an `internal::Box_node`, and returns the bits of those that count
  template <class Bound, class Visit>
  void visit_nearest_first(const Box_3& region, const Bound& bound, double limit, const Visit& visit) {
    static_cast<void>(bound), static_cast<void>(limit);
    visited_.clear();
    derived().query(region, visited_);
    for (const Face_index f : visited_)
      visit(f);
  }

  /// Puts faces in an order in which near ones are side by side. Here by their places: n log n.
  void put_in_order(std::vector<Face_index>& faces) const {
    const auto ordered = internal::faces_in_spatial_order(*mesh_, faces, scale_);
    for (std::size_t i = 0; i < ordered.size(); ++i)
      faces[i] = Face_index(ordered[i].face);
  }

  /// As `faces_moved(faces)`, after a change that moves many at once; threads of `run` may share the work.
  /// `corners_of(face)` says sooner than the mesh what the corners of a face are. Here one thread does all of it.
  template <class Faces, class Corners>
  void many_faces_moved(const Faces& faces, const Corners& /*corners_of*/, const Part_runner& /*run*/) {
    derived().faces_moved(faces);
  }

  /// A query about here may follow soon: its memory may be asked for. Changes no answer. Here nothing is done.
  void fetch_ahead(const Box_3& /*box*/) {}
  /// Called now and then until that query: goes on with asking. Here nothing is done.
  void fetch_on() {}
  /// Makes room for this many faces in all and this many insertions, so that they allocate nothing; asked before edits,
  /// again and again. Here nothing is done: right where what comes and moves allocates nothing.
  void reserve(std::size_t /*faces*/, std::size_t /*insertions*/) {}
  /// Bytes held that grow with the mesh, capacity included. Here none are known of.
  std::size_t memory() const { return 0; }

protected:
  /// For `most`: any number of faces.
  static constexpr std::size_t unlimited = std::numeric_limits<std::size_t>::max();

  /// \param mesh has to outlive this. Cost: reads its points once
  explicit Broad_phase_base(const Mesh_& mesh) : mesh_(&mesh), scale_(internal::Box_scale::of(mesh)) {}
  Broad_phase_base(const Broad_phase_base&) = delete; // a Sculptor makes its own
  Broad_phase_base& operator=(const Broad_phase_base&) = delete;

  const Mesh_& mesh() const { return *mesh_; } ///< the one given
  /// By what coordinates are multiplied in the boxes of nodes: that of the mesh when this was made.
  const internal::Box_scale& scale() const { return scale_; }

private:
  friend struct internal::Broad_phase_access;

  const Mesh_* mesh_;
  internal::Box_scale scale_;
  std::vector<Face_index> visited_;

  Derived& derived() { return static_cast<Derived&>(*this); }
};

namespace internal {

/// For those who write bounds of a node's boxes.
struct Broad_phase_access {
  template <class Mesh, class Derived>
  static const Box_scale& scale(const Broad_phase_base<Mesh, Derived>& broad_phase) {
    return broad_phase.scale_;
  }
};

} // namespace internal
} // namespace haptic_sculpt
