// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

/// \file
/// Scenes in which the point a drag has to end at is unique: planes, convex cavities, concave corners; the plane of a
/// pair of edges and that of a face and a vertex.

#include "oracle/constrained_optimum.h"
#include "sculpting/scene_parts.h"

#include <optional>

namespace haptic_sculpt::test {

/// As far as the targets drawn by `target()` reach, `moved` is free exactly where all half-spaces hold.
struct Convex_scene {
  std::string name;
  Mesh mesh;
  Vertex_index moved;
  std::vector<Half_space> half_spaces;
  std::function<Point_3(Random&)> any_target;
  std::optional<std::array<Point_3, 3>> rim; ///< of a groove or a pit; the free side is positive

  /// A target from where `moved` may be now. Out of a groove a slide could climb over the rim, and then another end is
  /// right; not so where the ball about the target that holds the source, in which a slide stays, is all below the rim.
  Point_3 target(Random& random, const Point_3& source) const {
    for (;;) {
      const Point_3 t = any_target(random);
      if (!rim)
        return t;
      const Vector_3 n = CGAL::cross_product((*rim)[1] - (*rim)[0], (*rim)[2] - (*rim)[0]);
      const double depth = -(n * (t - (*rim)[0])) / std::sqrt(n.squared_length());
      if (depth > 1.001 * std::sqrt(CGAL::squared_distance(t, source)))
        return t;
    }
  }
};

namespace internal_scenes {

/// A scene as it is written down, before it is moved to where it shall stand.
struct Draft {
  std::string name;
  meshes::Triangle_list list;
  std::size_t moved = 0;
  std::vector<std::array<std::size_t, 3>> planes; ///< three points each; the moved vertex starts on the free side
  std::function<Point_3(Random&)> target;
  std::optional<std::array<std::size_t, 3>> rim = std::nullopt;
};

inline std::array<double, 3> array_of(const Point_3& p) { return {p.x(), p.y(), p.z()}; }

inline Convex_scene finished(Draft draft, const Rigid_motion& motion) {
  draft.list.transform(motion);
  Convex_scene scene;
  scene.name = draft.name;
  scene.mesh = valid_mesh(draft.list, draft.name);
  scene.moved = Vertex_index(static_cast<Mesh::size_type>(draft.moved));
  for (const auto& f : draft.planes) {
    const auto& p = draft.list.points;
    const int side = CGAL::orientation(p[f[0]], p[f[1]], p[f[2]], p[draft.moved]);
    scene.half_spaces.push_back({{array_of(p[f[0]]), array_of(p[f[1]]), array_of(p[f[2]])}, side});
  }
  const auto target = draft.target;
  scene.any_target = [target, motion](Random& random) { return motion(target(random)); };
  if (draft.rim) {
    const auto& p = draft.list.points;
    scene.rim = {{p[(*draft.rim)[0]], p[(*draft.rim)[1]], p[(*draft.rim)[2]]}};
  }
  return scene;
}

/// Adds the mover; that of a tetrahedron may not cross the plane of its other three corners either.
inline void put_mover(Draft& draft, Mover mover, const Point_3& start, const Point_3& base, double width) {
  draft.name += std::string(", ") + name_of(mover);
  draft.moved = add_mover(draft.list, mover, start, base, width);
  if (mover == Mover::tetrahedron)
    draft.planes.push_back({draft.moved - 3, draft.moved - 2, draft.moved - 1});
}

inline Draft plane(Mover mover, Random& random) {
  Draft draft{"plane", slab(), 0, {{0, 1, 2}}, {}};
  put_mover(draft, mover, Point_3(0.1, 0.2, 1) + uniform_vector(random, 0.1), {0, 0, 3}, 0.5);
  draft.target = [](Random& r) {
    const double x = uniform(r, -2, 2), y = uniform(r, -2, 2), z = uniform(r, -3, 0.5);
    return Point_3(x, y, z);
  };
  return draft;
}

/// The inside of a convex solid about the origin that holds a ball of radius 0.6.
inline Draft cavity(const std::string& name, meshes::Triangle_list solid, Mover mover, Random& random) {
  Draft draft{name, solid, 0, solid.faces, {}};
  put_mover(draft, mover, Point_3(0.1, 0.15, 0.2) + uniform_vector(random, 0.1), {-0.1, -0.1, -0.2}, 0.2);
  const std::vector<Point_3> corners = solid.points;
  const auto faces = solid.faces;
  draft.target = [corners, faces](Random& r) {
    const Point_3 centre(0, 0, 0);
    switch (r() % 5) {
    case 0: return centre + uniform_vector(r, 3);
    case 1: return centre + uniform_vector(r, 0.5);
    case 2: return centre + uniform(r, 1.05, 2) * (corners[r() % corners.size()] - centre) + uniform_vector(r, 0.05);
    case 3: { // beyond an edge
      const auto& f = faces[r() % faces.size()];
      const double a = uniform(r, 0, 1);
      return centre + uniform(r, 1, 2) * (a * (corners[f[0]] - centre) + (1 - a) * (corners[f[1]] - centre));
    }
    default: return corners[r() % corners.size()]; // a vertex exactly
    }
  };
  return draft;
}

inline meshes::Triangle_list random_tetrahedron(Random& random) {
  meshes::Triangle_list list = meshes::tetrahedron();
  list.points = {{2, 2, 2}, {2, -2, -2}, {-2, 2, -2}, {-2, -2, 2}};
  return list.transform([&](const Point_3& p) { return p + uniform_vector(random, 0.4); });
}

inline Draft groove_scene(Mover mover, Random& random) {
  const double width = uniform(random, 0.5, 2), depth = uniform(random, 0.5, 3);
  Draft draft{"groove", groove(width, depth), 0, {}, {}, {{0, 4, 7}}};
  draft.planes = {draft.list.faces[0], draft.list.faces[2]};
  put_mover(draft, mover, {0.05, 0.1, -0.3 * depth}, {0, 0, 2}, 0.1);
  const double slope = depth / width, length = std::sqrt(1 + slope * slope);
  draft.target = [=](Random& r) {
    // A point of the groove's left, right, or bottom, pushed into what is below it.
    const double height = uniform(r, 0.02, 0.9) * depth, y = uniform(r, -3, 3);
    const std::size_t kind = r() % 3;
    const Point_3 left(-height / slope, y, height - depth), right(height / slope, y, height - depth),
        bottom(0, y, -depth);
    const Vector_3 into_left(-slope / length, 0, -1 / length), into_right(slope / length, 0, -1 / length);
    const double deep = r() % 4 == 0 ? 20 : 2; // where it stands near the rim only a far target is right
    const double a = uniform(r, -0.05, deep), b = uniform(r, 0, deep);
    return kind == 0   ? left + a * into_left
           : kind == 1 ? right + a * into_right
                       : bottom + a * into_left + b * into_right;
  };
  return draft;
}

inline Draft pit_scene(Mover mover, Random& random) {
  const Point_3 bottom = Point_3(0, 0, -uniform(random, 1, 3)) + uniform_vector(random, 0.2);
  std::array<Point_3, 3> rim;
  for (int i = 0; i < 3; ++i) {
    const double angle = 2.0943951023931953 * i + uniform(random, -0.2, 0.2), radius = uniform(random, 1.5, 2.5);
    rim[i] = Point_3(radius * std::cos(angle), radius * std::sin(angle), 0);
  }
  Draft draft{"pit", pit(rim, bottom), 0, {}, {}, {{4, 5, 6}}};
  draft.planes = {draft.list.faces[0], draft.list.faces[1], draft.list.faces[2]};
  const Vector_3 axis = CGAL::centroid(rim[0], rim[1], rim[2]) - bottom; // within the cone of the three sides
  put_mover(draft, mover, bottom + 0.4 * axis, bottom + 1.8 * axis, 0.02);
  std::array<Vector_3, 3> into;
  for (int i = 0; i < 3; ++i) {
    const Vector_3 n = CGAL::cross_product(rim[i] - bottom, rim[(i + 1) % 3] - bottom);
    into[i] = n / (n.z() > 0 ? -std::sqrt(n.squared_length()) : std::sqrt(n.squared_length()));
  }
  draft.target = [=](Random& r) {
    const std::size_t i = r() % 3, j = (i + 1) % 3;
    const double deep = r() % 4 == 0 ? 20 : 2;
    const double s = uniform(r, 0.05, 0.9), t = uniform(r, 0, 1), a = uniform(r, 0, deep), b = uniform(r, 0, deep),
                 c = uniform(r, 0, deep);
    switch (r() % 3) {
    case 0: return bottom + s * (t * (rim[i] - bottom) + (1 - t) * (rim[j] - bottom)) + a * into[i];
    // The edge from the bottom to rim[j] is that of sides i and j.
    case 1: return bottom + s * (rim[j] - bottom) + a * into[i] + b * into[j];
    default: return bottom + a * into[0] + b * into[1] + c * into[2];
    }
  };
  return draft;
}

/// A ridge along x from vertex 0 to vertex 1 and an edge of the moved solid from vertex 5 across it.
inline Draft crossing_edges(Random& random) {
  const auto near = [&](double x, double y, double z) { return Point_3(x, y, z) + uniform_vector(random, 0.05); };
  Draft draft{"edge over edge",
              two_tetrahedra({near(-8, 0, 0), near(8, 0, 0), near(0, -1, -3), near(0, 1, -3), near(0, -2, 1),
                              near(0, 2, 0.5), near(-0.5, 0, 6), near(0.5, 0, 6)}),
              4,
              {{5, 0, 1}},
              {}};
  const Point_3 v = draft.list.points[5], a = draft.list.points[0], b = draft.list.points[1];
  Vector_3 up = CGAL::cross_product(a - v, b - v);
  up = up / (up.z() > 0 ? std::sqrt(up.squared_length()) : -std::sqrt(up.squared_length()));
  draft.target = [=](Random& r) {
    const Point_3 on_ridge = a + uniform(r, 0.45, 0.55) * (b - a);
    return v + uniform(r, 1.7, 2.3) * (on_ridge - v) - uniform(r, -0.1, 2) * up;
  };
  return draft;
}

/// A wide face whose far corner is dragged, over the tip, vertex 0, of a spike; vertices 5 and 6 are its other corners.
inline Draft face_over_vertex(Random& random) {
  const auto near = [&](double x, double y, double z) { return Point_3(x, y, z) + uniform_vector(random, 0.05); };
  Draft draft{"face over vertex",
              two_tetrahedra({near(0, 0, 0), near(-1, -1, -3), near(1, -1, -3), near(0, 1, -3), near(0, 3, 1),
                              near(-2, -1, 0.5), near(2, -1, 0.5), near(0, 0, 6)}),
              4,
              {{5, 6, 0}},
              {}};
  const Point_3 g = draft.list.points[5], i = draft.list.points[6], a = draft.list.points[0];
  Vector_3 up = CGAL::cross_product(g - a, i - a);
  up = up / (up.z() > 0 ? std::sqrt(up.squared_length()) : -std::sqrt(up.squared_length()));
  draft.target = [=](Random& r) {
    const double s = uniform(r, 1.2, 1.8), t = s + uniform(r, -0.2, 0.2);
    return a + s * (a - g) + t * (a - i) - uniform(r, -0.1, 2) * up;
  };
  return draft;
}

} // namespace internal_scenes

/// All kinds of scenes, with sizes, angles and places drawn anew. Half of them stand along the axes.
inline std::vector<Convex_scene> convex_scenes(Random& random) {
  using namespace internal_scenes;
  std::vector<Convex_scene> scenes;
  const auto add = [&](Draft draft) {
    const bool along_axes = random() % 2 == 0;
    scenes.push_back(finished(std::move(draft), along_axes ? Rigid_motion() : Rigid_motion::random(random)));
  };
  for (const Mover mover : {Mover::probe, Mover::tetrahedron}) {
    add(plane(mover, random));
    add(cavity("inside of a tetrahedron", random_tetrahedron(random), mover, random));
    add(cavity("inside of a cube", meshes::box(1 + random() % 3, 2).scale_and_move(1, -1, -1, -1), mover, random));
    add(cavity("inside of an icosphere", meshes::icosphere(2).scale_and_move(1.5, 0, 0, 0), mover, random));
    add(groove_scene(mover, random));
    add(pit_scene(mover, random));
  }
  add(crossing_edges(random));
  add(face_over_vertex(random));
  return scenes;
}

} // namespace haptic_sculpt::test
