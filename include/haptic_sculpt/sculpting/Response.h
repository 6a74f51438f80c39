// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <initializer_list>
#include <memory>
#include <optional>
#include <string>

namespace haptic_sculpt {

namespace internal {

class Other_walk;
template <class Mesh>
class Responses;

/// What a response is called, and who makes its walk: nobody where every Sculptor has it.
struct Response_kind {
  const char* name;
  std::unique_ptr<Other_walk> (*make_walk)();
};
inline constexpr Response_kind slide_kind{"slide", nullptr}, stop_kind{"stop", nullptr};

/// Complete where the header of the walk of 1997 is included, for `void` only.
template <class>
struct Paper_1997 {
  static constexpr bool is_included = false;
};

} // namespace internal

/// What a vertex does when its way is blocked. A value, which says how its walk is made: whoever does not name the walk
/// of the 1997 paper does not compile it.
class Response {
public:
  static const Response slide; ///< it slides on, to a point nearest to its target that the contacts permit
  static const Response stop;  ///< it stays where it was stopped

  /// It walks by the rules of the 1997 paper; kept to be compared with. Needs <haptic_sculpt/sculpting/paper_1997.h>.
  template <class Included = void>
  static constexpr Response paper() {
    static_assert(internal::Paper_1997<Included>::is_included,
                  "Response::paper(): include <haptic_sculpt/sculpting/paper_1997.h>");
    return Response(internal::Paper_1997<Included>::kind);
  }

  friend constexpr bool operator==(Response a, Response b) { return a.kind_ == b.kind_; } ///< whether they are one
  friend constexpr bool operator!=(Response a, Response b) { return a.kind_ != b.kind_; } ///< the opposite
  /// The name used in scripts: "slide", "stop" or "paper".
  friend constexpr const char* name_of(Response response) { return response.kind_->name; }

private:
  template <class Mesh>
  friend class internal::Responses;

  const internal::Response_kind* kind_;

  explicit constexpr Response(const internal::Response_kind& kind) : kind_(&kind) {}
};

inline constexpr Response Response::slide(internal::slide_kind);
inline constexpr Response Response::stop(internal::stop_kind);

/// The response of that name, or nothing: slide, stop, or one of `others`, which may be `{Response::paper()}`.
inline std::optional<Response> response_named(const std::string& name, std::initializer_list<Response> others = {}) {
  for (const Response response : {Response::slide, Response::stop})
    if (name == name_of(response))
      return response;
  for (const Response response : others)
    if (name == name_of(response))
      return response;
  return std::nullopt;
}

} // namespace haptic_sculpt
