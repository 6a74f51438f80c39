// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/Error.h>
#include <haptic_sculpt/Rounding_to_nearest.h>

#include <Eigen/Core>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <string>
#include <string_view>
#include <vector>

namespace haptic_sculpt {

/// A path without rows, or one that cannot be read: then it says line and column, both from 1.
class Hand_path_error : public Error {
public:
  /// Takes the whole message.
  using Error::Error;
};

/// Where a hand wants to be, and what it does with the button. SI units, axes of the device; linear between rows. What
/// was moved from is only to be assigned to, or destroyed.
class Hand_path {
public:
  /// m and s: whoever writes more means another unit.
  static constexpr double largest_number = 1e9;
  /// s, between two rows, of which rounding may take half: velocities stay finite.
  static constexpr double least_time = 1e-9;

  /// A place, and when.
  struct Row {
    double time;              ///< s
    Eigen::Vector3d position; ///< m
    int button;               ///< 0 none, 1 grab or create, 2 remove; from this row on
  };
  /// What the hand wants at one moment.
  struct Wish {
    Eigen::Vector3d position, ///< m
        velocity;             ///< m/s; 0 before the first row and after the last
    int button;               ///< of the row before, or the first
  };

  /// \pre the times grow by least_time, no number is beyond largest_number \throw Hand_path_error without rows
  explicit Hand_path(std::vector<Row> rows) : rows_(std::move(rows)) {
    if (rows_.empty())
      throw Hand_path_error("a path needs at least one row");
  }

  /// Reads `t,x,y,z,button` and rows of numbers. \param name how messages call it \throw Hand_path_error
  static Hand_path parse(std::string_view text, const std::string& name);

  const std::vector<Row>& rows() const { return rows_; } ///< at least one; the times grow
  double end() const { return rows_.back().time; }       ///< time of the last row, s

  /// Before the first row and after the last the hand rests there. Cost: log n.
  Wish at(double time) const {
    const auto after =
        std::upper_bound(rows_.begin(), rows_.end(), time, [](double t, const Row& row) { return t < row.time; });
    if (after == rows_.begin())
      return {rows_.front().position, Eigen::Vector3d::Zero(), rows_.front().button};
    const Row& a = *(after - 1);
    if (after == rows_.end())
      return {a.position, Eigen::Vector3d::Zero(), a.button};
    const double length = after->time - a.time, share = (time - a.time) / length;
    const Eigen::Vector3d way = after->position - a.position;
    return {a.position + share * way, way / length, a.button};
  }

private:
  std::vector<Row> rows_;
};

inline Hand_path Hand_path::parse(std::string_view text, const std::string& name) {
  const auto fail = [&](std::size_t line, std::size_t column, const std::string& what) {
    throw Hand_path_error(name + ": line " + std::to_string(line) + ", column " + std::to_string(column) + ": " + what);
  };
  const internal::Rounding_to_nearest rounding; // decimals are read by it
  std::vector<Row> rows;
  std::size_t number = 0;
  while (!text.empty()) {
    ++number;
    const std::size_t end = text.find('\n');
    std::string_view line = text.substr(0, end);
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
    if (!line.empty() && line.back() == '\r')
      line.remove_suffix(1);
    if (number == 1) {
      if (line != "t,x,y,z,button")
        fail(1, 1, "the first line must be `t,x,y,z,button`");
      continue;
    }
    if (line.empty())
      continue;
    double values[5];
    const char* at = line.data();
    for (int k = 0; k < 5; ++k) {
      const char* const stop = line.data() + line.size();
      const auto column = [&] { return static_cast<std::size_t>(at - line.data()) + 1; };
      const auto [next, error] = std::from_chars(at, stop, values[k]);
      if (error != std::errc() || !(std::abs(values[k]) <= largest_number))
        fail(number, column(), "a number is expected, from -1e9 to 1e9");
      at = next;
      if (k < 4 ? (at == stop || *at != ',') : at != stop)
        fail(number, column(),
             k < 4 ? "a comma is expected; a row is `t,x,y,z,button`" : "there is more than a row has");
      at += k < 4 ? 1 : 0;
    }
    if (values[4] != 0 && values[4] != 1 && values[4] != 2)
      fail(number, line.rfind(',') + 2, "the button must be 0, 1 or 2");
    if (!rows.empty() && !(values[0] - rows.back().time > 0.5 * least_time)) // rounded
      fail(number, 1, "the times must grow from row to row, by a nanosecond at least");
    rows.push_back({values[0], {values[1], values[2], values[3]}, static_cast<int>(values[4])});
  }
  if (rows.empty())
    fail(number + 1, 1, "a path needs at least one row");
  return Hand_path(std::move(rows));
}

} // namespace haptic_sculpt
