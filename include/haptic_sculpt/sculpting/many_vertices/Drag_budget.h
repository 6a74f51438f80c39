// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/sculpting/Move_report.h>

#include <algorithm>
#include <optional>

namespace haptic_sculpt::internal {

/// How many drags may still be made, a slide counting by its work, and how many pairs decided
/// (doc/use/many_vertices.md, "Limits of time").
class Drag_budget {
public:
  /// A slide decides at most this many pairs: few need more, where parts lie close about each other, and these would
  /// take most of the time.
  static constexpr std::size_t slide_work = 10000;

  /// \param report where `counted`, `pairs` and `out_of_work` are written
  Drag_budget(const Move_parameters& parameters, Move_report& report) : parameters_(&parameters), report_(&report) {}

  /// Whether there is room for another drag; the report tells where there is none.
  bool has_room() {
    const bool has = report_->counted < parameters_->drag_limit && report_->pairs < most_pairs();
    report_->out_of_work |= !has;
    return has;
  }

  void count_drag(std::size_t work) {
    ++report_->counted;
    count_pairs(work);
  }
  void count_slide(std::size_t work) {
    report_->counted += std::max<std::size_t>(1, (work + unit - 1) / unit);
    count_pairs(work);
  }

  /// What the next drag may decide, if that is bounded. \pre has_room() \param bound of the Sculptor's own
  std::optional<std::size_t> work_of_drag(const std::optional<std::size_t>& bound) const {
    if (!parameters_->pair_limit)
      return bound;
    return std::min(most_pairs() - report_->pairs, bound.value_or(most_pairs()));
  }
  /// The same of a slide.
  std::size_t work_of_slide(const std::optional<std::size_t>& bound) const {
    const std::size_t drags = std::min(parameters_->drag_limit - report_->counted, slide_work);
    return std::min({slide_work, drags * unit, work_of_drag(bound).value_or(slide_work)});
  }

  /// Whether the progress function is to be asked now.
  bool is_call_due() {
    if (report_->counted < next_call_)
      return false;
    next_call_ = report_->counted + Move_parameters::drags_between_calls;
    return true;
  }

private:
  static constexpr std::size_t unit = Move_parameters::pairs_a_drag;

  const Move_parameters* parameters_;
  Move_report* report_;
  std::size_t next_call_ = 0; ///< of the progress function, as counted

  std::size_t most_pairs() const { return parameters_->pair_limit.value_or(std::numeric_limits<std::size_t>::max()); }
  void count_pairs(std::size_t work) {
    if (parameters_->pair_limit)
      report_->pairs += work;
  }
};

} // namespace haptic_sculpt::internal
