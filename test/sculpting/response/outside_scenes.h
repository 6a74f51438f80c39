// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

/// \file
/// Scenes in which drags end at one of many local minima: probes and stars around solids, vertices dragged against
/// their own star, and the targets that bring all kinds of contact about.

#include "sculpting/scene_parts.h"

#include <haptic_sculpt/surface.h>

#include <CGAL/Side_of_triangle_mesh.h>

#include <algorithm>
#include <filesystem>
#include <memory>

namespace haptic_sculpt::test {

struct Outside_scene {
  std::string name;
  Mesh mesh;
  Vertex_index moved;
  double size = 1;                 ///< half of the largest extent of what stands still
  Point_3 centre{0, 0, 0};
  bool has_needle_grooves = false; ///< stretched so much that grooves are acute
  std::size_t first_of_mover = 0;  ///< vertices from here on belong to what is dragged; all others are other solids'
};

/// Notices a dragged vertex that has passed through a solid, and a solid that has come inside of the one that is
/// dragged. Says nothing about vertices of the solids themselves: what those may not pass through, `validate` sees.
class Containment_check {
public:
  explicit Containment_check(const Outside_scene& scene) : scene_(&scene) {
    if (scene.first_of_mover == 0)
      return;
    std::map<Vertex_index, Vertex_index> copy;
    for (const auto f : scene.mesh.faces()) {
      std::vector<Vertex_index> corners;
      for (const Vertex_index v : scene.mesh.vertices_around_face(scene.mesh.halfedge(f)))
        corners.push_back(v);
      const bool is_mover = static_cast<std::size_t>(corners[0]) >= scene.first_of_mover;
      Mesh& part = is_mover ? mover_ : solids_;
      for (Vertex_index& v : corners) {
        const auto [place, is_new] = copy.emplace(v, Vertex_index());
        if (is_new)
          place->second = part.add_vertex(scene.mesh.point(v));
        v = place->second;
      }
      part.add_face(corners);
    }
    if (mover_.is_empty())
      side_of_solids_ = std::make_unique<Side>(solids_);
    else
      moved_ = copy.at(scene.moved);
  }

