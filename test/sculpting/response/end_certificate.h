// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

/// \file
/// Does a drag end too early? Looks for a free straight way from its end to somewhere nearer to the target: in many
/// random directions, and in those that what is near singles out. Shares the decision whether a way is free with the
/// slide, and nothing else: no contact, no plane, no path. Distance is convex along a segment, so every point of a way
/// that ends nearer is nearer than its start.

#include "oracle/Still_surroundings.h"
#include "sculpting/scene_parts.h"

#include <haptic_sculpt/sculpting.h>

namespace haptic_sculpt::test {

/// What speaks against an end.
struct End_certificate {
  bool asked = false;     ///< the target is farther than 16 clearances: no way can lead nearer by more
  double gain = 0;        ///< how much nearer the best free way leads; 0 where none does by more than 16 clearances
  Point_3 better;         ///< where it leads
  bool is_random = false; ///< whether a random way was enough
  std::size_t ways = 0;   ///< decided
};

class End_certifier {
public:
  static constexpr double least_gain = 16, least_reach = 32, near = 64; ///< clearances
  /// Of the way that was asked for: random ways are no longer.
  static constexpr double longest_part = 1e-2;

  /// The mesh must outlive it and may change between two calls of take().
  explicit End_certifier(const Mesh& mesh)
      : mesh_(&mesh)
      , broad_phase_(mesh)
      , corners_(mesh)
      , guard_(mesh, broad_phase_, corners_, Exact_sweep_traits<Mesh>(&counters_)) {}

  /// \param v is where the drag has left it, all else stands still \param way_asked |T - S|, how far it had to go
  End_certificate certify(Vertex_index v, const Point_3& target, double way_asked, double clearance, double delta,
                          Random& random, std::size_t random_ways = 1000) {
    return certify(v, mesh_->point(v), target, way_asked, clearance, delta, random, random_ways);
  }
  /// \param v null: of a probe \param x where it is
  End_certificate certify(Vertex_index v, const Point_3& x, const Point_3& target, double way_asked, double clearance,
                          double delta, Random& random, std::size_t random_ways = 1000) {
    begin(v, x, target, delta);
    if (!(far_ > least_gain * clearance))
      return found_;
    found_.asked = true;
    least_ = least_gain * clearance;
    try_random(way_asked, clearance, random, random_ways);
    found_.is_random = found_.gain > 0;
    try_near(clearance);
    return found_;
  }

private:
  using Long_vector = std::array<long double, 3>;
  using Coordinates = haptic_sculpt::internal::Coordinates;

  const Mesh* mesh_;
  Brute_force_broad_phase<Mesh> broad_phase_;
  internal::Face_corners<Mesh> corners_;
  Filter_counters counters_;
  internal::Guarded_star<Mesh, Brute_force_broad_phase<Mesh>> guard_;
  Vertex_index v_;
  Coordinates x_{};
  Long_vector pull_{};
  long double far_ = 0;
  double delta_ = 0, least_ = 0;
  End_certificate found_;

