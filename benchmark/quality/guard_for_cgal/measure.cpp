// SPDX-License-Identifier: GPL-3.0-or-later
#include "guard_for_cgal/Comparison.h"

#include <CGAL/Polygon_mesh_processing/distance.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>

namespace haptic_sculpt::benchmark {
namespace {

namespace PMP = CGAL::Polygon_mesh_processing;

double least_angle(const Mesh& mesh, Face_index f) {
  const auto h = mesh.halfedge(f);
  const Point_3 &a = mesh.point(mesh.source(h)), &b = mesh.point(mesh.target(h)),
                &c = mesh.point(mesh.target(mesh.next(h)));
  return std::min(
      {CGAL::approximate_angle(a, b, c), CGAL::approximate_angle(b, c, a), CGAL::approximate_angle(c, a, b)});
}

std::vector<Point_3> samples(const Mesh& mesh) {
  std::vector<Point_3> points;
  for (const Vertex_index v : mesh.vertices())
    points.push_back(mesh.point(v));
  for (const Face_index f : mesh.faces()) {
    const auto h = mesh.halfedge(f);
    points.push_back(
        CGAL::centroid(mesh.point(mesh.source(h)), mesh.point(mesh.target(h)), mesh.point(mesh.target(mesh.next(h)))));
  }
  return points;
}

Json to_json(const Outcome& outcome) {
  return {{"seconds", outcome.seconds},
          {"pairs", outcome.pairs},
          {"valid", outcome.is_valid},
          {"failed", outcome.failed},
          {"faces", outcome.faces},
          {"least_angle", outcome.least_angle},
          {"mean_least_angle", outcome.mean_least_angle},
          {"valence_six", outcome.valence_six},
          {"length", outcome.length},
          {"hausdorff", outcome.hausdorff}};
}

} // namespace

bool has_areas(const Mesh& mesh) {
  for (const Face_index f : mesh.faces()) {
    const auto h = mesh.halfedge(f);
    const Point_3& a = mesh.point(mesh.source(h));
    const double square =
        CGAL::cross_product(mesh.point(mesh.target(h)) - a, mesh.point(mesh.target(mesh.next(h))) - a).squared_length();
    if (!(square > 0 && std::isfinite(square)))
      return false;
  }
  return true;
}

double mean_edge(const Mesh& mesh) {
  double sum = 0;
  for (const Edge_index e : mesh.edges())
    sum += std::sqrt(CGAL::squared_distance(mesh.point(mesh.vertex(e, 0)), mesh.point(mesh.vertex(e, 1))));
  return sum / static_cast<double>(mesh.number_of_edges());
}

void measure(Mesh mesh, double unit, const Mesh* input, Outcome& outcome) {
  mesh.collect_garbage();
  std::vector<std::pair<Face_index, Face_index>> pairs;
  PMP::self_intersections(mesh, std::back_inserter(pairs));
  outcome.pairs = pairs.size();
  outcome.is_valid = validate(mesh).is_valid();
  outcome.faces = mesh.number_of_faces();
  outcome.least_angle = 180;
  double sum = 0;
  for (const Face_index f : mesh.faces()) {
    const double angle = least_angle(mesh, f);
    outcome.least_angle = std::min(outcome.least_angle, angle);
    sum += angle;
  }
  outcome.mean_least_angle = sum / static_cast<double>(mesh.number_of_faces());
  std::size_t sixes = 0;
  for (const Vertex_index v : mesh.vertices())
    sixes += mesh.degree(v) == 6;
  outcome.valence_six = static_cast<double>(sixes) / static_cast<double>(mesh.number_of_vertices());
  outcome.length = mean_edge(mesh) / unit;
  if (input != nullptr)
    outcome.hausdorff = std::max(PMP::max_distance_to_triangle_mesh<CGAL::Sequential_tag>(samples(mesh), *input),
                                 PMP::max_distance_to_triangle_mesh<CGAL::Sequential_tag>(samples(*input), mesh)) /
                        unit;
}

Json to_json(const Comparison& c) {
  return {{"mesh", c.mesh},
          {"function", c.function},
          {"way", c.way},
          {"share", c.share ? Json(*c.share) : Json()},
          {"asked", c.asked},
          {"refused", c.refused},
          {"drags", c.drags},
          {"out_of_work", c.out_of_work},
          {"undone_to_the_bit", c.undone_to_the_bit},
          {"redone_to_the_bit", c.redone_to_the_bit},
          {"set_up_seconds", c.set_up},
          {"time_ratio", c.guarded.seconds / c.plain.seconds},
          {"plain", to_json(c.plain)},
          {"guarded", to_json(c.guarded)}};
}

} // namespace haptic_sculpt::benchmark
