// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/sculpting/many_vertices/Scaled_points.h>

#include <limits>

namespace haptic_sculpt::internal {

/// Points of the surface as it was, each with a face of the surface as it is that is near it, so that no operation
/// takes the surface farther from one of them than allowed.
///
/// A face has the points it stands for. An operation takes those of the faces that it changes in hand; it is made where
/// each is near enough to one of the faces that come of it, or no farther than before, and then they are handed on to
/// these. So the distance to the face of a point, which is no less than that to the surface, stays bounded, whatever
/// number of operations there are. See doc/use/remeshing.md.
///
/// Everything is in the unit of the points, and rounded. Cost of an operation: the points of its faces.
template <class Mesh>
class Input_samples {
public:
  using Vertex_index = typename Mesh::Vertex_index;
  using Face_index = typename Mesh::Face_index;
  using Halfedge_index = typename Mesh::Halfedge_index;

  /// \param most_distance may be infinite: then nothing is kept, and everything allowed
  explicit Input_samples(double most_distance) : most_(most_distance * most_distance) {}

  /// The vertices of the range are the points.
  template <class Marks>
  void begin(const Mesh& mesh, const Scaled_points<Mesh>& points, const Marks& marks) {
    if (!is_on())
      return;
    first_.assign(mesh.num_faces(), none);
    for (const Vertex_index v : mesh.vertices())
        for (const Halfedge_index h : mesh.halfedges_around_target(mesh.halfedge(v)))
          if (marks.is_in_range(mesh.face(h))) {
            points_.push_back(points(v));
            next_.push_back(none);
            give(static_cast<Sample>(points_.size() - 1), mesh.face(h));
            break;
          }
  }

  /// Those of faces that are to change.
  template <class Faces>
  void take(const Faces& faces) {
    held_.clear();
    if (points_.empty())
      return;
    std::uint32_t place = 0;
    for (const Face_index f : faces) {
      for (Sample s = first_[static_cast<std::size_t>(f)]; s != none; s = next_[s])
        held_.push_back({s, place, place});
      ++place;
    }
  }

  /// Whether those in hand may have n new faces. Notes which each would have.
  /// \param after `after(p, i)`: squared distance of p to new face i, infinite where there is none; faces are in order,
  /// each beside the next, the old one of the same place, and the last beside the first
  /// \param before `before(p, i)`: squared distance to old face i
  template <class After, class Before>
  bool fit(std::size_t n, const After& after, const Before& before) {
    for (Held& held : held_) {
      const Coordinates& p = points_[held.sample];
      held.place = held.old_place;
      double least = after(p, held.place);
      const auto is_nearer = [&](std::size_t i) {
        const double other = after(p, i);
        if (!(other < least))
          return false;
        least = other;
        held.place = static_cast<std::uint32_t>(i);
        return true;
      };
      // Downhill in one direction, then in the other.
      for (std::size_t steps = 1, i = held.old_place; steps < n; ++steps)
        if (i = i + 1 < n ? i + 1 : 0; !is_nearer(i))
          break;
      if (held.place == held.old_place)
        for (std::size_t steps = 1, i = held.old_place; steps < n; ++steps)
          if (i = i > 0 ? i - 1 : n - 1; !is_nearer(i))
            break;
      for (std::size_t i = 0; i < n && least > most_; ++i)
        is_nearer(i);
      if (least > most_ && !(least <= before(p, held.old_place)))
        return false;
    }
    return true;
  }

  /// The change has been made. \param faces those that were given to take() \param face_of `face_of(i)`: new face i
  template <class Faces, class Face_of>
  void put(const Mesh& mesh, const Faces& faces, const Face_of& face_of) {
    if (!is_on() || first_.empty())
      return;
    if (first_.size() < mesh.num_faces())
      first_.resize(mesh.num_faces(), none);
    for (const Face_index f : faces)
      first_[static_cast<std::size_t>(f)] = none;
    for (const Held& held : held_)
      give(held.sample, face_of(held.place));
  }

private:
  using Sample = std::uint32_t;
  static constexpr Sample none = std::numeric_limits<Sample>::max();

  struct Held {
    Sample sample;
    std::uint32_t old_place, place; ///< of faces: the one it had, and the one it would have
  };

  double most_; ///< squared
  std::vector<Coordinates> points_;
  std::vector<Sample> next_;  ///< by sample: another one of its face
  std::vector<Sample> first_; ///< by face
  std::vector<Held> held_;

  bool is_on() const { return most_ < std::numeric_limits<double>::infinity(); }
  void give(Sample s, Face_index f) {
    next_[s] = first_[static_cast<std::size_t>(f)];
    first_[static_cast<std::size_t>(f)] = s;
  }
};

} // namespace haptic_sculpt::internal