  static long double dot(const Long_vector& a, const Long_vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
  static Long_vector cross(const Long_vector& a, const Long_vector& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
  }
  static Long_vector difference(const Point_3& a, const Point_3& b) {
    return {static_cast<long double>(a.x()) - b.x(), static_cast<long double>(a.y()) - b.y(),
            static_cast<long double>(a.z()) - b.z()};
  }
  /// False where the length is zero.
  static bool normalize(Long_vector& a) {
    const long double l = std::sqrt(dot(a, a));
    for (long double& k : a)
      k /= l;
    return l > 0;
  }

  void begin(Vertex_index v, const Point_3& x, const Point_3& target, double delta) {
    corners_ = internal::Face_corners<Mesh>(*mesh_);
    if (v.is_valid()) {
      guard_.collect(v);
    } else {
      guard_.star().clear();
      guard_.invalidate();
    }
    v_ = v;
    x_ = {x.x(), x.y(), x.z()};
    delta_ = delta;
    pull_ = difference(target, x);
    far_ = std::sqrt(dot(pull_, pull_));
    found_ = End_certificate();
  }

  /// Whether it would be an improvement, and was decided.
  bool try_way(const Long_vector& direction, long double length) {
    Coordinates y;
    Long_vector step;
    for (int i = 0; i < 3; ++i) {
      y[i] = static_cast<double>(x_[i] + length * direction[i]);
      step[i] = static_cast<long double>(y[i]) - x_[i];
    }
    Long_vector rest;
    for (int i = 0; i < 3; ++i)
      rest[i] = pull_[i] - step[i];
    const long double left = std::sqrt(dot(rest, rest)),
                      gain = (2 * dot(step, pull_) - dot(step, step)) / (far_ + left);
    if (!(gain > std::fmax(least_, found_.gain)))
      return false;
    ++found_.ways;
    if (guard_.is_free(x_, y, delta_)) {
      found_.gain = static_cast<double>(gain);
      found_.better = Point_3(y[0], y[1], y[2]);
    }
    return true;
  }

  void try_random(double way_asked, double clearance, Random& random, std::size_t random_ways) {
    const double shortest = least_reach * clearance;
    const double longest = std::fmax(shortest, std::fmin(longest_part * way_asked, 2 * static_cast<double>(far_)));
    for (std::size_t done = 0, drawn = 0; done < random_ways && drawn < 100 * random_ways; ++drawn) {
      const Vector_3 d = uniform_direction(random);
      Long_vector direction = {d.x(), d.y(), d.z()};
      if (dot(direction, pull_) < 0)
        for (long double& k : direction)
          k = -k;
      done += try_way(direction, shortest * std::pow(longest / shortest, uniform(random, 0, 1)));
    }
  }

  /// Ways of several lengths, up to where the target is nearest.
  void try_both_ways(Long_vector direction, double clearance) {
    if (!normalize(direction))
      return;
    long double along = dot(direction, pull_);
    if (along < 0) {
      along = -along;
      for (long double& k : direction)
        k = -k;
    }
    for (long double length = along; length > least_reach / 2 * clearance; length /= 5)
      try_way(direction, length);
  }

  /// Along the planes near by, the lines in which two of them meet, and the edges; past the corners.
  void try_near(double clearance) {
    const Still_surroundings<meshes::Kernel> around(*mesh_, v_);
    const Point_3 x(x_[0], x_[1], x_[2]);
    std::vector<Long_vector> normals, edges;
    const auto add = [](std::vector<Long_vector>& list, Long_vector a, std::size_t most) {
      constexpr long double alike = 1e-30L; // of the square of a sine
      if (list.size() >= most || !normalize(a))
        return;
      for (const Long_vector& b : list) {
        const Long_vector n = cross(a, b);
        if (dot(n, n) < alike)
          return;
      }
      list.push_back(a);
    };
    try_both_ways(pull_, clearance);
    for (const Facet_near& f : around.facets_near(x, near * clearance)) {
      constexpr std::size_t most_normals = 12, most_edges = 40;
      add(normals, f.normal, most_normals);
      const auto point = [&](int i) {
        return mesh_->point(Vertex_index(static_cast<Mesh::size_type>(f.vertices[static_cast<std::size_t>(i)])));
      };
      for (int i = 0; i < 3; ++i) {
        add(edges, difference(point((i + 1) % 3), point(i)), most_edges);
        try_both_ways(difference(point(i), x), clearance);
      }
    }
    for (const Vertex_index w : guard_.star().link)
      add(edges, difference(mesh_->point(w), x), 40);
    for (std::size_t i = 0; i < normals.size(); ++i) {
      Long_vector in_plane = pull_;
      const long double height = dot(pull_, normals[i]);
      for (int k = 0; k < 3; ++k)
        in_plane[k] -= height * normals[i][k];
      try_both_ways(in_plane, clearance);
      for (std::size_t j = 0; j < i; ++j)
        try_both_ways(cross(normals[i], normals[j]), clearance);
    }
    for (const Long_vector& edge : edges)
      try_both_ways(edge, clearance);
  }
};

} // namespace haptic_sculpt::test
