// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/surface/Validity_report.h>
#include <haptic_sculpt/surface/validity/Face_soup.h>

#include <algorithm>
#include <numeric>
#include <vector>

namespace haptic_sculpt::internal {

/// Disjoint sets of 0, ..., n-1, with path halving.
class Disjoint_sets {
public:
  explicit Disjoint_sets(std::size_t n) : parent_(n) { std::iota(parent_.begin(), parent_.end(), 0u); }
  std::uint32_t find(std::uint32_t i) {
    while (parent_[i] != i)
      i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  bool unite(std::uint32_t i, std::uint32_t j) {
    i = find(i);
    j = find(j);
    parent_[std::max(i, j)] = std::min(i, j);
    return i != j;
  }

private:
  std::vector<std::uint32_t> parent_;
};

/// A sorted grouping of items by a key in 0, ..., n-1, in linear time: the items of key k are `items[first[k]]` up to
/// `items[first[k + 1]]`, in the order they were given.
template <class Item>
struct Buckets {
  std::vector<std::size_t> first;
  std::vector<Item> items;

  /// \param each calls its argument with (key, item) for every item, twice with the same sequence
  template <class For_each>
  Buckets(std::size_t n, const For_each& each) : first(n + 2, 0) {
    each([this](std::uint32_t key, const Item&) { ++first[key + 2]; });
    std::partial_sum(first.begin(), first.end(), first.begin());
    items.resize(first.back());
    each([this](std::uint32_t key, const Item& item) { items[first[key + 1]++] = item; });
    first.pop_back();
  }
};

/// Finds what is wrong with the way the faces hang together: boundary, non-manifold and inconsistently oriented edges,
/// non-manifold vertices, isolated vertices, faces that are not triangles; counts components. O(n log valence).
///
/// It looks at nothing but the lists of corners, so that no half-edge structure has to be believed.
class Soup_connectivity {
  using Index = Face_soup::Index;
  using Arc = std::pair<Index, Index>;

public:
  explicit Soup_connectivity(const Face_soup& soup) : soup_(soup) {}

  /// Appends to the report; `face_name[f]` is the index under which face f is reported; `vertex_exists`
  /// tells which points are there at all, for a mesh has removed ones.
  void find_faults(const std::vector<Index>& face_name, const std::vector<bool>& vertex_exists,
                   Validity_report& report) const {
    for (std::size_t f = 0; f < soup_.number_of_faces(); ++f)
      if (soup_.number_of_corners(f) != 3)
        report.non_triangular_faces.emplace_back(face_name[f]);
    check_edges(report);
    check_vertices(vertex_exists, report);
  }

  /// Gives each point the lowest point of its component.
  Disjoint_sets components() const {
    Disjoint_sets sets(soup_.points.size());
    for (std::size_t f = 0; f < soup_.number_of_faces(); ++f)
      for (const Index* corner = soup_.begin(f); corner != soup_.end(f); ++corner)
        sets.unite(*soup_.begin(f), *corner);
    return sets;
  }

private:
  // Calls do_this(previous, corner, next) for every corner of every face.
  template <class Function>
  void for_each_corner(const Function& do_this) const {
    for (std::size_t f = 0; f < soup_.number_of_faces(); ++f) {
      const Index* corner = soup_.begin(f);
      const std::size_t n = soup_.number_of_corners(f);
      for (std::size_t i = 0; i < n; ++i)
        do_this(corner[(i + n - 1) % n], corner[i], corner[(i + 1) % n]);
    }
  }

  void check_edges(Validity_report& report) const {
    struct Use {
      Index higher;
      bool upward;
    };
    Buckets<Use> edges(soup_.points.size(), [&](const auto& put) {
      for_each_corner([&](Index, Index from, Index to) {
        if (from != to) // a repeated corner makes a degenerate face and is named as that
          put(std::min(from, to), Use{std::max(from, to), from < to});
      });
    });
    for (Index lower = 0; lower < soup_.points.size(); ++lower) {
      const auto begin = edges.items.begin() + edges.first[lower], end = edges.items.begin() + edges.first[lower + 1];
      std::sort(begin, end, [](const Use& a, const Use& b) { return a.higher < b.higher; });
      for (auto use = begin; use != end;) {
        std::size_t all = 0, upward = 0;
        const Index higher = use->higher;
        for (; use != end && use->higher == higher; ++use, ++all)
          upward += use->upward;
        const Validity_report::Vertex_pair edge{Validity_report::Vertex_index(lower),
                                                Validity_report::Vertex_index(higher)};
        if (all == 1)
          report.boundary_edges.push_back(edge);
        else if (all > 2)
          report.non_manifold_edges.push_back(edge);
        else if (upward != 1)
          report.inconsistently_oriented_edges.push_back(edge);
      }
    }
  }

  // The faces around a vertex are arcs of its link; they form one fan iff the link is connected.
  void check_vertices(const std::vector<bool>& vertex_exists, Validity_report& report) const {
    Buckets<Arc> arcs(soup_.points.size(), [&](const auto& put) {
      for_each_corner([&](Index previous, Index corner, Index next) { put(corner, Arc(next, previous)); });
    });
    Disjoint_sets components = this->components();
    std::vector<Index> link;
    for (Index v = 0; v < soup_.points.size(); ++v) {
      const auto begin = arcs.items.begin() + arcs.first[v], end = arcs.items.begin() + arcs.first[v + 1];
      if (begin == end) {
        if (vertex_exists[v])
          report.isolated_vertices.emplace_back(v);
        continue;
      }
      report.number_of_components += components.find(v) == v;
      link.clear();
      for (auto arc = begin; arc != end; ++arc)
        link.insert(link.end(), {arc->first, arc->second});
      std::sort(link.begin(), link.end());
      link.erase(std::unique(link.begin(), link.end()), link.end());
      const auto place = [&](Index neighbour) {
        return static_cast<Index>(std::lower_bound(link.begin(), link.end(), neighbour) - link.begin());
      };
      std::size_t fans = link.size();
      Disjoint_sets sets(link.size());
      for (auto arc = begin; arc != end; ++arc)
        fans -= sets.unite(place(arc->first), place(arc->second));
      if (fans > 1)
        report.non_manifold_vertices.emplace_back(v);
    }
  }

  const Face_soup& soup_;
};

} // namespace haptic_sculpt::internal
