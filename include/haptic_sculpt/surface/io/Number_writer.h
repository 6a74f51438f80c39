// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/surface/Vertex_attribute.h>

#include <cstdint>
#include <cstring>
#include <limits>
#include <locale>
#include <sstream>

namespace haptic_sculpt::internal {

/// In the C locale and with 17 digits, which bring every double back. What is thrown within it, such as
/// std::bad_alloc, comes out of it.
inline std::ostringstream exact_stream() {
  std::ostringstream out;
  out.exceptions(std::ios::badbit); // else it is a stream that has failed, and nobody hears why
  out.imbue(std::locale::classic());
  out.precision(std::numeric_limits<double>::max_digits10);
  return out;
}

/// Numbers of the types that PLY has, as text or as bytes.
class Number_writer {
public:
  Number_writer(std::ostringstream& out, bool binary) : out_(out), binary_(binary) {}

  void put(Vertex_attribute::Type type, double x) {
    using Type = Vertex_attribute::Type;
    switch (type) {
    case Type::int8:
      return put_as<std::int8_t>(x);
    case Type::uint8:
      return put_as<std::uint8_t>(x);
    case Type::int16:
      return put_as<std::int16_t>(x);
    case Type::uint16:
      return put_as<std::uint16_t>(x);
    case Type::int32:
      return put_as<std::int32_t>(x);
    case Type::uint32:
      return put_as<std::uint32_t>(x);
    case Type::float32:
      return put_as<float>(x);
    case Type::float64:
      return put_as<double>(x);
    }
  }
  void end_line() {
    if (!binary_)
      out_ << '\n';
  }

private:
  std::ostringstream& out_;
  bool binary_;

  template <class Number>
  void put_as(double x) {
    const Number number = static_cast<Number>(x);
    if (!binary_) {
      out_ << +number << ' ';
      return;
    }
    char bytes[sizeof number];
    std::memcpy(bytes, &number, sizeof number);
    out_.write(bytes, sizeof number);
  }
};

} // namespace haptic_sculpt::internal
