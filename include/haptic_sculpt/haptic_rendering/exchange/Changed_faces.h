// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <boost/circular_buffer.hpp>

#include <algorithm>
#include <cstdint>
#include <vector>

namespace haptic_sculpt {

/// Indices of faces that have changed and are to be passed on, each once: those of a time at which all were marked
/// first, then in the order in which they changed first.
class Changed_faces {
public:
  /// Makes room for indices below this: they allocate nothing.
  void reserve(std::size_t faces) {
    if (faces <= waits_.size())
      return;
    waiting_.set_capacity(faces); // first: where memory runs out between the two, what waits still has room
    waits_.resize(faces, false);
  }
  /// All indices below this are to be passed on. Allocates nothing. Linear in what waited before.
  void add_all(std::uint32_t faces) {
    clear();
    all_until_ = faces;
  }
  /// Amortized constant time.
  void add(std::uint32_t face) {
    ++number_;
    if (face >= next_of_all_ && face < all_until_)
      return;
    if (face >= waits_.size())
      reserve(std::max<std::size_t>(face + 1, 2 * waits_.size()));
    if (waits_[face])
      return;
    waits_[face] = true;
    waiting_.push_back(face);
  }
  std::size_t size() const { return all_until_ - next_of_all_ + waiting_.size(); } ///< faces that are to be passed on
  /// The next of them. \pre there is one
  std::uint32_t front() const { return next_of_all_ < all_until_ ? next_of_all_ : waiting_.front(); }
  /// It has been passed on. \pre there is one
  void pop() {
    if (next_of_all_ < all_until_) {
      ++next_of_all_;
      return;
    }
    waits_[waiting_.front()] = false;
    waiting_.pop_front();
  }
  /// All are known.
  void clear() {
    for (; !waiting_.empty(); waiting_.pop_front())
      waits_[waiting_.front()] = false;
    next_of_all_ = all_until_ = 0;
  }
  /// Of calls of add() so far: it grows with each change of the mesh.
  std::uint64_t number() const { return number_; }

private:
  std::vector<bool> waits_;
  boost::circular_buffer<std::uint32_t> waiting_;
  std::uint32_t next_of_all_ = 0, all_until_ = 0; ///< between them all wait
  std::uint64_t number_ = 0;
};

} // namespace haptic_sculpt
