// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <CLI/CLI.hpp>

#include <cstddef>
#include <sstream>
#include <string>

namespace haptic_sculpt::benchmark {

/// A share of a run: `--shard i/n` makes each unit whose number, in the order of a whole run, is i modulo n.
///
/// Each unit draws from a seed of its own, so it is the same in every share. `merge_shards.py` makes the report of the
/// whole run of the reports of all shares.
class Shard {
public:
  /// \param unit what is shared out, for `--help`: "population"
  void add_option(CLI::App& app, const std::string& unit) {
    app.add_option("--shard", text_,
                   "i/n: every n-th " + unit + ", beginning with the i-th from 0; merge_shards.py joins the reports")
        ->capture_default_str()
        ->check([this](const std::string& text) { return read(text); });
  }

  /// Goes on to the next unit: whether it belongs to this share.
  bool takes_next() { return unit_++ % shards_ == shard_; }
  /// Number of the next unit.
  std::size_t next_unit() const { return unit_; }
  /// Whether this is the first share: what all shares see is counted there, once.
  bool is_first() const { return shard_ == 0; }
  const std::string& text() const { return text_; }

private:
  std::string text_ = "0/1";
  std::size_t shard_ = 0, shards_ = 1, unit_ = 0;

  /// What is wrong with the text; nothing, and the share is set, where all is well.
  std::string read(const std::string& text) {
    std::istringstream words(text);
    std::size_t shard = 0, shards = 0;
    char slash = 0;
    if (text.find('-') != std::string::npos || !(words >> shard >> slash >> shards) || slash != '/' ||
        shard >= shards || words.peek() != std::char_traits<char>::eof())
      return "--shard takes i/n with 0 <= i < n, not '" + text + "'";
    shard_ = shard, shards_ = shards;
    return {};
  }
};

} // namespace haptic_sculpt::benchmark
