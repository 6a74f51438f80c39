// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

/// \file
/// The three sweeps on plain coordinates: whether and when. Why these signs decide: doc/proofs/exact_sweeps.md.

#include <haptic_sculpt/collision/arithmetic/flat_sweep.h>

namespace haptic_sculpt::internal {

/// Whether both signs are on one strict side.
inline bool same_side(int a, int b) { return a * b > 0; }

/// Whether a line that crosses the plane of a triangle passes through the closed triangle, from its sides of the three
/// edges. In the plane of the triangle the three signs belong to barycentric coordinates of one point.
inline bool passes_through(int ab, int bc, int ca) {
  return (ab >= 0 && bc >= 0 && ca >= 0) || (ab <= 0 && bc <= 0 && ca <= 0);
}

template <class... Determinants>
bool are_nonzero(const Determinants&... determinants) {
  return (static_cast<int>(determinants.is_nonzero()) & ...) != 0;
}

/// Whether all determinants have one sign. \pre are_nonzero(first, others...)
template <class... Determinants>
bool have_one_sign(const Enclosed_determinant& first, const Determinants&... others) {
  return (static_cast<int>((first.value > 0) == (others.value > 0)) & ...) != 0;
}

/// A hit whose time is that of the moving vertex entering the plane of the three static points.
inline Sweep_verdict plane_hit() {
  Sweep_verdict verdict;
  verdict.hits = true;
  verdict.form = Time_form::plane;
  verdict.through = {2, 3, 4};
  return verdict;
}

// Each sweep comes twice: from signs that may be zero, exact to the last; and before it from doubles alone, where all
// signs are certain and none is zero, which is nearly always. The second evaluates determinants in groups without a
// branch in between, for a mispredicted branch costs more than a determinant.

/// Points S, T, A, B, C: segment ST against triangle ABC.
template <class Counters>
HAPTIC_SCULPT_NOINLINE Sweep_verdict careful_vertex_face_verdict(const Sweep_points& p, Counters& counters) {
  Sweep_signs<Counters> signs(p, counters);
  constexpr int s = 0, t = 1, a = 2, b = 3, c = 4;
  const int start = signs.orientation_3(a, b, c, s);
  const int target = signs.orientation_3(a, b, c, t);
  if (same_side(start, target))
    return {};
  const int ab = signs.orientation_3(s, t, a, b);
  const int bc = signs.orientation_3(s, t, b, c);
  if (ab * bc < 0)
    return {};
  const int ca = signs.orientation_3(s, t, c, a);
  if (!passes_through(ab, bc, ca))
    return {};
  if (start == 0 && target == 0) {
    // Either all five points are coplanar, or A, B, C are collinear and ST passes their line.
    if (ab != 0 || bc != 0 || ca != 0)
      return {};
    return Flat_sweep<Counters>(p, signs).vertex_face(a, b, c);
  }
  Sweep_verdict verdict = plane_hit();
  verdict.location = Flat_sweep<Counters>::location_from_signs(ab, bc, ca);
  return verdict;
}

template <class Counters>
Sweep_verdict vertex_face_verdict(const Sweep_points& p, Counters& counters) {
  const auto& [s, t, a, b, c] = p;
  const Enclosed_determinant start = enclosed_orientation_3(a, b, c, s), target = enclosed_orientation_3(a, b, c, t);
  if (are_nonzero(start, target)) {
    if (have_one_sign(start, target))
      return {};
    const Enclosed_determinant ab = enclosed_orientation_3(s, t, a, b), bc = enclosed_orientation_3(s, t, b, c),
                               ca = enclosed_orientation_3(s, t, c, a);
    if (are_nonzero(ab, bc, ca))
      return have_one_sign(ab, bc, ca) ? plane_hit() : Sweep_verdict();
  }
  return careful_vertex_face_verdict(p, counters);
}

/// Points S, T, V, A, B: triangle STV against segment AB.
template <class Counters>
HAPTIC_SCULPT_NOINLINE Sweep_verdict careful_edge_edge_verdict(const Sweep_points& p, Counters& counters) {
  Sweep_signs<Counters> signs(p, counters);
  constexpr int s = 0, t = 1, v = 2, a = 3, b = 4;
  const int at_a = signs.orientation_3(s, t, v, a);
  const int at_b = signs.orientation_3(s, t, v, b);
  if (same_side(at_a, at_b))
    return {};
  const int tv = signs.orientation_3(t, v, a, b);
  const int vs = signs.orientation_3(v, s, a, b);
  if (tv * vs < 0)
    return {};
  const int st = signs.orientation_3(s, t, a, b);
  if (!passes_through(st, tv, vs))
    return {};
  if (at_a == 0 && at_b == 0) {
    // Either all five points are coplanar, or S, T, V are collinear and AB passes their line.
    if (st != 0 || tv != 0 || vs != 0)
      return {};
    return Flat_sweep<Counters>(p, signs).edge_edge(v, a, b);
  }
  Sweep_verdict verdict = plane_hit();
  if (tv == 0 && vs == 0) // AB passes through V, which both ends of the motion share
    verdict.form = Time_form::at_start;
  return verdict;
}

template <class Counters>
Sweep_verdict edge_edge_verdict(const Sweep_points& p, Counters& counters) {
  const auto& [s, t, v, a, b] = p;
  const Enclosed_determinant at_a = enclosed_orientation_3(s, t, v, a), at_b = enclosed_orientation_3(s, t, v, b);
  if (are_nonzero(at_a, at_b)) {
    if (have_one_sign(at_a, at_b))
      return {};
    const Enclosed_determinant st = enclosed_orientation_3(a, b, s, t), tv = enclosed_orientation_3(a, b, t, v),
                               vs = enclosed_orientation_3(a, b, v, s);
    if (are_nonzero(st, tv, vs))
      return have_one_sign(st, tv, vs) ? plane_hit() : Sweep_verdict();
  }
  return careful_edge_edge_verdict(p, counters);
}

/// Points S, T, G, I, A: tetrahedron STGI against point A.
template <class Counters>
HAPTIC_SCULPT_NOINLINE Sweep_verdict careful_face_vertex_verdict(const Sweep_points& p, Counters& counters) {
  Sweep_signs<Counters> signs(p, counters);
  constexpr int s = 0, t = 1, g = 2, i = 3, a = 4;
  // A replaces each corner in turn; the four determinants add up to the tetrahedron's, so no two may differ in sign.
  const int for_s = signs.orientation_3(a, t, g, i);
  const int for_t = signs.orientation_3(s, a, g, i);
  if (for_s * for_t < 0)
    return {};
  const int for_g = signs.orientation_3(s, t, a, i);
  if (for_s * for_g < 0 || for_t * for_g < 0)
    return {};
  const int for_i = signs.orientation_3(s, t, g, a);
  if (for_s * for_i < 0 || for_t * for_i < 0 || for_g * for_i < 0)
    return {};
  if (for_s == 0 && for_t == 0 && for_g == 0 && for_i == 0)
    return Flat_sweep<Counters>(p, signs).face_vertex(g, i, a);
  Sweep_verdict verdict = plane_hit();
  if (for_s == 0 && for_t == 0) // A lies on the static edge GI
    verdict.form = Time_form::at_start;
  return verdict;
}

template <class Counters>
Sweep_verdict face_vertex_verdict(const Sweep_points& p, Counters& counters) {
  const auto& [s, t, g, i, a] = p;
  const Enclosed_determinant for_s = enclosed_orientation_3(g, i, a, t), for_t = enclosed_orientation_3(i, g, a, s);
  if (are_nonzero(for_s, for_t)) {
    if (!have_one_sign(for_s, for_t))
      return {};
    const Enclosed_determinant for_g = enclosed_orientation_3(s, t, a, i), for_i = enclosed_orientation_3(s, t, g, a);
    if (are_nonzero(for_g, for_i))
      return have_one_sign(for_s, for_g, for_i) ? plane_hit() : Sweep_verdict();
  }
  return careful_face_vertex_verdict(p, counters);
}

} // namespace haptic_sculpt::internal
