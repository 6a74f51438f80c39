// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

/// \file
/// Does a mesh stay embedded while one of its vertices moves along a segment? Decided by integers, from nothing but the
/// definition: no sweep test, no lemma about what has to be hit first, nothing of the library, nothing of CGAL.

#include <oracle/exact_triangles.h>

#include <map>
#include <optional>
#include <set>

namespace oracle {

/// A time in [0, 1] as a fraction.
template <class Integer>
struct Time {
  Integer numerator, denominator; // > 0
  friend bool operator<(const Time& s, const Time& t) {
    return s.numerator * t.denominator < t.numerator * s.denominator;
  }
};

inline __int128 greatest_divisor(__int128 a, __int128 b) {
  while (b != 0)
    std::swap(a %= b, b);
  return a < 0 ? -a : a;
}
inline mpz_class greatest_divisor(const mpz_class& a, const mpz_class& b) {
  return gcd(a, b);
}

/// Signs of points of which one, J, is at S + u (T - S). Every determinant in which J stands once is affine in u, so
/// its value at u comes from those at S and T. Signs without J are asked of the points as they stand.
template <class Integer>
class Moving_signs {
public:
  using Points = std::vector<Point<Integer>>;

  /// \param points with J at S
  Moving_signs(const Points& points, int moving, const Point<Integer>& target)
      : points_(points), J_(moving), T_(target), still_{points_} {}

  void set_time(const Time<Integer>& u) {
    p_ = u.numerator;
    r_ = u.denominator - u.numerator;
  }

  int orient_3(int a, int b, int c, int d) const {
    // J to the front: an odd permutation where it stands second or fourth.
    if (a == J_)
      return at_time(ends_3(b, c, d));
    if (b == J_)
      return -at_time(ends_3(a, c, d));
    if (c == J_)
      return at_time(ends_3(a, b, d));
    if (d == J_)
      return -at_time(ends_3(a, b, c));
    return still_.orient_3(a, b, c, d);
  }
  int orient_2(int axis, int a, int b, int c) const {
    if (a == J_)
      return at_time(ends_2(axis, b, c));
    if (b == J_)
      return at_time(ends_2(axis, c, a));
    if (c == J_)
      return at_time(ends_2(axis, a, b));
    return still_.orient_2(axis, a, b, c);
  }
  int compare(int axis, int a, int b) const {
    if (a == J_)
      return at_time(ends_1(axis, b));
    if (b == J_)
      return -at_time(ends_1(axis, a));
    return still_.compare(axis, a, b);
  }

  /// Values at S and at T.
  using Ends = std::pair<Integer, Integer>;
  const Ends& ends_3(int a, int b, int c) const {
    const auto [place, is_new] = ends_3_.try_emplace({a, b, c});
    if (is_new)
      place->second = {determinant_3(points_[J_], points_[a], points_[b], points_[c]),
                       determinant_3(T_, points_[a], points_[b], points_[c])};
    return place->second;
  }
  Ends ends_2(int axis, int a, int b) const {
    return {determinant_2(axis, points_[J_], points_[a], points_[b]), determinant_2(axis, T_, points_[a], points_[b])};
  }
  Ends ends_1(int axis, int a) const { return {points_[J_][axis] - points_[a][axis], T_[axis] - points_[a][axis]}; }
  const Still_signs<Integer>& still() const { return still_; }

private:
  int at_time(const Ends& ends) const { return sign_of(Integer(r_ * ends.first + p_ * ends.second)); }

  const Points& points_;
  int J_;
  Point<Integer> T_;
  Still_signs<Integer> still_;
  Integer p_ = 0, r_ = 1;
  mutable std::map<std::array<int, 3>, Ends> ends_3_;
};

/// See `first_time_not_embedded()`.
template <class Integer>
class Embedded_motion {
  using Signs = Moving_signs<Integer>;

public:
  Embedded_motion(const std::vector<Point<Integer>>& points, const std::vector<Corner_indices>& faces, int moving,
                  const Point<Integer>& target, bool isolated_are_obstacles)
      : points_(points), faces_(faces), J_(moving), target_(target), isolated_are_obstacles_(isolated_are_obstacles),
        signs_(points, moving, target) {}

