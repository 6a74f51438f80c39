// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef HAPTIC_SCULPT_SCULPTING_SCULPTOR_PARAMETERS_H
#define HAPTIC_SCULPT_SCULPTING_SCULPTOR_PARAMETERS_H

#include <haptic_sculpt/sculpting/Drag_result.h>

#include <optional>

namespace haptic_sculpt {

/// The options of a Sculptor, named and chained: `parameters::clearance(1e-9).delta(1e-3)`.
struct Sculptor_parameters {
  std::optional<double> clearance_length; ///< unset: default_clearance() at each contact
  double delta_length = 0;                ///< 0: only exactly degenerate triangles are refused
  Response response_rule = Response::slide; ///< see response()
  std::optional<std::size_t> work_bound;  ///< unset: a drag takes what it takes
  bool is_known_valid = false;            ///< whether the mesh has been validated by the caller

  /// The distance normal to a contact plane that a stop keeps, in the unit of the coordinates. Of use is what is at
  /// least an ulp of the scene's largest coordinate, and at most 1/128 of its extent.
  Sculptor_parameters& clearance(double length) {
    clearance_length = length;
    return *this;
  }
  /// No triangle may have an altitude below this length; >= 0 and in range.
  Sculptor_parameters& delta(double length) {
    delta_length = length;
    return *this;
  }
  /// What a dragged vertex does when its way is blocked; it slides on by default.
  Sculptor_parameters& response(Response rule) {
    response_rule = rule;
    return *this;
  }
  /// Bounds the work of a drag, for a loop that has to be in time: so many pairs decided and candidates looked up, and
  /// it ends as Drag_end::work_limit where it is (doc/use/work.md).
  Sculptor_parameters& work_limit(std::size_t pairs) {
    work_bound = pairs;
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

#endif
