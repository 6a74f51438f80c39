// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

/// \file
/// Surfaces as machine parts have them, on an integer grid: flat faces of several triangles, right angles, coplanar and
/// axis-parallel on purpose. Blocks of cells, and extruded polygons with holes.

#include "sculpting/scene_parts.h"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <deque>
#include <map>

namespace haptic_sculpt::test {

/// In [low, high].
inline int whole_number(Random& random, int low, int high) {
  return low + static_cast<int>(random() % static_cast<std::uint64_t>(high - low + 1));
}

/// A solid of unit cells.
class Cells {
public:
  explicit Cells(const std::array<int, 3>& size)
      : size_(size), full_(static_cast<std::size_t>(size[0] * size[1] * size[2])) {}

  const std::array<int, 3>& size() const { return size_; }

  bool is_full(int i, int j, int k) const {
    return i >= 0 && j >= 0 && k >= 0 && i < size_[0] && j < size_[1] && k < size_[2] && full_[at(i, j, k)] != 0;
  }
  /// Cells with lower <= (i, j, k) < upper.
  void set(const std::array<int, 3>& lower, const std::array<int, 3>& upper, bool full) {
    for (int i = lower[0]; i < upper[0]; ++i)
      for (int j = lower[1]; j < upper[1]; ++j)
        for (int k = lower[2]; k < upper[2]; ++k)
          full_[at(i, j, k)] = full ? 1 : 0;
  }

  /// The boundary; every quadrangle is cut along one of its diagonals, drawn.
  meshes::Triangle_list boundary(Random& random) const {
    meshes::Triangle_list list;
    std::map<std::array<int, 3>, std::size_t> index;
    const auto vertex = [&](const std::array<int, 3>& p) {
      const auto [place, is_new] = index.emplace(p, list.points.size());
      if (is_new)
        list.add_point(p[0], p[1], p[2]);
      return place->second;
    };
    for (int i = 0; i < size_[0]; ++i)
      for (int j = 0; j < size_[1]; ++j)
        for (int k = 0; k < size_[2]; ++k)
          for (int axis = 0; axis < 3 && is_full(i, j, k); ++axis)
            for (const int side : {0, 1}) {
              std::array<int, 3> beyond = {i, j, k};
              beyond[axis] += side == 0 ? -1 : 1;
              if (is_full(beyond[0], beyond[1], beyond[2]))
                continue;
              const auto corner = [&](int u, int v) {
                std::array<int, 3> p = {i, j, k};
                p[axis] += side;
                p[(axis + 1) % 3] += u;
                p[(axis + 2) % 3] += v;
                return vertex(p);
              };
              std::array<std::size_t, 4> q = {corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)};
              if (side == 0)
                std::swap(q[1], q[3]);
              const std::size_t first = random() % 2;
              list.add_quadrangle(q[first], q[first + 1], q[first + 2], q[(first + 3) % 4]);
            }
    return list;
  }

private:
  std::array<int, 3> size_;
  std::vector<char> full_;

  std::size_t at(int i, int j, int k) const { return static_cast<std::size_t>((i * size_[1] + j) * size_[2] + k); }
};

/// A block with pockets, slots and holes cut through.
inline Cells block_with_pockets(Random& random) {
  Cells cells({whole_number(random, 3, 6), whole_number(random, 3, 6), whole_number(random, 2, 4)});
  const auto& size = cells.size();
  cells.set({0, 0, 0}, size, true);
  for (int cuts = whole_number(random, 1, 4); cuts > 0; --cuts) {
    std::array<int, 3> lower, upper;
    for (int axis = 0; axis < 3; ++axis) {
      lower[axis] = whole_number(random, 0, size[axis] - 1);
      upper[axis] = whole_number(random, lower[axis] + 1, std::min(size[axis], lower[axis] + 2));
    }
    const int through = whole_number(random, 0, 3); // 3: a pocket
    if (through < 3)
      lower[through] = 0, upper[through] = size[through];
    cells.set(lower, upper, false);
  }
  return cells;
}

/// Stairs along one or both axes, or columns of any height.
inline Cells stairs(Random& random) {
  Cells cells({whole_number(random, 2, 5), whole_number(random, 2, 5), 4});
  const int kind = whole_number(random, 0, 2);
  for (int i = 0; i < cells.size()[0]; ++i)
    for (int j = 0; j < cells.size()[1]; ++j) {
      const int height = kind == 0 ? i + 1 : kind == 1 ? i + j + 1 : whole_number(random, 1, 4);
      cells.set({i, j, 0}, {i + 1, j + 1, std::min(height, 4)}, true);
    }
  return cells;
}

