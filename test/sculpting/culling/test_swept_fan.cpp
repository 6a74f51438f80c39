// SPDX-License-Identifier: GPL-3.0-or-later
// What a fan says is apart, the exact sweeps find apart: on small grids, a few units in the last place beside the fan,
// at any scale, for flat fans, vanishing motions and repeated points. And it says so often enough to be of use.
#include "sculpting/culling/planes_and_points.h"

#include <haptic_sculpt/collision.h>
#include <haptic_sculpt/sculpting/culling/Spoke_planes.h>

#include <boost/test/unit_test.hpp>

using namespace haptic_sculpt;
using namespace haptic_sculpt::test;

namespace {

using Coordinates = std::array<double, 3>;
using internal::minus;

struct Drawn_fan {
  Coordinates source, target;
  std::vector<Coordinates> link;
  double scale, offset;

  Drawn_fan(Random& random, int faces) {
    std::uniform_real_distribution<double> number(-1, 1);
    scale = std::ldexp(1.0, static_cast<int>(random() % 400) - 200);
    offset = random() % 2 == 0 ? 0 : scale * 1e3;
    const bool is_flat = random() % 4 == 0, stands = random() % 8 == 0;
    source = place(0.1 * number(random), 0.1 * number(random), is_flat ? 0 : 1);
    target =
        stands ? source : place(0.3 * number(random), 0.3 * number(random), is_flat ? 0 : 1 + 0.5 * number(random));
    const double turn = random() % 2 == 0 ? 1 : -1, first = 6 * number(random), opening = 0.3 * (1.1 + number(random));
    for (int i = 0; i <= faces; ++i)
      link.push_back(beside(first + turn * opening * i / faces));
    if (faces > 1 && random() % 8 == 0)
      link.back() = link.front();
    if (offset == 0 && random() % 8 == 0) { // a spoke whose reciprocal is not a number
      source = {0, 0, 0};
      Coordinates& end = link[random() % link.size()];
      for (double& x : end)
        x = std::ldexp(number(random), -1040);
    }
  }

  Coordinates place(double x, double y, double z) const {
    return {offset + scale * x, offset + scale * y, offset + scale * z};
  }
  Coordinates beside(double angle) const { return place(std::cos(angle), std::sin(angle), 0.1 * std::cos(3 * angle)); }

  /// A point of the link moved by a few units in the last place, one near its plane, or any.
  Coordinates draw_still(Random& random) const {
    std::uniform_real_distribution<double> number(-1, 1);
    Coordinates p = random() % 2 == 0 ? link[random() % link.size()] : beside(7 * number(random));
    if (random() % 4 == 0)
      p = source;
    switch (random() % 4) {
    case 0:
      return place(number(random), number(random), number(random));
    case 1:
      return p;
    case 2:
      for (double& x : p)
        x = std::nextafter(x, x + scale * number(random));
      return p;
    default:
      for (double& x : p)
        x += 0.05 * scale * number(random);
      return p;
    }
  }
};

Point_3 point(const Coordinates& p) {
  return Point_3(p[0], p[1], p[2]);
}

} // namespace

BOOST_AUTO_TEST_CASE(what_a_fan_says_is_apart_is_apart) {
  Random random(seed_from_environment(71));
  const std::size_t fans = count_from_environment("HAPTIC_SCULPT_FANS", 6000);
  const Edge_edge_sweep_3<meshes::Kernel> edge_sweep;
  const Face_vertex_sweep_3<meshes::Kernel> face_sweep;
  std::size_t asked = 0, apart = 0, really = 0, wrong = 0;
  for (std::size_t k = 0; k < fans; ++k) {
    const int faces = 1 + static_cast<int>(random() % 4);
    const Drawn_fan drawn(random, faces);
    std::vector<internal::Vector> spokes;
    double reach = 4 * drawn.scale;
    for (const Coordinates& p : drawn.link)
      spokes.push_back(minus(p, drawn.source));
    const internal::Swept_fan fan(minus(drawn.target, drawn.source), spokes, 0, static_cast<std::size_t>(faces), reach);
    for (int i = 0; i < 10; ++i) {
      const Coordinates p = drawn.draw_still(random), q = drawn.draw_still(random);
      if (p == q)
        continue;
      const auto is_hit = [&](const auto& sweep, const auto&... points) {
        return sweep.do_collide(point(drawn.source), point(drawn.target), point(points)...);
      };
      bool hits = false, p_hits = false;
      for (int f = 0; f <= faces; ++f)
        hits = hits || is_hit(edge_sweep, drawn.link[f], p, q);
      for (int f = 0; f < faces; ++f)
        p_hits = p_hits || is_hit(face_sweep, drawn.link[f], drawn.link[f + 1], p);
      internal::Outcodes outcodes;
      outcodes.resize(2);
      outcodes.set(0, minus(p, drawn.source));
      outcodes.set(1, minus(q, drawn.source));
      outcodes.clear();
      const std::size_t number = random() % internal::Swept_fan::most_fans;
      fan.compare(outcodes, number);
      const unsigned from_edge = internal::Swept_fan::apart_from_fans(outcodes.outcode(0) & outcodes.outcode(1)),
                     from_point = internal::Swept_fan::apart_from_fans(outcodes.outcode(0));
      const bool is_edge_apart = from_edge != 0, is_point_apart = from_point != 0;
      BOOST_TEST(((from_edge | from_point) & ~(1u << number)) == 0u);
      asked += 2, apart += is_edge_apart + is_point_apart, really += !hits + !p_hits;
      wrong += (is_edge_apart && hits) + (is_point_apart && p_hits);
    }
  }
  BOOST_TEST_MESSAGE(asked << " asked, " << apart << " said to be apart of " << really);
  BOOST_TEST(wrong == 0u);
  BOOST_TEST(really < asked);
  BOOST_TEST(2 * apart > really);
}

