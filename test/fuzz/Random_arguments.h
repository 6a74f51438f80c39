// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <fuzz/Choices.h>
#include <fuzz/Throwing_visitor.h>
#include <fuzz/any_response.h>
#include <meshes/generated_meshes.h>

#include <haptic_sculpt/sculpting.h>

#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

namespace haptic_sculpt::fuzz {

/// What calls of a Sculptor are made with, as the choices say.
class Random_arguments {
public:
  using Mesh = meshes::Mesh;
  using Kernel = meshes::Kernel;
  using Point_3 = meshes::Point_3;
  using Vertex_index = Mesh::Vertex_index;

  /// \param unit what numbers are multiplied by
  Random_arguments(Choices& choices, const Mesh& mesh, double unit) : choices_(choices), mesh_(mesh), unit_(unit) {}

  double length() { return choices_.number() * unit_; }
  /// Elements that are there, mostly; one behind the last, or dead, now and then.
  template <class Index>
  Index element(std::size_t slots) {
    const std::size_t k = slots < 200 ? choices_.byte() : choices_.integer<std::uint16_t>() % (2 * slots);
    return k == 255 ? Index() : Index(static_cast<Mesh::size_type>(k % (slots + (k % 64 == 63))));
  }
  Vertex_index vertex() { return element<Vertex_index>(mesh_.num_vertices()); }
  Mesh::Edge_index edge() { return element<Mesh::Edge_index>(mesh_.num_edges()); }
  Mesh::Halfedge_index halfedge() { return element<Mesh::Halfedge_index>(mesh_.num_halfedges()); }
  Mesh::Face_index face() { return element<Mesh::Face_index>(mesh_.num_faces()); }
  template <class Index>
  bool lives(Index i) const {
    return mesh_.has_valid_index(i) && !mesh_.is_removed(i);
  }

  Point_3 near(const Point_3& p, int farthest = 0) {
    const double by = std::ldexp(unit_, farthest - static_cast<int>(choices_.below(60)));
    const double x = choices_.number(), y = choices_.number(), z = choices_.number();
    return {p.x() + x * by, p.y() + y * by, p.z() + z * by};
  }
  Point_3 point() {
    const double x = length(), y = length(), z = length();
    return {x, y, z};
  }
  Point_3 target(Vertex_index v) {
    const Vertex_index w = vertex();
    switch (choices_.below(4)) {
    case 0: // another vertex
      return lives(w) ? mesh_.point(w) : Point_3(0, 0, 0);
    case 1:
      return near(lives(v) ? mesh_.point(v) : Point_3(0, 0, 0));
    default:
      return point();
    }
  }
  Point_3 in_face(Mesh::Face_index f) {
    if (!lives(f) || choices_.below(4) == 0)
      return point();
    const auto c = internal::corners_of_face(mesh_, f);
    const double a = static_cast<double>(choices_.below(17)) / 16, b = static_cast<double>(choices_.below(17)) / 32;
    const Point_3 p = mesh_.point(c[0]);
    const Point_3 q = p + a * (mesh_.point(c[1]) - p) + b * (mesh_.point(c[2]) - p);
    return choices_.flag() ? q : near(q, -1);
  }
  std::optional<Drag_parameters> drag_parameters() {
    if (choices_.below(3) != 0)
      return std::nullopt;
    Drag_parameters drag;
    drag.response(any_response(choices_)).once(choices_.flag());
    if (choices_.below(4) == 0)
      drag.clearance(length());
    if (choices_.below(4) == 0)
      drag.work_limit(choices_.integer<std::uint16_t>());
    return drag;
  }
  std::vector<Vertex_index> some_vertices() {
    std::vector<Vertex_index> some;
    if (choices_.flag())
      some.assign(mesh_.vertices().begin(), mesh_.vertices().end());
    else
      for (std::size_t n = choices_.below(6); n > 0; --n)
        some.push_back(vertex());
    return some;
  }
  Move_parameters move_parameters() {
    Move_parameters move;
    move.most_drags(choices_.byte() * 8u).steps(choices_.below(4) != 0).drags(choices_.flag()).slide(choices_.flag());
    if (choices_.below(4) == 0)
      move.most_pairs(choices_.below(4) * choices_.integer<std::uint16_t>());
    if (choices_.below(4) == 0)
      move.progress([left = choices_.byte()](const Move_progress&) mutable {
        if (left % 2 == 1 && left < 3)
          throw Thrown();
        return left == 0 || --left > 0;
      });
    return move;
  }
  /// One dab, or several, of which each may be the last one in a mirror.
  std::vector<Dab_3<Kernel>> dabs() {
    std::vector<Dab_3<Kernel>> all;
    for (std::size_t n = choices_.flag() ? 1 : choices_.below(4); n > 0; --n) {
      Dab_3<Kernel> dab{static_cast<Brush_kind>(choices_.below(5)), point(), length(), length(), {}};
      if (choices_.flag())
        dab.direction = point() - CGAL::ORIGIN;
      if (!all.empty() && choices_.flag()) {
        const Point_3 in_plane = point(), normal = point();
        dab = mirrored(all.back(), Kernel::Plane_3(in_plane, normal - CGAL::ORIGIN));
      }
      all.push_back(dab);
    }
    return all;
  }
  /// How much each vertex takes part: of those that are there between 0 and 1, mostly.
  std::vector<double> mask() {
    std::vector<double> shares(mesh_.num_vertices());
    for (double& share : shares)
      share = choices_.below(16) == 0 ? choices_.number() : static_cast<double>(choices_.below(5)) / 4;
    return shares;
  }

private:
  Choices& choices_;
  const Mesh& mesh_;
  const double unit_;
};

} // namespace haptic_sculpt::fuzz
