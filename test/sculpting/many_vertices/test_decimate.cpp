// SPDX-License-Identifier: GPL-3.0-or-later
// Decimation under the guard, beside CGAL's own with the same policies.
#include "sculpting/many_vertices/Edge_count_stop.h"
#include "sculpting/many_vertices/Policy_optional.h"

#include <haptic_sculpt/sculpting/decimate.h>
#include <haptic_sculpt/surface.h>

#include <meshes/generated_meshes.h>
#include <meshes/thin_walls.h>
#include <surface/identical.h>

#include <CGAL/Polygon_mesh_processing/distance.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/GarlandHeckbert_plane_policies.h>
#include <CGAL/Surface_mesh_simplification/edge_collapse.h>

#include <boost/test/unit_test.hpp>

#include <set>
#include <string>
#include <utility>
#include <vector>

namespace {

namespace SMS = CGAL::Surface_mesh_simplification;
using haptic_sculpt::Policy_optional;
using haptic_sculpt::Sculptor;
using meshes::Mesh;

std::size_t intersecting_pairs(const Mesh& mesh) {
  std::vector<std::pair<Mesh::Face_index, Mesh::Face_index>> pairs;
  CGAL::Polygon_mesh_processing::self_intersections(mesh, std::back_inserter(pairs));
  return pairs.size();
}

double hausdorff_distance(const Mesh& a, const Mesh& b) {
  const auto sampled = CGAL::parameters::number_of_points_on_faces(20000).random_seed(7);
  return CGAL::Polygon_mesh_processing::approximate_symmetric_Hausdorff_distance<CGAL::Sequential_tag>(a, b, sampled,
                                                                                                       sampled);
}

std::vector<std::pair<std::string, Mesh>> meshes_to_decimate() {
  return {{"hollow ball", meshes::to_mesh(meshes::hollow_ball(4, 0.01))},
          {"wavy plate", meshes::to_mesh(meshes::wavy_plate(24, 0.05))},
          {"bumpy sphere", meshes::to_mesh(meshes::bumpy_sphere(4, 0.3, 0.02))},
          {"C tube", meshes::to_mesh(meshes::c_tube(0.01, 48))}};
}

} // namespace

BOOST_AUTO_TEST_SUITE(decimation)

BOOST_AUTO_TEST_CASE(to_a_tenth_without_an_intersection) {
  std::size_t pairs_of_cgal = 0;
  for (const auto& [name, mesh] : meshes_to_decimate())
    BOOST_TEST_CONTEXT(name) {
      const std::size_t edges = mesh.number_of_edges() / 10;
      const haptic_sculpt::Edge_count_stop<Mesh> stop(edges);
      Mesh guarded = mesh, alone = mesh;
      SMS::edge_collapse(alone, stop);
      alone.collect_garbage();
      const std::size_t pairs = intersecting_pairs(alone);
      pairs_of_cgal += pairs;
      haptic_sculpt::Decimation_report report;
      {
        Sculptor<Mesh> sculptor(guarded);
        report = haptic_sculpt::decimate(sculptor, stop);
        BOOST_TEST(sculptor.history().number_of_undo_steps() == 1u);
        BOOST_TEST(mesh.number_of_edges() == guarded.number_of_edges() + 3 * report.collapsed);
      }
      guarded.collect_garbage();
      const auto found = haptic_sculpt::validate(guarded);
      BOOST_TEST(found.is_valid(), found.message());
      BOOST_TEST(guarded.number_of_edges() < edges);
      BOOST_TEST(guarded.number_of_edges() + 3 >= edges);
      const double ours = hausdorff_distance(mesh, guarded), theirs = hausdorff_distance(mesh, alone);
      BOOST_TEST_MESSAGE(name << ": " << mesh.number_of_faces() << " to " << guarded.number_of_faces()
                              << " faces, CGAL to " << alone.number_of_faces() << " with " << pairs
                              << " pairs; distances " << ours << " and " << theirs << "; " << report.refused
                              << " times refused");
      // Where CGAL goes through itself it comes nearer. Where a collapse is refused another edge goes: 1.35 times as
      // far for the tube of 38 faces with CGAL 6.0.1. Costs are rounded: with fused products other edges go, too.
      BOOST_TEST(ours <= (pairs > 0 ? 2 : report.refused > 0 ? 1.5 : 1.15) * theirs);
    }
  BOOST_TEST(pairs_of_cgal > 0u); // else these meshes show nothing
}

BOOST_AUTO_TEST_CASE(undo_brings_all_back) {
  Mesh mesh = meshes::to_mesh(meshes::bumpy_sphere(3, 0.3, 0.02));
  const Mesh before = mesh;
  Sculptor<Mesh> sculptor(mesh);
  haptic_sculpt::decimate(sculptor, haptic_sculpt::Edge_count_stop<Mesh>(300));
  BOOST_TEST(mesh.number_of_edges() <= 300u);
  BOOST_TEST(static_cast<bool>(sculptor.undo()));
  BOOST_TEST(mesh.number_of_faces() == before.number_of_faces());
  std::set<meshes::Point_3> points, points_before;
  for (const auto v : mesh.vertices())
    points.insert(mesh.point(v));
  for (const auto v : before.vertices())
    points_before.insert(before.point(v));
  BOOST_TEST((points == points_before));
  BOOST_TEST(haptic_sculpt::validate(mesh).is_valid());
}