/// Walls one cell thick on a plate, along both axes.
inline Cells slots(Random& random) {
  const int n = whole_number(random, 2, 4);
  Cells cells({2 * n - 1, whole_number(random, 2, 4), 3});
  cells.set({0, 0, 0}, {2 * n - 1, cells.size()[1], 1}, true);
  for (int i = 0; i < n; ++i)
    cells.set({2 * i, 0, 1}, {2 * i + 1, cells.size()[1], whole_number(random, 2, 3)}, true);
  if (random() % 2 == 0) // a wall across
    cells.set({0, 0, 1}, {2 * n - 1, 1, 2}, true);
  return cells;
}

/// A cube of 3^3 cells without the middles.
inline Cells menger() {
  Cells cells({3, 3, 3});
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      for (int k = 0; k < 3; ++k)
        if ((i == 1) + (j == 1) + (k == 1) < 2)
          cells.set({i, j, k}, {i + 1, j + 1, k + 1}, true);
  return cells;
}

using Grid_point = std::array<int, 2>;

/// A polygon with holes, counterclockwise, its holes clockwise, and points inside that are vertices too.
struct Grid_polygon {
  std::vector<std::vector<Grid_point>> rings;
  std::vector<Grid_point> inside;
};

/// The skyline of some towers on a flat base, with steps or ramps between, and with holes in its lower part.
inline Grid_polygon skyline(Random& random) {
  Grid_polygon polygon;
  const int towers = whole_number(random, 2, 5);
  std::vector<Grid_point> ring = {{0, 0}, {4 * towers, 0}};
  for (int i = towers; i > 0; --i) {
    const int top = whole_number(random, 5, 9);
    const bool is_ramp = random() % 4 == 0;
    ring.push_back({4 * i - (is_ramp && i != towers ? 1 : 0), top});
    ring.push_back({4 * (i - 1), top});
  }
  const auto last = std::unique(ring.begin(), ring.end()); // towers of the same height
  ring.erase(last, ring.end());
  polygon.rings.push_back(ring);
  for (int i = 0; i < towers; ++i) {
    const int x = 4 * i;
    switch (random() % 4) {
    case 0:
      polygon.rings.push_back({{x + 1, 1}, {x + 1, 3}, {x + 3, 3}, {x + 3, 1}});
      break;
    case 1:
      polygon.rings.push_back({{x + 1, 2}, {x + 2, 3}, {x + 3, 2}, {x + 2, 1}});
      break;
    case 2:
      polygon.inside.push_back({x + 2, 2});
      break;
    default:
      break;
    }
  }
  return polygon;
}

namespace internal_shapes {

/// The triangles, counterclockwise, of points numbered ring by ring, those inside last.
inline std::vector<std::array<std::size_t, 3>> triangles_of(const Grid_polygon& polygon) {
  using Vertex_base = CGAL::Triangulation_vertex_base_with_info_2<std::size_t, meshes::Kernel>;
  using Face_info = CGAL::Triangulation_face_base_with_info_2<int, meshes::Kernel>;
  using Face_base = CGAL::Constrained_triangulation_face_base_2<meshes::Kernel, Face_info>;
  using Triangulation =
      CGAL::Constrained_Delaunay_triangulation_2<meshes::Kernel,
                                                 CGAL::Triangulation_data_structure_2<Vertex_base, Face_base>>;
  Triangulation triangulation;
  std::size_t number = 0;
  const auto insert = [&](const Grid_point& p) {
    const auto vertex = triangulation.insert(meshes::Kernel::Point_2(p[0], p[1]));
    vertex->info() = number++;
    return vertex;
  };
  for (const auto& ring : polygon.rings) {
    std::vector<Triangulation::Vertex_handle> vertices;
    for (const Grid_point& p : ring)
      vertices.push_back(insert(p));
    for (std::size_t i = 0; i < vertices.size(); ++i)
      triangulation.insert_constraint(vertices[i], vertices[(i + 1) % vertices.size()]);
  }
  for (const Grid_point& p : polygon.inside)
    insert(p);
  // How many borders are between a face and what is far away: inside where odd.
  for (const auto face : triangulation.all_face_handles())
    face->info() = -1;
  std::deque<Triangulation::Face_handle> open = {triangulation.infinite_face()};
  open.front()->info() = 0;
  while (!open.empty()) {
    const auto face = open.front();
    open.pop_front();
    for (int i = 0; i < 3; ++i) {
      const auto next = face->neighbor(i);
      const bool is_border = triangulation.is_constrained({face, i});
      if (next->info() >= 0)
        continue;
      next->info() = face->info() + (is_border ? 1 : 0);
      is_border ? open.push_back(next) : open.push_front(next);
    }
  }
  std::vector<std::array<std::size_t, 3>> triangles;
  for (const auto face : triangulation.finite_face_handles())
    if (face->info() % 2 == 1)
      triangles.push_back({face->vertex(0)->info(), face->vertex(1)->info(), face->vertex(2)->info()});
  return triangles;
}

} // namespace internal_shapes

