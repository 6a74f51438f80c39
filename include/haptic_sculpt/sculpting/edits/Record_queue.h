// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <new>
#include <utility>
#include <vector>

namespace haptic_sculpt::internal {

/// Records in the order in which they came: added and taken away at the end, forgotten at the beginning, and read by a
/// number that a record keeps as long as it is there.
///
/// In blocks that are never copied and are used again, so that nothing is allocated while there is room, and no
/// addition takes longer the more there are.
template <class Record, std::size_t block_size>
class Record_queue {
public:
  /// Of the first record, and one more than that of the last.
  std::size_t begin() const { return begin_; }
  std::size_t end() const { return end_; }
  std::size_t size() const { return end_ - begin_; }

  const Record& operator[](std::size_t i) const { return block_of(i)[(i - base_) % block_size]; }
  Record& operator[](std::size_t i) { return const_cast<Record&>(static_cast<const Record_queue&>(*this)[i]); }

  void push_back(const Record& record) {
    reserve(1);
    std::vector<Record>& block = blocks_[(end_ - base_) / block_size];
    const std::size_t place = (end_ - base_) % block_size;
    if (place < block.size())
      block[place] = record;
    else
      block.push_back(record);
    ++end_;
  }

  /// Takes away all from this number on. \pre begin() <= end <= end()
  void cut(std::size_t end) { end_ = end; }

  /// Forgets all before this number. \pre begin() <= begin <= end()
  void forget(std::size_t begin) {
    begin_ = begin;
    const std::size_t empty = (begin_ - base_) / block_size;
    std::rotate(blocks_.begin(), blocks_.begin() + static_cast<std::ptrdiff_t>(empty), blocks_.end());
    base_ += empty * block_size;
  }

  /// This many additions allocate nothing. \throw std::bad_alloc, and no record has changed
  void reserve(std::size_t additions) {
    const std::size_t blocks = (end_ - base_ + additions + block_size - 1) / block_size;
    if (blocks > blocks_.size() + 1)
      check_memory(blocks - blocks_.size());
    while (blocks_.size() < blocks) {
      std::vector<Record> block;
      block.reserve(block_size);
      blocks_.push_back(std::move(block));
    }
  }

private:
  std::vector<std::vector<Record>> blocks_;    ///< each with room for block_size
  std::size_t begin_ = 0, end_ = 0, base_ = 0; ///< base_: the number of the first place of the first block

  /// Asks for all at once: a system grants block after block, until it has to end some process.
  /// \throw std::bad_alloc
  static void check_memory(std::size_t blocks) {
    constexpr std::size_t most = std::numeric_limits<std::ptrdiff_t>::max();
    if (blocks > most / (block_size * sizeof(Record)))
      throw std::bad_alloc();
    ::operator delete(::operator new(blocks* block_size * sizeof(Record)));
  }

  const std::vector<Record>& block_of(std::size_t i) const { return blocks_[(i - base_) / block_size]; }
};

} // namespace haptic_sculpt::internal
