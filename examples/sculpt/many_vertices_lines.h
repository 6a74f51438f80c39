// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Run_result.h"

#include <cmath>
#include <sstream>

/// \file
/// The lines `move`, `brush` and `remesh` of a script. Each is one step of undo.

namespace haptic_sculpt::sculpt_program {

/// What became of such a line.
struct Many_vertices_outcome {
  const char* refusal = nullptr;    ///< nothing was done, for this reason
  std::size_t asked = 0, done = 0;  ///< move, brush: vertices, and those at their targets; remesh: operations
  std::string detail;               ///< for people
};

/// A dab with a brush.
template <class Sculptor>
Many_vertices_outcome carry_out_brush(Sculptor& sculptor, const Command& command) {
  try {
    const Move_report report = apply_brush(sculptor, std::array<Dab_3<Kernel>, 1>{dab_of(command)},
                                           boost::static_property_map<double, Vertex_index>(1.0), Move_parameters());
    if (report.asked == 0)
      return {"nothing-in-reach", 0, 0, "no vertex is nearer to the centre than the radius"};
    std::ostringstream detail;
    detail.precision(3);
    detail << report.reached << " of " << report.asked << " vertices arrived";
    if (report.reached != report.asked)
      detail << ", " << 100 * (1 - report.left_l2 / report.asked_l2) << " % of the way was gone";
    return {nullptr, report.asked, report.reached, detail.str()};
  } catch (const Out_of_range& error) {
    return {"out-of-range", 0, 0, error.what()};
  } catch (const Invalid_parameter& error) {
    return {"clearance-of-no-use", 0, 0, error.what()};
  }
}

/// The vertices that are joined to v by edges, v first.
inline std::vector<Vertex_index> component_of(const Mesh& mesh, Vertex_index v) {
  std::vector<Vertex_index> component{v};
  std::vector<bool> is_met(mesh.num_vertices(), false);
  is_met[v] = true;
  for (std::size_t i = 0; i < component.size(); ++i)
    for (const Vertex_index w : mesh.vertices_around_target(mesh.halfedge(component[i])))
      if (!is_met[w]) {
        is_met[w] = true;
        component.push_back(w);
      }
  return component;
}

/// The component of v by a vector. \param blocking what is in the way, where not all of the way is gone: the first
/// place
template <class Sculptor>
Many_vertices_outcome carry_out_move(Sculptor& sculptor, Vertex_index v, const Kernel::Vector_3& way,
                                     std::vector<Vertex_index>& blocking) {
  try {
    const auto report = move_rigidly(sculptor, component_of(sculptor.mesh(), v),
                                     CGAL::Aff_transformation_3<Kernel>(CGAL::TRANSLATION, way));
    if (!report.contacts.empty())
      for (const Vertex_index w : report.contacts.front().vertices)
        if (w.is_valid())
          blocking.push_back(w);
    std::ostringstream detail;
    detail << "an object of " << report.asked << " vertices has gone " << 100 * report.share << " % of the way";
    return {nullptr, report.asked, report ? report.asked : 0, detail.str()};
  } catch (const Out_of_range& error) {
    return {"out-of-range", 0, 0, error.what()};
  }
}

/// About how many triangles a remeshing makes on its way, of each face by the larger of two: equilateral ones, by its
/// area; and what is left of a needle when its edges have been halved until they are no longer than 4/3 of the length:
/// each time three needles of half the length come of one, however thin it is. In doubles: it may be infinite, or not a
/// number.
inline double triangles_of_remeshing(const Mesh& mesh, double length) {
  double triangles = 0;
  for (const auto f : mesh.faces()) {
    const auto h = mesh.halfedge(f);
    const auto p = mesh.point(mesh.source(h));
    const Kernel::Vector_3 a = (mesh.point(mesh.target(h)) - p) / length,
                           b = (mesh.point(mesh.target(mesh.next(h))) - p) / length;
    const double by_area = std::sqrt(CGAL::cross_product(a, b).squared_length()) * (2 / std::sqrt(3.));
    const double longest =
        std::sqrt(std::fmax(a.squared_length(), std::fmax(b.squared_length(), (b - a).squared_length())));
    const double halvings = std::ceil(std::fmax(0, std::log2(longest / (4. / 3))));
    const double of_needle = std::pow(3, halvings) / 2; // a face shares its longest edge with another
    triangles += by_area < of_needle ? of_needle : by_area; // what is not a number stays one
  }
  return triangles;
}

/// Remeshes all of it to edges of about a length.
template <class Sculptor>
Many_vertices_outcome carry_out_remesh(Sculptor& sculptor, const Command& command) {
  constexpr double most_triangles = 2e7; // some 800 bytes each: what a machine of 16 GiB holds
  if (!(triangles_of_remeshing(sculptor.mesh(), command.length) <= most_triangles))
    return {"too-many-triangles", 0, 0, "edges of this length would make more than 20 million triangles of it"};
  Remeshing_report report;
  try {
    report = isotropic_remeshing(sculptor, command.length, CGAL::parameters::number_of_iterations(3));
  } catch (const Out_of_range& error) {
    return {"out-of-range", 0, 0, error.what()};
  } catch (const Invalid_parameter& error) {
    return {"clearance-of-no-use", 0, 0, error.what()};
  }
  std::size_t done = 0, refused = 0;
  std::ostringstream detail;
  const auto tell = [&](const char* what, const Remeshing_report::Count& count) {
    done += count.done;
    refused += count.refused;
    detail << (detail.tellp() == 0 ? "" : ", ") << count.done << ' ' << what;
    if (count.refused != 0)
      detail << " (" << count.refused << " refused)";
  };
  tell("splits", report.splits);
  tell("collapses", report.collapses);
  tell("flips", report.flips);
  tell("moves", report.moves);
  return {nullptr, done + refused, done, detail.str()};
}

} // namespace haptic_sculpt::sculpt_program
