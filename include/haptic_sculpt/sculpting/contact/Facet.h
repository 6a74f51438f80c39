// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/sculpting/Contact_3.h>
#include <haptic_sculpt/sculpting/geometry/clearance.h>
#include <haptic_sculpt/sculpting/geometry/delta_limit.h>

namespace haptic_sculpt::internal {

/// What one contact forbids the moving vertex J, taken as a point: to cross a planar convex facet
/// (doc/proofs/slide.md).
///
/// vertex-face: the triangle ABC; edge-edge: the part of plane V A B beyond AB, between the rays VA and VB;
/// face-vertex: the wedge A + s (A - G) + t (A - I), s, t >= 0. The delta rule forbids to go through the surface of
/// constant altitude, of which a facet is the tangent plane where J is. A flat impact determines no plane; its facet is
/// a wall across the path.
///
/// Heights of the three kinds are exact up to some roundings at the end, their signs always; the rest is floating point
/// and only proposes.
template <class Mesh>
class Facet {
public:
  Facet(const Contact_3<Mesh>& contact, const Vector& point_of_contact)
      : contact_(contact)
      , foot_(point_of_contact)
      , reach_(largest_coordinate_of(contact)) {
    if (contact.kind == Contact_kind::delta || contact.is_flat)
      return;
    // The plane's own normal, about which its three points run counterclockwise.
    const Vector normal = scaled(this->normal(), contact.side);
    const auto [a, b, c] = corners();
    switch (contact.kind) {
    case Contact_kind::vertex_face:
      add_border(a, b, normal, 1), add_border(b, c, normal, 1), add_border(c, a, normal, 1);
      break;
    case Contact_kind::edge_edge:
      add_border(a, b, normal, 1), add_border(b, c, normal, -1), add_border(c, a, normal, 1);
      break;
    default:
      add_border(b, c, normal, -1), add_border(c, a, normal, -1);
    }
  }

  const Contact_3<Mesh>& contact() const { return contact_; }

  /// Of length 1, towards the side J came from.
  Vector normal() const { return coordinates(contact_.normal); }

  /// A wall holds for one drag only: another path meets another wall.
  bool is_wall() const { return contact_.kind != Contact_kind::delta && contact_.is_flat; }

  /// How far J is from the facet's plane, as of the last measure(); negative beyond. A clearance where an altitude is
  /// below delta: the facet then goes with J.
  double height() const { return height_; }

  /// How far J is from what the contact forbids, as of the last measure(); no less than 0.
  double distance() const { return is_low_ ? 0 : std::fmax(0.0, height_); }

  /// What J keeps from the plane where it is, as of the last measure().
  double clearance() const { return clearance_; }
  /// Of the features that stand still.
  double largest_coordinate() const { return reach_; }

  /// Whether J has lifted off by this many clearances, or has gone round the facet to its other side (whose sign is
  /// exact).
  bool is_over(double clearances) const {
    return height_ > clearances * clearance_ || (height_ < 0 && !contact_.is_flat);
  }

  /// J is at x now.
  void measure(const Vector& x, const Drag_rules& rules) {
    clearance_ = rules.clearance.at(std::fmax(reach_, largest_magnitude(x)));
    if (contact_.kind == Contact_kind::delta) {
      const Altitude_over over = side_of_altitude();
      const auto points = corners();
      const Vector up = altitude_gradient(x, points[0], points[1], over);
      contact_.normal = {up[0], up[1], up[2]};
      height_ = distance_to_altitude(x, points[0], points[1], over, rules.delta);
      // Lower than delta already it may not get lower: J is where it has to be, and all that rises is permitted.
      is_low_ = height_ < 0;
      if (is_low_)
        height_ = clearance_;
    } else if (contact_.is_flat)
      height_ = dot(normal(), minus(x, foot_));
    else
      height_ = contact_.side * height_over_plane(contact_, x);
  }

  /// How far x, seen along the normal, is out of the facet; negative inside. At corners the larger of two distances.
  double outside(const Vector& x) const {
    double most = -std::numeric_limits<double>::infinity();
    for (int i = 0; i < borders_; ++i)
      most = std::fmax(most, beyond_border(i, x));
    return most;
  }

  /// Whether J has gone past a border: its plane goes on, but is no obstacle there. At once when J is as far as the
  /// clearance from the facet itself; a facet that is met again right after that holds on until J is `border` past it.
  bool is_left(const Vector& x, double resolution, double border) const {
    return is_past(x, holds_on_ ? border : resolution);
  }
  /// The same for one that does not hold on.
  bool is_past(const Vector& x, double resolution) const {
    const double beside = outside(x);
    return beside > resolution && length({beside, height_, 0}) > clearance_;
  }

  void hold_on() { holds_on_ = true; }

  int borders() const { return borders_; }
  /// Out of the facet, in its plane, normal to border i; of length 1.
  const Vector& outward(int i) const { return outward_[i]; }
  /// How far x is beyond the line of border i.
  double beyond_border(int i, const Vector& x) const { return dot(outward_[i], minus(x, border_[i])); }
  /// The direction, of length 1, of border i.
  Vector along_border(int i) const { return cross(outward_[i], normal()); }

  /// Whether border i of a face is also one of another: then J that goes past it goes over to the other.
  bool shares_border(int i, const Facet& other) const {
    if (contact_.kind != Contact_kind::vertex_face || other.contact_.kind != Contact_kind::vertex_face)
      return false;
    const auto& theirs = other.contact_.vertices;
    const auto has = [&](const auto v) { return theirs[0] == v || theirs[1] == v || theirs[2] == v; };
    return has(contact_.vertices[static_cast<std::size_t>(i)]) &&
           has(contact_.vertices[static_cast<std::size_t>((i + 1) % 3)]);
  }

  /// The normal of the plane in which a flat impact happened, of length 1; 0 where all is on one line.
  Vector normal_of_wall() const {
    const auto [a, b, c] = corners();
    return normalized(cross(normalized(minus(b, a)), normalized(minus(c, a))));
  }

  /// The same features, met from the same side.
  static bool is_same(const Contact_3<Mesh>& a, const Contact_3<Mesh>& b) {
    return a.kind == b.kind && a.vertices == b.vertices && a.side == b.side;
  }
  bool is_of(const Contact_3<Mesh>& contact) const { return !is_wall() && is_same(contact_, contact); }

private:
  Contact_3<Mesh> contact_;
  Vector foot_;
  std::array<Vector, 3> border_{}, outward_{};
  int borders_ = 0;
  double reach_, clearance_ = 0, height_ = 0;
  bool holds_on_ = false;
  bool is_low_ = false; ///< an altitude that is below delta already

  /// The three points of the contact plane.
  std::array<Vector, 3> corners() const {
    const auto& [a, b, c] = contact_.plane;
    return {coordinates(a), coordinates(b), coordinates(c)};
  }

  /// The line from p to q; the facet lies on its left about the normal where sign is 1, on its right where it is -1.
  void add_border(const Vector& p, const Vector& q, const Vector& normal, double sign) {
    border_[borders_] = p;
    outward_[borders_++] = scaled(normalized(cross(normalized(minus(q, p)), normal)), sign);
  }

  Altitude_over side_of_altitude() const {
    return contact_.vertices[2] == contact_.vertices[0]   ? Altitude_over::ji
           : contact_.vertices[2] == contact_.vertices[1] ? Altitude_over::jg
                                                          : Altitude_over::gi;
  }
};

} // namespace haptic_sculpt::internal
