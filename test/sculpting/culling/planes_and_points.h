// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "sculpting/Random_scene.h"
#include "sculpting/culling/drawn_stars.h"

#include <haptic_sculpt/sculpting/culling/Outcodes.h>
#include <haptic_sculpt/sculpting/geometry/Star_motion.h>

#include <cfenv>

namespace haptic_sculpt::test {

/// Rounds in one of the four ways until it goes.
class Rounding {
public:
  explicit Rounding(std::size_t way) {
    static constexpr int ways[] = {FE_TONEAREST, FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO};
    std::fesetround(ways[way % 4]);
  }
  Rounding(const Rounding&) = delete;
  Rounding& operator=(const Rounding&) = delete;
  ~Rounding() { std::fesetround(FE_TONEAREST); }
};

inline int draw_exponent(Random& random) {
  switch (random() % 8) {
  case 0:
    return 0;
  case 1: // nearly or quite beyond where there are planes
    return (random() % 2 == 0 ? 1 : -1) * (180 + static_cast<int>(random() % 120));
  case 2: // where products and differences lose what is left of them
    return random() % 4 == 0 ? 960 : -960 - static_cast<int>(random() % 110);
  default:
    return static_cast<int>(random() % 381) - 190;
  }
}

inline double draw_offset(Random& random) {
  static constexpr double offsets[] = {0, 0, 0, 3, 1024, 0x1p+20, 0x1p+40};
  return offsets[random() % 7];
}

/// Some faces of a star, a motion of its centre, and points around, as planes are made for and asked about.
struct Faces_and_points {
  using Coordinates = internal::Coordinates;
  using Sweep_points = internal::Sweep_points;
  using Outcode = internal::Outcodes::Outcode;

  Drawn_star drawn;
  std::size_t first, last;
  double margin, until;
  std::vector<Coordinates> points;
  std::size_t rounding; ///< in this mode all further is computed, and planes are to be
  internal::Vector way;
  std::vector<internal::Vector> spokes;
  double reach;
  Box_3 box;
  internal::Outcodes outcodes; ///< of the points

  /// \param most of this many faces \param may_be_whole whether those may be the whole star
  Faces_and_points(Random& random, std::size_t valence, int exponent, std::size_t most, bool may_be_whole)
    : drawn(random, valence, exponent, draw_offset(random)), first(0), last(valence) {
    if (!may_be_whole || valence > most ||
        random() % 2 == 0) { // often up to the end, where the last spoke is the first of the link
      const std::size_t faces = 1 + random() % std::min(valence - 1, most);
      first = random() % 3 == 0 ? valence - faces : random() % (valence - faces + 1);
      last = first + faces;
    }
    margin = random() % 4 == 0 ? drawn.size() * std::ldexp(1.0, -static_cast<int>(random() % 30)) : 0;
    until = random() % 4 == 0 ? std::uniform_real_distribution<double>(0, 1)(random) : 1;
    for (int i = 0; i < 24; ++i)
      points.push_back(drawn.draw_still(random));
    rounding = random() % 8 < 4 ? 0 : random() % 4;
    const Rounding in_this_mode(rounding);
    internal::Star_motion motion(drawn.source, drawn.target);
    motion.shorten(until);
    way = motion.way(1);
    reach = internal::quick_magnitude(internal::minus(drawn.target, drawn.source));
    const auto local = [&](const Coordinates& p) {
      const Coordinates place = internal::minus(p, drawn.source);
      reach = internal::larger(reach, internal::quick_magnitude(place));
      return place;
    };
    for (const Coordinates& p : drawn.link)
      spokes.push_back(local(p));
    outcodes.resize(points.size());
    for (std::size_t k = 0; k < points.size(); ++k)
      outcodes.set(k, local(points[k]));
    box = motion.path();
    for (std::size_t i = first; i <= last; ++i)
      box.include(drawn.link[i % valence]);
    for (int i = 0; i < 3; ++i) {
      box.lower[i] = box.lower[i] - margin - drawn.source[i];
      box.upper[i] = box.upper[i] + margin - drawn.source[i];
    }
  }

  const Coordinates& link(std::size_t i) const { return drawn.link[i % drawn.link.size()]; }

