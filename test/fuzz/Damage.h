// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <iterator>
#include <random>
#include <string>
#include <vector>

namespace haptic_sculpt::fuzz {

/// Damages a text or some bytes in a few of many ways.
class Damage {
public:
  /// \param seeds good inputs. The first byte, which says what kind of input it is, is never damaged
  Damage(std::mt19937_64& random, const std::vector<std::string>& seeds) : random_(random), seeds_(seeds) {}

  /// One of the seeds, damaged.
  std::string operator()() {
    std::string input = seeds_[below(seeds_.size())];
    const std::string kind = input.substr(0, 1);
    input.erase(0, 1);
    for (std::size_t n = 1 + below(4); n-- > 0;)
      damage(input);
    return kind + input;
  }

private:
  std::mt19937_64& random_;
  const std::vector<std::string>& seeds_;

  std::size_t below(std::size_t n) { return n == 0 ? 0 : random_() % n; }

  void damage(std::string& text) {
    static const char* const words[] = {"nan",        "inf",        "-inf",
                                        "1e308",      "-1e308",     "1e999",
                                        "1e-320",     "5e-324",     "-0",
                                        "0",          "1",          "-1",
                                        "+-1",        "+1",         "4294967295",
                                        "4294967296", "2147483648", "18446744073709551616",
                                        "0x1",        "1e",         ".5",
                                        "3",          "4",          "solid",
                                        "endsolid",   "facet",      "v",
                                        "f",          "vt",         "l",
                                        "#",          "\n",         " ",
                                        "ply",        "format",     "element",
                                        "property",   "list",       "uchar",
                                        "double",     "face",       "vertex",
                                        "OFF",        "end_header", "binary_big_endian 1.0",
                                        "1/1/1",      "-4//1",      "0.5",
                                        "0.25",       "1e-300",     "\r",
                                        "\\"};
    const std::size_t at = below(text.size() + 1), length = below(std::min<std::size_t>(text.size() - at + 1, 40));
    switch (below(10)) {
    case 0: // a bit
      if (at < text.size())
        text[at] = char(text[at] ^ (1 << below(8)));
      break;
    case 1: // a byte
      if (at < text.size())
        text[at] = char(random_());
      break;
    case 2: // a part lost
      text.erase(at, length);
      break;
    case 3: // a part doubled
      text.insert(below(text.size() + 1), text.substr(at, length));
      break;
    case 4: // a word put in
      text.insert(at, words[below(std::size(words))]);
      break;
    case 5: { // the rest of another
      const std::string& other = seeds_[below(seeds_.size())];
      text = text.substr(0, at) + other.substr(below(other.size()));
      break;
    }
    case 6: { // some bytes of a number
      const std::uint64_t values[] = {0, 1, 0x7fffffff, 0xffffffff, 0x7ff0000000000000, 0x8000000000000000, random_()};
      const std::uint64_t value = values[below(std::size(values))];
      const std::size_t bytes = std::min(text.size() - at, std::size_t(1) << below(4));
      std::memcpy(text.data() + at, &value, bytes);
      break;
    }
    default: // a word for a word, where there are digits: what is likely to be read all the same
      const std::size_t begin = std::min(text.find_first_of("0123456789", at), text.size());
      const std::size_t end = std::min(text.find_first_of(" \t\r\n/", begin), text.size());
      if (end - begin < 40)
        text.replace(begin, end - begin, below(2) ? words[below(std::size(words))] : std::to_string(below(9)));
    }
  }
};

} // namespace haptic_sculpt::fuzz
