// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/Error.h>
#include <haptic_sculpt/surface/cgal_compatibility.h>

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace haptic_sculpt {

/// What `validate()` found: every offending element of every kind, named by its index.
///
/// An edge is named by its two vertices, because the faces of a file that cannot become a `Surface_mesh` have edges
/// too. Lists are sorted and name an element once.
struct Validity_report {
  using Any_mesh =
      CGAL::Surface_mesh<Decision_kernel::Point_3>; ///< only its indices are used, which every `Surface_mesh` shares
  using Vertex_index = Any_mesh::Vertex_index;                   ///< of a vertex, or of a file's point
  using Halfedge_index = Any_mesh::Halfedge_index;               ///< of a half-edge of a `Surface_mesh`
  using Face_index = Any_mesh::Face_index;                       ///< of a face, or of its place in a file
  using Vertex_pair = std::pair<Vertex_index, Vertex_index>;     ///< the lower index first
  using Face_pair = std::pair<Face_index, Face_index>;           ///< the lower index first

  /// This many pairs of intersecting faces are named where nothing else is asked for. A surface that crosses itself
  /// badly has as many as the square of its faces.
  static constexpr std::size_t default_most_intersections = 1000;
  /// Asks for all of them.
  static constexpr std::size_t all_intersections = static_cast<std::size_t>(-1);

  /// The `delta` asked for: length of the smallest altitude allowed, in the unit of the coordinates.
  double delta = 0;

  /// Half-edges whose pointers contradict each other, of edges without faces, into a vertex that names none of them,
  /// and not on the face they name. Where there are any, or any of the next two, nothing else was looked at.
  std::vector<Halfedge_index> inconsistent_halfedges;
  /// Faces that name no half-edge, or one of another face.
  std::vector<Face_index> inconsistent_faces;
  /// Vertices that name a half-edge into another vertex.
  std::vector<Vertex_index> inconsistent_vertices;
  /// Vertices with a coordinate that is infinite or not a number.
  std::vector<Vertex_index> non_finite_vertices;
  /// Faces with more or fewer than three corners.
  std::vector<Face_index> non_triangular_faces;
  /// Triangles whose corners lie exactly on a line, a repeated corner included.
  std::vector<Face_index> degenerate_faces;
  /// Triangles that are not degenerate but have an altitude below `delta`. Empty for `delta == 0`.
  std::vector<Face_index> low_faces;
  /// Edges of one face only (in a `Surface_mesh`: also where another edge between the same two vertices has one, too).
  std::vector<Vertex_pair> boundary_edges;
  /// Edges of three faces or more (in a `Surface_mesh`: several edges between the same two vertices).
  std::vector<Vertex_pair> non_manifold_edges;
  /// Edges whose two faces run through them in the same direction: one of the two is turned over.
  std::vector<Vertex_pair> inconsistently_oriented_edges;
  /// Vertices whose faces form more than one fan.
  std::vector<Vertex_index> non_manifold_vertices;
  /// Vertices without a face.
  std::vector<Vertex_index> isolated_vertices;
  /// Pairs of different vertices at one point; the first is the lowest index there. Isolated vertices do not count.
  std::vector<Vertex_pair> coincident_vertices;
  /// Pairs of faces that meet elsewhere than in their shared vertices and edge. A degenerate face counts as the segment
  /// it is, and only against faces with which it shares no vertex.
  std::vector<Face_pair> intersecting_faces;
  /// Whether there are more of them: the search ended when it had found as many as it was asked for.
  bool has_more_intersections = false;

  /// \name For information: what does not make a surface invalid
  ///@{

  /// Number of connected components that have faces.
  std::size_t number_of_components = 0;
  /// The lowest face of each component whose normals point into the solid; looked at only where the surface is valid.
  /// A component lying in an odd number of others bounds a cavity and has to have its normals pointing into itself.
  std::vector<Face_index> inside_out_components;
  ///@}

  /// Whether the surface is closed, 2-manifold, triangular, not degenerate, embedded, and obeys the delta rule.
  bool is_valid() const { return number_of_faults() == 0; }

  /// Number of offending elements of all kinds; at least this many if `has_more_intersections`.
  std::size_t number_of_faults() const {
    return inconsistent_halfedges.size() + inconsistent_faces.size() + inconsistent_vertices.size() +
           non_finite_vertices.size() + non_triangular_faces.size() + degenerate_faces.size() + low_faces.size() +
           boundary_edges.size() + non_manifold_edges.size() + inconsistently_oriented_edges.size() +
           non_manifold_vertices.size() + isolated_vertices.size() + coincident_vertices.size() +
           intersecting_faces.size();
  }

  /// Whether repair() is worth a try: there are faults that it looks after. A low triangle it leaves as it is, and of a
  /// coordinate that is no number it knows nothing.
  bool is_repairable() const {
    return inconsistent_halfedges.empty() && inconsistent_faces.empty() && inconsistent_vertices.empty() &&
           non_finite_vertices.empty() && number_of_faults() > low_faces.size();
  }

  /// What does not make a surface invalid and may be meant or not, in plain words, one kind a line, the first `named`
  /// of each: components inside out. Empty where there are none.
  std::string remarks(std::size_t named = 8) const {
    return inside_out_components.empty()
               ? ""
               : counted(inside_out_components.size(), "component(s) inside out, with the faces",
                         names(inside_out_components, named), named) +
                     '\n';
  }

  /// To whom `message()` says what repairs a fault.
  enum class Reader {
    programmer, ///< by the functions of CGAL that do
    user        ///< of a program: by what to do, in whatever program makes meshes
  };

  /// Says in plain words what is wrong, one kind a line: how many, the first `named` of them, and what repairs it.
  // Cold: it is compiled small, which is fast, for no time depends on it.
  [[gnu::cold]] std::string message(std::size_t named = 8, Reader reader = Reader::programmer) const {
    std::string text;
    const auto list = [&](const auto& elements, const std::string& kind, const char* cure, const char* by_cgal,
                          bool has_more = false) {
      if (!elements.empty())
        text += counted(elements.size(), kind, names(elements, named), named, has_more) + ". " +
                (reader == Reader::user ? cure : by_cgal) + '\n';
    };
    const std::string low = "face(s) with an altitude below delta = " + internal::number(delta);
    const char* const rebuild = "Rebuild the mesh from its points and faces (PMP::polygon_soup_to_polygon_mesh).";
    list(inconsistent_halfedges, "half-edge(s) with contradictory connectivity", "Make the mesh anew.", rebuild);
    list(inconsistent_faces, "face(s) that name no half-edge of theirs", "Make the mesh anew.", rebuild);
    list(inconsistent_vertices, "vertex(es) that name a half-edge into another", "Make the mesh anew.", rebuild);
    list(non_finite_vertices, "vertex(es) with a coordinate that is infinite or not a number",
         "Give them finite coordinates.", "Give them finite coordinates.");
    list(non_triangular_faces, "face(s) that are not triangles", "Divide them into triangles.",
         "Use PMP::triangulate_faces.");
    list(degenerate_faces, "degenerate face(s) (corners on one line)",
         "Merge corners that are nearly the same, or move them apart.", "Use PMP::remove_degenerate_faces.");
    list(low_faces, low, "Use a smaller delta, or triangles of better shape.",
         "Use a smaller delta, or remesh (PMP::isotropic_remeshing).");
    list(boundary_edges, "boundary edge(s), between vertices", "Merge vertices at one point, and fill the holes.",
         "Use PMP::stitch_borders where edges coincide, else PMP::triangulate_hole.");
    list(non_manifold_edges, "edge(s) of more than two faces, between vertices",
         "Remove the surplus faces, such as walls in the inside.",
         "Remove the surplus faces, or use PMP::orient_polygon_soup, which splits such edges.");
    list(inconsistently_oriented_edges, "edge(s) between faces of opposite orientation, between vertices",
         "Turn faces over until all have their corners counterclockwise from outside.",
         "Use PMP::orient_polygon_soup.");
    list(non_manifold_vertices, "non-manifold vertex(es), where several fans of faces meet",
         "Give each fan a vertex of its own, and move these apart.",
         "Use PMP::duplicate_non_manifold_vertices, then move the copies apart.");
    list(isolated_vertices, "vertex(es) without faces", "Leave them out; a surface is made of faces.",
         "Use PMP::remove_isolated_vertices.");
    list(coincident_vertices, "pair(s) of vertices at one point", "Merge them, or move them apart.",
         "Use PMP::merge_duplicate_points_in_polygon_soup, or move them apart.");
    list(intersecting_faces, "pair(s) of intersecting faces",
         "Unite parts that overlap, and move faces apart where the surface crosses or touches itself.",
         "Use PMP::experimental::remove_self_intersections, or PMP::autorefine and keep the outer surface.",
         has_more_intersections);
    return text;
  }

private:
  /// How many of what, and the names of the first `named` of them.
  [[gnu::cold]] static std::string counted(std::size_t size, const std::string& kind, const std::string& names,
                                           std::size_t named, bool has_more = false) {
    const std::string number = (has_more ? "at least " : "") + std::to_string(size), text = number + ' ' + kind + ':';
    return text + names + (size > named ? ", ... (" + std::to_string(named) + " of " + number + ')' : std::string());
  }
  template <class Elements>
  [[gnu::cold]] static std::string names(const Elements& elements, std::size_t most) {
    std::string text;
    for (std::size_t i = 0; i < elements.size() && i < most; ++i)
      text += (i == 0 ? " " : ", ") + name(elements[i]);
    return text;
  }

  template <class Index>
  static std::string name(Index index) {
    return std::to_string(static_cast<std::size_t>(index));
  }
  template <class Index>
  static std::string name(const std::pair<Index, Index>& pair) {
    return name(pair.first) + "-" + name(pair.second);
  }
};

/// "programmer" or "user".
inline const char* name_of(Validity_report::Reader reader) {
  return reader == Validity_report::Reader::user ? "user" : "programmer";
}

} // namespace haptic_sculpt
