// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

/// \file
/// Lower bounds by which a tree of boxes is searched, nearest first. In doubles, safe whatever rounding does
/// (doc/proofs/finding.md, "What is left out").

#include <haptic_sculpt/surface/broad_phase/Box_node.h>
#include <haptic_sculpt/surface/broad_phase/Box_scale.h>

#include <cmath>

namespace haptic_sculpt::internal {

/// The boxes that hold anything.
inline unsigned nonempty_boxes(const Box_node& node) {
  unsigned mask = 0;
  for (unsigned j = 0; j < Box_node::width; ++j)
    mask |= static_cast<unsigned>(node.bounds[0][j] <= node.bounds[3][j]) << j; // by ?: g++ 12 with UBSan errs
  return mask;
}

/// Of the squares of the distances from a point, in the unit of the boxes.
class Distance_bound {
public:
  /// \param scale of the boxes
  Distance_bound(const std::array<double, 3>& point, const Box_scale& scale) : point_(scale(point)) {}

  /// What a square may be short of the true one by rounding, or more than it.
  static constexpr double rounding = 0x1p-48;

  unsigned operator()(const Box_node& node, double* lowest) const {
    for (unsigned j = 0; j < Box_node::width; ++j)
      lowest[j] = 0;
    for (int i = 0; i < 3; ++i)
      for (unsigned j = 0; j < Box_node::width; ++j) {
        const double before = static_cast<double>(node.bounds[i][j]) - point_[i],
                     after = point_[i] - static_cast<double>(node.bounds[i + 3][j]);
        const double outside = before > after ? before : after, gap = outside > 0 ? outside : 0;
        lowest[j] += gap * gap;
      }
    for (unsigned j = 0; j < Box_node::width; ++j)
      lowest[j] *= 1 - rounding;
    return nonempty_boxes(node);
  }

private:
  std::array<double, 3> point_;
};

/// Of the times at which a point comes into boxes on its straight way from source to target, at the times 0 and 1.
class Entry_bound {
public:
  /// \param scale of the boxes
  Entry_bound(const std::array<double, 3>& source, const std::array<double, 3>& target, const Box_scale& scale)
      : source_(scale(source)), around_(scale.query(Box_3(source).include(target))) {
    for (int i = 0; i < 3; ++i) {
      const double way = (target[i] - source[i]) * scale.factor();
      // Along an axis on which there is next to no way the box around it tells as much; of one that overflows no time
      // is known.
      is_used_[i] = std::abs(way) > least_way && std::abs(way) < 1 / least_way;
      inverse_[i] = is_used_[i] ? 1 / way : 0;
    }
  }

  /// What a time in [0, 1] may be off by rounding.
  static constexpr double rounding = 0x1p-48;

  unsigned operator()(const Box_node& node, double* lowest) const {
    double last[Box_node::width];
    for (unsigned j = 0; j < Box_node::width; ++j)
      lowest[j] = 0, last[j] = 1;
    for (int i = 0; i < 3; ++i)
      if (is_used_[i]) {
        const int near = inverse_[i] > 0 ? i : i + 3, far = inverse_[i] > 0 ? i + 3 : i;
        for (unsigned j = 0; j < Box_node::width; ++j) {
          const double in = (static_cast<double>(node.bounds[near][j]) - source_[i]) * inverse_[i],
                       out = (static_cast<double>(node.bounds[far][j]) - source_[i]) * inverse_[i];
          lowest[j] = in > lowest[j] ? in : lowest[j];
          last[j] = out < last[j] ? out : last[j];
        }
      }
    unsigned mask = node.meeting(around_);
    for (unsigned j = 0; j < Box_node::width; ++j) {
      lowest[j] -= rounding;
      mask &= ~(static_cast<unsigned>(lowest[j] > last[j] + rounding) << j);
    }
    return mask;
  }

private:
  static constexpr double least_way = 0x1p-1000; ///< from here to its inverse no inverse overflows, or loses digits

  std::array<double, 3> source_;
  Float_box around_;
  std::array<double, 3> inverse_{};
  std::array<bool, 3> is_used_{};
};

} // namespace haptic_sculpt::internal
