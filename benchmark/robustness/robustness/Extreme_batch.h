// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Extreme_tally.h"
#include "robustness_meshes.h"
#include "sculpting/result_contradiction.h"

#include <haptic_sculpt/sculpting.h>

#include <CGAL/Gmpq.h>

#include <cstring>
#include <optional>

namespace haptic_sculpt::robustness {

/// Drags with targets anywhere among the doubles, and lengths of any size: whatever is asked, the mesh stays embedded
/// and finite and no vertex goes away from its target, or an error is thrown and nothing has moved.
class Extreme_batch {
public:
  Extreme_batch(const Mesh& mesh, Response response, std::uint64_t seed)
      : input_(mesh), mesh_(mesh), response_(response), random_(seed) {}

  /// \param per_mesh drags, then the mesh is a copy of the input again and the lengths are drawn anew
  Extreme_tally run(std::size_t drags, std::size_t per_mesh = 10) {
    const auto drawn = [this] { return tally_.drags + tally_.refused + tally_.not_begun; };
    while (drawn() < drags)
      one_mesh(std::min(per_mesh, drags - drawn()));
    return tally_;
  }

private:
  Mesh input_, mesh_;
  Response response_;
  std::mt19937_64 random_;
  Extreme_tally tally_;

  /// Any finite double: sign, exponent and digits drawn, so about log-uniform, subnormals included.
  double any_double() {
    for (;;) {
      const std::uint64_t bits = random_();
      double x;
      std::memcpy(&x, &bits, sizeof x);
      if (std::isfinite(x))
        return random_() % 16 == 0 ? std::copysign(random_() % 2 == 0 ? std::numeric_limits<double>::max()
                                                                      : std::numeric_limits<double>::denorm_min(),
                                                   x)
                                   : x;
    }
  }

  /// A length, or unset: that of the size of the mesh now and then.
  double any_length() {
    return random_() % 4 == 0 ? std::ldexp(1.0, -static_cast<int>(random_() % 60)) : std::abs(any_double());
  }

  /// All coordinates extreme, or one, or one of the mesh's own points changed in one.
  Point_3 target(const Point_3& p) {
    std::array<double, 3> t = {p.x(), p.y(), p.z()};
    switch (random_() % 3) {
    case 0:
      return Point_3(any_double(), any_double(), any_double());
    case 1:
      t[random_() % 3] = any_double();
      break;
    default: {
      const double size = any_double();
      for (double& x : t)
        x = size * (static_cast<double>(random_() >> 11) * 0x1p-53);
    }
    }
    return Point_3(t[0], t[1], t[2]);
  }

  std::vector<std::array<double, 3>> points() const {
    std::vector<std::array<double, 3>> all;
    for (const Vertex_index v : mesh_.vertices())
      all.push_back(vertex_coordinates(mesh_, v));
    return all;
  }

  void one_mesh(std::size_t drags) {
    mesh_ = input_;
    const int exponent = random_() % 2 == 0 ? 0 : static_cast<int>(random_() % 1200) - 600;
    for (const Vertex_index v : mesh_.vertices()) {
      const Point_3 p = mesh_.point(v);
      mesh_.point(v) = Point_3(std::ldexp(p.x(), exponent), std::ldexp(p.y(), exponent), std::ldexp(p.z(), exponent));
    }
    std::optional<Sculptor<Mesh>> sculptor;
    Sculptor_parameters options = parameters::response(response_);
    if (random_() % 2 == 0)
      options.clearance(any_length());
    if (random_() % 4 == 0)
      options.delta(any_length());
    // Lengths may be out of range or break the delta rule, and the mesh may be out of range, too.
    for (const Sculptor_parameters& tried : {options, parameters::response(response_)})
      try {
        sculptor.emplace(mesh_, tried);
        break;
      } catch (const Error&) {
        ++tally_.settings_refused;
      }
    if (!sculptor) {
      tally_.not_begun += drags;
      return;
    }
    for (; drags > 0; --drags) {
      const Vertex_index v(static_cast<Mesh::size_type>(random_() % mesh_.number_of_vertices()));
      if (!drag(*sculptor, v, target(mesh_.point(v))))
        return;
    }
  }

  /// Whether the mesh can be used on.
  bool drag(Sculptor<Mesh>& sculptor, Vertex_index v, const Point_3& target) {
    const auto before = points();
    const Point_3 start = mesh_.point(v);
    try {
      const auto result = sculptor.grab(v).drag_to(target);
      ++tally_.drags;
      tally_.reached += result.reached;
      tally_.contradictions +=
          result.position != mesh_.point(v) || test::contradiction(result, start, target) != nullptr;
    } catch (const Error&) {
      ++tally_.refused;
      tally_.moved_though_refused += points() != before;
      return true;
    }
    const auto after = points();
    for (const auto& p : after)
      for (const double x : p)
        if (!std::isfinite(x)) {
          ++tally_.not_finite;
          return false;
        }
    const std::array<double, 3> t = {target.x(), target.y(), target.z()};
    tally_.farther += squared_distance(after[v], t) > squared_distance(before[v], t);
    const bool is_valid = validate(mesh_).is_valid();
    tally_.invalid += !is_valid;
    return is_valid;
  }

  static CGAL::Gmpq squared_distance(const std::array<double, 3>& a, const std::array<double, 3>& b) {
    CGAL::Gmpq sum = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const CGAL::Gmpq d = CGAL::Gmpq(a[i]) - CGAL::Gmpq(b[i]);
      sum += d * d;
    }
    return sum;
  }
};

} // namespace haptic_sculpt::robustness
