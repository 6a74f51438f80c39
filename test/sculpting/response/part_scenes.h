// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

/// \file
/// Machine parts and near-degenerate solids in which vertices are dragged, and targets that lie on, along and beyond
/// what is flat and right-angled in them.

#include "sculpting/response/part_shapes.h"

#include <haptic_sculpt/surface.h>

#include <string>

namespace haptic_sculpt::test {

struct Part_scene {
  std::string family;
  Mesh mesh;
  std::size_t first_mover = 0; ///< vertices from here on are movers' vertices, all before are the part's
  std::vector<Point_3> probes; ///< where probes begin
  double size = 1;             ///< half of the largest extent
  Point_3 centre{0, 0, 0};
  bool is_near_degenerate = false;
};

/// All families, in the order in which part_scene() numbers them.
inline const std::vector<std::string>& part_families() {
  static const std::vector<std::string> names = {
      "pockets",          "stairs",      "slots",        "menger", "extruded",    "pockets, turned",
      "extruded, turned", "thin plates", "sliver stack", "books",  "narrow slots"};
  return names;
}
/// From here on they are near-degenerate.
constexpr std::size_t first_near_degenerate_family = 7;

namespace internal_parts {

inline void measure(Part_scene& scene) {
  const auto box = CGAL::bbox_3(scene.mesh.points().begin(), scene.mesh.points().end());
  scene.size = std::max({box.xmax() - box.xmin(), box.ymax() - box.ymin(), box.zmax() - box.zmin()}) / 2;
  scene.centre = Point_3((box.xmin() + box.xmax()) / 2, (box.ymin() + box.ymax()) / 2, (box.zmin() + box.zmax()) / 2);
}

/// Each coordinate of the grid is put elsewhere, the order kept: equal ones stay equal, so what was flat is.
inline void stretch(meshes::Triangle_list& list, Random& random) {
  static constexpr std::array<double, 9> scales = {1, 1, 0.1, 25.4, 0x1p-10, 1e-6, 1e6, 3, 1.0 / 3};
  static constexpr std::array<double, 6> shifts = {0, 0, 1, 0.3, 100, -1e4};
  const double scale = scales[random() % scales.size()];
  std::array<std::map<double, double>, 3> places;
  for (int axis = 0; axis < 3; ++axis) {
    for (const Point_3& p : list.points)
      places[axis][p[axis]];
    const double shift = shifts[random() % shifts.size()];
    const bool is_even = random() % 2 == 0;
    double before = 0, where = 0;
    for (auto& [coordinate, place] : places[axis]) {
      where += (coordinate - before) * (is_even ? 1 : whole_number(random, 1, 3));
      before = coordinate;
      place = scale * (where + shift);
    }
  }
  list.transform([&](const Point_3& p) { return Point_3(places[0][p.x()], places[1][p.y()], places[2][p.z()]); });
}

inline meshes::Triangle_list shape(std::size_t family, Random& random) {
  switch (family) {
  case 0:
  case 5:
    return block_with_pockets(random).boundary(random);
  case 1:
    return stairs(random).boundary(random);
  case 2:
    return slots(random).boundary(random);
  case 3:
    return menger().boundary(random);
  case 4:
  case 6:
    return extruded(skyline(random), whole_number(random, 1, 3), random);
  case 7:
    return thin_plates(random);
  case 8:
    return meshes::sliver_stack(static_cast<std::size_t>(whole_number(random, 3, 30)),
                                std::ldexp(1.0, -whole_number(random, 20, 45)));
  case 9:
    return narrow_slots(random() % 2 == 0 ? 1e-10 : std::pow(10, uniform(random, -12, -8)), 0, random);
  default: {
    const double width = std::pow(10, uniform(random, -15, -6));
    return narrow_slots(width, random() % 2 == 0 ? width : width * uniform(random, 0.5, 1), random);
  }
  }
}

/// A small solid and probes beside or in the part; corners of boxes have faces parallel to the part's.
inline void add_movers(meshes::Triangle_list& list, std::vector<Point_3>& probes, Random& random) {
  const auto box = CGAL::bbox_3(list.points.begin(), list.points.end());
  const std::array<double, 3> lower = {box.xmin(), box.ymin(), box.zmin()},
                              upper = {box.xmax(), box.ymax(), box.zmax()};
  const double size = std::max({upper[0] - lower[0], upper[1] - lower[1], upper[2] - lower[2]}) / 2;
  const auto place = [&] {
    std::array<double, 3> p;
    for (int i = 0; i < 3; ++i)
      p[i] = uniform(random, lower[i] - 0.3 * size, upper[i] + 0.3 * size);
    return Point_3(p[0], p[1], p[2]);
  };
  for (int i = 0; i < 2; ++i)
    probes.push_back(place());
  const Point_3 p = place();
  if (random() % 2 == 0) {
    meshes::Triangle_list cube = meshes::cube(0.1 * size);
    list += cube.scale_and_move(1, p.x(), p.y(), p.z());
  } else
    add_mover(list, random() % 2 == 0 ? Mover::tetrahedron : Mover::bipyramid, p,
              p + 0.2 * size * uniform_direction(random), 0.1 * size);
}

} // namespace internal_parts

/// A scene of a family, drawn anew until it is valid. \pre family < part_families().size()
inline Part_scene part_scene(std::size_t family, Random& random) {
  for (int attempts = 0; attempts < 1000; ++attempts) {
    Part_scene scene;
    scene.family = part_families()[family];
    scene.is_near_degenerate = family >= first_near_degenerate_family;
    meshes::Triangle_list list = internal_parts::shape(family, random);
    if (!scene.is_near_degenerate)
      internal_parts::stretch(list, random);
    scene.first_mover = list.points.size();
    if (!scene.is_near_degenerate || random() % 2 == 0)
      internal_parts::add_movers(list, scene.probes, random);
    if (scene.family.find("turned") != std::string::npos) {
      const Rigid_motion motion = Rigid_motion::random(random);
      list.transform([&](const Point_3& p) { return motion(p); });
      std::transform(scene.probes.begin(), scene.probes.end(), scene.probes.begin(),
                     [&](const Point_3& p) { return motion(p); });
    }
    try {
      scene.mesh = meshes::to_mesh(list);
    } catch (const std::logic_error&) {
      continue; // cells that share an edge only
    }
    if (!validate(scene.mesh).is_valid())
      continue;
    internal_parts::measure(scene);
    return scene;
  }
  throw std::logic_error(part_families()[family] + ": no valid scene among a thousand");
}

/// Any vertex, movers more often than they are many.
inline Vertex_index part_vertex(const Part_scene& scene, const Mesh& mesh, Random& random) {
  const std::size_t n = mesh.num_vertices(), movers = n - scene.first_mover;
  for (;;) {
    const bool is_mover = movers > 0 && random() % 3 == 0;
    const Vertex_index v(static_cast<Mesh::size_type>(is_mover ? scene.first_mover + random() % movers : random() % n));
    if (!mesh.is_removed(v))
      return v;
  }
}

/// On vertices and edges, in planes of faces, on extensions of edges, beyond faces, along axes, near and anywhere.
/// \param v what is dragged, null: a probe \param p where it is
inline Point_3 part_target(const Part_scene& scene, const Mesh& mesh, Vertex_index v, const Point_3& p,
                           Random& random) {
  const auto any_vertex = [&] {
    for (;;) {
      const Vertex_index w(static_cast<Mesh::size_type>(random() % mesh.num_vertices()));
      if (!mesh.is_removed(w))
        return w;
    }
  };
  const auto any = [&] { return mesh.point(any_vertex()); };
  const auto halfedge = [&](bool of_star) {
    if (of_star && v.is_valid()) {
      auto h = mesh.halfedge(v);
      for (std::size_t turns = random() % 8; turns > 0; --turns)
        h = mesh.opposite(mesh.next(h));
      return h;
    }
    for (;;) {
      const Mesh::Halfedge_index h(static_cast<Mesh::size_type>(random() % mesh.num_halfedges()));
      if (!mesh.is_removed(h))
        return h;
    }
  };
  const auto part = [&](double low, double high) { // of a length: quarters, or anything
    return random() % 2 == 0 ? whole_number(random, static_cast<int>(4 * low), static_cast<int>(4 * high)) / 4.0
                             : uniform(random, low, high);
  };
  static constexpr std::array<double, 6> near = {0.3, 0.06, 0.06, 0.01, 1e-3, 1e-6};
  switch (random() % 12) {
  case 0:
    return any();
  case 1: {
    const auto h = halfedge(false);
    const Point_3 a = mesh.point(mesh.source(h));
    return a + part(0, 1) * (mesh.point(mesh.target(h)) - a);
  }
  case 2: {
    const auto h = halfedge(random() % 2 == 0);
    const Point_3 a = mesh.point(mesh.source(h));
    return a + part(-2, 3) * (mesh.point(mesh.target(h)) - a);
  }
  case 3:
  case 4: {
    const auto h = halfedge(random() % 2 == 0);
    const Point_3 a = mesh.point(mesh.source(h)), b = mesh.point(mesh.target(h)),
                  c = mesh.point(mesh.target(mesh.next(h)));
    return a + part(-1, 2) * (b - a) + part(-1, 2) * (c - a);
  }
  case 5: { // along an axis
    std::array<double, 3> t = {p.x(), p.y(), p.z()};
    const std::size_t axis = random() % 3;
    t[axis] = random() % 2 == 0 ? any()[static_cast<int>(axis)] : t[axis] + uniform(random, -1, 1) * scene.size;
    return {t[0], t[1], t[2]};
  }
  case 6: { // across one
    const Point_3 q = any();
    std::array<double, 3> t = {q.x(), q.y(), q.z()};
    const std::size_t kept = random() % 3;
    t[kept] = p[static_cast<int>(kept)];
    return {t[0], t[1], t[2]};
  }
  case 7: {
    const double x = any().x(), y = any().y(), z = any().z();
    return {x, y, z};
  }
  case 8: { // beyond a face
    const auto h = halfedge(false);
    const Point_3 q =
        CGAL::centroid(mesh.point(mesh.source(h)), mesh.point(mesh.target(h)), mesh.point(mesh.target(mesh.next(h))));
    return p + part(1, 2) * (q - p);
  }
  case 9:
  case 10:
    return p + uniform_vector(random, near[random() % near.size()] * scene.size);
  default:
    return scene.centre + uniform_vector(random, 1.5 * scene.size);
  }
}

} // namespace haptic_sculpt::test
