// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "haptic_rendering/pose_readings.h"
#include "meshes/generated_meshes.h"

#include <haptic_sculpt/haptic_rendering.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <vector>

namespace exchange_tests {

using Mesh = meshes::Mesh;
using Scene = Loop_scene<Mesh>;

inline std::unique_ptr<Scene> scene_of(int level) {
  return std::make_unique<Scene>(meshes::to_mesh(meshes::bumpy_sphere(level, 0.12)),
                                 [](const Vector3d&, const Vector3d&) { return map_of_tests; });
}

/// Points and faces by the vertices' numbers: what a mesh is, whatever its indices are.
struct Surface {
  std::map<std::uint64_t, std::array<double, 3>> points;
  std::vector<std::array<std::uint64_t, 3>> faces;
  bool operator==(const Surface& other) const { return points == other.points && faces == other.faces; }

  void add_face(std::array<std::uint64_t, 3> face) {
    std::rotate(face.begin(), std::min_element(face.begin(), face.end()), face.end());
    faces.push_back(face);
  }
};

template <class Sculptor>
Surface surface_of(const Mesh& mesh, const Sculptor& sculptor) {
  Surface surface;
  for (const auto v : mesh.vertices())
    surface.points[sculptor.id(v)] = {mesh.point(v).x(), mesh.point(v).y(), mesh.point(v).z()};
  for (const auto f : mesh.faces()) {
    std::array<std::uint64_t, 3> face{};
    int i = 0;
    for (const auto v : mesh.vertices_around_face(mesh.halfedge(f)))
      face[i++] = sculptor.id(v);
    surface.add_face(face);
  }
  std::sort(surface.faces.begin(), surface.faces.end());
  return surface;
}
inline Surface surface_of(const Scene& scene) { return surface_of(scene.mesh, scene.sculptor); }

/// What a viewer has of the faces it was passed.
inline Surface surface_of(const std::map<std::uint32_t, Face_change>& faces) {
  Surface surface;
  for (const auto& [index, face] : faces) {
    surface.add_face(face.vertices);
    for (std::size_t i = 0; i < 3; ++i)
      surface.points[face.vertices[i]] = face.corners[i];
  }
  std::sort(surface.faces.begin(), surface.faces.end());
  return surface;
}

/// As a viewer does it: of another scene nothing is left.
inline void show(const Face_change& face, std::map<std::uint32_t, Face_change>& shown, std::uint32_t& scene) {
  if (face.scene != scene)
    shown.clear(), scene = face.scene;
  if (face.is_there)
    shown[face.index] = face;
  else
    shown.erase(face.index);
}

inline Surface surface_of(const Scene_copy& copy) {
  Surface surface;
  for (std::size_t v = 0; v < copy.ids.size(); ++v)
    if (copy.ids[v] != Scene_copy::absent)
      surface.points[copy.ids[v]] = copy.points[v];
  for (const auto& f : copy.faces)
    if (f[0] != Scene_copy::no_corner)
      surface.add_face({copy.ids[f[0]], copy.ids[f[1]], copy.ids[f[2]]});
  std::sort(surface.faces.begin(), surface.faces.end());
  return surface;
}

} // namespace exchange_tests
