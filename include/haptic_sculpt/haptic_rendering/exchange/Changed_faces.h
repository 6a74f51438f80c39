// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <boost/circular_buffer.hpp>

#include <algorithm>
#include <cstdint>
#include <vector>

namespace haptic_sculpt {

/// Indices of faces that have changed and are to be passed on, each once, in the order in which they changed first.
class Changed_faces {
public:
  /// Makes room for indices below this: they allocate nothing.
  void reserve(std::size_t faces) {
    if (faces <= waits_.size())
      return;
    waits_.resize(faces, false);
    waiting_.set_capacity(faces);
  }
  /// Amortized constant time.
  void add(std::uint32_t face) {
    ++number_;
    if (face >= waits_.size())
      reserve(std::max<std::size_t>(face + 1, 2 * waits_.size()));
    if (waits_[face])
      return;
    waits_[face] = true;
    waiting_.push_back(face);
  }
  std::size_t size() const { return waiting_.size(); }     ///< faces that are to be passed on
  std::uint32_t front() const { return waiting_.front(); } ///< the next of them \pre there is one
  /// It has been passed on. \pre there is one
  void pop() {
    waits_[waiting_.front()] = false;
    waiting_.pop_front();
  }
  /// All are known.
  void clear() {
    waits_.assign(waits_.size(), false);
    waiting_.clear();
  }
  /// Of calls of add() so far: it grows with each change of the mesh.
  std::uint64_t number() const { return number_; }

private:
  std::vector<bool> waits_;
  boost::circular_buffer<std::uint32_t> waiting_;
  std::uint64_t number_ = 0;
};

} // namespace haptic_sculpt
