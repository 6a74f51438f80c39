// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/surface/broad_phase/Broad_phase_base.h>
#include <haptic_sculpt/surface/containers/make_room.h>

#include <algorithm>
#include <cstdint>

namespace haptic_sculpt {

/// The broad phase of 1997 (paper 4.0): six lists of all faces, sorted by the lower and upper bounds of their boxes in
/// x, y and z, and six pointers that run up and down the lists as the query box moves.
///
/// A face meets the query box when six comparisons hold, one a list; each list is divided by its pointer into those for
/// which it holds and the others. The faces for which all six hold are the checklist. A model of BroadPhase
/// (doc/proofs/broad_phase.md), and the historical baseline.
///
/// Cost: a query, the number of list entries between the old and the new pointers: few in a drag, all on a far jump.
/// A face that moves: log n to find its entries, and as many steps as entries are passed. One that comes or goes: the n
/// entries behind it are shifted.
template <class Mesh>
class Six_list_broad_phase : public Broad_phase_base<Mesh, Six_list_broad_phase<Mesh>> {
public:
  using Face_index = typename Mesh::Face_index; ///< what queries append

  /// Sorts the lists: n log n. \param mesh has to outlive this
  explicit Six_list_broad_phase(const Mesh& mesh) : Broad_phase_base<Mesh, Six_list_broad_phase>(mesh) {
    make_room(mesh.num_faces());
    for (const Face_index f : mesh.faces()) {
      const std::size_t i = f;
      boxes_[i] = face_box(mesh, f);
      alive_[i] = true;
      for (int list = 0; list < 6; ++list)
        lists_[list].push_back({bound(list, boxes_[i]), static_cast<std::uint32_t>(i)});
    }
    for (auto& list : lists_)
      std::sort(list.begin(), list.end());
    for (int list = 3; list < 6; ++list) // no upper bound reaches the empty query box
      pointers_[list] = lists_[list].size();
  }

  /// Appends every face whose closed box meets the closed box, to which the pointers run.
  void query(const Box_3& box, std::vector<Face_index>& faces) {
    for (int list = 0; list < 6; ++list)
      run_pointer(list, box);
    query_box_ = box;
    for (const std::uint32_t i : checklist_)
      faces.push_back(Face_index(i));
  }

  /// Puts them where they belong by now. \pre each of the faces is in the lists
  template <class Faces>
  void faces_moved(const Faces& faces) {
    for (const Face_index f : faces)
      move(f);
  }
  /// Reads their corners from the mesh; one that is in the lists already is put in anew.
  template <class Faces>
  void faces_inserted(const Faces& faces) {
    make_room(this->mesh().num_faces());
    for (const Face_index f : faces) {
      remove(f); // its index may be one used before
      insert(f);
    }
  }
  /// Reads no mesh; faces that are not in the lists are passed over.
  template <class Faces>
  void faces_removed(const Faces& faces) {
    for (const Face_index f : faces)
      remove(f);
  }

  /// Makes room for this many faces in all: insertions allocate nothing then. Moves, removals and queries of few faces
  /// never do.
  void reserve(std::size_t faces, std::size_t /*insertions*/) {
    boxes_.reserve(faces);
    alive_.reserve(faces);
    holding_.reserve(faces);
    place_.reserve(faces);
    for (auto& list : lists_)
      list.reserve(faces);
    checklist_.reserve(faces);
  }

  /// Bytes held, capacity included.
  std::size_t memory() const {
    std::size_t bytes = boxes_.capacity() * sizeof(Box_3) + alive_.capacity() + holding_.capacity() +
                        (checklist_.capacity() + place_.capacity()) * sizeof(std::uint32_t);
    for (const auto& entries : lists_)
      bytes += entries.capacity() * sizeof(Entry);
    return bytes;
  }

private:
  /// A bound and its face; sorted by the bound first.
  using Entry = std::pair<double, std::uint32_t>;

  std::array<std::vector<Entry>, 6> lists_; ///< lower x, y, z; upper x, y, z
  std::array<std::size_t, 6>
      pointers_{};  ///< entries before it: lower bound <= query's upper; upper bound < query's lower
  Box_3 query_box_; ///< at first the empty box
  std::vector<Box_3> boxes_;
  std::vector<char> alive_;
  std::vector<std::uint8_t> holding_;    ///< how many of the six comparisons hold for a face
  std::vector<std::uint32_t> checklist_; ///< faces for which all six hold; there is always room for all
  std::vector<std::uint32_t> place_;     ///< of a face in the checklist

