// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/sculpting/response/Other_walk.h>
#include <haptic_sculpt/sculpting/response/is_farther.h>

#include <algorithm>

namespace haptic_sculpt::internal {

/// The walk of the 1997 paper (3.2.2, rules a to e), kept to be compared with: from face to edge to vertex, each time
/// to the point nearest to the target on the triangles at the feature in contact; edge on edge and face on vertex
/// stick.
///
/// The paper's sub-cases of (b) and (c) are in a figure only. Here: among the triangles at the feature, the nearest
/// point decides which face, edge or vertex is next; J lifts off where the target is on its free side of that triangle.
/// Every leg stops and is proven like any motion. Does not reach a nearest point everywhere; that is the paper's.
class Paper_response final : public Other_walk {
public:
  static constexpr int most_legs = Slide_path::most_legs;

  void forget() override { touched_.number = 0; }

  Drag_end move(Walk_ground& ground, const Coordinates& source, const Coordinates& target,
                const Clearance_rule& clearances) override {
    if (place_ != source)
      forget();
    place_ = source;
    path_ = Slide_path(source);
    Drag_end why = walk(ground, target, clearances);
    if (is_farther(target, place_, source)) { // no less than a stop does, and it touches nothing that it met there
      forget();
      place_ = source, path_ = Slide_path(source);
      go_to(ground.leg(source, target));
      why = place_ == target ? Drag_end::reached : Drag_end::held;
    }
    return ground.is_spent() && why != Drag_end::reached ? Drag_end::work_limit : why;
  }

private:
  using Vertex = Walk_ground::Vertex;
  using Face = Walk_ground::Face;
  static constexpr Vertex none = Walk_ground::none;

  /// A face, edge or vertex of the mesh, and the side of its faces J is on: +1 where their normals point.
  struct Touched {
    Face vertices = {none, none, none};
    int number = 0; ///< of vertices; 0: nothing is touched
    int side = 0;

    Touched() = default;
    Touched(const Face& corners, int count, int on_side)
        : vertices(corners), number(count), side(on_side) {
      std::sort(vertices.begin(), vertices.begin() + number); // a set: faces are met from any corner
    }

    friend bool operator==(const Touched& a, const Touched& b) {
      return a.number == b.number && a.side == b.side && a.vertices == b.vertices;
    }
  };
  struct Aim {
    Touched touched;
    Vector place;
    bool lifts_off;
    double clearance;
  };

  Touched touched_;
  mutable std::vector<Face> faces_; ///< at a vertex; kept to allocate no more

  Drag_end walk(Walk_ground& ground, const Coordinates& target, const Clearance_rule& clearances) {
    bool stands = false; // did not move in the turn before
    for (int legs = 1; legs < most_legs; ++legs) {
      const std::optional<Aim> aim = next_aim(ground, target, clearances);
      if (aim && !aim->lifts_off && is_at(*aim))
        return rest(ground, target, aim->clearance);
      const Vector goal = aim && !aim->lifts_off ? aim->place : target;
      const Coordinates end = ground.leg(place_, goal);
      const bool moved = end != place_;
      go_to(end);
      if (end == target) {
        forget();
        return Drag_end::reached;
      }
      if (end == goal) { // on the way over the surface
        touched_ = aim->touched;
        continue;
      }
      touched_ = touched_at(ground.stop());
      if (touched_.number == 0 || (!moved && stands)) // (d), (e): it sticks; or two features send it to each other
        return Drag_end::held;
      stands = !moved;
    }
    go_to(ground.leg(place_, target)); // the last: so what stops it is what does so where it ends
    touched_ = touched_at(ground.stop());
    return place_ == target ? Drag_end::reached : Drag_end::leg_limit;
  }

  /// It is at the nearest point: what holds it there is asked for, and where that is nothing it goes on.
  Drag_end rest(Walk_ground& ground, const Coordinates& target, double clearance) {
    const Coordinates before = place_;
    go_to(ground.leg(place_, target));
    if (place_ == target) {
      forget();
      return Drag_end::reached;
    }
    if (length(minus(place_, before)) > clearance)
      touched_ = touched_at(ground.stop());
    return Drag_end::held;
  }

  void go_to(const Coordinates& end) {
    if (end != place_)
      path_.add(end);
    place_ = end;
  }

  bool is_at(const Aim& aim) const {
    // A clearance is what separates stops of one place from each other.
    return aim.touched == touched_ && length(minus(aim.place, place_)) <= aim.clearance;
  }