  std::optional<Time<Integer>> first_failure() {
    std::vector<std::size_t> star, rest;
    for (std::size_t f = 0; f < faces_.size(); ++f)
      (has(faces_[f], J_) ? star : rest).push_back(f);
    if (!still_part_is_embedded(rest))
      return Time<Integer>{0, 1};
    for (const std::size_t f : star)
      look_for_degeneracy(faces_[f]);
    for (std::size_t i = 0; i < star.size(); ++i) {
      const Corner_indices& f = faces_[star[i]];
      for (std::size_t k = i + 1; k < star.size(); ++k)
        look_for_failure(f, faces_[star[k]]);
      for (const std::size_t g : rest)
        if (boxes_meet(f, faces_[g]))
          look_for_failure(f, faces_[g]);
    }
    if (star.empty()) // a probe, which may not touch a face
      for (const std::size_t g : rest)
        look_for_failure({J_, J_, J_}, faces_[g]);
    if (isolated_are_obstacles_)
      for (const int a : isolated())
        for (const std::size_t f : star)
          look_for_failure(faces_[f], {a, a, a});
    return first_;
  }

private:
  std::vector<int> isolated() const {
    std::vector<bool> is_used(points_.size(), false);
    for (const Corner_indices& f : faces_)
      for (const int v : f)
        is_used[static_cast<std::size_t>(v)] = true;
    std::vector<int> found;
    for (int v = 0; v < static_cast<int>(points_.size()); ++v)
      if (!is_used[static_cast<std::size_t>(v)] && v != J_)
        found.push_back(v);
    return found;
  }

  static bool has(const Corner_indices& f, int v) { return f[0] == v || f[1] == v || f[2] == v; }

  bool still_part_is_embedded(const std::vector<std::size_t>& rest) const {
    for (std::size_t i = 0; i < rest.size(); ++i) {
      const Corner_indices& f = faces_[rest[i]];
      if (on_one_line(signs_.still(), f[0], f[1], f[2]))
        return false;
      for (std::size_t k = 0; k < i; ++k)
        if (boxes_meet(f, faces_[rest[k]]) && triangles_meet_improperly(signs_.still(), f, faces_[rest[k]]))
          return false;
    }
    return true;
  }

  // Boxes of all places of the faces; sharing a vertex they meet.
  bool boxes_meet(const Corner_indices& f, const Corner_indices& g) const {
    for (int axis = 0; axis < 3; ++axis) {
      const auto [f_low, f_high] = extent(f, axis);
      const auto [g_low, g_high] = extent(g, axis);
      if (f_high < g_low || g_high < f_low)
        return false;
    }
    return true;
  }
  std::pair<Integer, Integer> extent(const Corner_indices& f, int axis) const {
    Integer low = points_[f[0]][axis], high = low;
    const auto widen = [&](const Integer& x) {
      low = x < low ? x : low;
      high = high < x ? x : high;
    };
    for (const int v : f) {
      widen(points_[v][axis]);
      if (v == J_)
        widen(target_[axis]);
    }
    return {low, high};
  }

  void fails_at(const Time<Integer>& u) {
    if (!first_ || u < *first_)
      first_ = u;
  }

  // The time, if it is in [0, 1], at which a value that is affine in time and not always 0 vanishes.
  static std::optional<Time<Integer>> root(const typename Signs::Ends& ends) {
    const int s = sign_of(ends.first), t = sign_of(ends.second);
    if (s * t > 0 || (s == 0 && t == 0))
      return std::nullopt;
    Integer p = s < 0 ? Integer(-ends.first) : ends.first, q = p + (t < 0 ? Integer(-ends.second) : ends.second);
    const Integer divisor = greatest_divisor(p, q);
    return Time<Integer>{Integer(p / divisor), Integer(q / divisor)};
  }

