// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "oracle/Sweep_kind.h"

#include <vector>

namespace haptic_sculpt::test {

/// A query whose answer was worked out by hand: it first hits at `numerator / denominator`, or never (denominator 0).
struct Analytic_case {
  const char* what;
  Sweep_kind kind;
  Sweep_coordinates x;
  int numerator, denominator;
};

inline const std::vector<Analytic_case>& analytic_cases() {
  constexpr Sweep_kind VF = Sweep_kind::vertex_face, EE = Sweep_kind::edge_edge, FV = Sweep_kind::face_vertex;
  constexpr double tiny = 0x1p-1074, small = 0x1p-1000;
  static const std::vector<Analytic_case> cases{
    // S T | the triangle x, y >= 0, x + y <= 4 of the plane z = 0
    {"through the face", VF, {1, 1, 1, 1, 1, -1, 0, 0, 0, 4, 0, 0, 0, 4, 0}, 1, 2},
    {"through the face, slanted", VF, {0, 0, 1, 3, 3, -2, 0, 0, 0, 4, 0, 0, 0, 4, 0}, 1, 3},
    {"starts on the face, leaves", VF, {1, 1, 0, 1, 1, 5, 0, 0, 0, 4, 0, 0, 0, 4, 0}, 0, 1},
    {"ends on the face", VF, {1, 1, 3, 1, 1, 0, 0, 0, 0, 4, 0, 0, 0, 4, 0}, 1, 1},
    {"stops before the face", VF, {1, 1, 3, 1, 1, 1, 0, 0, 0, 4, 0, 0, 0, 4, 0}, 0, 0},
    {"passes beside the face", VF, {3, 3, 1, 3, 3, -1, 0, 0, 0, 4, 0, 0, 0, 4, 0}, 0, 0},
    {"through an edge", VF, {2, 2, 1, 2, 2, -1, 0, 0, 0, 4, 0, 0, 0, 4, 0}, 1, 2},
    {"through a vertex", VF, {0, 0, 1, 0, 0, -3, 0, 0, 0, 4, 0, 0, 0, 4, 0}, 1, 4},
    {"in the plane, enters by an edge", VF, {-1, 1, 0, 3, 1, 0, 0, 0, 0, 4, 0, 0, 0, 4, 0}, 1, 4},
    {"in the plane, leaves", VF, {1, 1, 0, 9, 1, 0, 0, 0, 0, 4, 0, 0, 0, 4, 0}, 0, 1},
    {"in the plane, outside", VF, {-1, 1, 0, -2, 1, 0, 0, 0, 0, 4, 0, 0, 0, 4, 0}, 0, 0},
    {"in the plane, by a vertex alone", VF, {-1, 1, 0, 1, -1, 0, 0, 0, 0, 4, 0, 0, 0, 4, 0}, 1, 2},
    {"along an edge, from outside", VF, {5, 0, 0, -1, 0, 0, 0, 0, 0, 4, 0, 0, 0, 4, 0}, 1, 6},
    {"along an edge, from within", VF, {2, 0, 0, 9, 0, 0, 0, 0, 0, 4, 0, 0, 0, 4, 0}, 0, 1},
    {"along an edge, beyond it", VF, {5, 0, 0, 9, 0, 0, 0, 0, 0, 4, 0, 0, 0, 4, 0}, 0, 0},
    {"S = T on the face", VF, {1, 1, 0, 1, 1, 0, 0, 0, 0, 4, 0, 0, 0, 4, 0}, 0, 1},
    {"S = T off the face", VF, {1, 1, 1, 1, 1, 1, 0, 0, 0, 4, 0, 0, 0, 4, 0}, 0, 0},
    {"S = T in the plane, outside", VF, {3, 3, 0, 3, 3, 0, 0, 0, 0, 4, 0, 0, 0, 4, 0}, 0, 0},
    {"S = T = A", VF, {0, 0, 0, 0, 0, 0, 0, 0, 0, 4, 0, 0, 0, 4, 0}, 0, 1},
    {"T = A", VF, {0, 0, 7, 0, 0, 0, 0, 0, 0, 4, 0, 0, 0, 4, 0}, 1, 1},
    {"the least motion there is", VF, {1, 1, tiny, 1, 1, -tiny, 0, 0, 0, 4, 0, 0, 0, 4, 0}, 1, 2},
    {"misses an edge by 2^-1001", VF, {2, 0, 1, 2, -small, -1, 0, 0, 0, 4, 0, 0, 0, 4, 0}, 0, 0},
    {"hits inside an edge by 2^-1001", VF, {2, 0, 1, 2, small, -1, 0, 0, 0, 4, 0, 0, 0, 4, 0}, 1, 2},
    // S T V = (0,0,0) (4,0,0) (0,4,0): the point (x, y) is swept at u = x / (4 - y)
    {"across the swept triangle", EE, {0, 0, 0, 4, 0, 0, 0, 4, 0, 1, 1, -1, 1, 1, 1}, 1, 3},
    {"across the first edge", EE, {0, 0, 0, 4, 0, 0, 0, 4, 0, 0, 1, -1, 0, 1, 1}, 0, 1},
    {"across the far end V", EE, {0, 0, 0, 4, 0, 0, 0, 4, 0, 0, 4, -1, 0, 4, 1}, 0, 1},
    {"across the last edge", EE, {0, 0, 0, 4, 0, 0, 0, 4, 0, 2, 2, -1, 2, 2, 1}, 1, 1},
    {"across T", EE, {0, 0, 0, 4, 0, 0, 0, 4, 0, 4, 0, -1, 4, 0, 1}, 1, 1},
    {"across ST", EE, {0, 0, 0, 4, 0, 0, 0, 4, 0, 3, 0, -1, 3, 0, 1}, 3, 4},
    {"beside the triangle", EE, {0, 0, 0, 4, 0, 0, 0, 4, 0, 3, 3, -1, 3, 3, 1}, 0, 0},
    {"A on the triangle", EE, {0, 0, 0, 4, 0, 0, 0, 4, 0, 1, 1, 0, 1, 1, 5}, 1, 3},
    {"AB ends before the triangle", EE, {0, 0, 0, 4, 0, 0, 0, 4, 0, 1, 1, 1, 1, 1, 5}, 0, 0},
    {"AB in the plane, across", EE, {0, 0, 0, 4, 0, 0, 0, 4, 0, 1, -1, 0, 1, 5, 0}, 1, 4},
    {"AB in the plane, from the first edge", EE, {0, 0, 0, 4, 0, 0, 0, 4, 0, -1, 1, 0, 5, 1, 0}, 0, 1},
    {"AB in the plane, A within", EE, {0, 0, 0, 4, 0, 0, 0, 4, 0, 1, 1, 0, 1, 9, 0}, 1, 3},
    {"AB in the plane, outside", EE, {0, 0, 0, 4, 0, 0, 0, 4, 0, 3, -1, 0, 3, -2, 0}, 0, 0},
    {"AB along the last edge", EE, {0, 0, 0, 4, 0, 0, 0, 4, 0, 3, 1, 0, 1, 3, 0}, 1, 1},
    {"S = T, crossing", EE, {0, 0, 0, 0, 0, 0, 0, 4, 0, -1, 1, 0, 1, 1, 0}, 0, 1},
    {"S = T, beyond V", EE, {0, 0, 0, 0, 0, 0, 0, 4, 0, -1, 5, 0, 1, 5, 0}, 0, 0},
    {"S T V in line, the edge shrinks", EE, {0, 0, 0, 4, 0, 0, 8, 0, 0, 1, 0, -1, 1, 0, 1}, 0, 1},
    {"S T V in line, the edge grows", EE, {0, 0, 0, 4, 0, 0, -2, 0, 0, 1, 0, -1, 1, 0, 1}, 1, 4},
    {"S T V in line, beyond the edge", EE, {0, 0, 0, 4, 0, 0, -2, 0, 0, 5, 0, -1, 5, 0, 1}, 0, 0},
    {"S T V in line, through V, behind", EE, {0, 0, 0, 4, 0, 0, 2, 0, 0, 1, 0, -1, 1, 0, 1}, 0, 1},
    {"S T V in line, through V, ahead", EE, {0, 0, 0, 4, 0, 0, 2, 0, 0, 3, 0, -1, 3, 0, 1}, 3, 4},
    {"all in line, the edge grows to A", EE, {0, 0, 0, 4, 0, 0, -2, 0, 0, 3, 0, 0, 7, 0, 0}, 3, 4},
    {"all in line, apart", EE, {0, 0, 0, 4, 0, 0, -2, 0, 0, 5, 0, 0, 7, 0, 0}, 0, 0},
    {"S = V, crossing", EE, {0, 0, 0, 4, 0, 0, 0, 0, 0, 2, 0, -1, 2, 0, 1}, 1, 2},
    {"S = V, at S", EE, {0, 0, 0, 4, 0, 0, 0, 0, 0, 0, 0, -1, 0, 0, 1}, 0, 1},
    {"T = V, crossing", EE, {0, 0, 0, 4, 0, 0, 4, 0, 0, 1, 0, -1, 1, 0, 1}, 0, 1},
    {"S = T = V on AB", EE, {0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, -1, 0, 0, 1}, 0, 1},
    {"S = T = V off AB", EE, {0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1, -1, 0, 1, 1}, 0, 0},
    {"V = A", EE, {0, 0, 0, 4, 0, 0, 0, 4, 0, 0, 4, 0, 0, 4, 1}, 0, 1},
    // S T G I = (0,0,0) (4,0,0) (0,4,0) (0,0,4): the point (x, y, z) is swept at u = x / (4 - y - z)
    {"inside the tetrahedron", FV, {0, 0, 0, 4, 0, 0, 0, 4, 0, 0, 0, 4, 1, 1, 1}, 1, 2},
    {"on the first face", FV, {0, 0, 0, 4, 0, 0, 0, 4, 0, 0, 0, 4, 0, 1, 1}, 0, 1},
    {"on the last face", FV, {0, 0, 0, 4, 0, 0, 0, 4, 0, 0, 0, 4, 1, 1, 2}, 1, 1},
    {"on ST", FV, {0, 0, 0, 4, 0, 0, 0, 4, 0, 0, 0, 4, 1, 0, 0}, 1, 4},
    {"A = T", FV, {0, 0, 0, 4, 0, 0, 0, 4, 0, 0, 0, 4, 4, 0, 0}, 1, 1},
    {"A = G", FV, {0, 0, 0, 4, 0, 0, 0, 4, 0, 0, 0, 4, 0, 4, 0}, 0, 1},
    {"A on GI", FV, {0, 0, 0, 4, 0, 0, 0, 4, 0, 0, 0, 4, 0, 2, 2}, 0, 1},
    {"beyond the last face", FV, {0, 0, 0, 4, 0, 0, 0, 4, 0, 0, 0, 4, 2, 2, 2}, 0, 0},
    {"behind the first face", FV, {0, 0, 0, 4, 0, 0, 0, 4, 0, 0, 0, 4, -1, 1, 1}, 0, 0},
    {"flat, swept over", FV, {0, 0, 0, 4, 0, 0, 0, 4, 0, 4, 4, 0, 2, 1, 0}, 1, 3},
    {"flat, on the first face", FV, {0, 0, 0, 4, 0, 0, 0, 4, 0, 4, 4, 0, .5, 1, 0}, 0, 1},
    {"flat, above", FV, {0, 0, 0, 4, 0, 0, 0, 4, 0, 4, 4, 0, 2, 1, 1}, 0, 0},
    {"S = T, on the face", FV, {0, 0, 0, 0, 0, 0, 4, 0, 0, 0, 4, 0, 1, 1, 0}, 0, 1},
    {"S = T, off the face", FV, {0, 0, 0, 0, 0, 0, 4, 0, 0, 0, 4, 0, 1, 1, 1}, 0, 0},
    {"all in line, the face shrinks", FV, {0, 0, 0, 4, 0, 0, 5, 0, 0, 6, 0, 0, 1, 0, 0}, 0, 1},
    {"all in line, the face grows", FV, {0, 0, 0, 4, 0, 0, -1, 0, 0, -2, 0, 0, 1, 0, 0}, 1, 4},
    {"all in line, apart", FV, {0, 0, 0, 4, 0, 0, 5, 0, 0, 6, 0, 0, 7, 0, 0}, 0, 0},
    {"S = G", FV, {0, 0, 0, 4, 0, 0, 0, 0, 0, 0, 4, 0, 1, 1, 0}, 1, 3},
    {"T = G", FV, {4, 0, 0, 0, 0, 0, 0, 0, 0, 0, 4, 0, 1, 1, 0}, 0, 1},
    {"S T G in line, A on the edge", FV, {0, 0, 0, 2, 0, 0, -2, 0, 0, 0, 4, 0, 1, 0, 0}, 1, 2},
    {"S T G in line, A in the face", FV, {0, 0, 0, 2, 0, 0, -2, 0, 0, 0, 4, 0, 1, 1, 0}, 2, 3},
    {"T on GI", FV, {2, 2, 4, 2, 2, 0, 4, 0, 0, 0, 4, 0, 2, 2, 1}, 0, 1},
  };
  return cases;
}

} // namespace haptic_sculpt::test
