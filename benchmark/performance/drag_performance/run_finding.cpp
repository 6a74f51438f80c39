// SPDX-License-Identifier: GPL-3.0-or-later
#include "drag_performance/Random_motions.h"
#include "drag_performance/run_structures.h"

#include <haptic_sculpt/sculpting.h>

namespace haptic_sculpt::benchmark {

namespace {

/// What a Sculptor finds, and where a probe may begin: another place of a torus each time, so that memory is new.
class Findings {
public:
  Findings(const Workload_mesh& scene, std::uint64_t seed)
      : name_(scene.name)
      , mesh_(scene.mesh)
      , edge_(scene.edge)
      , sculptor_(mesh_)
      , random_(seed) {}

  void nearest_vertex(Json& rows, std::size_t count) {
    Latencies near, off, far;
    for (std::size_t k = 0; k < count; ++k) {
      const Point_3 p = beside_the_surface(0.5), o = beside_the_surface(10), q = anywhere(1.5);
      found_ += near.measure([&] { return sculptor_.nearest_vertex(p, 2 * edge_); }).is_valid();
      found_ += off.measure([&] { return sculptor_.nearest_vertex(o, 20 * edge_); }).is_valid();
      found_ += far.measure([&] { return sculptor_.nearest_vertex(q, 10); }).is_valid();
    }
    add_row(rows, "nearest vertex: half an edge away", near);
    add_row(rows, "nearest vertex: ten edges away", off);
    add_row(rows, "nearest vertex: anywhere", far);
  }

  void first_hit(Json& rows, std::size_t count) {
    Latencies across, along;
    for (std::size_t k = 0; k < count; ++k) {
      const Point_3 s = anywhere(3), t = anywhere(0.7);
      found_ += across.measure([&] { return sculptor_.first_hit(s, t); }).has_value();
      const Point_3 p = beside_the_surface(0.5), q = beside_the_surface(0.5);
      found_ += along.measure([&] { return sculptor_.first_hit(p, q); }).has_value();
    }
    add_row(rows, "first hit: from outside", across);
    add_row(rows, "first hit: from surface to surface", along);
  }

  void place(Json& rows, std::size_t count) {
    Latencies times;
    std::size_t refused = 0;
    for (std::size_t k = 0; k < count; ++k) {
      const Point_3 p = beside_the_surface(random_.uniform() < 0.5 ? -1 : 1);
      refused += !times.measure([&] { return sculptor_.probe(p); });
    }
    add_row(rows, "place a probe", times);
    rows.back()["blocked"] = refused;
  }

private:
  std::string name_;
  Mesh mesh_;
  double edge_;
  Sculptor<Mesh> sculptor_;
  Random_motions random_;
  std::size_t found_ = 0;

  Point_3 anywhere(double reach) { return to_point(internal::scaled(random_.direction(), reach)); }
  Point_3 beside_the_surface(double edges) {
    const Vertex_index v = random_.vertex(mesh_);
    return to_point(internal::advanced(vertex_coordinates(mesh_, v), edges * edge_, normal_at(mesh_, v)));
  }

  void add_row(Json& rows, const char* workload, Latencies& times) {
    Json row = {{"structure", "box tree"},
                {"mesh", name_},
                {"triangles", static_cast<std::size_t>(mesh_.number_of_faces())},
                {"workload", workload}};
    row.update(times.json());
    rows.push_back(std::move(row));
  }
};

} // namespace

void run_finding(Json& rows, std::size_t triangles, const Effort& effort) {
  Findings findings(torus_of(triangles), effort.seed);
  findings.nearest_vertex(rows, effort.drags);
  findings.first_hit(rows, effort.drags);
  findings.place(rows, effort.drags);
}

} // namespace haptic_sculpt::benchmark