  /// \param position of the dragged vertex; all else is where it was
  bool holds(const Point_3& position) {
    if (scene_->first_of_mover == 0)
      return true;
    if (side_of_solids_)
      return (*side_of_solids_)(position) == CGAL::ON_UNBOUNDED_SIDE;
    mover_.point(moved_) = position;
    const Side side(mover_);
    for (std::size_t i = 0; i < scene_->first_of_mover; ++i)
      if (side(scene_->mesh.point(Vertex_index(static_cast<Mesh::size_type>(i)))) != CGAL::ON_UNBOUNDED_SIDE)
        return false;
    return true;
  }

private:
  using Side = CGAL::Side_of_triangle_mesh<Mesh, meshes::Kernel>;
  const Outside_scene* scene_;
  Mesh solids_, mover_;
  Vertex_index moved_;
  std::unique_ptr<Side> side_of_solids_;
};

namespace internal_scenes {

inline double half_extent(const meshes::Triangle_list& list) {
  double extent = 0;
  for (int i = 0; i < 3; ++i) {
    double low = list.points[0][i], high = low;
    for (const Point_3& p : list.points) {
      low = std::fmin(low, p[i]);
      high = std::fmax(high, p[i]);
    }
    extent = std::fmax(extent, (high - low) / 2);
  }
  return extent;
}

/// A mover near the surface of a solid about the origin, in a random direction.
inline Outside_scene around(const std::string& name, meshes::Triangle_list solid, Mover mover, Random& random,
                            double start = 1.8) {
  Outside_scene scene;
  scene.name = name + ", " + name_of(mover);
  scene.size = half_extent(solid);
  scene.first_of_mover = solid.points.size();
  const Vector_3 direction = uniform_direction(random);
  const Point_3 centre(0, 0, 0);
  const std::size_t moved =
      add_mover(solid, mover, centre + start * scene.size * direction, centre + (start + 0.7) * scene.size * direction,
                uniform(random, 0.1, 0.5) * scene.size);
  scene.mesh = valid_mesh(solid, scene.name);
  scene.moved = Vertex_index(static_cast<Mesh::size_type>(moved));
  return scene;
}

/// A vertex of the solid itself.
inline Outside_scene own_vertex(const std::string& name, const meshes::Triangle_list& solid, Random& random) {
  Outside_scene scene;
  scene.name = name + ", a vertex of it";
  scene.size = half_extent(solid);
  scene.mesh = valid_mesh(solid, scene.name);
  scene.moved = Vertex_index(static_cast<Mesh::size_type>(random() % solid.points.size()));
  return scene;
}

inline meshes::Triangle_list irregular_tetrahedron(Random& random) {
  meshes::Triangle_list list = meshes::tetrahedron();
  list.points = {{1, 1, 1}, {-1, 1, -1}, {1, -1, -1}, {-1, -1, 1}};
  return list.transform([&](const Point_3& p) { return p + uniform_vector(random, 0.5); });
}

inline meshes::Triangle_list split_cube() { return meshes::box(3, 2).scale_and_move(1, -1, -1, -1); }

inline meshes::Triangle_list terrain(Random& random) {
  return meshes::bumpy_sphere(3, 0.3, 0.03, static_cast<std::uint32_t>(random()));
}

/// Terrain stretched 50 : 1.
inline meshes::Triangle_list needle(Random& random) {
  return meshes::bumpy_sphere(2, 0.3, 0.03, static_cast<std::uint32_t>(random())).transform([](const Point_3& p) {
    return Point_3(5 * p.x(), 0.1 * p.y(), 0.1 * p.z());
  });
}

/// Four solids about the origin, and a star in their middle whose tip can reach all.
inline Outside_scene among_four_solids(Random& random) {
  meshes::Triangle_list list;
  const std::array<meshes::Triangle_list, 4> solids = {
      irregular_tetrahedron(random), split_cube(), meshes::icosphere(1),
      meshes::bumpy_sphere(2, 0.4, 0.05, static_cast<std::uint32_t>(random()))};
  const std::array<Vector_3, 4> places = {Vector_3(1, 1, 1), Vector_3(-1, 1, -1), Vector_3(1, -1, -1),
                                          Vector_3(-1, -1, 1)};
  for (int i = 0; i < 4; ++i) {
    meshes::Triangle_list solid = solids[i];
    const Rigid_motion motion = Rigid_motion::random(random);
    solid.transform([&](const Point_3& p) {
      return Point_3(0, 0, 0) + 0.35 * (motion(p) - Point_3(0, 0, 0) - motion.shift) + 0.7 * places[i];
    });
    list += solid;
  }
  Outside_scene scene;
  scene.name = "star among four solids";
  scene.size = half_extent(list);
  scene.first_of_mover = list.points.size();
  const std::size_t moved = add_mover(list, Mover::bipyramid, {0, 0, 0.1}, {0, 0, -0.1}, 0.2);
  scene.mesh = valid_mesh(list, scene.name);
  scene.moved = Vertex_index(static_cast<Mesh::size_type>(moved));
  return scene;
}

} // namespace internal_scenes

/// All kinds of scenes once, drawn anew.
inline std::vector<Outside_scene> outside_scenes(Random& random) {
  using namespace internal_scenes;
  std::vector<Outside_scene> scenes;
  for (const Mover mover : {Mover::probe, Mover::tetrahedron, Mover::bipyramid}) {
    scenes.push_back(around("tetrahedron", irregular_tetrahedron(random), mover, random, 2.2));
    scenes.push_back(around("split cube", split_cube(), mover, random));
    scenes.push_back(around("icosphere", meshes::icosphere(3), mover, random, 1.2));
    scenes.push_back(around("terrain", terrain(random), mover, random, 1.3));
    scenes.push_back(around("needle", needle(random), mover, random, 1.2));
    scenes.back().has_needle_grooves = true;
  }
  scenes.push_back(among_four_solids(random));
  scenes.push_back(own_vertex("tetrahedron", irregular_tetrahedron(random), random));
  scenes.push_back(own_vertex("split cube", split_cube(), random));
  scenes.push_back(own_vertex("bipyramid", meshes::bipyramid(5), random));
  scenes.push_back(own_vertex("torus", meshes::torus(9, 6), random));
  scenes.push_back(own_vertex("terrain", terrain(random), random));
  scenes.push_back(own_vertex("needle", needle(random), random));
  scenes.back().has_needle_grooves = true;
  return scenes;
}

/// The valid meshes of a folder with at most this many faces, in order of their names; which vertex is dragged is left
/// open.
inline std::vector<Outside_scene> shared_scenes(const std::filesystem::path& folder, std::size_t most_faces) {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    if (mesh_file_format(entry.path()))
      files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  std::vector<Outside_scene> scenes;
  for (const auto& file : files)
    try {
      Outside_scene scene;
      scene.mesh = read_surface<Mesh>(file);
      if (scene.mesh.number_of_faces() > most_faces)
        continue;
      scene.name = file.filename().string();
      meshes::Triangle_list points;
      for (const Vertex_index v : scene.mesh.vertices())
        points.points.push_back(scene.mesh.point(v));
      scene.size = internal_scenes::half_extent(points);
      const auto box = CGAL::bbox_3(points.points.begin(), points.points.end());
      scene.centre =
          Point_3((box.xmin() + box.xmax()) / 2, (box.ymin() + box.ymax()) / 2, (box.zmin() + box.zmax()) / 2);
      scenes.push_back(std::move(scene));
    } catch (const Invalid_surface&) {
      // What read_surface() refuses is none of a drag's business; test_surface sees to it.
    }
  return scenes;
}

/// Somewhere, and on purpose: through other vertices, exactly on them, on faces, in the plane of own faces, along own
/// edges, beyond the own star's other side, with coordinates of other vertices so that paths lie in planes of faces,
/// and close by.
inline Point_3 outside_target(const Outside_scene& scene, const Mesh& mesh, Random& random) {
  const Vertex_index v = scene.moved;
  const Point_3 p = mesh.point(v);
  const auto any = [&] {
    return mesh.point(Vertex_index(static_cast<Mesh::size_type>(random() % mesh.number_of_vertices())));
  };
  const auto neighbour = [&] {
    if (mesh.is_isolated(v))
      return any();
    auto h = mesh.halfedge(v);
    for (std::size_t turns = random() % 8; turns > 0; --turns)
      h = mesh.opposite(mesh.next(h));
    return mesh.point(mesh.source(h));
  };
  switch (random() % 12) {
  case 0: case 1: return scene.centre + uniform_vector(random, 1.5 * scene.size);
  case 2: return scene.centre + uniform_vector(random, 0.5 * scene.size);
  case 3: { const Point_3 q = any(); return q + uniform(random, 0, 0.5) * (q - p); }
  case 4: return any();
  case 5: { const Point_3 a = any(), b = any(); return CGAL::midpoint(a, b); }
  case 6: { const Point_3 a = neighbour(); return p + uniform(random, -1, 2) * (a - p); }
  case 7: {
    const Point_3 a = neighbour(), b = neighbour();
    return p + uniform(random, 0, 2) * (CGAL::midpoint(a, b) - p);
  }
  case 8: { // in planes of faces, where those lie along the axes
    const Point_3 q = any();
    const std::size_t kept = random() % 3;
    std::array<double, 3> t = {q.x(), q.y(), q.z()};
    t[kept] = p[static_cast<int>(kept)];
    return {t[0], t[1], t[2]};
  }
  case 9: return p + uniform_vector(random, 0.1 * scene.size);
  case 10: return p + uniform_vector(random, 0.01 * scene.size);
  default: return p + uniform(random, 0, 0.2) * (scene.centre + uniform_vector(random, 0.3 * scene.size) - p);
  }
}

} // namespace haptic_sculpt::test
