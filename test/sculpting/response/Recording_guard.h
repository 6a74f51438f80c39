// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/sculpting.h>

#include <deque>
#include <map>
#include <set>
#include <utility>
#include <vector>

namespace haptic_sculpt::test {

/// A guard that notes which motions it has found free: the legs of a walk are among them.
template <class Mesh>
class Recording_guard : public internal::Guarded_star<Mesh, Box_tree_broad_phase<Mesh>> {
public:
  using Base = internal::Guarded_star<Mesh, Box_tree_broad_phase<Mesh>>;
  using Coordinates = typename Base::Coordinates;
  using Base::Base;

  auto decide(const Coordinates& source, const Coordinates& target, double delta) {
    const auto decision = Base::decide(source, target, delta);
    if (decision.is_free())
      free_.emplace(source, target);
    return decision;
  }
  bool is_free(const Coordinates& source, const Coordinates& target, double delta) {
    const bool free = Base::is_free(source, target, delta);
    if (free)
      free_.emplace(source, target);
    return free;
  }

  /// The legs of a way from source to target through free motions only, as few as can be, or none: then the vertex has
  /// gone where nothing was proven.
  std::vector<std::pair<Coordinates, Coordinates>> way(const Coordinates& source, const Coordinates& target) const {
    std::map<Coordinates, Coordinates> came_from;
    std::deque<Coordinates> open = {source}; // those of fewest legs first
    while (!open.empty() && came_from.count(target) == 0) {
      const Coordinates x = open.front();
      open.pop_front();
      for (auto i = free_.lower_bound({x, {-HUGE_VAL, -HUGE_VAL, -HUGE_VAL}}); i != free_.end() && i->first == x; ++i)
        if (i->second != source && came_from.emplace(i->second, x).second)
          open.push_back(i->second);
    }
    std::vector<std::pair<Coordinates, Coordinates>> legs;
    if (came_from.count(target) != 0)
      for (Coordinates x = target; x != source; x = came_from.at(x))
        legs.emplace_back(came_from.at(x), x);
    return legs;
  }
  void clear() { free_.clear(); }

private:
  std::set<std::pair<Coordinates, Coordinates>> free_;
};

} // namespace haptic_sculpt::test
