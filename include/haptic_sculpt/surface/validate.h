// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/Error.h>
#include <haptic_sculpt/Rounding_to_nearest.h>
#include <haptic_sculpt/surface/Validity_report.h>
#include <haptic_sculpt/surface/delta_rule.h>
#include <haptic_sculpt/surface/validity/Face_soup.h>
#include <haptic_sculpt/surface/validity/component_orientation.h>
#include <haptic_sculpt/surface/validity/improper_intersection.h>
#include <haptic_sculpt/surface/validity/soup_connectivity.h>

#include <CGAL/Kernel_traits.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <type_traits>
#include <vector>

namespace haptic_sculpt {
namespace internal {

/// \throw Error for a delta that is negative or not finite
inline void check_length_of_delta(double delta) {
  if (!(delta >= 0) || !std::isfinite(delta))
    throw Error("delta is a length: it must be finite and not negative, not " + number(delta));
}

/// Those that name a face on whose boundary they are not. \pre all others are consistent
template <class Mesh>
void find_halfedges_beside_their_faces(const Mesh& mesh, std::vector<typename Mesh::Halfedge_index>& found) {
  std::vector<bool> is_on_face(mesh.num_halfedges(), false);
  for (const auto f : mesh.faces())
    for (const auto h : mesh.halfedges_around_face(mesh.halfedge(f)))
      is_on_face[h] = true;
  for (const auto h : mesh.halfedges())
    if (mesh.face(h) != Mesh::null_face() && !is_on_face[h])
      found.push_back(h);
}

/// What contradicts itself in a mesh.
template <class Mesh>
struct Inconsistent_elements {
  /// Those whose pointers lead nowhere, to something removed, or contradict each other, those of edges without faces,
  /// those that their target does not know, and those that name a face on whose boundary they are not.
  std::vector<typename Mesh::Halfedge_index> halfedges;
  /// Those that name no half-edge of theirs. Of a vertex that names none the half-edges tell.
  std::vector<typename Mesh::Face_index> faces;
  std::vector<typename Mesh::Vertex_index> vertices;

