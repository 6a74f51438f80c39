// SPDX-License-Identifier: GPL-3.0-or-later
// Guarded remeshing of patches, and along lines of constraints, beside CGAL's.
#include "sculpting/many_vertices/many_vertices_scene.h"

#include <haptic_sculpt/sculpting/isotropic_remeshing.h>

#include <CGAL/Polygon_mesh_processing/remesh.h>

#include <set>

using namespace haptic_sculpt;
using namespace haptic_sculpt::test;

namespace {

using Patch_map = Mesh::Property_map<Face_index, int>;
using Edge_marks = Mesh::Property_map<Edge_index, bool>;

/// The side of the unit cube that three corners are on, from 1; 0: none.
int side(const Mesh& mesh, Face_index f) {
  for (int i = 0; i < 3; ++i)
    for (const double at : {0.0, 1.0}) {
      bool is_on = true;
      for (const auto v : internal::corners_of_face(mesh, f))
        is_on = is_on && std::abs(mesh.point(v)[i] - at) < 1e-14;
      if (is_on)
        return 1 + 2 * i + (at == 0 ? 0 : 1);
    }
  return 0;
}

Patch_map by_side(Mesh& mesh) {
  const Patch_map patches = mesh.add_property_map<Face_index, int>("f:patch", 0).first;
  for (const auto f : mesh.faces())
    patches[f] = side(mesh, f);
  return patches;
}

std::size_t wrong(const Mesh& mesh, const Patch_map& patches) {
  std::size_t count = 0;
  for (const auto f : mesh.faces())
    count += patches[f] != side(mesh, f) || patches[f] == 0;
  return count;
}

double area(const Mesh& mesh, const Patch_map& patches, int patch) {
  double sum = 0;
  for (const auto f : mesh.faces())
    if (patches[f] == patch) {
      const auto c = internal::corners_of_face(mesh, f);
      sum += std::sqrt(CGAL::squared_area(mesh.point(c[0]), mesh.point(c[1]), mesh.point(c[2])));
    }
  return sum;
}

/// A line about the torus, uneven.
Edge_marks line_about_torus(Mesh& mesh) {
  const Edge_marks marks = mesh.add_property_map<Edge_index, bool>("e:line", false).first;
  for (const auto e : mesh.edges())
    marks[e] = static_cast<std::size_t>(mesh.vertex(e, 0)) % 12 == 0 &&
               static_cast<std::size_t>(mesh.vertex(e, 1)) % 12 == 0;
  return marks;
}

/// The longest over the shortest of the constrained edges.
double unevenness(const Mesh& mesh, const Edge_marks& marks) {
  double longest = 0, shortest = 1e300;
  for (const auto e : mesh.edges())
    if (marks[e]) {
      const double l = std::sqrt(CGAL::squared_distance(mesh.point(mesh.vertex(e, 0)), mesh.point(mesh.vertex(e, 1))));
      longest = std::max(longest, l);
      shortest = std::min(shortest, l);
    }
  return longest / shortest;
}

} // namespace

BOOST_AUTO_TEST_CASE(a_call_of_cgals_means_cgals_in_both_namespaces) {
  using namespace CGAL::Polygon_mesh_processing;
  Mesh mesh = meshes::to_mesh(meshes::box(2));
  auto faces = mesh.faces(); // no constant, nor a temporary: as good a first argument as a Sculptor
  isotropic_remeshing(faces, 0.2, mesh);
  BOOST_TEST(mesh.number_of_faces() > 48u);
}

BOOST_AUTO_TEST_CASE(faces_keep_the_patch_they_came_of) {
  for (const double length : {0.05, 0.4}) {
    const auto np = [](const Patch_map& patches) {
      return CGAL::parameters::number_of_iterations(3).face_patch_map(patches);
    };
    Mesh plain = meshes::to_mesh(meshes::box(6));
    const Patch_map plain_patches = by_side(plain);
    CGAL::Polygon_mesh_processing::isotropic_remeshing(plain.faces(), length, plain, np(plain_patches));
    BOOST_TEST(wrong(plain, plain_patches) == 0u);

    Mesh mesh = meshes::to_mesh(meshes::box(6));
    const Patch_map patches = by_side(mesh);
    const Edge_marks marks = mesh.add_property_map<Edge_index, bool>("e:sharp", false).first;
    Sculptor<Mesh> sculptor(mesh);
    isotropic_remeshing(sculptor, length, np(patches).edge_is_constrained_map(marks));
    BOOST_TEST(validate(mesh).is_valid());
    BOOST_TEST(wrong(mesh, patches) == 0u);
    // Borders of patches are constrained, as CGAL's, and not written into the map of edges.
    for (int patch = 1; patch <= 6; ++patch)
      BOOST_TEST(std::abs(area(mesh, patches, patch) - 1) < 1e-12);
    for (const auto e : mesh.edges())
      BOOST_TEST(!marks[e]);
    BOOST_TEST(mesh.number_of_faces() != 432u);
  }
}

