// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/Error.h>
#include <haptic_sculpt/surface/Validity_report.h>
#include <haptic_sculpt/surface/validity/Face_soup.h>

#include <cstddef>
#include <string>
#include <vector>

namespace haptic_sculpt {

/// What repair() does, in its order.
enum class Repair_kind {
  merge_points,              ///< equal points become one
  drop_faces,                ///< faces with a repeated corner, and all but one of faces with the same corners, go
  drop_points,               ///< points without faces go
  close_gaps,                ///< points on open edges that are nearly equal become one
  orient_faces,              ///< neighbours agree; edges of more than two faces and vertices of several fans are split
  divide_faces,              ///< into triangles
  stitch_edges,              ///< open edges at one place become one
  remove_degenerate_faces,   ///< triangles whose corners lie on a line
  close_holes,               ///< with triangles between the vertices of the boundary
  separate_vertices,         ///< that were split, and so are at one point
  drop_sheets,               ///< components of signed volume exactly 0 go, unless all are such
  resolve_self_intersections, ///< of a component with itself
  unite_solids,              ///< components that overlap
  orient_solids              ///< components bound a volume: their normals point out of the solid
};

/// E.g. "close holes".
inline const char* name_of(Repair_kind kind) {
  constexpr const char* names[] = {"merge points", "drop faces", "drop points", "close gaps", "orient faces",
                                   "divide faces", "stitch edges", "remove degenerate faces", "close holes",
                                   "separate vertices", "drop sheets", "resolve self-intersections", "unite solids",
                                   "orient solids"};
  return names[static_cast<int>(kind)];
}

/// How many of what: "holes closed" 2.
struct Repair_count {
  const char* what;   ///< in words, e.g. "holes closed"
  std::size_t number; ///< how many
};

/// One step of a repair.
struct Repair_step {
  Repair_kind kind;                 ///< which of the steps
  std::vector<Repair_count> counts; ///< what was changed
  double moved = 0;    ///< the largest distance a point went in it, in the unit of the coordinates, rounded
  std::string failure; ///< why CGAL gave up, of several parts the last; they were not changed. Empty: it did not

  /// Whether there is anything to say of it.
  bool did_something() const {
    bool did = !failure.empty();
    for (const Repair_count& count : counts)
      did = did || count.number != 0;
    return did;
  }
};

/// What repair() has done, and what it could not do.
///
/// Points of the input are counted once a place, and only where they have a face; "where it is now" is the farthest of
/// several if a point was split. Distances are in the unit of the coordinates and rounded: of those of points the
/// relative error is less than 1e-15, unless they are less than 2^-1000; removed_distance is off by some 1e-15 of the
/// size of the scene.
struct Repair_report {
  std::vector<Repair_step> steps; ///< those that did or left something, or failed; empty: there was nothing to do
  double moved = 0;               ///< the largest distance of a point from where it was
  std::size_t points_before = 0;  ///< distinct ones with faces
  std::size_t points_removed = 0; ///< of these: they are not there any more
  double removed_distance = 0;    ///< the largest distance of such a point from the repaired surface
  std::size_t points_added = 0;   ///< vertices now that are at no point's new place

  /// Of the repaired surface, or of what the repair came to: what is left of the faults.
  Validity_report left;
  /// What the repair came to, where faults are left; the numbers in `left` are those of its points and faces. Empty
  /// where it came to the end.
  Face_soup attempt;

  /// There were faces, and the repair came to none: all lay on a line, or in a point.
  bool has_vanished = false;

  /// Whether the surface is valid now. If not, what was given to repair() is unchanged.
  bool is_repaired() const { return left.is_valid() && !has_vanished; }

  /// Says in plain words what was done, one step a line, and what is left.
  std::string message(Validity_report::Reader reader = Validity_report::Reader::programmer) const {
    std::string text;
    for (const Repair_step& step : steps) {
      text += std::string(name_of(step.kind)) + ":";
      const char* separator = " ";
      for (const Repair_count& count : step.counts)
        if (count.number != 0) {
          text += separator + std::to_string(count.number) + ' ' + count.what;
          separator = ", ";
        }
      if (step.moved > 0)
        text += separator + ("points moved by at most " + internal::number(step.moved));
      if (!step.failure.empty())
        text += " could not be done: " + step.failure;
      text += '\n';
    }
    if (!left.non_finite_vertices.empty()) // no step was tried
      return "nothing was changed:\n" + left.message(8, reader);
    if (steps.empty())
      text = "nothing to repair\n";
    text += "of " + std::to_string(points_before) + " points none moved farther than " + internal::number(moved);
    if (points_removed > 0)
      text += "; " + std::to_string(points_removed) + " are gone, and were at most " +
              internal::number(removed_distance) + " from the surface as it is now";
    text += "; " + std::to_string(points_added) + " are new\n";
    if (has_vanished)
      text += "no face is left, for all of them lay on a line or in a point, and nothing was changed\n";
    else if (!is_repaired())
      text += "what is left could not be repaired, and nothing was changed (numbers are those of its attempt):\n" +
              left.message(8, reader);
    return text;
  }
};

} // namespace haptic_sculpt