/// The polygon drawn out along z in this many layers, each of height 2.
inline meshes::Triangle_list extruded(const Grid_polygon& polygon, int layers, Random& random) {
  meshes::Triangle_list list;
  std::size_t on_rings = 0;
  for (const auto& ring : polygon.rings)
    on_rings += ring.size();
  const std::size_t in_all = on_rings + polygon.inside.size();
  // Level 0, the points inside of it, then the others, those inside of the last at the end.
  const auto at = [&](int level, std::size_t i) {
    return level == 0 ? i : in_all + static_cast<std::size_t>(level - 1) * on_rings + i;
  };
  for (int level = 0; level <= layers; ++level) {
    for (const auto& ring : polygon.rings)
      for (const Grid_point& p : ring)
        list.add_point(p[0], p[1], 2 * level);
    if (level == 0 || level == layers)
      for (const Grid_point& p : polygon.inside)
        list.add_point(p[0], p[1], 2 * level);
  }
  for (const auto& [a, b, c] : internal_shapes::triangles_of(polygon)) {
    list.add_face(a, c, b);
    list.add_face(at(layers, a), at(layers, b), at(layers, c));
  }
  for (int level = 0; level < layers; ++level) {
    std::size_t first = 0;
    for (const auto& ring : polygon.rings) {
      for (std::size_t i = 0; i < ring.size(); ++i) {
        const std::size_t j = first + (i + 1) % ring.size(), k = first + i;
        const std::array<std::size_t, 4> q = {at(level, k), at(level, j), at(level + 1, j), at(level + 1, k)};
        const std::size_t turn = random() % 2;
        list.add_quadrangle(q[turn], q[turn + 1], q[turn + 2], q[(turn + 3) % 4]);
      }
      first += ring.size();
    }
  }
  return list;
}

/// Plates one ulp thick at z about 1, one over the other, each a block of 2 x 2 quadrangles above and below.
inline meshes::Triangle_list thin_plates(Random& random) {
  meshes::Triangle_list list;
  double z = 1;
  for (int plates = whole_number(random, 1, 4); plates > 0; --plates) {
    Cells cells({2, 2, 1});
    cells.set({0, 0, 0}, {2, 2, 1}, true);
    meshes::Triangle_list plate = cells.boundary(random);
    const double top = z + whole_number(random, 1, 2) * 0x1p-52;
    list += plate.transform([&](const Point_3& p) { return Point_3(p.x(), p.y(), p.z() == 0 ? z : top); });
    z = random() % 2 == 0 ? top + whole_number(random, 1, 64) * 0x1p-52
                          : top + std::ldexp(1.0, -whole_number(random, 1, 40));
  }
  return list;
}

/// Slots of width `width` between walls one thick, cut into the top of a block: antiparallel walls.
/// \param foot the width at the bottom: 0 gives the pages of a book
inline meshes::Triangle_list narrow_slots(double width, double foot, Random& random) {
  Grid_polygon polygon;
  const int walls = whole_number(random, 2, 4);
  std::vector<Grid_point> ring = {{0, 0}, {4 * walls - 2, 0}};
  // 4 i + 2 stands for the left side of slot i, 4 i + 4 for its right one: x = i + 1 and that plus a width.
  for (int i = walls; i > 0; --i) {
    ring.push_back({4 * i - 2, 3});
    ring.push_back({4 * i - 4, 3});
    if (i == 1)
      break;
    if (foot > 0)
      ring.push_back({4 * i - 4, 1}), ring.push_back({4 * i - 6, 1});
    else
      ring.push_back({4 * i - 5, 1}); // the middle
  }
  polygon.rings.push_back(ring);
  return extruded(polygon, 1, random).transform([&](const Point_3& p) {
    const int cell = static_cast<int>(p.x()) / 4, part = static_cast<int>(p.x()) % 4;
    const double wide = p.y() == 1 ? foot : width;
    const double x = part == 0   ? cell + (cell == 0 ? 0 : wide / 2)
                     : part == 2 ? cell + 1 - (cell == walls - 1 ? 0 : wide / 2)
                                 : cell + 1;
    return Point_3(x, p.y(), p.z());
  });
}

} // namespace haptic_sculpt::test
