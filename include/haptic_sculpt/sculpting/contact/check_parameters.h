// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/collision/arithmetic/exact_integers.h>
#include <haptic_sculpt/sculpting/Invalid_parameter.h>
#include <haptic_sculpt/sculpting/Sculptor_parameters.h>
#include <haptic_sculpt/sculpting/contact/check_arguments.h>
#include <haptic_sculpt/sculpting/geometry/clearance.h>
#include <haptic_sculpt/sculpting/geometry/vector_3.h>
#include <haptic_sculpt/surface/Invalid_surface.h>
#include <haptic_sculpt/surface/Box_3.h>
#include <haptic_sculpt/surface/coordinate_range.h>
#include <haptic_sculpt/surface/validate.h>
#include <haptic_sculpt/surface/vertex_coordinates.h>

namespace haptic_sculpt::internal {

/// \throw Out_of_range; Invalid_parameter where a length would be refused in every scene.
inline void check_length(const std::optional<double>& clearance) {
  if (!clearance)
    return;
  check_range("the clearance", *clearance);
  if (!(*clearance > 0))
    throw Invalid_parameter("the clearance must be a length > 0, not " + number(*clearance));
}
/// The same of all.
inline void check_parameters(const Sculptor_parameters& parameters) {
  check_length(parameters.drag.clearance_length);
  check_range("delta", parameters.delta_length);
  if (!(parameters.delta_length >= 0))
    throw Invalid_parameter("delta must be a length >= 0, not " + number(parameters.delta_length));
}

/// Where the vertices of a mesh are.
struct Scene_extent {
  Box_3 box;
  double largest = 0; ///< magnitude of a coordinate

  template <class Mesh>
  explicit Scene_extent(const Mesh& mesh) {
    for (const auto v : mesh.vertices()) {
      const Coordinates p = vertex_coordinates(mesh, v);
      box.include(p);
      largest = std::fmax(largest, largest_magnitude(p));
    }
  }
};

/// \throw Invalid_parameter unless a clearance that is set serves the scene: what is less than an ulp cannot be kept,
/// and the longest way that a slide goes back to keep it from several planes should not be longer than the scene.
template <class Mesh>
void check_clearance(const Mesh& mesh, const std::optional<double>& clearance) {
  if (!clearance)
    return;
  const Scene_extent extent(mesh);
  double widest = 0;
  for (int i = 0; i < 3; ++i)
    widest = std::fmax(widest, extent.box.upper[i] - extent.box.lower[i]);
  const double least = unit_in_the_last_place(extent.largest), most = widest / Slide_lengths::clearances_of_retreat;
  if (least > most)
    throw Invalid_parameter("no clearance serves this scene: an ulp of its largest coordinate, " + number(least) +
                            ", is more than 1/128 of its extent, " + number(most) + "; give none");
  if (!(*clearance >= least && *clearance <= most))
    throw Invalid_parameter("the clearance " + number(*clearance) + " does not serve this scene: give " +
                            number(least) + " (an ulp of its largest coordinate) to " + number(most) +
                            " (1/128 of its extent), or none");
}

/// Returns the mesh. \throw Invalid_surface, Invalid_parameter, Out_of_range unless a Sculptor can guard it. Cost: that
/// of validate().
template <class Mesh>
const Mesh& checked_scene(const Mesh& mesh, const Sculptor_parameters& parameters) {
  check_parameters(parameters);
  check_points(mesh, If_not_finite::leave); // of which the report of validate() names all
  if (!parameters.is_known_valid || parameters.delta_length > 0) {
    Validity_report report = validate(mesh, parameters.delta_length);
    if (!report.is_valid())
      throw Invalid_surface("the mesh", std::move(report));
  }
  check_clearance(mesh, parameters.drag.clearance_length);
  return mesh;
}

} // namespace haptic_sculpt::internal