  /// Whether the sweep meets in the part of the way that is of interest.
  template <class Verdict_of>
  bool meets(const Verdict_of& verdict_of, const Sweep_points& points) const {
    No_filter_counters uncounted;
    const internal::Sweep_verdict verdict = verdict_of(points, uncounted);
    return verdict.hits && (until == 1 || internal::exact_time(points, verdict) <= mpq_class(until));
  }

  /// Whether it meets, or would if what stands still, the last points, were anywhere nearer by about the margin.
  template <class Verdict_of>
  bool meets_within_margin(Random& random, const Verdict_of& verdict_of, const Sweep_points& points, int still) const {
    if (meets(verdict_of, points))
      return true;
    if (margin == 0)
      return false;
    std::uniform_real_distribution<double> number(0, 1);
    for (int attempt = 0; attempt < 3; ++attempt) {
      // From some point of the still to some point of the moving, which is often at its border.
      internal::Vector way{};
      const double t = number(random);
      const Coordinates &from = points[5 - 1 - random() % still], &to = points[random() % (5 - still)],
                        &other = points[random() % (5 - still)];
      for (int i = 0; i < 3; ++i)
        way[i] = to[i] + t * (other[i] - to[i]) - from[i];
      const double length = internal::length(way), shift = std::min(1.0, 0.9999999 * margin / length);
      if (!(length > 0) || drawn.size() * 0x1p+20 < internal::largest_magnitude(from))
        continue; // far from the origin roundings are larger than what is taken off here
      Sweep_points moved = points;
      for (int k = 5 - still; k < 5; ++k)
        for (int i = 0; i < 3; ++i)
          moved[k][i] += shift * way[i];
      if (meets(verdict_of, moved))
        return true;
    }
    return false;
  }
};

/// Counts what is asked, said to be apart, and wrong.
struct Count {
  std::size_t asked = 0, apart = 0, wrong = 0;

  template <class Meets>
  void note(bool is_apart, const Meets& meets) {
    ++asked, apart += is_apart, wrong += is_apart && meets();
  }
  friend std::ostream& operator<<(std::ostream& out, const Count& count) {
    return out << count.asked << " asked, " << count.apart << " said to be apart, " << count.wrong << " wrong";
  }
};

/// Asks the exact sweeps about points, edges and faces on which planes decide. \tparam Planes has
/// `beyond_vertex(sides)`, and `beyond_edge(i, sides)` and `beyond_face(i, sides)` for the edge and the face i of the
/// star
template <class Planes>
void check(Random& random, const Faces_and_points& scene, const Planes& planes, Count& vertex, Count& edge,
           Count& face) {
  const auto on = [](const auto& p, auto& c) { return internal::vertex_face_verdict(p, c); };
  const auto of_edges = [](const auto& p, auto& c) { return internal::edge_edge_verdict(p, c); };
  const auto of_faces = [](const auto& p, auto& c) { return internal::face_vertex_verdict(p, c); };
  const auto& source = scene.drawn.source;
  const auto& target = scene.drawn.target;
  const auto& points = scene.points;
  const auto sides = [&](std::size_t k) { return scene.outcodes.outcode(k); };
  for (std::size_t k = 0; k < points.size(); ++k) {
    const std::size_t a = k, b = random() % points.size(), c = random() % points.size();
    if (scene.last - scene.first == scene.drawn.link.size())
      vertex.note(planes.beyond_vertex(sides(a) & sides(b) & sides(c)), [&] {
        return scene.meets_within_margin(random, on, {source, target, points[a], points[b], points[c]}, 3);
      });
    for (std::size_t i = scene.first; i < scene.last; ++i) {
      edge.note(planes.beyond_edge(i, sides(a) & sides(b)), [&] {
        return scene.meets_within_margin(random, of_edges, {source, target, scene.link(i), points[a], points[b]}, 2);
      });
      face.note(planes.beyond_face(i, sides(a)), [&] {
        return scene.meets_within_margin(random, of_faces,
                                         {source, target, scene.link(i), scene.link(i + 1), points[a]}, 1);
      });
    }
  }
}

} // namespace haptic_sculpt::test
