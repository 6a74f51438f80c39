// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "oracle/Sweep_kind.h"
#include "populations/Five_points.h"
#include "populations/Portable_random.h"

namespace haptic_sculpt::test {

// ordinary and regular, sweep_populations.cpp
Five_points random_box(Sweep_kind kind, Portable_random& random);
Five_points sculpt_scale(Sweep_kind kind, Portable_random& random);
Five_points integer_grid(Sweep_kind kind, Portable_random& random);
Five_points tenths(Sweep_kind kind, Portable_random& random);
Five_points coincident_points(Sweep_kind kind, Portable_random& random);

/// A touch of two faces of the hulls, then one coordinate of one point moved by -1, 0 or +1 ulp. `size` points span the
/// face on the side of the triangle or tetrahedron: 3, 2, 1 for a face, an edge, a vertex.
Five_points contact_ulp(Sweep_kind kind, Portable_random& random, int size);
Five_points start_or_end_in_contact(Sweep_kind kind, Portable_random& random);
Five_points tiny_motion(Sweep_kind kind, Portable_random& random);
Five_points zero_motion(Sweep_kind kind, Portable_random& random);

Five_points coplanar_axis(Sweep_kind kind, Portable_random& random);
Five_points coplanar_oblique(Sweep_kind kind, Portable_random& random);
Five_points slivers(Sweep_kind kind, Portable_random& random);
Five_points along_moved_edge(Sweep_kind kind, Portable_random& random);
Five_points collinear_sweep(Sweep_kind kind, Portable_random& random);

/// A query of any sort above, multiplied: half the time by `factor`, which rounds, else by the power of two below it.
Five_points scaled(Sweep_kind kind, Portable_random& random, double factor);
/// A query of any sort above, every coordinate shifted by about `offset`.
Five_points offset(Sweep_kind kind, Portable_random& random, double offset);
Five_points mixed_exponents(Sweep_kind kind, Portable_random& random);
Five_points subnormal(Sweep_kind kind, Portable_random& random);

} // namespace haptic_sculpt::test
