// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Script.h"

#include <haptic_sculpt/haptic_rendering/exchange/Journaled_edits.h>
#include <haptic_sculpt/sculpting.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <cmath>
#include <set>
#include <sstream>

/// \file
/// What the lines of a script do that are no edits by value: directives, and `move`, `brush` and `remesh`, each a
/// step of undo.

namespace haptic_sculpt::examples {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;
using Vertex_index = Mesh::Vertex_index;

/// What became of such a line.
struct Line_outcome {
  const char* refusal = nullptr; ///< nothing was done, for this reason
  /// Asked and done of a move or a brush: vertices, and those at their targets; of a remeshing: operations. None of a
  /// directive.
  std::optional<std::array<std::size_t, 2>> many;
  std::string detail; ///< for people
  std::vector<std::size_t> elements; ///< numbers of vertices: what blocks a move, where too low triangles are

  static Line_outcome refused(const char* reason, std::string detail = "", std::vector<std::size_t> elements = {}) {
    return {reason, std::nullopt, std::move(detail), std::move(elements)};
  }
};

constexpr const char* clearance_of_no_use = "clearance-of-no-use";

/// Of a line that is refused because the scene has outgrown the clearance that an earlier one has set.
inline std::string outgrown(const Invalid_parameter& error) {
  return error.what() + std::string("; `clearance default` before this line serves always");
}

/// \pre `command` is a brush
inline Dab_3<Kernel> dab_of(const Command& command) {
  const auto& c = command.points[0];
  Dab_3<Kernel> dab{*brush_kind(command.word), {c[0], c[1], c[2]}, command.length, command.strength};
  if (command.points.size() == 2)
    dab.direction = Kernel::Vector_3(command.points[1][0], command.points[1][1], command.points[1][2]);
  return dab;
}

/// A dab with a brush.
template <class Sculptor>
Line_outcome carry_out_brush(Sculptor& sculptor, const Command& command) {
  const Dab_3<Kernel> dab = dab_of(command);
  if (const Vertex_index nearest = sculptor.nearest_vertex(dab.centre, dab.radius);
      nearest.is_valid() && std::abs(dab.strength) > largest_strength(sculptor.mesh(), dab, nearest))
    return Line_outcome::refused("out-of-range", "the strength is more than 2^53 times what it is measured in");
  Move_report report;
  try {
    report = apply_brush(sculptor, std::array<Dab_3<Kernel>, 1>{dab},
                         boost::static_property_map<double, Vertex_index>(1.0), Move_parameters());
  } catch (const Out_of_range&) { // which names a vertex by the mesh's own index
    return Line_outcome::refused("out-of-range", "a vertex under the brush would be out of range");
  }
  sculptor.release(); // of the vertex that slid last: a drag of it is a grab of its own
  if (report.asked == 0)
    return Line_outcome::refused("nothing-in-reach", "no vertex is nearer to the centre than the radius");
  std::ostringstream detail;
  detail.precision(3);
  detail << report.reached << " of " << report.asked << " vertices arrived";
  if (report.reached != report.asked)
    detail << ", " << 100 * (1 - report.left_l2 / report.asked_l2) << " % of the way was gone";
  return {nullptr, {{report.asked, report.reached}}, detail.str(), {}};
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

/// The component of a vertex by a vector. \param journal of Journaled_edits, or nullptr
template <class Sculptor, class Journal>
Line_outcome carry_out_move(Sculptor& sculptor, const Command& command, Journal* journal) {
  const Vertex_index v = sculptor.vertex(command.edit.vertices[0]);
  if (!v.is_valid())
    return Line_outcome::refused("unknown-element", "", vertices_of(command));
  const auto& [x, y, z] = command.edit.point;
  Journaled_edits<Sculptor, Journal> edits(sculptor);
  edits.keep_journal(journal);
  Rigid_move_report<Mesh> report;
  try {
    report = move_rigidly(edits, component_of(sculptor.mesh(), v),
                          CGAL::Aff_transformation_3<Kernel>(CGAL::TRANSLATION, Kernel::Vector_3(x, y, z)));
  } catch (const Out_of_range&) { // which names a vertex by the mesh's own index
    return Line_outcome::refused("out-of-range", "a vertex of the object would be out of range", vertices_of(command));
  }
  std::ostringstream detail;
  detail << "an object of " << report.asked << " vertices has gone " << 100 * report.share << " % of the way";
  Line_outcome done{nullptr, {{report.asked, report ? report.asked : 0}}, detail.str(), {}};
  if (!report.contacts.empty()) // where not all of the way is gone: the first place
    for (const Vertex_index w : report.contacts.front().vertices)
      if (w.is_valid())
        done.elements.push_back(sculptor.id(w));
  return done;
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
Line_outcome carry_out_remesh(Sculptor& sculptor, const Command& command) {
  constexpr double most_triangles = 2e7; // some 800 bytes each: what a machine of 16 GiB holds
  if (!(triangles_of_remeshing(sculptor.mesh(), command.length) <= most_triangles))
    return Line_outcome::refused("too-many-triangles",
                                 "edges of this length would make more than 20 million triangles of it");
  const Remeshing_report report =
      isotropic_remeshing(sculptor, command.length, CGAL::parameters::number_of_iterations(3));
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
  return {nullptr, {{done + refused, done}}, detail.str(), {}};
}

template <class Sculptor>
Line_outcome carry_out_delta(Sculptor& sculptor, const Command& command) {
  if (command.length != sculptor.parameters().delta_length) // a log begins so; to look at all triangles finds nothing
    try {
      sculptor.set_delta(command.length);
    } catch (const Invalid_surface& error) {
      std::set<std::size_t> corners;
      for (const auto f : error.report().low_faces)
        for (const auto v : sculptor.mesh().vertices_around_face(sculptor.mesh().halfedge(f)))
          corners.insert(sculptor.id(v));
      return Line_outcome::refused("triangle-lower-than-delta", "", {corners.begin(), corners.end()});
    } catch (const Open_stroke& error) {
      return Line_outcome::refused("open-stroke", error.what());
    } catch (const Invalid_parameter& error) {
      return Line_outcome::refused(clearance_of_no_use, outgrown(error));
    }
  return {};
}

/// What is in the hand is let go: only drags that follow each other are one grab. A probe changes nothing.
/// \param journal hears what a move does, edit by edit \pre the line is no edit by value
template <class Sculptor, class Journal = Edit_journal>
Line_outcome carry_out_line(Sculptor& sculptor, const Command& command, Journal* journal = nullptr) {
  using Kind = Command::Kind;
  sculptor.release();
  Drag_parameters drag = sculptor.parameters().drag;
  try {
    switch (command.kind) {
    case Kind::move: return carry_out_move(sculptor, command, journal);
    case Kind::brush: return carry_out_brush(sculptor, command);
    case Kind::remesh: return carry_out_remesh(sculptor, command);
    case Kind::delta: return carry_out_delta(sculptor, command);
    case Kind::response: sculptor.set_drag_parameters(drag.response(*response_by_name(command.word))); break;
    case Kind::clearance:
      sculptor.set_drag_parameters(command.word == "default" ? drag.clearance(std::nullopt)
                                                             : drag.clearance(command.length));
      break;
    default: break; // mesh was checked before the first edit
    }
  } catch (const Out_of_range& error) {
    return Line_outcome::refused("out-of-range", error.what());
  } catch (const Invalid_parameter& error) {
    std::string detail = error.what();
    if (command.kind == Kind::clearance)
      detail += "; a script says none as `clearance default`";
    else if (command.kind == Kind::brush) // by what an earlier line has set
      detail = outgrown(error);
    return Line_outcome::refused(clearance_of_no_use, detail);
  }
  return {};
}

} // namespace haptic_sculpt::examples
