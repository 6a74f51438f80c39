// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <limits>
#include <optional>

namespace haptic_sculpt {

/// The options of repair(), named and chained: `Repair_parameters().gap(1e-4).largest_hole(100)`.
struct Repair_parameters {
  std::optional<double> gap_length; ///< unset: see default_gap_share
  std::size_t hole_limit = std::numeric_limits<std::size_t>::max(); ///< largest_hole(); at first without limit
  double delta_length = 0;                                          ///< delta()

  /// Unless gap() says otherwise, points on open edges become one where they are at most this share of the diagonal of
  /// the bounding box apart, 2^-20, about 1e-6: what is left of coordinates written with six digits, or computed in
  /// single precision. So that no edge shrinks away, they also have to be at most 1/default_edges_per_gap of the
  /// shortest edge at either of them apart.
  static constexpr double default_gap_share = 0x1p-20;
  static constexpr int default_edges_per_gap = 4; ///< see default_gap_share

  /// Points on open edges become one where they are at most this length apart, in the unit of the coordinates, however
  /// short the edges are; so does a chain of such points, however long. >= 0 and in range. 0: only equal points do.
  Repair_parameters& gap(double length) {
    gap_length = length;
    return *this;
  }
  /// Holes with more boundary edges than this are not closed, and the mesh is refused.
  Repair_parameters& largest_hole(std::size_t edges) {
    hole_limit = edges;
    return *this;
  }
  /// What validate() is asked for in the end, in the unit of the coordinates. Low triangles are not repaired.
  Repair_parameters& delta(double length) {
    delta_length = length;
    return *this;
  }
};

} // namespace haptic_sculpt
