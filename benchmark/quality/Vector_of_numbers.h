// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace haptic_sculpt::benchmark {

/// Three coordinates of any number type, and what the determinants need.
template <class Number> struct Vector_of_numbers {
  Number x, y, z;

  friend Vector_of_numbers operator-(const Vector_of_numbers& a, const Vector_of_numbers& b) {
    return {Number(a.x - b.x), Number(a.y - b.y), Number(a.z - b.z)};
  }
  friend Vector_of_numbers operator+(const Vector_of_numbers& a, const Vector_of_numbers& b) {
    return {Number(a.x + b.x), Number(a.y + b.y), Number(a.z + b.z)};
  }
  friend Vector_of_numbers operator*(const Number& s, const Vector_of_numbers& a) {
    return {Number(s * a.x), Number(s * a.y), Number(s * a.z)};
  }
};

template <class Number> Number dot(const Vector_of_numbers<Number>& a, const Vector_of_numbers<Number>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

template <class Number>
Vector_of_numbers<Number> cross(const Vector_of_numbers<Number>& a, const Vector_of_numbers<Number>& b) {
  return {Number(a.y * b.z - a.z * b.y), Number(a.z * b.x - a.x * b.z), Number(a.x * b.y - a.y * b.x)};
}

/// Six times the signed volume of the tetrahedron.
template <class Number>
Number orientation(const Vector_of_numbers<Number>& a, const Vector_of_numbers<Number>& b,
                   const Vector_of_numbers<Number>& c, const Vector_of_numbers<Number>& d) {
  return dot(cross(b - a, c - a), d - a);
}

} // namespace haptic_sculpt::benchmark
