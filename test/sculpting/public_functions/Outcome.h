// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "sculpting/Random_scene.h"

#include <cmath>
#include <cstring>
#include <functional>
#include <optional>
#include <vector>

namespace haptic_sculpt::test {

/// All that a call came to, number by number, each with the power of a length that it is: so what was done in a scene
/// that is 2^k times as large can be compared with it, bit for bit.
class Outcome {
public:
  void length(double x) { add(x, 1); }
  void number(double x) { add(x, 0); }
  void point(const Point_3& p) { length(p.x()), length(p.y()), length(p.z()); }

  template <class Vector>
  void direction(const Vector& v) {
    number(v.x()), number(v.y()), number(v.z());
  }
  template <class Index>
  void index(Index i) {
    number(i.is_valid() ? static_cast<double>(static_cast<std::size_t>(i)) : -1);
  }
  void mesh(const Mesh& mesh) {
    for (const auto v : mesh.vertices())
      index(v), point(mesh.point(v));
    for (const auto h : mesh.halfedges())
      index(mesh.target(h)), index(mesh.next(h));
  }
  void contact(const Contact_3<Mesh>& contact) {
    number(static_cast<int>(contact.kind)), number(contact.side), number(contact.is_flat);
    number(static_cast<int>(contact.location));
    direction(contact.normal);
    for (int i = 0; i < 3; ++i)
      index(contact.vertices[i]), point(contact.plane[i]);
  }
  void drag(const Drag_result<Mesh>& result) {
    point(result.position);
    number(result.reached), number(static_cast<int>(result.end)), number(result.legs);
    number(static_cast<double>(result.work));
    length(result.stop_error), length(result.stop_error_along_path), number(result.kkt_residual);
    for (const auto& c : result.contacts)
      contact(c);
  }
  void edit(const Edit_result<Mesh>& result) {
    if (result.vertex)
      index(*result.vertex);
    if (result.refusal) {
      number(static_cast<int>(result.refusal->reason));
      for (const auto v : result.refusal->elements)
        index(v);
    }
  }
  template <class Impact>
  void impact(const Impact& impact) {
    number(static_cast<int>(impact.feature())), number(impact.is_flat()), number(impact.is_at_start());
    number(impact.time().first), number(impact.time().second);
    number(impact.tight_time().first), number(impact.tight_time().second);
    number(impact.exact_time().get_d());
    point(impact.source()), point(impact.target());
    for (int i = 0; i < 3; ++i)
      point(impact.static_point(i));
  }

  std::size_t size() const { return values_.size(); }
  bool is_finite() const {
    for (const Value& value : values_)
      if (!std::isfinite(value.number))
        return false;
    return true;
  }

  /// The place of the first number that is not, bit for bit, what it is at scale 1, multiplied by 2^k as often as it is
  /// a length; where one of them has more numbers, of the first of these. None where all are the same.
  std::optional<std::size_t> first_difference(const Outcome& at_scale_1, int k) const {
    if (size() != at_scale_1.size())
      return std::min(size(), at_scale_1.size());
    for (std::size_t i = 0; i < size(); ++i)
      if (!is_same(values_[i].number, std::ldexp(at_scale_1.values_[i].number, k * values_[i].power)))
        return i;
    return std::nullopt;
  }
  double value(std::size_t i) const {
    return i < size() ? values_[i].number : std::numeric_limits<double>::quiet_NaN();
  }

private:
  struct Value {
    double number;
    int power;
  };
  std::vector<Value> values_;

  void add(double x, int power) { values_.push_back({x, power}); }
  static bool is_same(double a, double b) { return std::memcmp(&a, &b, sizeof a) == 0 || (a == 0 && b == 0); }
};

/// A public function, or several that belong together, called in a scene of its own.
struct Public_function {
  std::string names; ///< as check_public_functions.py finds them in the headers, separated by spaces
  /// \param unit a power of two, by which all coordinates and lengths are multiplied
  std::function<void(double unit, Outcome& outcome)> call;
};

} // namespace haptic_sculpt::test
