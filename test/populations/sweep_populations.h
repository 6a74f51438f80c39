// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "oracle/Sweep_kind.h"

#include <functional>
#include <random>
#include <string>
#include <vector>

namespace haptic_sculpt::test {

/// One question to the sweeps.
struct Sweep_query {
  Sweep_kind kind;
  Sweep_coordinates x;
};

/// A seeded source of queries of one sort. The same engine state gives the same queries on every machine and with every
/// compiler flag: the sources are a library of their own, compiled with -ffp-contract=off, because a contracted
/// multiply-add would move the points built to touch exactly; only correctly rounded operations are used.
///
/// The standing features and those of the mesh are simplices, exactly: A, B, C are not collinear, A != B, G != I.
/// Anything else may coincide.
struct Sweep_population {
  std::string name;
  bool degenerate; ///< built to touch, to be flat or to strain the arithmetic
  std::function<Sweep_coordinates(Sweep_kind, std::mt19937_64&)> draw; ///< may break the promise above

  Sweep_query operator()(Sweep_kind kind, std::mt19937_64& engine) const;
  Sweep_query operator()(std::mt19937_64& engine) const; ///< of a random kind
};

/// All populations, the ordinary ones first.
const std::vector<Sweep_population>& sweep_populations();

/// Whether the features that stand still are simplices of a valid mesh, decided exactly.
bool standing_features_are_simplices(Sweep_kind kind, const Sweep_coordinates& x);

} // namespace haptic_sculpt::test