  static Touched touched_at(const std::optional<Walk_ground::Stop>& stop) {
    if (!stop)
      return {};
    const auto& [a, b, c] = stop->face;
    const int side = stop->side;
    switch (stop->location) {
    case Triangle_location::edge_ab: return Touched({a, b, none}, 2, side);
    case Triangle_location::edge_bc: return Touched({b, c, none}, 2, side);
    case Triangle_location::edge_ca: return Touched({c, a, none}, 2, side);
    case Triangle_location::vertex_a: return Touched({a, none, none}, 1, side);
    case Triangle_location::vertex_b: return Touched({b, none, none}, 1, side);
    case Triangle_location::vertex_c: return Touched({c, none, none}, 1, side);
    default: return Touched({a, b, c}, 3, side);
    }
  }

  /// The nearest point to the target on the faces at the feature; nothing where none is touched.
  std::optional<Aim> next_aim(const Walk_ground& ground, const Vector& target,
                              const Clearance_rule& clearances) const {
    std::optional<Aim> best;
    double least = std::numeric_limits<double>::infinity();
    for_each_face(ground, [&](const Face& corners) {
      const std::array<Vector, 3> p = {ground.point(corners[0]), ground.point(corners[1]), ground.point(corners[2])};
      const double unit = unit_of_triangle(p);
      const Vector normal =
          scaled(normalized(cross(scaled(minus(p[1], p[0]), unit), scaled(minus(p[2], p[0]), unit))), touched_.side);
      Touched touched;
      const Vector nearest = nearest_on_triangle(target, corners, p, normal, touched_.side, touched);
      const double distance = length(minus(target, nearest));
      if (distance >= least)
        return;
      least = distance;
      double reach = largest_magnitude(nearest);
      for (const Vector& corner : p)
        reach = std::fmax(reach, largest_magnitude(corner));
      const double clearance = clearances.at(reach);
      best = Aim{touched, advanced(nearest, clearance, normal),
                 dot(minus(target, p[0]), normal) > 0, clearance};
    });
    return best;
  }

  /// By which its edges are multiplied, lest products of them leave the range of doubles.
  static double unit_of_triangle(const std::array<Vector, 3>& p) {
    return unit_of(std::fmax(largest_magnitude(minus(p[1], p[0])), largest_magnitude(minus(p[2], p[0]))));
  }

  /// Also tells on what feature of the triangle it lies.
  static Vector nearest_on_triangle(const Vector& target, const Face& corners, const std::array<Vector, 3>& p,
                                    const Vector& normal, int side, Touched& touched) {
    const Vector foot = advanced(target, -dot(minus(target, p[0]), normal), normal);
    const Vector up = scaled(normal, side);
    const double unit = unit_of_triangle(p);
    bool inside = true;
    for (int i = 0; i < 3; ++i)
      inside = inside && dot(cross(up, scaled(minus(p[(i + 1) % 3], p[i]), unit)), minus(foot, p[i])) >= 0;
    if (inside) {
      touched = Touched(corners, 3, side);
      return foot;
    }
    Vector best = p[0];
    double least = std::numeric_limits<double>::infinity();
    for (int i = 0; i < 3; ++i) {
      const int j = (i + 1) % 3;
      const Vector edge = minus(p[j], p[i]);
      const Vector short_edge = scaled(edge, unit);
      const double along =
          std::fmin(1.0, std::fmax(0.0, dot(minus(target, p[i]), short_edge) * unit / dot(short_edge, short_edge)));
      const Vector q = along == 1 ? p[j] : advanced(p[i], along, edge);
      const double distance = length(minus(target, q));
      if (distance >= least)
        continue;
      least = distance, best = q;
      touched = along == 0   ? Touched({corners[i], none, none}, 1, side)
                : along == 1 ? Touched({corners[j], none, none}, 1, side)
                             : Touched({corners[i], corners[j], none}, 2, side);
    }
    return best;
  }

  /// The faces at the feature that are not J's own.
  template <class Function>
  void for_each_face(const Walk_ground& ground, const Function& function) const {
    if (touched_.number == 0)
      return;
    const Vertex moving = ground.moving();
    ground.find_faces(touched_.vertices[0], faces_);
    for (const Face& corners : faces_) {
      const auto has = [&](Vertex v) { return v == corners[0] || v == corners[1] || v == corners[2]; };
      bool meets = true;
      for (int i = 1; i < touched_.number; ++i)
        meets = meets && has(touched_.vertices[i]);
      if (meets && !has(moving)) // a probe's is none
        function(corners);
    }
  }
};

/// What makes Response::paper() complete.
template <>
struct Paper_1997<void> {
  static constexpr bool is_included = true;
  static std::unique_ptr<Other_walk> make_walk() { return std::make_unique<Paper_response>(); }
  static constexpr Response_kind kind{"paper", make_walk};
};

} // namespace haptic_sculpt::internal