  // A triangle that moves is degenerate where the three components of its normal, affine in time, vanish together.
  void look_for_degeneracy(Corner_indices f) {
    while (f[0] != J_)
      std::rotate(f.begin(), f.begin() + 1, f.end());
    std::set<Time<Integer>> times{{0, 1}};
    for (int axis = 0; axis < 3; ++axis)
      if (const auto u = root(signs_.ends_2(axis, f[1], f[2])))
        times.insert(*u);
    for (const auto& u : times) {
      signs_.set_time(u);
      if (on_one_line(signs_, f[0], f[1], f[2]))
        return fails_at(u);
    }
  }

  bool fails(const Time<Integer>& u, const Corner_indices& f, const Corner_indices& g) {
    signs_.set_time(u);
    if (f[0] == f[1])
      return point_in_triangle(signs_, f[0], g[0], g[1], g[2]);
    if (g[0] == g[1])
      return on_one_line(signs_, f[0], f[1], f[2]) || point_in_triangle(signs_, g[0], f[0], f[1], f[2]);
    // A degenerate triangle is a failure; it is found by the search for those, and kept from the tests here.
    return on_one_line(signs_, f[0], f[1], f[2]) || on_one_line(signs_, g[0], g[1], g[2]) ||
           triangles_meet_improperly(signs_, f, g);
  }

  // f moves. Between two critical times of the pair no sign that its test could ask changes.
  void look_for_failure(const Corner_indices& f, const Corner_indices& g) {
    std::vector<int> others;
    for (const Corner_indices& t : {f, g})
      for (const int v : t)
        if (v != J_ && std::find(others.begin(), others.end(), v) == others.end())
          others.push_back(v);
    std::set<Time<Integer>> times{{0, 1}, {1, 1}};
    const auto add_root = [&](const typename Signs::Ends& ends) {
      if (const auto u = root(ends))
        times.insert(*u);
    };
    bool flat = false;
    const std::size_t n = others.size();
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t k = i + 1; k < n; ++k)
        for (std::size_t l = k + 1; l < n; ++l) {
          const auto& ends = signs_.ends_3(others[i], others[k], others[l]);
          add_root(ends);
          flat |= sign_of(ends.first) == 0 && sign_of(ends.second) == 0;
        }
    // Only where J moves in a plane of the others are its planar signs asked all the time, and then all may be.
    for (std::size_t i = 0; flat && i < n; ++i)
      for (int axis = 0; axis < 3; ++axis) {
        add_root(signs_.ends_1(axis, others[i]));
        for (std::size_t k = i + 1; k < n; ++k)
          add_root(signs_.ends_2(axis, others[i], others[k]));
      }
    const Time<Integer>* before = nullptr;
    for (const auto& u : times) {
      if (before) {
        const Time<Integer> between{before->numerator + u.numerator, before->denominator + u.denominator};
        if (first_ && !(between < *first_))
          return;
        if (fails(between, f, g)) // closed sets that meet all the way from a time on meet at that time
          throw std::logic_error("embedding oracle: a failure between two critical times that did not begin at one");
      }
      if (first_ && !(u < *first_))
        return;
      if (fails(u, f, g))
        return fails_at(u);
      before = &u;
    }
  }

  const std::vector<Point<Integer>>& points_;
  const std::vector<Corner_indices>& faces_;
  int J_;
  Point<Integer> target_;
  bool isolated_are_obstacles_;
  Signs signs_;
  std::optional<Time<Integer>> first_;
};

inline mpz_class to_mpz(const mpz_class& x) {
  return x;
}
inline mpz_class to_mpz(__int128 x) {
  const bool negative = x < 0;
  const auto magnitude = static_cast<unsigned __int128>(negative ? -x : x);
  mpz_class high(static_cast<unsigned long>(magnitude >> 64)), low(static_cast<unsigned long>(magnitude));
  mpz_class found = (high << 64) + low;
  return negative ? mpz_class(-found) : found;
}

