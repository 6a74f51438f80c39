// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/sculpting/geometry/vector_3.h>

#include <cmath>
#include <random>
#include <vector>

namespace haptic_sculpt::test {

/// A star's link and a motion of its centre, drawn at random from shapes that are hard to part from their surroundings:
/// smooth fans, spikes, flat stars, needles, small integer grids, clouds; long and short ways and none; spokes and
/// points of the link that coincide. And points in, on, and a few units in the last place beside what it sweeps over.
struct Drawn_star {
  using Random = std::mt19937_64;
  using Coordinates = internal::Vector;

  enum Shape { fan, spike, flat, needle, grid, flat_grid, cloud, shapes };

  Coordinates source, target;
  std::vector<Coordinates> link;

  /// \param exponent all lengths are scaled by 2^exponent \param offset in these lengths: how far from the origin
  Drawn_star(Random& random, std::size_t valence, int exponent, double offset)
    : scale_(std::ldexp(1.0, exponent)), shape_(static_cast<Shape>(random() % shapes)) {
    for (Coordinates& column : map_)
      for (double& x : column)
        x = number(random);
    is_mapped_ = !is_grid() && random() % 2 == 0;
    is_tight_ = random() % 3 == 0;
    for (double& x : offset_)
      x = is_grid() ? offset : offset * number(random);
    source = place(random() % 8 == 0 && is_grid() ? on_grid(random) : near_centre(random));
    target = place(end_of_way(random));
    const double turn = random() % 2 == 0 ? 1 : -1, first = 6 * number(random);
    for (std::size_t i = 0; i < valence; ++i)
      link.push_back(place(on_link(random, first + turn * 6.283185307179586 * static_cast<double>(i) /
                                                         static_cast<double>(valence))));
    if (random() % 16 == 0)
      link[random() % valence] = link[random() % valence];
    if (random() % 32 == 0)
      link[random() % valence] = random() % 2 == 0 ? source : target;
    if (random() % 16 == 0)
      target = source;
  }

  double size() const { return scale_; }

  /// Where things happen: on edges, chords, planes about spokes and way, at corners; seldom anywhere.
  Coordinates draw_still(Random& random) const {
    const std::size_t i = random() % link.size(), j = i + 1 < link.size() ? i + 1 : 0;
    const auto part = [&] {
      static constexpr double parts[] = {0, 0, 0, 0.25, 0.5, 0.75, 1, 1, -1, 2};
      return random() % 4 == 0 ? number(random) : parts[random() % 10];
    };
    if (is_tight_) {
      // On a line between two corners of what one face sweeps over, or beside it: nothing reaches farther than the
      // star, so that bounds of roundings, which grow with that, are as small as they can be.
      const Coordinates* const corners[] = {&source, &target, &link[i], &link[j]};
      const Coordinates &a = *corners[random() % 4], &b = *corners[random() % 4];
      const double t = random() % 2 == 0 ? 0.5 : std::abs(number(random));
      const double beside = random() % 2 == 0 ? 0 : std::ldexp(scale_, -4 - static_cast<int>(random() % 50));
      Coordinates p;
      for (int k = 0; k < 3; ++k)
        p[k] = a[k] + t * (b[k] - a[k]) + beside * number(random);
      return p;
    }
    Coordinates p = source;
    const double along_way = part(), along_spoke = part(), along_next = random() % 2 == 0 ? part() : 1 - along_spoke;
    for (int k = 0; k < 3; ++k)
      p[k] += along_way * (target[k] - source[k]) + along_spoke * (link[i][k] - source[k]) +
              along_next * (link[j][k] - source[k]);
    switch (random() % 8) {
    case 0:
      p = link[i];
      break;
    case 1:
      for (int k = 0; k < 3; ++k)
        p[k] += 0.1 * scale_ * number(random);
      break;
    case 2:
      p = place({2 * number(random), 2 * number(random), 2 * number(random)});
      break;
    default:;
    }
    if (random() % 3 == 0)
      for (double& x : p)
        for (int steps = static_cast<int>(random() % 4); steps > 0; --steps)
          x = std::nextafter(x, random() % 2 == 0 ? 1e300 : -1e300);
    return p;
  }

private:
  double scale_;
  Shape shape_;
  bool is_mapped_ = false, is_tight_;
  Coordinates offset_;
  std::array<Coordinates, 3> map_;

  static double number(Random& random) { return std::uniform_real_distribution<double>(-1, 1)(random); }
  bool is_grid() const { return shape_ == grid || shape_ == flat_grid; }

  Coordinates on_grid(Random& random) const {
    const auto coordinate = [&] { return static_cast<double>(random() % 9) - 4; };
    const double x = coordinate(), y = coordinate(), z = coordinate();
    return {x, y, shape_ == flat_grid ? 0 : z};
  }
  Coordinates near_centre(Random& random) const {
    const double x = 0.1 * number(random), y = 0.1 * number(random), z = number(random);
    if (is_grid())
      return {0, 0, 0};
    return {x, y, shape_ == flat ? 0 : shape_ == fan ? 0.5 * z : shape_ == spike ? 1 + z : x};
  }
  Coordinates end_of_way(Random& random) const {
    static constexpr double lengths[] = {0x1p-30, 0.01, 0.1, 0.5, 1, 2, 40};
    const double length = lengths[random() % 7], x = number(random), y = number(random), z = number(random);
    if (is_grid())
      return on_grid(random);
    const Coordinates start = {0, 0, shape_ == spike ? 1.0 : 0.0};
    return {start[0] + length * x, start[1] + length * y, shape_ == flat ? 0 : start[2] + length * z};
  }
  Coordinates on_link(Random& random, double angle) const {
    const double x = number(random), y = number(random), z = number(random);
    switch (shape_) {
    case fan:
      return {std::cos(angle) + 0.01 * x, std::sin(angle) + 0.01 * y, 0.2 * std::cos(3 * angle)};
    case spike:
      return {0.05 * std::cos(angle), 0.05 * std::sin(angle), 0.01 * z};
    case flat:
      return {(1.5 + x) * std::cos(angle), (1.5 + x) * std::sin(angle), 0};
    case needle:
      return {x, 0x1p-20 * y, 0x1p-20 * z};
    case cloud:
    case shapes:
      return {x, y, z};
    default:
      return on_grid(random);
    }
  }
  Coordinates place(Coordinates p) const {
    if (is_mapped_) {
      const Coordinates q = p;
      for (int i = 0; i < 3; ++i)
        p[i] = map_[0][i] * q[0] + map_[1][i] * q[1] + map_[2][i] * q[2];
    }
    for (int i = 0; i < 3; ++i)
      p[i] = scale_ * (p[i] + offset_[i]);
    return p;
  }
};

} // namespace haptic_sculpt::test
