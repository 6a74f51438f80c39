// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef HAPTIC_SCULPT_SCULPTING_RESPONSE_SCOPE_H
#define HAPTIC_SCULPT_SCULPTING_RESPONSE_SCOPE_H

#include <haptic_sculpt/sculpting/Response.h>

#include <cstddef>
#include <optional>

namespace haptic_sculpt {
namespace internal {

/// Sets the response of a Sculptor and whether it expects single drags; at its end, an exception included, these and
/// the bound on the work of a drag, which may be set meanwhile, are as they were before. Lets go of the vertex in hand.
template <class Sculptor>
class Response_scope {
public:
  Response_scope(Sculptor& sculptor, Response rule, bool expects_single_drags)
      : sculptor_(sculptor)
      , before_(sculptor.options().response_rule)
      , expected_before_(sculptor.expects_single_drags())
      , work_before_(sculptor.options().work_bound) {
    set(rule, expects_single_drags);
  }
  ~Response_scope() {
    set(before_, expected_before_);
    sculptor_.set_work_limit(work_before_);
  }

  Response_scope(const Response_scope&) = delete;
  Response_scope& operator=(const Response_scope&) = delete;

private:
  Sculptor& sculptor_;
  Response before_;
  bool expected_before_;
  std::optional<std::size_t> work_before_;

  void set(Response rule, bool expects_single_drags) {
    sculptor_.set_response(rule);
    sculptor_.expect_single_drags(expects_single_drags);
  }
};

} // namespace internal
} // namespace haptic_sculpt

#endif
