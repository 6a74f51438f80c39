// SPDX-License-Identifier: GPL-3.0-or-later
// The pairs that are left near a place give the impacts that all pairs give: with needles a million times longer than
// the star, features next to it, and any scale.
#include "sculpting/Random_scene.h"

#include <haptic_sculpt/sculpting/motion/Narrow_phase.h>

#include <boost/test/unit_test.hpp>

using namespace haptic_sculpt;
using namespace haptic_sculpt::test;

namespace {

using Coordinates = std::array<double, 3>;

struct Crowded_star {
  Mesh mesh;
  internal::Star<Mesh> star;
  internal::Candidate_list<Mesh> list;
  Coordinates centre{};

  /// A star of three faces around a vertex near the origin, and triangles around it whose corners are 2^0 to 2^longest
  /// away.
  Crowded_star(Random& random, int longest, int triangles, double scale, double offset) {
    std::uniform_real_distribution<double> number(-1, 1);
    const auto point = [&](double size) {
      Coordinates p;
      for (double& x : p)
        x = offset + scale * size * number(random);
      return p;
    };
    const auto add = [&](const Coordinates& p) { return mesh.add_vertex(Point_3(p[0], p[1], p[2])); };
    centre = point(0.2);
    star.centre = add(centre);
    for (int i = 0; i < 3; ++i) {
      star.link_points.push_back(point(1));
      star.link.push_back(add(star.link_points[i]));
    }
    std::vector<Mesh::Face_index> faces;
    for (int k = 0; k < triangles; ++k) {
      std::array<Vertex_index, 3> corner;
      for (Vertex_index& v : corner)
        v = random() % 8 == 0 ? star.link[random() % 3]
                              : add(point(std::ldexp(1.0, static_cast<int>(random() % (longest + 1)))));
      const auto f = mesh.add_face(corner[0], corner[1], corner[2]);
      if (f.is_valid())
        faces.push_back(f);
    }
    Box_3 everywhere;
    everywhere.include(Coordinates{-1e300, -1e300, -1e300}).include(Coordinates{1e300, 1e300, 1e300});
    list.assign(mesh, [this](auto f) { return internal::corners_of_face(mesh, f); }, star, faces, everywhere);
  }
};

} // namespace

namespace {

bool same(const Star_impacts<Mesh>& a, const Star_impacts<Mesh>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const auto& x, const auto& y) {
    return x.feature() == y.feature() && x.vertices() == y.vertices() &&
           compare_time(x.impact(), y.impact()) == CGAL::EQUAL;
  });
}

} // namespace

BOOST_AUTO_TEST_CASE(near_pairs_give_what_all_pairs_give) {
  Random random(seed_from_environment(61));
  const std::size_t scenes = count_from_environment("HAPTIC_SCULPT_BALLS", 40000);
  std::size_t balls = 0, motions = 0, blocked = 0, wrong = 0, without_sweeps = 0;
  for (std::size_t k = 0; k < scenes; ++k) {
    const int longest = static_cast<int>(random() % 50);
    const double scale = std::ldexp(1.0, static_cast<int>(random() % 60) - 30);
    const double offset = random() % 4 == 0 ? 1e3 * scale : 0;
    Crowded_star scene(random, longest, 1 + static_cast<int>(random() % 4), scale, offset);
    std::normal_distribution<double> normal;
    const auto direction = [&] {
      const double x = normal(random), y = normal(random), z = normal(random);
      return internal::normalized({x, y, z});
    };
    internal::Near_pairs<Mesh> pairs;
    const double step = std::ldexp(scale, -static_cast<int>(random() % 20));
    internal::Star_runs<Mesh> memory;
    pairs.assign(scene.star, scene.list, memory, scene.centre, internal::advanced(scene.centre, step, direction()));
    if (!pairs.cover(scene.centre, scene.centre))
      continue;
    ++balls;
    Filter_counters counters;
    internal::Narrow_phase<Mesh> narrow{Exact_sweep_traits<Mesh>(&counters)};
    Star_impacts<Mesh> all, near;
    for (int i = 0; i < 20; ++i) {
      // As far as the ball goes in a random direction, found by halving; or a part of it.
      const Coordinates way = direction();
      Coordinates target = scene.centre;
      double low = 0, high = 4 * scale;
      for (int halving = 0; halving < 60; ++halving) {
        const double middle = (low + high) / 2;
        const Coordinates p = internal::advanced(scene.centre, middle, way);
        const bool is_covered = pairs.cover(scene.centre, p);
        (is_covered ? low : high) = middle;
        if (is_covered && (i % 2 == 0 || halving < 3))
          target = p;
      }
      std::size_t swept = 0;
      pairs.for_each_near(scene.centre, target, [&](const auto&) { return ++swept, true; });
      narrow.first_impacts(scene.star, scene.list, scene.centre, target, all);
      narrow.first_impacts(scene.star, scene.list, pairs, scene.centre, target, near);
      ++motions;
      without_sweeps += swept == 0;
      blocked += !all.empty();
      wrong += !same(all, near) || narrow.is_free(scene.star, scene.list, pairs, scene.centre, target) != all.empty();
    }
  }
  BOOST_TEST_MESSAGE(scenes << " scenes, " << balls << " balls, " << motions << " motions in them, " << without_sweeps
                            << " free without a sweep, " << blocked << " blocked, " << wrong << " wrong");
  BOOST_TEST(wrong == 0u);
  BOOST_TEST(balls > scenes / 20);
  BOOST_TEST(without_sweeps > motions / 20);
  BOOST_TEST(blocked > motions / 100);
}
