// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/surface/repair/mesh_steps.h>
#include <haptic_sculpt/surface/repair/separate_vertices.h>
#include <haptic_sculpt/surface/validity/improper_intersection.h>

#include <CGAL/boost/graph/Euler_operations.h>
#include <CGAL/boost/graph/selection.h>

#include <iterator>
#include <set>
#include <utility>
#include <vector>

namespace haptic_sculpt::internal {

/// Cuts the faces of a closed mesh that meet each other out, with rings of faces around them, and closes the holes;
/// with more rings as long as faces meet. `CGAL::Polygon_mesh_processing::experimental::remove_self_intersections`
/// smooths before it cuts: that makes points of NaN, on which GMP ends the process. Here no point is new and none
/// moves.
class Crossing_removal {
  using Face = Work_mesh::Face_index;
  using Faces = std::set<Face>;

  /// The most rings, as many as CGAL takes: if these do not do, it is no fault of a place, but of the whole mesh.
  static constexpr int most_rings = 7;
  /// One of this many vertices has to be left: where more have to go, what is left is another shape.
  static constexpr std::size_t least_share = 2;

public:
  /// \pre the mesh is closed, and a 2-manifold of triangles
  /// \return whether no faces meet now, and most of the mesh is left; if not, the mesh is worth nothing
  static bool run(Work_mesh& mesh) {
    const std::size_t vertices = mesh.number_of_vertices();
    Faces meeting = meeting_faces(mesh);
    // What is cut out is a disc each time, so that the genus stays; if that does not do, it may be anything.
    for (const bool keeps_genus : {true, false})
      for (int rings = 0; rings < most_rings && !meeting.empty();) {
        const std::size_t before = meeting.size();
        Work_mesh trial = mesh;
        if (cut_out(trial, meeting, rings, keeps_genus) && close(trial) && inconsistent_elements(trial).empty()) {
          trial.collect_garbage();
          mesh = std::move(trial);
          meeting = meeting_faces(mesh);
        }
        rings += 4 * meeting.size() > 3 * before; // the fewer rings the fewer vertices go
      }
    return meeting.empty() && mesh.number_of_vertices() * least_share >= vertices;
  }

private:
  /// Those that are flat among them, which a hole may be closed with.
  static Faces meeting_faces(const Work_mesh& mesh) {
    std::vector<Face_soup::Index> face_name, triangles;
    const Face_soup soup = face_soup(mesh, &face_name);
    const Meet_improperly meet_improperly(soup);
    std::vector<bool> flat(soup.number_of_faces());
    Faces faces;
    for (Face_soup::Index f = 0; f < soup.number_of_faces(); ++f) {
      triangles.push_back(f);
      flat[f] = meet_improperly.is_flat(f);
      if (flat[f])
        faces.insert(Face(face_name[f]));
    }
    for (const auto& [f, g] : improper_intersections(soup, triangles, flat, Vertex_separation::most_pairs).pairs) {
      faces.insert(Face(face_name[f]));
      faces.insert(Face(face_name[g]));
    }
    return faces;
  }

  /// \return whether anything was cut out
  static bool cut_out(Work_mesh& mesh, Faces faces, int rings, bool keeps_genus) {
    const CGAL::Boolean_property_map<Faces> is_selected(faces);
    CGAL::expand_face_selection(std::vector<Face>(faces.begin(), faces.end()), mesh, static_cast<unsigned int>(rings),
                                is_selected, CGAL::Emptyset_iterator());
    CGAL::expand_face_selection_for_removal(std::vector<Face>(faces.begin(), faces.end()), mesh, is_selected);
    bool did = false;
    while (!faces.empty()) {
      const std::vector<Face> part = take_part(mesh, faces);
      if (part.size() == mesh.number_of_faces() ||
          (keeps_genus && CGAL::euler_characteristic_of_selection(part, mesh) != 1))
        continue;
      for (const Face f : part)
        CGAL::Euler::remove_face(mesh.halfedge(f), mesh);
      did = true;
    }
    return did;
  }

  /// Takes one of them and all that hang together with it by edges.
  static std::vector<Face> take_part(const Work_mesh& mesh, Faces& faces) {
    std::vector<Face> part{*faces.begin()};
    faces.erase(faces.begin());
    for (std::size_t i = 0; i < part.size(); ++i)
      for (const auto h : mesh.halfedges_around_face(mesh.halfedge(part[i])))
        if (const Face f = mesh.face(mesh.opposite(h)); faces.erase(f) != 0)
          part.push_back(f);
    return part;
  }

  static bool close(Work_mesh& mesh) {
    for (const auto h : holes_of(mesh)) {
      close_hole(mesh, h);
      if (mesh.is_border(h))
        return false;
    }
    return true;
  }
};

} // namespace haptic_sculpt::internal
