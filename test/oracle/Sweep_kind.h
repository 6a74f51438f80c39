// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>

namespace haptic_sculpt::test {

/// The three sweeps. Five points each, in the order of the functors' arguments, the first two being the start S and the
/// end T of the moving vertex:
/// - `vertex_face` S, T | A, B, C: the segment ST meets the triangle ABC;
/// - `edge_edge` S, T, V | A, B: the triangle STV, swept by the edge JV, meets the segment AB;
/// - `face_vertex` S, T, G, I | A: the tetrahedron STGI, swept by the face JGI, meets the point A.
enum class Sweep_kind { vertex_face, edge_edge, face_vertex };

constexpr std::array<Sweep_kind, 3> sweep_kinds{Sweep_kind::vertex_face, Sweep_kind::edge_edge,
                                                Sweep_kind::face_vertex};

/// How many of the five points span the swept hull; the rest span the hull that stands still.
constexpr int swept_points(Sweep_kind kind) { return 2 + static_cast<int>(kind); }

/// `VF`, `EE` or `FV`, as in files of queries.
constexpr const char* sweep_name(Sweep_kind kind) {
  return kind == Sweep_kind::vertex_face ? "VF" : kind == Sweep_kind::edge_edge ? "EE" : "FV";
}

/// Fifteen coordinates: five points of three.
using Sweep_coordinates = std::array<double, 15>;

} // namespace haptic_sculpt::test
