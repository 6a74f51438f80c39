// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <type_traits>

namespace haptic_sculpt {

/// What the property of a new element can be made of: the values of those that it comes from (doc/use/properties.md).
template <class Value>
struct Property_origin {
  std::size_t size = 0;                 ///< how many values there are, 1 to 3
  std::array<const Value*, 3> values{}; ///< the first `size` are not null
  std::array<double, 3> weights{};      ///< >= 0; those of the first `size` add up to 1, but for rounding

  /// Adds one. \pre size < 3
  void add(const Value& value, double weight) {
    values[size] = &value;
    weights[size++] = weight;
  }
};

/// Gives a new element the value that has the largest weight, the first of equal ones.
struct Copy_property {
  /// \pre origin.size > 0
  template <class Value>
  Value operator()(const Property_origin<Value>& origin) const {
    std::size_t best = 0;
    for (std::size_t k = 1; k < origin.size; ++k)
      if (origin.weights[k] > origin.weights[best])
        best = k;
    return *origin.values[best];
  }
};

/// Gives a new element the weighted sum of the values: for numbers and vectors, of which integers are none.
struct Interpolate_property {
  /// \pre origin.size > 0
  template <class Value>
  Value operator()(const Property_origin<Value>& origin) const {
    static_assert(!std::is_integral<Value>::value, "Interpolate_property: a weighted sum of integers would be cut off");
    Value sum = *origin.values[0] * origin.weights[0];
    for (std::size_t k = 1; k < origin.size; ++k)
      sum = sum + *origin.values[k] * origin.weights[k];
    return sum;
  }
};

} // namespace haptic_sculpt
