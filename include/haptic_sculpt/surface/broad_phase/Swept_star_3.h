// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/surface/Box_3.h>

#include <cmath>

namespace haptic_sculpt {

/// What a broad phase is asked about: all that the faces, edges and vertex of a star pass over while its centre goes
/// straight from `source` to `target`. Each moving face sweeps the tetrahedron of source, target and one link edge.
struct Swept_star_3 {
  using Coordinates = std::array<double, 3>; ///< x, y, z

  Coordinates source{},              ///< where the centre is at time 0
      target{};                      ///< where it would be at time 1
  const Coordinates* link = nullptr; ///< the link's vertices in order around the star; link[i], link[i + 1] are an edge
  std::size_t valence = 0;           ///< 0 for a probe: then only the segment from source to target counts
  double until = 1;                  ///< only what is passed over up to this time counts; in (0, 1], 1 being the target
  bool is_box = false; ///< the centre may be anywhere in the box of source and target, not only straight between them

  /// A box around where the centre is: the smallest for the whole way; for a part of it wider by what rounding can do.
  Box_3 path() const {
    Box_3 result(source);
    if (until >= 1)
      return result.include(target);
    for (int i = 0; i < 3; ++i) {
      const double s = source[i], t = target[i], size = std::abs(s) + std::abs(t);
      const double p = s + until * (t - s), error = 0x1p-49 * size; // five roundings of 2^-53 of the size
      const bool is_known = size > 0x1p-1000;                       // denormal numbers round by more
      if (t < s)
        result.lower[i] = is_known && p - error > t ? p - error : t;
      else
        result.upper[i] = is_known && p + error < t ? p + error : t;
    }
    return result;
  }

  /// A box around everything that is passed over: path() and the link.
  Box_3 box() const {
    Box_3 result = path();
    for (std::size_t i = 0; i < valence; ++i)
      result.include(link[i]);
    return result;
  }
};

} // namespace haptic_sculpt