BOOST_AUTO_TEST_CASE(policies_that_keep_quadrics_are_told) {
  using Policies = SMS::GarlandHeckbert_plane_policies<Mesh, meshes::Kernel>;
  Mesh mesh = meshes::to_mesh(meshes::bumpy_sphere(4, 0.3, 0.02)), alone = mesh;
  const Mesh before = mesh;
  const haptic_sculpt::Edge_count_stop<Mesh> stop(mesh.number_of_edges() / 10);
  {
    Policies policies(alone);
    SMS::edge_collapse(alone, stop,
                       CGAL::parameters::get_cost(policies.get_cost()).get_placement(policies.get_placement()));
  }
  alone.collect_garbage();
  Policies policies(mesh);
  Sculptor<Mesh> sculptor(mesh);
  haptic_sculpt::decimate(sculptor, stop,
                          CGAL::parameters::get_cost(policies.get_cost()).get_placement(policies.get_placement()));
  BOOST_TEST(haptic_sculpt::validate(mesh).is_valid());
  const double ours = hausdorff_distance(before, mesh), theirs = hausdorff_distance(before, alone);
  BOOST_TEST_MESSAGE("distances " << ours << " and " << theirs);
  BOOST_TEST(ours <= 1.5 * theirs); // quadrics that are not handed on make it many times as large
}

// Plates whose planes are not those of the axes, so that corners are rounded and lie beside them by some 1e-16. There a
// plane may fold, ever so little above itself, and costs are rounding: the most negative one draws all into one vertex.
BOOST_AUTO_TEST_CASE(planes_stay_planes) {
  for (const std::size_t n : {16u, 24u})
    for (const bool with_quadrics : {false, true})
      BOOST_TEST_CONTEXT("fineness " << n << (with_quadrics ? ", quadrics" : "")) {
        Mesh mesh = meshes::to_mesh(meshes::box(n));
        for (const auto v : mesh.vertices()) {
          const auto p = mesh.point(v);
          const double x = 3 * p.x(), y = 2 * p.y(), z = 0.4 * p.z();
          mesh.point(v) = {x * std::cos(0.7) - y * std::sin(0.7),
                           (x * std::sin(0.7) + y * std::cos(0.7)) * std::cos(0.4) - z * std::sin(0.4),
                           (x * std::sin(0.7) + y * std::cos(0.7)) * std::sin(0.4) + z * std::cos(0.4)};
        }
        const Mesh before = mesh;
        const haptic_sculpt::Edge_count_stop<Mesh> stop(mesh.number_of_edges() / 40);
        SMS::GarlandHeckbert_plane_policies<Mesh, meshes::Kernel> policies(mesh);
        haptic_sculpt::Decimation_report report;
        {
          Sculptor<Mesh> sculptor(mesh);
          report = with_quadrics
                       ? haptic_sculpt::decimate(sculptor, stop,
                                                 CGAL::parameters::get_cost(policies.get_cost())
                                                     .get_placement(policies.get_placement()))
                       : haptic_sculpt::decimate(sculptor, stop);
        }
        mesh.collect_garbage();
        BOOST_TEST(haptic_sculpt::validate(mesh).is_valid());
        const double distance = hausdorff_distance(before, mesh);
        BOOST_TEST_MESSAGE(before.number_of_faces() << " to " << mesh.number_of_faces() << " faces, " << report.refused
                                                    << " times refused, distance " << distance);
        BOOST_TEST(mesh.number_of_edges() <= before.number_of_edges() / 40);
        BOOST_TEST(distance < 1e-6); // of 3: all of it is rounding
      }
}

BOOST_AUTO_TEST_CASE(an_error_stops_it_and_constrained_edges_stay) {
  Mesh mesh = meshes::to_mesh(meshes::box(8));
  auto map = mesh.add_property_map<Mesh::Edge_index, bool>("e:constrained", false).first;
  std::set<std::pair<meshes::Point_3, meshes::Point_3>> kept;
  const auto e = *mesh.edges().begin();
  map[e] = true;
  const auto v = mesh.vertex(e, 0), w = mesh.vertex(e, 1);
  Sculptor<Mesh> sculptor(mesh);
  // Only what costs nothing: flat sides and straight edges, so that the eight corners are left, and the edge.
  const auto report = haptic_sculpt::decimate(
      sculptor, [](double cost, const auto&, std::size_t, std::size_t) { return cost > 1e-12; },
      CGAL::parameters::edge_is_constrained_map(map));
  BOOST_TEST(report.collapsed > 300u);
  BOOST_TEST(haptic_sculpt::validate(mesh).is_valid());
  BOOST_TEST(!mesh.is_removed(v));
  BOOST_TEST(!mesh.is_removed(w));
  BOOST_TEST((mesh.halfedge(v, w) != Mesh::null_halfedge()));
  std::set<meshes::Point_3> corners;
  for (const auto u : mesh.vertices())
    corners.insert(mesh.point(u));
  for (const double x : {0., 1.})
    for (const double y : {0., 1.})
      for (const double z : {0., 1.})
        BOOST_TEST(std::any_of(corners.begin(), corners.end(), [&](const auto& p) {
          return CGAL::squared_distance(p, meshes::Point_3(x, y, z)) < 1e-20;
        }));
}

