// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/sculpting/Mesh_changed.h>
#include <haptic_sculpt/surface/connectivity/Face_corners.h>
#include <haptic_sculpt/surface/broad_phase/processor.h>
#include <haptic_sculpt/surface/connectivity/star.h>
#include <haptic_sculpt/surface/vertex_coordinates.h>


namespace haptic_sculpt::internal {

/// A private copy of the points and counts of a mesh, against which changes by others are found.
///
/// Comparing all points before every drag would cost more than the drag. So counts are compared every time, the star
/// and the candidates of a drag whenever they are looked up and a few of them in turn at every drag, and at a grab
/// `points_per_look` more points in turn; all points of a mesh of up to `few_points` vertices are compared then.
/// Connectivity is compared with a copy of the faces' corners: of the star whenever the candidates are looked up, and
/// of what an edit takes away. `check_all()` compares everything.
template <class Mesh>
class Mesh_watch {
public:
  using Vertex_index = typename Mesh::Vertex_index;
  using Coordinates = std::array<double, 3>;

  /// 768 bytes a look, and as much of the mesh: in a large mesh some 0.1 microseconds, a fiftieth of the budget of
  /// grabbing a new vertex.
  static constexpr std::size_t points_per_look = 32, few_points = 128;

  explicit Mesh_watch(const Mesh& mesh) : mesh_(&mesh) { remember_all(); }

  void remember_all() {
    points_.resize(mesh_->num_vertices());
    for (std::size_t i = 0; i < points_.size(); ++i)
      points_[i] = vertex_coordinates(*mesh_, Vertex_index(static_cast<typename Vertex_index::size_type>(i)));
    remember_counts();
  }

  /// The Sculptor itself has moved or made this vertex.
  void remember(Vertex_index v) {
    const auto i = static_cast<std::size_t>(v);
    if (i >= points_.size())
      points_.resize(i + 1);
    points_[i] = vertex_coordinates(*mesh_, v);
  }

  void remember_counts() {
    counts_ = counts();
  }

  /// \throw Mesh_changed if elements came or went, or garbage was collected. Cost: constant.
  void check_counts() const {
    if (counts() != counts_)
      throw Mesh_changed("it has " + std::to_string(mesh_->number_of_vertices()) + " vertices and " +
                         std::to_string(mesh_->number_of_faces()) +
                         " faces in use, or elements were removed or collected, unlike after the last edit");
  }

  /// \throw Mesh_changed if v is not where it was left.
  void check(Vertex_index v) const {
    if (is_elsewhere(v))
      throw Mesh_changed("vertex " + std::to_string(static_cast<std::size_t>(v)) + " was moved");
  }

  /// \throw Mesh_changed if f has other corners than it was left with.
  static void check_face(const Face_corners<Mesh>& corners, typename Mesh::Face_index f) {
    if (!corners.is_as_it_was(f))
      throw Mesh_changed("face " + std::to_string(static_cast<std::size_t>(f)) + " has other corners, or came or went");
  }
  template <class Faces>
  static void check_faces(const Face_corners<Mesh>& corners, const Faces& faces) {
    for (const auto f : faces)
      check_face(corners, f);
  }

  /// \throw Mesh_changed as check(). What was removed may be anywhere: even where no number equals itself.
  void check_place(std::size_t i) const {
    const Vertex_index v(static_cast<typename Vertex_index::size_type>(i));
    if (is_elsewhere(v) && !mesh_->is_removed(v)) // last: that is one more line of memory
      check(v);
  }

  /// Makes room for this many vertices in all.
  void reserve(std::size_t vertices) { points_.reserve(vertices); }

  /// Asks for the memory that check(v) will read.
  void prefetch(Vertex_index v) const {
    internal::prefetch(&points_[static_cast<std::size_t>(v)], sizeof(Coordinates));
  }

  /// Compares the next points_per_look points in turn, or few_points where there are no more.
  void check_some() {
    const std::size_t n = points_.size();
    for (std::size_t left = n <= few_points ? n : points_per_look; left != 0; --left) {
      next_ = next_ + 1 < n ? next_ + 1 : 0;
      check_place(next_);
    }
    if (n > few_points) { // else the next look would wait for memory, several times in a row
      const std::size_t first = next_ + points_per_look < n ? next_ + 1 : 0;
      const Vertex_index v(static_cast<typename Vertex_index::size_type>(first));
      internal::prefetch(&points_[first], points_per_look * sizeof(Coordinates));
      internal::prefetch(&mesh_->point(v), points_per_look * sizeof(Coordinates));
    }
  }

  void check_all(const Face_corners<Mesh>& corners) const {
    check_counts();
    for (std::size_t f = 0; f < mesh_->num_faces(); ++f)
      check_face(corners, typename Mesh::Face_index(static_cast<typename Mesh::size_type>(f)));
    for (std::size_t i = 0; i < points_.size(); ++i)
      check_place(i);
  }

  /// Bytes held, capacity included.
  std::size_t memory() const { return points_.capacity() * sizeof(Coordinates); }

private:
  using Counts = std::array<std::size_t, 6>;

  const Mesh* mesh_;
  std::vector<Coordinates> points_;
  Counts counts_{};
  std::size_t next_ = 0;

  bool is_elsewhere(Vertex_index v) const {
    return vertex_coordinates(*mesh_, v) != points_[static_cast<std::size_t>(v)];
  }

  Counts counts() const {
    return {mesh_->num_vertices(),       mesh_->num_edges(),       mesh_->num_faces(),
            mesh_->number_of_vertices(), mesh_->number_of_edges(), mesh_->number_of_faces()};
  }
};

} // namespace haptic_sculpt::internal
