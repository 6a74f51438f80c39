// SPDX-License-Identifier: GPL-3.0-or-later
// What memory costs on this machine, and how much of it a new vertex needs: the floor under the times of a large mesh.
#include "drag_performance/Random_motions.h"
#include "drag_performance/run_structures.h"

#include <haptic_sculpt/surface/broad_phase/spatial_order.h>

#include <iostream>
#include <numeric>
#include <set>

namespace haptic_sculpt::benchmark {

namespace {

constexpr std::size_t line_bytes = 64;

/// Of the mesh and all that guards it, about: twelve of halfedges, four of points, nine of boxes, six of corners and
/// copies, in units of four bytes.
constexpr std::size_t bytes_a_triangle = 130;

struct Line {
  std::uint32_t next;
  std::array<std::uint32_t, line_bytes / sizeof(std::uint32_t) - 1> rest;
};

/// Nanoseconds a line of `bytes` of memory: each telling where the next one is, and all known beforehand.
std::pair<double, double> nanoseconds_a_line(std::size_t bytes, std::uint64_t seed) {
  std::vector<Line> lines(bytes / line_bytes);
  std::vector<std::uint32_t> order(lines.size());
  std::iota(order.begin(), order.end(), 0u);
  std::mt19937_64 random(seed);
  for (std::size_t i = order.size() - 1; i > 0; --i) // std::shuffle differs between libraries
    std::swap(order[i], order[random() % (i + 1)]);
  for (std::size_t i = 0; i < order.size(); ++i)
    lines[order[i]].next = order[(i + 1) % order.size()];
  const std::size_t reads = std::min<std::size_t>(lines.size(), 200000);
  Latencies dependent, independent;
  std::uint32_t at = order[order.size() / 2], sum = 0;
  dependent.measure([&] {
    for (std::size_t k = 0; k < reads; ++k)
      at = lines[at].next;
  });
  independent.measure([&] {
    for (std::size_t k = 0; k < reads; ++k)
      sum += lines[order[k]].next; // written first, long ago: no cache has them
  });
  if (at + sum == 1) // as good as never; without it the compiler leaves the loops out
    std::cout << std::flush;
  return {dependent.last() / static_cast<double>(reads), independent.last() / static_cast<double>(reads)};
}

/// The boxes of a tree like the default one, level by level from the faces' up.
class Tree_lines {
public:
  explicit Tree_lines(const Mesh& mesh) {
    for (const internal::Face_middle& face :
         internal::faces_in_spatial_order(mesh, mesh.faces(), internal::Box_scale::of(mesh)))
      faces_.push_back(Mesh::Face_index(face.face));
    std::vector<Box_3> boxes;
    for (const auto f : faces_)
      boxes.push_back(face_box(mesh, f));
    while (boxes.size() > 1) {
      levels_.push_back(boxes);
      std::vector<Box_3> above((boxes.size() + 7) / 8);
      for (std::size_t k = 0; k < boxes.size(); ++k)
        above[k / 8].include(boxes[k]);
      boxes = std::move(above);
    }
  }

  /// Nodes visited on the lowest `far` levels, and the faces found.
  std::size_t visit(const Box_3& box, std::size_t far, std::vector<Mesh::Face_index>& found) const {
    std::size_t nodes = 0;
    visit(levels_.size() - 1, 0, box, far, nodes, found);
    return nodes;
  }

private:
  std::vector<Mesh::Face_index> faces_;
  std::vector<std::vector<Box_3>> levels_;

  void visit(std::size_t level, std::size_t node, const Box_3& box, std::size_t far, std::size_t& nodes,
             std::vector<Mesh::Face_index>& found) const {
    nodes += level < far;
    for (std::size_t k = 8 * node; k < std::min(8 * node + 8, levels_[level].size()); ++k)
      if (do_meet(levels_[level][k], box)) {
        if (level == 0)
          found.push_back(faces_[k]);
        else
          visit(level - 1, k, box, far, nodes, found);
      }
  }
};

} // namespace

void run_memory(Json& rows, std::size_t triangles, const Effort& effort) {
  const Workload_mesh scene = torus_of(triangles);
  const Mesh& mesh = scene.mesh;
  const Tree_lines tree(mesh);
  Random_motions random(effort.seed);
  const std::size_t count = std::min<std::size_t>(effort.drags, 1000);
  double chain = 0, star = 0, nodes = 0, faces = 0, corners = 0, points = 0;
  for (std::size_t k = 0; k < count; ++k) {
    const Vertex_index v = random.vertex(mesh);
    // Four halfedges of 16 bytes are a line; walking around a vertex reads each to know the next.
    std::set<std::size_t> halfedge_lines;
    std::size_t last = ~std::size_t{0};
    Box_3 link;
    for (const auto h : CGAL::halfedges_around_target(v, mesh)) {
      const std::size_t line = static_cast<std::size_t>(h) / 4;
      chain += line != last && halfedge_lines.insert(line).second;
      last = line;
      link.include(vertex_coordinates(mesh, mesh.source(h)));
    }
    star += static_cast<double>(halfedge_lines.size());
    const Box_3 around = link; // what the query of a new vertex is about: the link, and the centre within it
    std::vector<Mesh::Face_index> found;
    nodes += static_cast<double>(tree.visit(around, 3, found));
    faces += static_cast<double>(found.size());
    std::set<std::size_t> corner_lines, point_lines;
    for (const auto f : found) {
      corner_lines.insert(12 * static_cast<std::size_t>(f) / line_bytes);
      for (const auto w : CGAL::vertices_around_face(mesh.halfedge(f), mesh))
        point_lines.insert(24 * static_cast<std::size_t>(w) / line_bytes);
    }
    corners += static_cast<double>(corner_lines.size());
    points += static_cast<double>(point_lines.size());
  }
  const double n = static_cast<double>(count);
  const auto [dependent, independent] = nanoseconds_a_line(bytes_a_triangle * triangles, effort.seed);
  // Boxes of a node are three lines, read at once; the points are read twice, from the mesh and from the watch's copy.
  // The way round the star and the way down the tree are gone at the same time, both from the vertex; corners and
  // points follow.
  const double levels = 3, in_a_row = 1 + std::max(chain / n, levels) + 1 + 1,
               others = star / n + 3 * nodes / n + corners / n + 2 * points / n;
  rows.push_back({{"structure", "memory"},
                  {"mesh", scene.name},
                  {"triangles", static_cast<std::size_t>(mesh.number_of_faces())},
                  {"workload", "floor of a new vertex"},
                  {"ns_a_line_when_each_tells_the_next", dependent},
                  {"ns_a_line_when_all_are_known", independent},
                  {"lines_of_the_star_in_a_row", chain / n},
                  {"nodes_on_three_far_levels", nodes / n},
                  {"candidate_faces", faces / n},
                  {"lines_of_corners", corners / n},
                  {"lines_of_points", points / n},
                  {"reads_in_a_row", in_a_row},
                  {"lines_in_all", others},
                  {"floor_ns", in_a_row * dependent + others * independent}});
}

} // namespace haptic_sculpt::benchmark