  static double bound(int list, const Box_3& box) { return list < 3 ? box.lower[list] : box.upper[list - 3]; }

  /// Whether an entry of the list stands before the pointer for this query.
  static bool is_before(int list, double value, const Box_3& query) {
    return list < 3 ? value <= query.upper[list] : value < query.lower[list - 3];
  }

  void make_room(std::size_t faces) {
    if (boxes_.size() >= faces)
      return;
    if (faces > checklist_.capacity())
      reserve(std::max(faces, internal::grown(boxes_.size())), 0);
    boxes_.resize(faces);
    alive_.resize(faces, false);
    holding_.resize(faces, 0);
    place_.resize(faces, 0);
  }

  void begin_to_hold(std::uint32_t face) {
    if (++holding_[face] == 6) {
      place_[face] = static_cast<std::uint32_t>(checklist_.size());
      checklist_.push_back(face);
    }
  }

  void cease_to_hold(std::uint32_t face) {
    if (holding_[face]-- == 6) {
      checklist_[place_[face]] = checklist_.back();
      place_[checklist_.back()] = place_[face];
      checklist_.pop_back();
    }
  }

  void run_pointer(int list, const Box_3& query) {
    const std::vector<Entry>& entries = lists_[list];
    std::size_t& pointer = pointers_[list];
    while (pointer < entries.size() && is_before(list, entries[pointer].first, query)) {
      list < 3 ? begin_to_hold(entries[pointer].second) : cease_to_hold(entries[pointer].second);
      ++pointer;
    }
    while (pointer > 0 && !is_before(list, entries[pointer - 1].first, query)) {
      --pointer;
      list < 3 ? cease_to_hold(entries[pointer].second) : begin_to_hold(entries[pointer].second);
    }
  }

  void move(Face_index f) {
    const auto i = static_cast<std::uint32_t>(f);
    const Box_3 box = face_box(this->mesh(), f);
    for (int list = 0; list < 6; ++list) {
      std::vector<Entry>& entries = lists_[list];
      const Entry from(bound(list, boxes_[i]), i), to(bound(list, box), i);
      const auto old = std::lower_bound(entries.begin(), entries.end(), from);
      const bool was_before = static_cast<std::size_t>(old - entries.begin()) < pointers_[list];
      if (from < to) {
        const auto place = std::lower_bound(old + 1, entries.end(), to);
        *std::move(old + 1, place, old) = to;
      } else {
        const auto place = std::lower_bound(entries.begin(), old, to);
        *(std::move_backward(place, old, old + 1) - 1) = to;
      }
      const bool is_before_now = is_before(list, to.first, query_box_);
      pointers_[list] += static_cast<std::size_t>(is_before_now) - static_cast<std::size_t>(was_before);
      if (was_before == is_before_now)
        continue;
      if (is_before_now == (list < 3))
        begin_to_hold(i);
      else
        cease_to_hold(i);
    }
    boxes_[i] = box;
  }

  void remove(Face_index f) {
    const auto i = static_cast<std::uint32_t>(f);
    if (i >= alive_.size() || !alive_[i])
      return;
    for (int list = 0; list < 6; ++list) {
      std::vector<Entry>& entries = lists_[list];
      const auto found = std::lower_bound(entries.begin(), entries.end(), Entry(bound(list, boxes_[i]), i));
      const bool before = static_cast<std::size_t>(found - entries.begin()) < pointers_[list];
      entries.erase(found);
      pointers_[list] -= before;
      if (before == (list < 3))
        cease_to_hold(i);
    }
    alive_[i] = false;
  }

  void insert(Face_index f) {
    const auto i = static_cast<std::uint32_t>(f);
    boxes_[i] = face_box(this->mesh(), f);
    alive_[i] = true;
    for (int list = 0; list < 6; ++list) {
      std::vector<Entry>& entries = lists_[list];
      const Entry entry(bound(list, boxes_[i]), i);
      entries.insert(std::lower_bound(entries.begin(), entries.end(), entry), entry);
      const bool before = is_before(list, entry.first, query_box_);
      pointers_[list] += before;
      if (before == (list < 3))
        begin_to_hold(i);
    }
  }
};

} // namespace haptic_sculpt
