// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/sculpting/Star_impact.h>
#include <haptic_sculpt/sculpting/geometry/contact_plane.h>

namespace haptic_sculpt {

/// What holds a moving vertex: a pair of features that would meet, or the delta rule.
enum class Contact_kind : std::uint8_t { vertex_face, edge_edge, face_vertex, delta };

/// The name used in reports: "vertex-face", "edge-edge", "face-vertex" or "delta".
inline const char* name_of(Contact_kind kind) {
  constexpr const char* names[] = {"vertex-face", "edge-edge", "face-vertex", "delta"};
  return names[static_cast<int>(kind)];
}

/// One contact of a moving vertex J.
template <class Mesh>
struct Contact_3 {
  using Vertex_index = typename Mesh::Vertex_index;                         ///< of the mesh
  using Point_3 = typename Mesh::Point;                                     ///< with double coordinates
  using Vector_3 = typename CGAL::Kernel_traits<Point_3>::Kernel::Vector_3; ///< with double coordinates

  Contact_kind kind = Contact_kind::vertex_face; ///< says what `vertices` and `plane` are

  /// The vertices that stand still: A, B, C (J meets face ABC); V, A, B (edge JV meets edge AB); G, I, A (face JGI
  /// meets vertex A); for `delta` G, I and the corner whose altitude would fall below delta (J itself or G or I), whose
  /// triangle is JGI.
  std::array<Vertex_index, 3> vertices;

  /// Of length 1, towards the side J came from: the direction in which the contact pushes. Floating point. Of a refused
  /// probe neither this nor the plane is given.
  Vector_3 normal = {0, 0, 0};

  /// The three points of the contact plane, exact. Do not span it where `is_flat`; G, I, I for `delta`.
  std::array<Point_3, 3> plane = {Point_3(0, 0, 0), Point_3(0, 0, 0), Point_3(0, 0, 0)};

  /// Whether the plane is not determined by the features: the motion was coplanar with them.
  bool is_flat = false;

  /// Where on face ABC; vertex_face only.
  Triangle_location location = Triangle_location::face;

  /// Which side of `plane` J came from: the sign of orientation(plane[0], plane[1], plane[2], J) before the contact.
  int side = 0;
};

namespace internal {

/// The contact of an impact. `at` describes its path, see path_at_plane().
template <class Mesh, class Impact>
Contact_3<Mesh> contact_of(const Star_impact<Mesh, Impact>& impact, const Path_at_plane& at) {
  Contact_3<Mesh> contact;
  contact.kind = static_cast<Contact_kind>(impact.feature());
  contact.vertices = impact.vertices();
  contact.normal = {at.normal[0], at.normal[1], at.normal[2]};
  contact.plane = {impact.impact().static_point(0), impact.impact().static_point(1), impact.impact().static_point(2)};
  contact.is_flat = at.side == 0;
  contact.location = impact.impact().location();
  contact.side = at.side;
  return contact;
}

/// Of the still features of a contact.
template <class Mesh>
double largest_coordinate_of(const Contact_3<Mesh>& contact) {
  double largest = 0;
  for (const auto& p : contact.plane)
    largest = std::fmax(largest, largest_magnitude(coordinates(p)));
  return largest;
}

/// The distance of q from the plane of a contact that is not flat, signed: positive on the side of positive
/// orientation.
template <class Mesh>
double height_over_plane(const Contact_3<Mesh>& contact, const Coordinates& q) {
  const auto& [a, b, c] = contact.plane;
  return height_over_plane(coordinates(a), coordinates(b), coordinates(c), q);
}

} // namespace internal
} // namespace haptic_sculpt
