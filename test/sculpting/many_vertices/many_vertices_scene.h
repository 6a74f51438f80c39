// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "meshes/thin_walls.h"
#include "sculpting/Mesh_snapshot.h"

#include <haptic_sculpt/sculpting.h>
#include <haptic_sculpt/surface.h>

#include <seeds_and_sizes.h>
#include <shared_data.h>

#include <boost/test/unit_test.hpp>

#include <string>
#include <vector>

namespace haptic_sculpt::test {

using Mesh = meshes::Mesh;
using Point_3 = meshes::Point_3;
using Vector_3 = meshes::Kernel::Vector_3;
using Vertex_index = Mesh::Vertex_index;
using Edge_index = Mesh::Edge_index;
using Face_index = Mesh::Face_index;
using Point_map = Mesh::Property_map<Vertex_index, Point_3>;
using Transformation = CGAL::Aff_transformation_3<meshes::Kernel>;

inline Transformation translation(const Vector_3& d) {
  return {CGAL::TRANSLATION, d};
}

struct Named_mesh {
  std::string name;
  Mesh mesh;
};

/// Generated ones, and shared ones where they are present.
inline std::vector<Named_mesh> scenes(bool with_shared = true) {
  std::vector<Named_mesh> result = {{"bumpy sphere", meshes::to_mesh(meshes::bumpy_sphere(3, 0.3, 0.05))},
                                    {"torus", meshes::to_mesh(meshes::torus(24, 12))},
                                    {"hollow ball", meshes::to_mesh(meshes::hollow_ball())},
                                    {"wavy plate", meshes::to_mesh(meshes::wavy_plate())},
                                    {"Swiss cheese", meshes::to_mesh(meshes::swiss_cheese())},
                                    {"ball in a cavity", meshes::to_mesh(meshes::ball_in_a_cavity())},
                                    {"box", meshes::to_mesh(meshes::box(6))},
                                    {"sliver stack", meshes::to_mesh(meshes::sliver_stack(20, 0x1p-12))},
                                    {"C tube", meshes::to_mesh(meshes::c_tube(0.01))}};
  if (with_shared)
    for (const char* name : {"cgal_eight.off", "cgal_joint.off", "oded_spot_low_resolution.obj"})
      if (const auto path = shared_data(std::string("meshes/") + name))
        result.push_back({name, read_surface<Mesh>(*path)});
  return result;
}

/// A box from a corner on, of these sizes, as a component of its own. \return its vertices
inline std::vector<Vertex_index> add_box(meshes::Triangle_list& list, const Vector_3& corner, const Vector_3& size) {
  const std::size_t first = list.points.size();
  list += meshes::box(1).transform([&](const Point_3& p) {
    return Point_3(corner.x() + p.x() * size.x(), corner.y() + p.y() * size.y(), corner.z() + p.z() * size.z());
  });
  std::vector<Vertex_index> vertices;
  for (std::size_t v = first; v < list.points.size(); ++v)
    vertices.emplace_back(static_cast<Mesh::size_type>(v));
  return vertices;
}

/// A box that stands 2^-12 above a plate: free along x and y, and not far down.
struct Box_over_plate {
  std::vector<Vertex_index> box;
  Mesh mesh;
  Sculptor<Mesh> sculptor;

  Box_over_plate() : mesh(made(box)), sculptor(mesh) {}
  /// That can be undone, and redone.
  std::pair<std::size_t, std::size_t> steps() const {
    return {sculptor.history().number_of_undo_steps(), sculptor.history().number_of_redo_steps()};
  }

private:
  static Mesh made(std::vector<Vertex_index>& box) {
    meshes::Triangle_list list;
    box = add_box(list, {0, 0, 0}, {1, 1, 1});
    add_box(list, {-9, -9, -9 - 0x1p-12}, {18, 18, 9});
    return meshes::to_mesh(list);
  }
};

inline double mean_edge(const Mesh& mesh) {
  double sum = 0;
  for (const auto e : mesh.edges())
    sum += std::sqrt(CGAL::squared_distance(mesh.point(mesh.vertex(e, 0)), mesh.point(mesh.vertex(e, 1))));
  return sum / static_cast<double>(mesh.number_of_edges());
}

/// Of the area around it; zero where that is.
inline Vector_3 normal(const Mesh& mesh, Vertex_index v) {
  Vector_3 sum = CGAL::NULL_VECTOR;
  for (const auto h : mesh.halfedges_around_target(mesh.halfedge(v)))
    sum = sum + CGAL::cross_product(mesh.point(mesh.target(mesh.next(h))) - mesh.point(v),
                                    mesh.point(mesh.source(h)) - mesh.point(v));
  const double length = std::sqrt(sum.squared_length());
  return length > 0 ? sum / length : sum;
}

/// What a step did is taken back and made again, to the bit.
template <class Sculptor>
void check_undo_and_redo(Sculptor& sculptor, const Mesh_snapshot& before) {
  const Mesh_snapshot after = snapshot(sculptor);
  if (after == before)
    return;
  BOOST_TEST(static_cast<bool>(sculptor.undo()));
  BOOST_TEST((snapshot(sculptor) == before));
  BOOST_TEST(static_cast<bool>(sculptor.redo()));
  BOOST_TEST((snapshot(sculptor) == after));
}

} // namespace haptic_sculpt::test