namespace {

struct Planes_at_spokes {
  using Outcode = internal::Outcodes::Outcode;
  std::size_t first;
  internal::Spoke_planes planes;

  explicit Planes_at_spokes(Faces_and_points& scene) : first(scene.first) {
    const Rounding in_this_mode(scene.rounding);
    planes.assign(scene.way, scene.spokes, first, scene.last, scene.reach, scene.margin);
    planes.compare(scene.outcodes);
  }
  bool beyond_vertex(Outcode) const { return false; } // these are no planes of a whole star
  bool beyond_edge(std::size_t i, Outcode sides) const {
    return (planes.apart_from_spokes(sides) >> (i - first) & 1) != 0;
  }
  bool beyond_face(std::size_t i, Outcode sides) const {
    return (planes.apart_from_faces(sides) >> (i - first) & 1) != 0;
  }
};

struct Planes_at_ends {
  using Outcode = internal::Outcodes::Outcode;

  explicit Planes_at_ends(Faces_and_points& scene) {
    const Rounding in_this_mode(scene.rounding);
    scene.outcodes.clear();
    internal::Swept_fan(scene.way, scene.spokes, scene.first, scene.last, scene.reach, scene.margin)
        .compare(scene.outcodes);
  }
  bool beyond_vertex(Outcode sides) const { return internal::Swept_fan::apart_from_fans(sides) != 0; }
  bool beyond_edge(std::size_t, Outcode sides) const { return beyond_vertex(sides); }
  bool beyond_face(std::size_t, Outcode sides) const { return beyond_vertex(sides); }
};

template <class Planes>
void check_large_stars(std::uint64_t seed, std::size_t stars) {
  Random random(seed);
  Count vertex, edge, face;
  for (std::size_t k = 0; k < stars; ++k) {
    const std::size_t most = internal::Spoke_planes::most_faces;
    Faces_and_points scene(random, 4 + random() % 16, draw_exponent(random), most, false);
    check(random, scene, Planes(scene), vertex, edge, face);
  }
  BOOST_TEST_MESSAGE("edges: " << edge << "; faces: " << face);
  for (const Count& count : {edge, face}) {
    BOOST_TEST(count.wrong == 0u);
    BOOST_TEST(count.apart * 16 > count.asked);
  }
}

} // namespace

// With margins, and in all rounding modes.
BOOST_AUTO_TEST_CASE(what_a_fan_of_a_star_says_is_apart_is_apart) {
  check_large_stars<Planes_at_ends>(seed_from_environment(74),
                                    count_from_environment("HAPTIC_SCULPT_LARGE_STARS", 5000));
}

BOOST_AUTO_TEST_CASE(what_planes_at_spokes_say_is_apart_is_apart) {
  check_large_stars<Planes_at_spokes>(seed_from_environment(72),
                                      count_from_environment("HAPTIC_SCULPT_LARGE_STARS", 5000));
}

// The other half of a bipyramid meets every spoke's end from below, and wherever the apex goes a little, no pair is
// left: that is what these planes are for.
BOOST_AUTO_TEST_CASE(planes_at_spokes_part_a_fan_from_what_lies_under_it) {
  Random random(seed_from_environment(73));
  std::uniform_real_distribution<double> number(-1, 1);
  std::size_t left = 0, asked = 0;
  for (int k = 0; k < 100; ++k) {
    const std::size_t valence = 100 + random() % 900, faces = 1 + random() % internal::Spoke_planes::most_faces;
    const double turn = random() % 2 == 0 ? 1 : -1, side = random() % 2 == 0 ? 1 : -1; // the fan may be a cap or a cup
    std::vector<internal::Vector> spokes;
    for (std::size_t i = 0; i < valence; ++i) {
      const double angle = turn * 6.283185307179586 * static_cast<double>(i) / static_cast<double>(valence);
      spokes.push_back({std::cos(angle), std::sin(angle), -side});
    }
    internal::Outcodes outcodes; // the ends of the spokes, and the other apex
    outcodes.resize(valence + 1);
    for (std::size_t i = 0; i < valence; ++i)
      outcodes.set(i, spokes[i]);
    outcodes.set(valence, {0, 0, -2 * side});
    const double x = number(random), y = number(random), z = number(random);
    internal::Spoke_planes planes;
    planes.assign({0.02 * x, 0.02 * y, 0.02 * z}, spokes, 0, faces, 2, 0);
    planes.compare(outcodes);
    for (std::size_t i = 0; i < faces; ++i)
      for (std::size_t j = 0; j < valence; ++j) {
        asked += 2;
        const std::size_t next = j + 1 < valence ? j + 1 : 0;
        const auto apart = [&](auto sides) { return (planes.apart_from_spokes(sides) >> i & 1) != 0; };
        left += j != i && !apart(outcodes.outcode(j) & outcodes.outcode(valence)) &&
                (j < 2 * faces || 2 * valence - 2 * faces < 2 * j);
        left += j != i && next != i && !apart(outcodes.outcode(j) & outcodes.outcode(next)) && j < 2 * faces;
      }
  }
  BOOST_TEST(left <= asked / 10000); // rounded planes: what they leave is decided exactly
}
