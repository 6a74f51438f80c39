// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/Part_runner.h>
#include <haptic_sculpt/surface/Box_3.h>
#include <haptic_sculpt/surface/validity/Face_soup.h>

#include <CGAL/Bbox_3.h>
#include <CGAL/Box_intersection_d/Box_with_info_d.h>
#include <CGAL/box_intersection_d.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <tuple>
#include <vector>

namespace haptic_sculpt::internal {

/// Finds the pairs of triangles that may meet improperly, by CGAL's box intersection, always in the same order.
///
/// At a vertex of valence n the boxes of all its faces meet: n^2 / 2 pairs. Two of them meet elsewhere than there only
/// if the edge of one that is opposite to the vertex meets the other, so at a *hub*, a vertex of high valence, it is
/// the boxes of these edges that are intersected with those of the faces. Faces at hubs are long, and their boxes much
/// larger than they are: each has several, one behind the other from the hub outwards.
class Near_faces {
  using Index = Face_soup::Index;
  using Box =
      CGAL::Box_intersection_d::Box_with_info_d<double, 3, Index, CGAL::Box_intersection_d::ID_FROM_BOX_ADDRESS>;
  using Boxes = std::vector<Box>;
  static constexpr Index none = static_cast<Index>(-1);
  /// A hub has a valence above this and above 4 sqrt(number of faces): each costs a run through the faces at hubs.
  static constexpr std::size_t least_valence = 256;
  /// Below this number of boxes all pairs are tried; the figure PMP uses.
  static constexpr std::ptrdiff_t cutoff = 2000;
  static constexpr std::size_t boxes_a_slab = 32768;
  static constexpr std::size_t most_slices = 16; ///< of a face at a hub, a box each
  /// Boxes of faces at hubs, 64 bytes each, unless there are more of these faces.
  static constexpr std::size_t most_sliced = 1 << 21;
  /// Larger than what rounding changes, as a share of a coordinate: two products and a sum, 2^-53 each.
  static constexpr double slice_error = 0x1p-50;

public:
  /// \param faces triangles of the soup with finite corners
  Near_faces(const Face_soup& soup, const std::vector<Index>& faces) : soup_(soup), faces_(faces) {}

  /// Calls do_this(f, g) with f < g: at least once for each pair that meets improperly, mostly not more than a few
  /// times; where threads share the work, in no order, and several at a time. O(n log^3 n + pairs of meeting boxes).
  template <class Function>
  void for_each_pair(const Function& do_this, const Part_runner& run = Part_runner()) const {
    const std::vector<bool> is_hub = find_hubs();
    Boxes plain;
    std::vector<Face_at_hub> at_hubs;
    for (const Index f : faces_) {
      bool has_hub = false;
      for (const Index* v = soup_.begin(f); v != soup_.end(f); ++v)
        if (is_hub[*v]) {
          at_hubs.push_back({*v, f, !has_hub});
          has_hub = true;
        }
      if (!has_hub)
        plain.push_back(box(f, none));
    }
    const auto share_a_hub = [&](Index f, Index g) {
      return std::any_of(soup_.begin(f), soup_.end(f), [&](Index v) {
        return is_hub[v] && std::find(soup_.begin(g), soup_.end(g), v) != soup_.end(g);
      });
    };
    bool are_at_hubs = false; // those that share one are found there
    const auto call = [&](const Box* a, const Box* b) { // of one type: CGAL's search is compiled once
      const Index f = std::min(a->info(), b->info()), g = std::max(a->info(), b->info());
      if (f != g && !(are_at_hubs && share_a_hub(f, g)))
        do_this(f, g);
    };
    const auto pairs_between = [&](const Boxes& a, const Boxes& b) {
      Boxes both = a; // CGAL parts boxes that begin alike by their addresses: in one list that is their order
      both.insert(both.end(), b.begin(), b.end());
      auto pointers = pointers_to(both);
      const auto middle = pointers.begin() + static_cast<std::ptrdiff_t>(a.size());
      CGAL::box_intersection_d(pointers.begin(), middle, middle, pointers.end(), call, cutoff);
    };
    pairs_within(plain, call, run);
    if (at_hubs.empty())
      return;
    std::sort(at_hubs.begin(), at_hubs.end(),
              [](const auto& a, const auto& b) { return std::tie(a.hub, a.face) < std::tie(b.hub, b.face); });
    const std::size_t slices = std::clamp<std::size_t>(most_sliced / at_hubs.size(), 1, most_slices);
    Boxes rest; // each face at a hub once: at the hub that is its first
    for (const Face_at_hub& a : at_hubs)
      if (a.is_first)
        add_slices(a, slices, rest);
    pairs_between(plain, rest);
    for (auto begin = at_hubs.begin(); begin != at_hubs.end();) {
      const auto end = std::find_if(begin, at_hubs.end(), [&](const auto& a) { return a.hub != begin->hub; });
      Boxes edges, fan, first, later;
      for (auto a = begin; a != end; ++a) {
        edges.push_back(box(a->face, a->hub));
        add_slices(*a, slices, fan);
        if (a->is_first)
          add_slices(*a, slices, first);
      }
      CGAL::Bbox_3 around;
      for (const Box& slice : first)
        around += slice.bbox();
      for (auto a = end; a != at_hubs.end(); ++a) // not what is far off, or all faces at hubs were sliced for each hub
        if (a->is_first && CGAL::do_overlap(around, box(a->face, none).bbox()))
          add_slices(*a, slices, later);
      are_at_hubs = false;
      pairs_between(edges, fan);
      are_at_hubs = true;
      pairs_between(first, later);
      begin = end;
    }
  }

private:
  struct Face_at_hub {
    Index hub, face;
    bool is_first; // whether no corner before this one is a hub
  };