/// Moves vertex J of a mesh from where it stands to T, all else still, and decides whether the mesh is embedded (no
/// face degenerate, closed faces meet only in shared vertices and edges) at every time u in [0, 1].
///
/// Every pair of faces of which one moves is tested at each critical time of the pair (each root of a determinant of J
/// with others of its vertices) and between any two; every other pair once. A vertex without faces is a probe: it may
/// not touch a face. Other isolated vertices are no part of the surface.
/// \param isolated_are_obstacles whether it is a failure, too, that a moving face touches one of those
/// \return nothing if it is embedded throughout, else the least u at which it is not (the failures are a closed set)
inline std::optional<mpq_class> first_time_not_embedded(const Mesh_list& mesh, int J, const std::array<double, 3>& T,
                                                        bool isolated_are_obstacles = false) {
  auto with_target = mesh.points;
  with_target.push_back(T);
  std::vector<Point<mpz_class>> points = scaled_to_integers(with_target);
  std::size_t bits = 0;
  for (const auto& p : points)
    for (const auto& x : p)
      bits = std::max(bits, x == 0 ? 0 : mpz_sizeinbase(x.get_mpz_t(), 2));
  const auto answer = [&](auto& all) -> std::optional<mpq_class> {
    const auto target = all.back();
    all.pop_back();
    using Integer = typename std::decay_t<decltype(target)>::value_type;
    if (const auto u = Embedded_motion<Integer>(all, mesh.faces, J, target, isolated_are_obstacles).first_failure())
      return mpq_class(to_mpz(u->numerator), to_mpz(u->denominator));
    return std::nullopt;
  };
  // A determinant has 3 b + 6 bits, its value at a time twice that and 2 more: 18 bits fit in 128.
  if (bits > 18)
    return answer(points);
  std::vector<Point<__int128>> small;
  for (const auto& p : points)
    small.push_back({p[0].get_si(), p[1].get_si(), p[2].get_si()});
  return answer(small);
}

/// Whether the mesh is an embedded closed 2-manifold: every edge has two faces of opposite direction, the faces around
/// a vertex form one cycle, no face is degenerate, all pairs meet properly. Isolated vertices are no part of it.
inline bool is_embedded_closed_manifold(const Mesh_list& mesh) {
  std::map<std::pair<int, int>, int> directed;
  std::map<int, std::map<int, int>> next_around; // vertex -> (corner after -> corner before)
  for (const auto& f : mesh.faces)
    for (int i = 0; i < 3; ++i) {
      const int a = f[i], b = f[(i + 1) % 3], c = f[(i + 2) % 3];
      if (a == b || ++directed[{a, b}] > 1)
        return false;
      next_around[a][b] = c;
    }
  for (const auto& [edge, count] : directed)
    if (directed.count({edge.second, edge.first}) == 0)
      return false;
  for (const auto& [v, next] : next_around) {
    std::size_t steps = 0;
    int at = next.begin()->first;
    do {
      const auto place = next.find(at);
      if (place == next.end())
        return false;
      at = place->second;
      ++steps;
    } while (at != next.begin()->first && steps <= next.size());
    if (steps != next.size())
      return false;
  }
  const auto points = scaled_to_integers(mesh.points);
  const Still_signs<mpz_class> signs{points};
  for (const auto& f : mesh.faces)
    if (on_one_line(signs, f[0], f[1], f[2]))
      return false;
  return improper_pairs(mesh).empty();
}

/// The mesh with J moved to its neighbour P and edge JP collapsed: faces with both vanish, in the others J becomes P.
inline Mesh_list collapsed(const Mesh_list& mesh, int J, int P) {
  Mesh_list result{mesh.points, {}};
  for (Corner_indices f : mesh.faces) {
    const bool has_J = std::count(f.begin(), f.end(), J), has_P = std::count(f.begin(), f.end(), P);
    if (has_J && has_P)
      continue;
    std::replace(f.begin(), f.end(), J, P);
    result.faces.push_back(f);
  }
  return result;
}

/// Whether J can be moved to its neighbour P and edge JP collapsed: the mesh is embedded for all u < 1, and collapsed
/// it is an embedded closed 2-manifold.
inline bool collapse_stays_embedded(const Mesh_list& mesh, int J, int P) {
  const auto failure = first_time_not_embedded(mesh, J, mesh.points[P]);
  return (!failure || *failure >= 1) && is_embedded_closed_manifold(collapsed(mesh, J, P));
}

} // namespace oracle
