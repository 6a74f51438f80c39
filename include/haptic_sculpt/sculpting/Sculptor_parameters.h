// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/sculpting/Drag_parameters.h>

namespace haptic_sculpt {

/// The options of a Sculptor, named and chained: `parameters::clearance(1e-9).delta(1e-3)`.
struct Sculptor_parameters {
  Drag_parameters drag;        ///< of drags that are given none
  double delta_length = 0;     ///< 0: only exactly degenerate triangles are refused
  bool is_known_valid = false; ///< whether the mesh has been validated by the caller

  /// \copydoc Drag_parameters::clearance
  Sculptor_parameters& clearance(double length) {
    drag.clearance(length);
    return *this;
  }
  /// No triangle may have an altitude below this length; >= 0 and in range.
  Sculptor_parameters& delta(double length) {
    delta_length = length;
    return *this;
  }
  /// \copydoc Drag_parameters::response
  Sculptor_parameters& response(Response rule) {
    drag.response(rule);
    return *this;
  }
  /// \copydoc Drag_parameters::work_limit
  Sculptor_parameters& work_limit(std::size_t pairs) {
    drag.work_limit(pairs);
    return *this;
  }
  /// Takes the caller's word that the mesh is valid, e.g. because read_surface() has just read it: it is not validated
  /// again. With a mesh that is not, nothing is promised. Of no effect where delta is not 0.
  Sculptor_parameters& known_valid(bool known) {
    is_known_valid = known;
    return *this;
  }
};

/// Starts a chain of named parameters.
namespace parameters {
/// \copydoc Sculptor_parameters::clearance
inline Sculptor_parameters clearance(double length) { return Sculptor_parameters().clearance(length); }
/// \copydoc Sculptor_parameters::delta
inline Sculptor_parameters delta(double length) { return Sculptor_parameters().delta(length); }
/// \copydoc Sculptor_parameters::response
inline Sculptor_parameters response(Response rule) { return Sculptor_parameters().response(rule); }
/// \copydoc Sculptor_parameters::work_limit
inline Sculptor_parameters work_limit(std::size_t pairs) { return Sculptor_parameters().work_limit(pairs); }
/// \copydoc Sculptor_parameters::known_valid
inline Sculptor_parameters known_valid(bool known) { return Sculptor_parameters().known_valid(known); }
} // namespace parameters

} // namespace haptic_sculpt
