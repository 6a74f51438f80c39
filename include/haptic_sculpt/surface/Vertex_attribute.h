// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/Rounding_to_nearest.h>
#include <haptic_sculpt/to_float.h>

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

namespace haptic_sculpt {

/// A number for each vertex that a file has beside its place: a part of a colour, a texture coordinate, a quality.
struct Vertex_attribute {
  /// Of the number in a file, as PLY names them.
  enum class Type : std::uint8_t { int8, uint8, int16, uint16, int32, uint32, float32, float64 };
  static constexpr int number_of_types = 8; ///< of Type
  std::string name;           ///< as in the file, e.g. "red"
  Type type = Type::float64;  ///< values are doubles, which hold all of them exactly
  std::vector<double> values; ///< by index of the point
};

/// "char", "uchar", "short", "ushort", "int", "uint", "float" or "double"
inline const char* name_of(Vertex_attribute::Type type) {
  constexpr const char* names[] = {"char", "uchar", "short", "ushort", "int", "uint", "float", "double"};
  return names[static_cast<int>(type)];
}

/// The number of the type that is nearest to x: what a file of that type can hold of it.
inline double rounded_to(Vertex_attribute::Type type, double x) {
  using Type = Vertex_attribute::Type;
  constexpr double low[] = {-128, 0, -32768, 0, -2147483648.0, 0},
                   high[] = {127, 255, 32767, 65535, 2147483647, 4294967295.0};
  if (type == Type::float64)
    return x;
  const internal::Rounding_to_nearest rounding;
  if (type == Type::float32)
    return internal::kept(internal::to_float(x));
  const double nearest = std::nearbyint(x);
  const int i = static_cast<int>(type);
  return internal::kept((nearest > low[i] ? std::fmin(nearest, high[i]) : low[i]) + 0.0); // NaN: the least; -0: +0
}

} // namespace haptic_sculpt
