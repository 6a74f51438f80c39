// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef HAPTIC_SCULPT_SURFACE_SWEPT_STAR_3_H
#define HAPTIC_SCULPT_SURFACE_SWEPT_STAR_3_H

#include <haptic_sculpt/surface/Box_3.h>

#include <vector>

namespace haptic_sculpt {

/// What a broad phase is asked about: all that the faces, edges and vertex of a star pass over while its centre goes
/// straight from `source` to `target`. Each moving face sweeps the tetrahedron of source, target and one link edge.
struct Swept_star_3 {
  using Coordinates = std::array<double, 3>;

  Coordinates source{}, target{};
  const Coordinates* link = nullptr; ///< the link's vertices in order around the star; link[i], link[i + 1] are an edge
  std::size_t valence = 0;           ///< 0 for a probe: then only the segment from source to target counts

  /// The smallest box around everything that is passed over.
  Box_3 box() const {
    Box_3 result(source);
    result.include(target);
    for (std::size_t i = 0; i < valence; ++i)
      result.include(link[i]);
    return result;
  }
};

} // namespace haptic_sculpt

#endif