BOOST_AUTO_TEST_CASE(no_face_is_without_a_patch) {
  // On a rough surface, in a part of it, with patches that say nothing of its shape.
  Mesh mesh = meshes::to_mesh(meshes::bumpy_sphere(3, 0.3, 0.05));
  const auto patches = mesh.add_property_map<Face_index, int>("f:patch", -1).first;
  std::vector<Face_index> range;
  for (const auto f : mesh.faces()) {
    const Point_3 p = mesh.point(mesh.source(mesh.halfedge(f)));
    patches[f] = p.x() > 0 ? p.y() > 0 ? 10 : 20 : 30;
    if (p.z() > -0.5)
      range.push_back(f);
  }
  const auto outside = mesh.add_property_map<Face_index, bool>("f:outside", true).first;
  for (const auto f : range)
    outside[f] = false;
  std::set<std::set<Point_3>> before;
  const auto corners = [&](Face_index f) {
    std::set<Point_3> points;
    for (const auto v : internal::corners_of_face(mesh, f))
      points.insert(mesh.point(v));
    return points;
  };
  for (const auto f : mesh.faces())
    if (outside[f])
      before.insert(corners(f));
  Sculptor<Mesh> sculptor(mesh);
  for (const double factor : {0.6, 3.0}) {
    const Remeshing_report report =
        isotropic_remeshing(range, sculptor, factor * mean_edge(mesh),
                            CGAL::parameters::number_of_iterations(3).face_patch_map(patches));
    BOOST_TEST(report.splits.done + report.collapses.done > 0u);
    BOOST_TEST(validate(mesh).is_valid());
    std::set<int> found;
    range.clear();
    for (const auto f : mesh.faces()) {
      BOOST_TEST(patches[f] > 0);
      found.insert(patches[f]);
      if (before.count(corners(f)) == 0)
        range.push_back(f);
    }
    BOOST_TEST(found.size() == 3u);
    BOOST_TEST(mesh.number_of_faces() - range.size() == before.size());
  }
}

BOOST_AUTO_TEST_CASE(flips_and_splits_in_patches) {
  // Splits alone, then flips alone: each face that is new has a patch.
  Mesh mesh = meshes::to_mesh(meshes::bumpy_sphere(3, 0.3, 0.1));
  const auto patches = mesh.add_property_map<Face_index, int>("f:patch", -1).first;
  for (const auto f : mesh.faces())
    patches[f] = 7;
  Sculptor<Mesh> sculptor(mesh);
  const double length = 0.5 * mean_edge(mesh);
  const auto np = CGAL::parameters::number_of_iterations(2).face_patch_map(patches);
  const Remeshing_report splits = isotropic_remeshing(sculptor, length, np.do_flip(false).do_collapse(false));
  BOOST_TEST(splits.splits.done > 0u);
  for (const auto f : mesh.faces())
    BOOST_TEST(patches[f] == 7);
  const Remeshing_report flips = isotropic_remeshing(sculptor, length, np.do_split(false).do_collapse(false));
  BOOST_TEST(flips.flips.done > 0u);
  for (const auto f : mesh.faces())
    BOOST_TEST(patches[f] == 7);
}

BOOST_AUTO_TEST_CASE(lines_are_relaxed_along_themselves) {
  const Mesh torus = meshes::to_mesh(meshes::torus(48, 12));
  std::array<double, 2> uneven;
  for (const bool relaxes : {false, true}) {
    Mesh mesh = torus;
    // The ring of the line is made uneven: in turn nearer to and farther from the next.
    for (const auto v : mesh.vertices())
      if (static_cast<std::size_t>(v) % 24 == 0) {
        const Point_3 p = mesh.point(v);
        const double turn = 0.05;
        mesh.point(v) = Point_3(std::cos(turn) * p.x() - std::sin(turn) * p.y(),
                                std::sin(turn) * p.x() + std::cos(turn) * p.y(), p.z());
      }
    const Edge_marks marks = line_about_torus(mesh);
    const double before = unevenness(mesh, marks);
    BOOST_TEST(before > 2);
    Mesh plain = mesh;
    const Edge_marks plain_marks = *find_property_map<Edge_index, bool>(plain, "e:line");
    const double length = mean_edge(mesh);
    const auto np = [&](const Edge_marks& map) {
      return CGAL::parameters::number_of_iterations(3).number_of_relaxation_steps(3).edge_is_constrained_map(map)
          .relax_constraints(relaxes).do_split(false).do_collapse(false);
    };
    CGAL::Polygon_mesh_processing::isotropic_remeshing(plain.faces(), length, plain, np(plain_marks));
    Sculptor<Mesh> sculptor(mesh);
    isotropic_remeshing(sculptor, length, np(marks));
    BOOST_TEST(validate(mesh).is_valid());
    uneven[relaxes] = unevenness(mesh, marks);
    BOOST_TEST_MESSAGE("uneven before " << before << ", after " << uneven[relaxes] << ", CGAL's "
                                        << unevenness(plain, plain_marks));
    BOOST_TEST((relaxes ? uneven[1] < 1.2 : uneven[0] == before));
    BOOST_TEST((relaxes ? unevenness(plain, plain_marks) < 1.2 : unevenness(plain, plain_marks) == before));
  }
  // The edges of a cube stay straight, and its corners where they are.
  Mesh cube = meshes::to_mesh(meshes::box(6));
  const Edge_marks marks = cube.add_property_map<Edge_index, bool>("e:sharp", false).first;
  Sculptor<Mesh> sculptor(cube);
  const auto np = CGAL::parameters::number_of_iterations(3).edge_is_constrained_map(marks).relax_constraints(true);
  isotropic_remeshing(sculptor, 0.11, np, Remeshing_parameters().feature_angle(45));
  BOOST_TEST(validate(cube).is_valid());
  double sum = 0;
  for (const auto e : cube.edges())
    if (marks[e])
      sum += std::sqrt(CGAL::squared_distance(cube.point(cube.vertex(e, 0)), cube.point(cube.vertex(e, 1))));
  BOOST_TEST(std::abs(sum - 12) < 1e-12);
}