  // In slabs that the boxes begin in, across the axis along which they begin in the widest range: a box meets some of
  // its slab, and some that begin before it and reach into it. Sorting within slabs asks memory for less, too.
  template <class Function>
  static void pairs_within(const Boxes& boxes, const Function& call, const Part_runner& run) {
    auto sorted = pointers_to(boxes);
    const int axis = widest_axis(boxes);
    std::sort(sorted.begin(), sorted.end(), [axis](const Box* a, const Box* b) {
      return a->min_coord(axis) < b->min_coord(axis) || (a->min_coord(axis) == b->min_coord(axis) && a < b);
    });
    const std::size_t slabs = 1 + sorted.size() / boxes_a_slab;
    const auto begin = [&](std::size_t slab) { return sorted.begin() + slab * sorted.size() / slabs; };
    std::vector<std::vector<const Box*>> reaching(slabs);
    std::size_t number_reaching = 0;
    for (std::size_t s = 0; s < slabs; ++s)
      for (auto box = begin(s); box != begin(s + 1); ++box)
        for (std::size_t t = s + 1; t < slabs && (*begin(t))->min_coord(axis) <= (*box)->max_coord(axis); ++t)
          if (++number_reaching <= sorted.size())
            reaching[t].push_back(*box);
    if (number_reaching > sorted.size()) // most are long
      return CGAL::box_self_intersection_d(sorted.begin(), sorted.end(), call, cutoff);
    const auto work_on = [&](std::size_t s) {
      std::vector<const Box*> own(begin(s), begin(s + 1));
      CGAL::box_self_intersection_d(own.begin(), own.end(), call, cutoff);
      CGAL::box_intersection_d(reaching[s].begin(), reaching[s].end(), own.begin(), own.end(), call, cutoff);
    };
    run(slabs, work_on);
  }

  static int widest_axis(const Boxes& boxes) {
    Box_3 ends; // of their lower corners
    for (const Box& box : boxes)
      ends.include(Box_3::Coordinates{box.min_coord(0), box.min_coord(1), box.min_coord(2)});
    const auto width = [&ends](int k) { return ends.upper[k] / 2 - ends.lower[k] / 2; }; // halved: none overflows
    int widest = 0;
    for (int k = 1; k < 3; ++k)
      if (width(k) > width(widest))
        widest = k;
    return widest;
  }

  // The box intersection orders these, so that boxes keep their addresses, by which it knows them.
  static std::vector<const Box*> pointers_to(const Boxes& boxes) {
    std::vector<const Box*> pointers;
    pointers.reserve(boxes.size());
    for (const Box& box : boxes)
      pointers.push_back(&box);
    return pointers;
  }

  std::vector<bool> find_hubs() const {
    std::vector<std::size_t> valence(soup_.points.size(), 0);
    for (const Index f : faces_)
      for (const Index* v = soup_.begin(f); v != soup_.end(f); ++v)
        ++valence[*v];
    const auto at_least = static_cast<std::size_t>(4 * std::sqrt(static_cast<double>(faces_.size())));
    const auto least = std::max(least_valence, at_least);
    std::vector<bool> is_hub(valence.size());
    std::transform(valence.begin(), valence.end(), is_hub.begin(), [&](std::size_t n) { return n > least; });
    return is_hub;
  }

  // Boxes that cover the face together: of what lies from the share i to i + 1 of the way from the hub to the other
  // corners.
  void add_slices(const Face_at_hub& at, std::size_t slices, Boxes& boxes) const {
    const auto& hub = soup_.points[at.hub];
    for (std::size_t i = 0; i < slices; ++i) {
      std::array<double, 3> low, high;
      for (int k = 0; k < 3; ++k) {
        low[k] = std::numeric_limits<double>::infinity(), high[k] = -low[k];
        // Below the least normal number products lose digits.
        double size = std::fmax(std::fabs(hub[k]), std::numeric_limits<double>::min());
        for (const Index* v = soup_.begin(at.face); v != soup_.end(at.face); ++v)
          for (const std::size_t end : {i, i + 1}) {
            if (*v == at.hub)
              continue;
            const double t = static_cast<double>(end) / static_cast<double>(slices);
            const double x = (1 - t) * hub[k] + t * soup_.points[*v][k];
            low[k] = std::fmin(low[k], x), high[k] = std::fmax(high[k], x);
            size = std::fmax(size, std::fabs(soup_.points[*v][k]));
          }
        low[k] -= slice_error * size, high[k] += slice_error * size;
      }
      boxes.emplace_back(CGAL::Bbox_3(low[0], low[1], low[2], high[0], high[1], high[2]), at.face);
    }
  }

  // Of the corners of f but `left_out`.
  Box box(Index f, Index left_out) const {
    CGAL::Bbox_3 bounds;
    for (const Index* v = soup_.begin(f); v != soup_.end(f); ++v)
      if (*v != left_out)
        bounds += soup_.points[*v].bbox();
    return Box(bounds, f);
  }

  const Face_soup& soup_;
  const std::vector<Index>& faces_;
};

} // namespace haptic_sculpt::internal
