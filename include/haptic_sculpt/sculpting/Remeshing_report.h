// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <utility>

namespace haptic_sculpt {

/// What a guarded remeshing did. `refused` counts what was worth doing but would have broken the promise, the delta
/// rule or the bound on faces; of moves see below.
struct Remeshing_report {
  /// Of one kind of operation.
  struct Count {
    std::size_t done = 0, ///< and proven
        refused = 0;      ///< the mesh stayed as it was
  };
  Count splits,              ///< of edges longer than 4/3 of the target length
      collapses,             ///< of edges shorter than 4/5 of it; both ways of an edge may be tried and count
      flips;                 ///< that bring vertices nearer to six neighbours, or slivers into shape
  Count moves;               ///< of relaxation and projection; refused: no eighth of the way was free, kept
                             ///< the shape and was near enough to the input
  std::size_t shortened = 0; ///< of the moves done, those that went only a half, a fourth or an eighth of the way
  std::size_t too_far = 0;   ///< collapses, flips and tries of moves left out for the distance to the input
  unsigned iterations = 0;   ///< completed
  bool cancelled = false;    ///< the progress function asked to stop
};

/// How far a remeshing has come.
struct Remeshing_progress {
  /// What an iteration does, in this order; projection is a part of `relax`.
  enum class Phase { split, collapse, flip, relax };
  unsigned iteration;     ///< from 0
  Phase phase;            ///< the one under way
  std::size_t operations; ///< asked for so far
};

/// The options of isotropic_remeshing() that CGAL does not have, named and chained.
struct Remeshing_parameters {
  double feature_angle_degrees = 180;       ///< feature_angle(); 180: no edge is constrained by its angle
  std::optional<double> most_distance;      ///< max_distance(); at first the default
  std::size_t most_number_of_faces = 1u << 30; ///< most_faces(); at first what the descriptors of a mesh can number
  std::function<bool(const Remeshing_progress&)> progress_function; ///< progress(); at first none

  /// Edges whose two faces have normals that differ by more than this are constrained, as if they were in the
  /// edge_is_constrained_map. In degrees, from 0 to 180; 180, the default, is none.
  Remeshing_parameters& feature_angle(double degrees) {
    feature_angle_degrees = degrees;
    return *this;
  }
  /// No vertex of the input, nor one that splits a long edge of the input first, gets farther than this from the
  /// surface, up to rounding. The default is the target length; of a projection_functor, which may lead elsewhere,
  /// infinity: no bound.
  Remeshing_parameters& max_distance(double length) {
    most_distance = length;
    return *this;
  }
  /// A remeshing that would have to make more faces than this, by the lengths and areas of the input, is refused; and
  /// no split makes more.
  Remeshing_parameters& most_faces(std::size_t number) {
    most_number_of_faces = number;
    return *this;
  }
  /// Called every `operations_between_calls` operations and between iterations; false ends the call, with the mesh as
  /// it is then. What it throws goes on to the caller; what was done by then is one step of the history. It may look at
  /// the mesh and ask its Sculptor; what would change something throws Reentrant_call.
  Remeshing_parameters& progress(std::function<bool(const Remeshing_progress&)> function) {
    progress_function = std::move(function);
    return *this;
  }
  /// Of the progress function; the first call is before any operation.
  static constexpr std::size_t operations_between_calls = 256;
};

} // namespace haptic_sculpt
