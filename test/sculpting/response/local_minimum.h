// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

/// \file
/// Is the end of a drag a constrained local minimum of the distance to the target? From outside of a solid no end is
/// the only right one, but this can be asked of each: the pull lies in the cone of the contacts' normals, and no short
/// free way leads anywhere nearer. Distance is convex along a segment, so *any* free straight way to a nearer point,
/// long or short, shows that the end is none.

#include "oracle/Still_surroundings.h"
#include "oracle/constrained_optimum.h"
#include "sculpting/scene_parts.h"

namespace haptic_sculpt::test {

using Surroundings = Still_surroundings<meshes::Kernel>;

/// What speaks for and against an end.
struct Local_minimum_check {
  bool asked = false;           ///< the target is farther than 16 clearances: shorter pulls say nothing
  double kkt_residual = 0;      ///< from normals computed anew
  bool wrong_contact = false;   ///< a contact that is not there: too far, on the wrong side, or with another normal
  bool only_flat = false;       ///< a flat impact is among what holds it, and without those the pull is not in the cone
  double slack =
      0; ///< L: how far the end is from the optimum of its own contacts at clearance 0; 0 where those do not hold it
  double allowed = 0;           ///< gains below max(8 c, 4 L) are the clearance's
  double random_gain = 0,
         directed_gain = 0;     ///< how much nearer the best free way leads, less what is allowed; > 0: a fault
  Point_3 better;               ///< where the best free way leads
  std::size_t ways = 0, oracle_disagrees = 0;
};

namespace internal_minimum {

using Long_vector = std::array<long double, 3>;

inline long double dot(const Long_vector& a, const Long_vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

inline Long_vector long_difference(const Point_3& a, const Point_3& b) {
  return {static_cast<long double>(a.x()) - b.x(), static_cast<long double>(a.y()) - b.y(),
          static_cast<long double>(a.z()) - b.z()};
}

/// What is left of v when everything along up to three vectors is taken away (Gram and Schmidt, twice). Tells the
/// weights.
inline Long_vector without(Long_vector v, const std::vector<Long_vector>& along) {
  std::vector<Long_vector> base;
  for (Long_vector a : along) {
    for (int twice = 0; twice < 2; ++twice)
      for (const Long_vector& b : base) {
        const long double w = dot(a, b);
        for (int k = 0; k < 3; ++k)
          a[k] -= w * b[k];
      }
    const long double l = std::sqrt(dot(a, a));
    if (l < 1e-12L)
      continue;
    for (long double& k : a)
      k /= l;
    base.push_back(a);
  }
  if (base.size() == 3)
    return {0, 0, 0};
  for (int twice = 0; twice < 2; ++twice)
    for (const Long_vector& b : base) {
      const long double w = dot(v, b);
      for (int k = 0; k < 3; ++k)
        v[k] -= w * b[k];
    }
  return v;
}

/// |nearest point to the pull among the directions that no normal forbids| / |pull|. By Moreau's decomposition that is
/// the distance from the pull to the cone of -normals, found here from the other side than by the library.
inline double residual(const Long_vector& pull, const std::vector<Long_vector>& normals) {
  const long double size = std::sqrt(dot(pull, pull));
  Long_vector d = pull;
  for (long double& k : d)
    k /= size;
  long double best = 1;
  Long_vector nearest{};
  const std::size_t n = normals.size();
  // The nearest direction lies in the intersection of up to three planes, and no plane forbids it; of all such the
  // longest.
  long double longest = -1;
  constexpr long double rounding = 1e-15L;
  const auto consider = [&](const std::vector<Long_vector>& planes) {
    const Long_vector z = without(d, planes);
    for (const Long_vector& m : normals)
      if (dot(m, z) < -rounding)
        return;
    const long double l = std::sqrt(dot(z, z));
    if (l > longest) {
      longest = l;
      nearest = z;
    }
  };
  consider({});
  for (std::size_t i = 0; i < n; ++i) {
    consider({normals[i]});
    for (std::size_t j = i + 1; j < n; ++j)
      consider({normals[i], normals[j]});
  }
  best = std::fmax(longest, 0.0L); // z = 0 is always permitted
  return static_cast<double>(best);
}

} // namespace internal_minimum

/// \param random_ways how many random directions and lengths are tried, \param oracle_every every how many of them the
/// oracle of the sweeps is asked too (0: never)
template <class Result>
Local_minimum_check check_local_minimum(const Surroundings& around, const Mesh& mesh, const Result& result,
                                        const Point_3& target, double c, Random& random, int random_ways = 64,
                                        int oracle_every = 0) {
  using namespace internal_minimum;
  Local_minimum_check check;
  const Point_3 x = result.position;
  const Long_vector pull = long_difference(target, x);
  const long double far = std::sqrt(dot(pull, pull));
  constexpr double shortest = 16;
  if (!(far > shortest * c))
    return check;
  check.asked = true;

  std::vector<Long_vector> normals, flat_too;
  std::vector<Half_space> planes;
  for (const auto& contact : result.contacts) {
    Long_vector claimed = {contact.normal[0], contact.normal[1], contact.normal[2]};
    if (contact.is_flat || contact.kind == Contact_kind::delta) {
      flat_too.push_back(claimed);
      continue;
    }
    const Point_3 a = mesh.point(contact.vertices[0]), b = mesh.point(contact.vertices[1]),
                  p = mesh.point(contact.vertices[2]);
    const Long_vector ab = long_difference(b, a), ap = long_difference(p, a), ax = long_difference(x, a);
    Long_vector n = {ab[1] * ap[2] - ab[2] * ap[1], ab[2] * ap[0] - ab[0] * ap[2], ab[0] * ap[1] - ab[1] * ap[0]};
    const int side = CGAL::orientation(a, b, p, x);
    const long double size = std::sqrt(dot(n, n));
    for (long double& k : n)
      k *= side / size;
    const long double height = dot(n, ax);
    constexpr double lifted = 8, normal_rounding = 1e-12;
    check.wrong_contact |=
        side == 0 || side != contact.side ||
        height > lifted * c + 4 * internal::unit_in_the_last_place(
                                      haptic_sculpt::internal::largest_magnitude({x.x(), x.y(), x.z()})) ||
        !(dot(n, claimed) > 1 - normal_rounding);
    normals.push_back(n);
    flat_too.push_back(n);
    planes.push_back(
        {{std::array<double, 3>{a.x(), a.y(), a.z()}, {b.x(), b.y(), b.z()}, {p.x(), p.y(), p.z()}}, side});
  }
  check.kkt_residual = residual(pull, flat_too);
  check.only_flat = residual(pull, normals) > check.kkt_residual + 1e-10;
  // Contacts that do not hold it determine no optimum, and L would excuse anything.
  constexpr double held = 1e-6;
  if (!check.wrong_contact && !planes.empty() && check.kkt_residual <= held)
    check.slack = distance(Offset_half_spaces(planes, 0).nearest({target.x(), target.y(), target.z()}).point,
                           rational(std::array<double, 3>{x.x(), x.y(), x.z()}));
  check.allowed = std::fmax(8 * c, 4 * check.slack);

  double random_gain = 0, directed_gain = 0;
  const auto try_way = [&](const Long_vector& direction, long double length, double& gain, bool ask_oracle) {
    const Point_3 y(static_cast<double>(x.x() + length * direction[0]),
                    static_cast<double>(x.y() + length * direction[1]),
                    static_cast<double>(x.z() + length * direction[2]));
    const Long_vector rest = long_difference(target, y);
    const double nearer = static_cast<double>(far - std::sqrt(dot(rest, rest)));
    if (y == x || (!ask_oracle && nearer <= std::fmax(check.allowed, gain)))
      return;
    const bool free = around.is_free(x, y);
    ++check.ways;
    if (ask_oracle && around.is_free_by_oracle(x, y) != free)
      ++check.oracle_disagrees;
    if (free && nearer > std::fmax(check.allowed, gain)) {
      gain = nearer;
      check.better = y;
    }
  };
  for (int i = 0; i < random_ways; ++i) {
    const Vector_3 d = uniform_direction(random);
    Long_vector direction = {d.x(), d.y(), d.z()};
    if (dot(direction, pull) < 0)
      for (long double& k : direction)
        k = -k;
    const double length =
        shortest * c * std::exp(uniform(random, 0, 1) * std::log(static_cast<double>(far) / (shortest * c)));
    try_way(direction, length, random_gain, oracle_every != 0 && i % oracle_every == 0);
  }
  // On purpose: along the planes of the facets near by, one or two at a time, to where these alone would let it go.
  std::vector<Long_vector> near;
  for (const Facet_near& f : around.facets_near(x, 4 * shortest * c))
    if (near.size() < 12)
      near.push_back(f.normal);
  const auto try_along = [&](const std::vector<Long_vector>& along) {
    Long_vector direction = without(pull, along);
    const long double way = std::sqrt(dot(direction, direction));
    if (!(way > 0))
      return;
    for (long double& k : direction)
      k /= way;
    for (const long double length :
         {way, way / 8, way / 64, std::sqrt(way * shortest * c), 32 * static_cast<long double>(shortest) * c})
      if (length <= way)
        try_way(direction, length, directed_gain, false);
  };
  try_along({});
  for (std::size_t i = 0; i < near.size(); ++i) {
    try_along({near[i]});
    for (std::size_t j = i + 1; j < near.size(); ++j)
      try_along({near[i], near[j]});
  }
  check.random_gain = random_gain;
  check.directed_gain = directed_gain;
  return check;
}

} // namespace haptic_sculpt::test