  bool empty() const { return halfedges.empty() && faces.empty() && vertices.empty(); }
};

/// Needs no trust in any pointer: each index is checked before it is followed.
template <class Mesh>
Inconsistent_elements<Mesh> inconsistent_elements(const Mesh& mesh) {
  Inconsistent_elements<Mesh> found;
  const auto lives = [&](const auto index) { return mesh.has_valid_index(index) && !mesh.is_removed(index); };
  for (const auto h : mesh.halfedges()) {
    const auto n = mesh.next(h), p = mesh.prev(h);
    const auto f = mesh.face(h);
    const bool good = lives(n) && lives(p) && lives(mesh.target(h)) && mesh.prev(n) == h && mesh.next(p) == h &&
                      mesh.face(n) == f && mesh.target(mesh.opposite(n)) == mesh.target(h) &&
                      (f == Mesh::null_face() ? mesh.face(mesh.opposite(h)) != f : lives(f)) &&
                      mesh.halfedge(mesh.target(h)) != Mesh::null_halfedge();
    if (!good)
      found.halfedges.push_back(h);
  }
  for (const auto f : mesh.faces())
    if (const auto h = mesh.halfedge(f); !lives(h) || mesh.face(h) != f)
      found.faces.push_back(f);
  for (const auto v : mesh.vertices())
    if (const auto h = mesh.halfedge(v); h != Mesh::null_halfedge() && (!lives(h) || mesh.target(h) != v))
      found.vertices.push_back(v);
  if (found.empty())
    find_halfedges_beside_their_faces(mesh, found.halfedges);
  return found;
}

/// Half-edges without a face that run in both directions between the same two vertices: a list of faces would take
/// their edges for one, with two faces. \pre the half-edges are consistent
template <class Mesh>
std::vector<typename Mesh::Halfedge_index> open_seams(const Mesh& mesh) {
  std::vector<typename Mesh::Halfedge_index> open, found;
  for (const auto h : mesh.halfedges())
    if (mesh.face(h) == Mesh::null_face())
      open.push_back(h);
  const auto is_before = [&](const auto g, const auto h) {
    return std::pair(mesh.source(g), mesh.target(g)) < std::pair(mesh.source(h), mesh.target(h));
  };
  std::sort(open.begin(), open.end(), is_before);
  for (const auto h : open)
    if (std::binary_search(open.begin(), open.end(), mesh.opposite(h), is_before))
      found.push_back(h);
  return found;
}

/// Names them in a report of what a list of faces tells.
template <class Mesh>
void report_open_seams(const Mesh& mesh, Validity_report& report) {
  const auto seams = open_seams(mesh);
  for (const auto h : seams) {
    const auto [v, w] = std::minmax({mesh.source(h), mesh.target(h)});
    report.boundary_edges.emplace_back(Validity_report::Vertex_index(static_cast<std::size_t>(v)),
                                       Validity_report::Vertex_index(static_cast<std::size_t>(w)));
  }
  if (seams.empty())
    return;
  std::sort(report.boundary_edges.begin(), report.boundary_edges.end());
  report.boundary_edges.erase(std::unique(report.boundary_edges.begin(), report.boundary_edges.end()),
                              report.boundary_edges.end());
  report.inside_out_components.clear(); // of a surface that is valid
}

/// Pairs of vertices at one point, by sorting; -0 and 0 are one coordinate.
inline void find_coincident_vertices(const Face_soup& soup, Validity_report& report) {
  using Index = Face_soup::Index;
  std::vector<bool> used(soup.points.size(), false);
  for (const Index corner : soup.corners)
    used[corner] = true;
  std::vector<Index> order;
  for (Index v = 0; v < soup.points.size(); ++v)
    if (used[v] && soup.is_finite(v))
      order.push_back(v);
  std::sort(order.begin(), order.end(), [&](Index v, Index w) {
    const auto c = CGAL::compare_lexicographically_xyz(soup.points[v], soup.points[w]);
    return c == CGAL::SMALLER || (c == CGAL::EQUAL && v < w);
  });
  for (std::size_t i = 1, first = 0; i < order.size(); ++i)
    if (soup.points[order[i]] == soup.points[order[first]])
      report.coincident_vertices.emplace_back(Validity_report::Vertex_index(order[first]),
                                              Validity_report::Vertex_index(order[i]));
    else
      first = i;
  std::sort(report.coincident_vertices.begin(), report.coincident_vertices.end());
}

} // namespace internal

/// Says everything that is wrong with a list of faces; see `validate(mesh)`.
/// \tparam Concurrency_tag as of `validate(mesh)`
/// \param most_intersections stop after this many pairs of intersecting faces, at least one
/// \param face_name the index under which each face is reported; empty: its place in the soup
/// \param vertex_exists false for points that belong to nothing (removed vertices); empty: all exist
/// \throw Error as `validate(mesh)`, and if a corner is no index of a point, a face no part of the corners, or names
/// are not one for each face
template <class Concurrency_tag = CGAL::Sequential_tag>
Validity_report validate_soup(const Face_soup& soup, double delta = 0,
                              std::size_t most_intersections = Validity_report::default_most_intersections,
                              std::vector<Face_soup::Index> face_name = {}, std::vector<bool> vertex_exists = {}) {
  const internal::Rounding_to_nearest rounding;
  using Index = Face_soup::Index;
  internal::check_length_of_delta(delta);
  internal::check_corners(soup);
  if (face_name.empty()) {
    face_name.resize(soup.number_of_faces());
    std::iota(face_name.begin(), face_name.end(), Index(0));
  }
  if (face_name.size() != soup.number_of_faces())
    throw Error("there are " + std::to_string(face_name.size()) + " names for " +
                std::to_string(soup.number_of_faces()) + " faces; give one for each, or none");
  vertex_exists.resize(std::max(vertex_exists.size(), soup.points.size()), vertex_exists.empty());

  Validity_report report;
  report.delta = delta;
  internal::Soup_connectivity(soup).find_faults(face_name, vertex_exists, report);
  for (Index v = 0; v < soup.points.size(); ++v)
    if (vertex_exists[v] && !soup.is_finite(v))
      report.non_finite_vertices.emplace_back(v);
  internal::find_coincident_vertices(soup, report);

  std::vector<Index> triangles;
  std::vector<bool> flat(soup.number_of_faces(), false);
  const internal::Meet_improperly meet_improperly(soup);
  const Satisfies_delta_rule_3<Decision_kernel> satisfies_delta_rule(delta);
  for (Index f = 0; f < soup.number_of_faces(); ++f) {
    const Index* corner = soup.begin(f);
    if (soup.number_of_corners(f) != 3 || !std::all_of(corner, corner + 3, [&](Index v) { return soup.is_finite(v); }))
      continue; // no triangle in space: named above, and nothing more can be said of it
    triangles.push_back(f);
    flat[f] = meet_improperly.is_flat(f);
    if (flat[f])
      report.degenerate_faces.emplace_back(face_name[f]);
    else if (delta > 0 && !satisfies_delta_rule(soup.points[corner[0]], soup.points[corner[1]], soup.points[corner[2]]))
      report.low_faces.emplace_back(face_name[f]);
  }
  const auto intersections = internal::improper_intersections<Concurrency_tag>(
      soup, triangles, flat, std::max<std::size_t>(most_intersections, 1));
  report.has_more_intersections = intersections.has_more;
  for (const auto& [f, g] : intersections.pairs)
    report.intersecting_faces.emplace_back(Validity_report::Face_index(face_name[f]),
                                           Validity_report::Face_index(face_name[g]));
  if (report.is_valid())
    for (const Index f : internal::Component_orientation(soup).inside_out())
      report.inside_out_components.emplace_back(face_name[f]);
  return report;
}

/// The points and faces of a mesh. Points keep the indices of their vertices, removed ones included, which are at the
/// origin; faces close up.
/// \param face_name if given, receives the index of each face
/// \pre the connectivity of the mesh is consistent
template <class Mesh>
Face_soup face_soup(const Mesh& mesh, std::vector<Face_soup::Index>* face_name = nullptr) {
  using Index = Face_soup::Index;
  Face_soup soup;
  soup.points.resize(mesh.number_of_vertices() + mesh.number_of_removed_vertices(), Face_soup::Point_3(0, 0, 0));
  for (const auto v : mesh.vertices()) {
    const auto& p = mesh.point(v);
    soup.points[v] = Face_soup::Point_3(p.x(), p.y(), p.z());
  }
  soup.corners.reserve(3 * mesh.number_of_faces());
  for (const auto f : mesh.faces()) {
    const auto first = mesh.halfedge(f);
    auto h = first;
    do {
      soup.corners.push_back(static_cast<Index>(mesh.source(h)));
      h = mesh.next(h);
    } while (h != first);
    soup.close_face();
    if (face_name)
      face_name->push_back(static_cast<Index>(f));
  }
  return soup;
}

/// The one oracle of validity: is this a closed, 2-manifold surface of triangles, none degenerate, whose closed
/// triangles meet only in shared vertices and edges, with no altitude below `delta`? Names every offending element of
/// every kind; of pairs of intersecting faces, which can be as many as the square of the faces, only the first
/// `most_intersections` (always the same ones), and whether there are more.
///
/// Everything geometric is decided exactly on the stored doubles, by predicates that no fast path of this library uses:
/// all pairs of faces with meeting boxes are tried. Decisions taken:
/// - *Isolated vertices* are a fault, wherever they lie: they are no part of a surface.
/// - *Inside-out* and *nested* components do not make a surface invalid, as a surface is embedded whichever way its
///   normals point; a component whose normals point into the solid is reported for information.
/// - A mesh without faces is valid.
/// - Faces that are no finite triangles are named, and left out of the search for intersections.
///
/// \tparam Concurrency_tag `CGAL::Sequential_tag` (the default), `CGAL::Parallel_tag` or
/// `CGAL::Parallel_if_available_tag`: whether oneTBB's threads share the search for intersections; the report is the
/// same \tparam Mesh `CGAL::Surface_mesh<K::Point_3>` with `K::FT = double` \param delta the delta rule's length
/// (paper, section 3.1), >= 0; 0: only exact degeneracy counts \param most_intersections pairs of intersecting faces to
/// name, at least one; `Validity_report::all_intersections`: all \throw Error if delta is negative or not finite
/// Complexity: O(n log^3 n + pairs of faces with meeting boxes) up to the last pair named, components included
/// (doc/use/validity.md); 1.6 s for a million triangles. Memory: about 80 bytes a triangle beside the mesh. Thread-safe
/// as far as reading the mesh is; whatever rounding mode the caller has set.
template <class Concurrency_tag = CGAL::Sequential_tag, class Mesh>
Validity_report validate(const Mesh& mesh, double delta = 0,
                         std::size_t most_intersections = Validity_report::default_most_intersections) {
  using Kernel = typename CGAL::Kernel_traits<typename Mesh::Point>::Kernel;
  static_assert(std::is_same_v<typename Kernel::FT, double>, "validate() decides on coordinates of type double");
  internal::check_length_of_delta(delta);
  if (const auto wrong = internal::inconsistent_elements(mesh); !wrong.empty()) {
    Validity_report report;
    report.delta = delta;
    for (const auto h : wrong.halfedges)
      report.inconsistent_halfedges.emplace_back(static_cast<std::size_t>(h));
    for (const auto f : wrong.faces)
      report.inconsistent_faces.emplace_back(static_cast<std::size_t>(f));
    for (const auto v : wrong.vertices)
      report.inconsistent_vertices.emplace_back(static_cast<std::size_t>(v));
    return report;
  }
  std::vector<Face_soup::Index> face_name;
  face_name.reserve(mesh.number_of_faces());
  const Face_soup soup = face_soup(mesh, &face_name);
  std::vector<bool> vertex_exists(soup.points.size(), false);
  for (const auto v : mesh.vertices())
    vertex_exists[v] = true;
  Validity_report report =
      validate_soup<Concurrency_tag>(soup, delta, most_intersections, std::move(face_name), std::move(vertex_exists));
  internal::report_open_seams(mesh, report);
  return report;
}

} // namespace haptic_sculpt
