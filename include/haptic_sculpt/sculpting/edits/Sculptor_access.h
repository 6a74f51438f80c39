// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <boost/property_map/property_map.hpp>

#include <utility>

namespace haptic_sculpt::internal {

/// The way of functions that are no members to what a Sculptor guards.
struct Sculptor_access {
  template <class Sculptor>
  static auto& guarded(Sculptor& sculptor) {
    return sculptor.guarded_;
  }
};

/// Calls a function of the caller's in the middle of a call: what it wants to change is refused (Reentrant_call).
template <class Guarded, class Function, class... Arguments>
decltype(auto) ask(Guarded& guarded, const Function& function, Arguments&&... arguments) {
  const auto asking = guarded.asking();
  return function(std::forward<Arguments>(arguments)...);
}

/// A property map of the caller's that is read and written in the middle of a call, as ask() has it.
template <class Guarded, class Map>
class Asked_map {
public:
  using key_type = typename boost::property_traits<Map>::key_type;
  using value_type = typename boost::property_traits<Map>::value_type;
  using reference = value_type;
  using category = boost::read_write_property_map_tag;

  Asked_map(Guarded& guarded, const Map& map) : guarded_(&guarded), map_(map) {}

  friend value_type get(const Asked_map& asked, const key_type& key) {
    using boost::get;
    return ask(*asked.guarded_, [&]() -> value_type { return get(asked.map_, key); });
  }
  friend void put(const Asked_map& asked, const key_type& key, const value_type& value) {
    using boost::put;
    ask(*asked.guarded_, [&] { put(asked.map_, key, value); });
  }

private:
  Guarded* guarded_;
  Map map_;
};

/// Shifts, or moves, made while one lives are noted at its end; those taken back by then are not.
template <class Guarded>
class [[nodiscard]] Edit_trial {
public:
  explicit Edit_trial(Guarded& guarded) : guarded_(guarded) { guarded_.begin_trial(); }
  ~Edit_trial() { guarded_.end_trial(); }
  Edit_trial(const Edit_trial&) = delete;
  Edit_trial& operator=(const Edit_trial&) = delete;

private:
  Guarded& guarded_;
};

} // namespace haptic_sculpt::internal
