// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/sculpting/geometry/vector_3.h>

#include <cstddef>
#include <vector>

namespace haptic_sculpt::internal {

/// One half-space { d : normal . d >= least } of displacements.
struct Half_space {
  Vector normal; ///< of length 1
  double least;
};

/// The permitted displacement nearest to a wanted one, and the half-spaces that hold it there.
struct Nearest_permitted {
  bool exists = false;
  Vector displacement{};
  std::array<std::size_t, 3> active{}; ///< the first `number_active` are positions in the list of half-spaces
  int number_active = 0;
  bool is_squeezed = false; ///< less than the wanted distance is kept, for lack of room; for the caller to set
};

namespace nearest_permitted_detail {

/// How flat the corner of two or three planes may be, as the sine of an angle or the volume of their normals, before
/// they count as one plane or line: below, the meeting of the planes is lost in the rounding of their normals.
constexpr double least_independence = 0x1p-48;

/// Mends what rounding has left, by a step of iterative refinement: where planes are all but parallel, all of the
/// digits of their meeting may be lost at first.
inline void refine(Vector& d, const Half_space& a) {
  d = advanced(d, a.least - dot(a.normal, d), a.normal);
}

} // namespace nearest_permitted_detail

/// The nearest point of a convex polyhedron to a given one: minimizes |d - wanted| over all d with normal_i . d >=
/// least_i - slack.
///
/// By enumeration of active sets of one, two and three half-spaces: the first that is feasible and has no negative
/// multiplier is the optimum, which is unique. \param spaces there are n \param slack a length, > 0: rounding of what
/// the caller measured \param slack_there the same at the end of a constrained way, where that of the normals is felt
/// too
/// Cost: cubic in the number of half-spaces. Floating point; proposes only. A polyhedron without a point: `exists` is
/// false.
inline Nearest_permitted nearest_permitted(const Vector& wanted, const Half_space* spaces, std::size_t n, double slack,
                                           double slack_there) {
  using namespace nearest_permitted_detail;
  Nearest_permitted result;
  const auto accept = [&](const Vector& d, std::array<std::size_t, 3> active, int number) {
    for (std::size_t i = 0; i < n; ++i)
      if (!(dot(spaces[i].normal, d) >= spaces[i].least - (number > 0 ? slack_there : slack)))
        return false;
    result = {true, d, active, number, false};
    return true;
  };
  if (accept(wanted, {}, 0))
    return result;
  for (std::size_t i = 0; i < n; ++i) {
    if (dot(spaces[i].normal, wanted) >= spaces[i].least)
      continue;
    Vector d = wanted;
    refine(d, spaces[i]);
    refine(d, spaces[i]);
    if (accept(d, {i}, 1))
      return result;
  }
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = i + 1; j < n; ++j) {
      const Half_space &a = spaces[i], &b = spaces[j];
      const Vector axis = cross(a.normal, b.normal);
      const double square = dot(axis, axis);
      if (square < least_independence * least_independence)
        continue;
      const double missing_a = a.least - dot(a.normal, wanted), missing_b = b.least - dot(b.normal, wanted);
      const double cosine = dot(a.normal, b.normal);
      if (std::fma(-cosine, missing_b, missing_a) < 0 || std::fma(-cosine, missing_a, missing_b) < 0)
        continue;
      // The point of the common line nearest to 0, and the way along the line.
      const Vector along_a = cross(b.normal, axis), along_b = cross(axis, a.normal);
      Vector d = scaled(combined(a.least, along_a, b.least, along_b), 1 / square);
      d = advanced(d, dot(axis, wanted) / square, axis);
      d = advanced(d, 1 / square, combined(a.least - dot(a.normal, d), along_a, b.least - dot(b.normal, d), along_b));
      if (accept(d, {i, j}, 2))
        return result;
    }
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = i + 1; j < n; ++j)
      for (std::size_t k = j + 1; k < n; ++k) {
        const Half_space &a = spaces[i], &b = spaces[j], &c = spaces[k];
        const Vector ab = cross(a.normal, b.normal), bc = cross(b.normal, c.normal), ca = cross(c.normal, a.normal);
        const double volume = dot(ab, c.normal);
        if (std::abs(volume) < least_independence)
          continue;
        const auto corner = [&](double of_a, double of_b, double of_c) {
          return advanced(combined(of_a, bc, of_b, ca), of_c, ab);
        };
        Vector d = scaled(corner(a.least, b.least, c.least), 1 / volume);
        d = advanced(d, 1 / volume,
                     corner(a.least - dot(a.normal, d), b.least - dot(b.normal, d), c.least - dot(c.normal, d)));
        const Vector push = minus(d, wanted);
        if (dot(push, bc) / volume < 0 || dot(push, ca) / volume < 0 || dot(push, ab) / volume < 0)
          continue;
        if (accept(d, {i, j, k}, 3))
          return result;
      }
  return result;
}

/// The distance from `pull` to the cone of all combinations of `-normals` with weights >= 0, over |pull|: 0 where the
/// contacts hold the vertex at a constrained nearest point to its target, 1 where none of them resists.
///
/// By Moreau's decomposition it is the length of the part of the pull that the contacts permit: the projection of the
/// pull on the polar cone, which is that of the displacements d with normal . d >= 0. \param half_spaces those, `least`
/// being 0 Cost: that of nearest_permitted(). Floating point.
inline double kkt_residual(const Vector& pull, const std::vector<Half_space>& half_spaces) {
  // What rounding leaves of a product of a normal and a direction of length 1, and of the meeting of nearly parallel
  // planes.
  constexpr double slack = 0x1p-46;
  const double pull_length = length(pull);
  if (pull_length == 0)
    return 0;
  const double unit = unit_of(pull_length); // the inverse of a subnormal number overflows
  const Nearest_permitted permitted =
      nearest_permitted(scaled(scaled(pull, unit), 1 / (pull_length * unit)), half_spaces.data(), half_spaces.size(),
                        slack, slack);
  return permitted.exists ? std::fmin(1.0, length(permitted.displacement)) : 0;
}

} // namespace haptic_sculpt::internal