// A tetrahedron cannot lose a vertex: the ends of its edges are drawn to their placements, and back.
BOOST_AUTO_TEST_CASE(nothing_done_is_no_step_and_what_was_undone_can_be_redone) {
  Mesh mesh = meshes::to_mesh(meshes::tetrahedron());
  Sculptor<Mesh> sculptor(mesh);
  const Mesh::Vertex_index v(0);
  sculptor.drag(v, mesh.point(v) + meshes::Kernel::Vector_3(0, 0, 0.125));
  sculptor.undo();
  const Mesh before = mesh;
  const auto report = haptic_sculpt::decimate(sculptor, haptic_sculpt::Edge_count_stop<Mesh>(0));
  BOOST_TEST(report.collapsed == 0u);
  BOOST_TEST(report.refused > 5u);
  BOOST_TEST(reading_and_writing::identical(mesh, before));
  BOOST_TEST(sculptor.history().number_of_undo_steps() == 0u);
  BOOST_TEST(sculptor.history().number_of_redo_steps() == 1u);
  BOOST_TEST(static_cast<bool>(sculptor.redo()));
  BOOST_TEST((mesh.point(v) == before.point(v) + meshes::Kernel::Vector_3(0, 0, 0.125)));
  sculptor.check_unchanged();
}

BOOST_AUTO_TEST_CASE(a_mesh_that_others_have_cleared_is_seen) {
  Mesh mesh = meshes::to_mesh(meshes::bumpy_sphere(1, 0));
  Sculptor<Mesh> sculptor(mesh);
  mesh.clear();
  BOOST_CHECK_THROW(decimate(sculptor, [](const auto&...) { return false; }), haptic_sculpt::Mesh_changed);
}

BOOST_AUTO_TEST_CASE(placements_and_meshes_out_of_range_are_refused_by_name) {
  const auto stop = [](const auto&, const auto&, std::size_t, std::size_t edges) { return edges < 100; };
  for (const double bad : {std::nan(""), std::numeric_limits<double>::infinity(), 0x1p1001})
    for (const int from : {1, 1000}) {
      Mesh mesh = meshes::to_mesh(meshes::bumpy_sphere(2, 0.3));
      const Mesh before = mesh;
      Sculptor<Mesh> sculptor(mesh);
      int calls = 0;
      const auto cost = [](const auto& profile, const auto&) {
        return Policy_optional<double>(CGAL::squared_distance(profile.p0(), profile.p1()));
      };
      const auto placement = [&](const auto& profile) {
        return Policy_optional<meshes::Point_3>(++calls < from ? CGAL::midpoint(profile.p0(), profile.p1())
                                                               : meshes::Point_3(0, bad, 0));
      };
      BOOST_CHECK_THROW(
          haptic_sculpt::decimate(sculptor, stop, CGAL::parameters::get_cost(cost).get_placement(placement)),
          haptic_sculpt::Out_of_range);
      BOOST_TEST(haptic_sculpt::validate(mesh).is_valid());
      BOOST_TEST((mesh.number_of_edges() < before.number_of_edges()) == (from > 1)); // what had collapsed, stands
      sculptor.undo();
      BOOST_TEST(mesh.number_of_faces() == before.number_of_faces());
      BOOST_TEST(sculptor.history().number_of_undo_steps() == 0u);
    }
  const auto scale = [](Mesh& mesh, double unit) {
    for (const auto v : mesh.vertices())
      mesh.point(v) = meshes::Point_3(unit * mesh.point(v).x(), unit * mesh.point(v).y(), unit * mesh.point(v).z());
  };
  Mesh usual;
  for (const double unit : {1.0, 0x1p-100, 0x1p100, 0x1p150, 0x1p200}) {
    Mesh mesh = meshes::to_mesh(meshes::bumpy_sphere(2, 0.3));
    scale(mesh, unit);
    {
      Sculptor<Mesh> sculptor(mesh);
      if (unit < 0x1p160)
        BOOST_TEST(haptic_sculpt::decimate(sculptor, stop).collapsed > 100u);
      else
        BOOST_CHECK_THROW(haptic_sculpt::decimate(sculptor, stop), haptic_sculpt::Out_of_range);
    }
    if (unit > 0x1p100)
      continue;
    mesh.collect_garbage();
    scale(mesh, 1 / unit);
    if (unit == 1)
      usual = mesh;
    BOOST_TEST(reading_and_writing::identical(mesh, usual));
  }
}

BOOST_AUTO_TEST_SUITE_END()
