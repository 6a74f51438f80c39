// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <random>
#include <string>

namespace haptic_sculpt::fuzz {

/// Scripts of all that scripts can say, some of them spoiled.
class Random_scripts {
public:
  explicit Random_scripts(std::mt19937_64& random) : random_(random) {}

  std::string next() {
    std::string bytes;
    for (int i = 0; i < 4; ++i) // the mesh, the settings, the byte of the log to change
      bytes += static_cast<char>(random_());
    for (std::size_t lines = 1 + below(12); lines != 0; --lines)
      bytes += line() + (below(40) == 0 ? "\r\n" : below(60) == 0 ? " # comment\n" : "\n");
    if (below(4) == 0)
      spoil(bytes);
    return bytes;
  }

private:
  std::mt19937_64& random_;

  std::size_t below(std::size_t n) { return random_() % n; }

  template <std::size_t n>
  const char* any_of(const std::array<const char*, n>& all) {
    return all[below(n)];
  }

  std::string number() {
    static constexpr std::array<const char*, 24> special = {"0",
                                                            "-0",
                                                            "1",
                                                            "-1",
                                                            "0.5",
                                                            "0.25",
                                                            "2",
                                                            "4",
                                                            "1e-320",
                                                            "4.9e-324",
                                                            "0x1p-1022",
                                                            "0x1p-1074",
                                                            "1e154",
                                                            "-1e154",
                                                            "1e-162",
                                                            "1e300",
                                                            "1e308",
                                                            "-1e308",
                                                            "0x1p52",
                                                            "0x1p53",
                                                            "3.3333333333333334e-161",
                                                            "0x1.fffffffffffffp1023",
                                                            "-0x1.fffffffffffffp1023",
                                                            "1e16"};
    char text[48];
    const double unit = static_cast<double>(random_()) * 0x1p-64;
    switch (below(8)) {
    case 0:
      return any_of(special);
    case 1: { // any double, log-uniform
      const std::uint64_t pattern = random_();
      double x;
      std::memcpy(&x, &pattern, sizeof x);
      std::snprintf(text, sizeof text, "%a", x);
      return text;
    }
    case 2: // on the grid
      return std::to_string(static_cast<int>(below(5)) - 1);
    case 3: // an ulp or so beside it
      std::snprintf(text, sizeof text, "%a", static_cast<double>(below(3)) + (below(2) ? 0x1p-52 : -0x1p-51));
      return text;
    default:
      std::snprintf(text, sizeof text, below(2) ? "%.17g" : "%.3f", 4 * unit - 1.5);
      return text;
    }
  }
  std::string length() {
    return below(3) == 0 ? number() : std::to_string(0x1p-10 * static_cast<double>(1 + below(200)));
  }
  std::string index() {
    if (below(20) == 0)
      return '@' + number() + ',' + number() + ',' + number();
    return std::to_string(below(30) == 0 ? random_() : below(below(3) == 0 ? 12 : 5));
  }
  std::string point() { return ' ' + number() + ' ' + number() + ' ' + number(); }
  /// On the mesh, or not far from it.
  std::string near_point() {
    std::string text;
    for (int k = 0; k < 3; ++k)
      text += ' ' + std::to_string(0x1p-63 * static_cast<double>(random_() >> 1) - 0.5);
    return text;
  }

  std::string line() {
    switch (below(25)) {
    case 0:
      return "insert_face " + index() + ' ' + index() + ' ' + index() + point();
    case 1:
      return "insert_face 0 " + std::string(below(2) ? "1 2" : "1 3") + " 0.3 0.3 0.1";
    case 2:
      return "insert_edge " + index() + ' ' + index() + point();
    case 3:
      return "insert_edge 0 1 0.5 " + number() + " 0";
    case 4:
      return "remove " + index();
    case 5:
      return below(2) ? "undo" : "redo";
    case 6:
      return "probe" + point() + point();
    case 7:
      return "clearance " + (below(3) == 0 ? "default" : length());
    case 8:
      return "delta " + (below(2) == 0 ? "0" : length());
    case 9:
      return std::string("response ") + any_of(std::array<const char*, 3>{"slide", "stop", "paper"});
    case 10:
      return below(2) ? "release" : "mesh " + std::string(64, 'b');
    case 11:
      return "collapse " + index() + ' ' + index();
    case 12:
      return "flip " + index() + ' ' + index();
    case 13:
      return below(2) ? "stroke" : "end";
    case 14: {
      std::string shift = "shift " + std::to_string(below(3)) + ' ';
      const std::size_t vertices = below(4);
      shift += std::to_string(vertices) + '\n';
      for (std::size_t k = 0; k < vertices; ++k)
        shift += std::to_string(below(6)) + ' ' + number() + '\n';
      return shift + "end";
    }
    case 15:
      return "move " + index() + point();
    case 16: {
      static constexpr std::array<const char*, 5> kinds = {"grab", "inflate", "smooth", "flatten", "pinch"};
      const std::string direction = below(2) ? near_point() : "";
      return std::string("brush ") + any_of(kinds) + near_point() + ' ' + length() + ' ' + length() + direction;
    }
    case 17: // of shorter edges some take minutes
      return "remesh " + std::to_string(0.2 + 0x1p-63 * static_cast<double>(random_() >> 1));
    default:
      return "drag " + index() + point();
    }
  }

  void spoil(std::string& bytes) {
    for (std::size_t changes = 1 + below(4); changes != 0; --changes) {
      const std::size_t at = below(bytes.size());
      switch (below(4)) {
      case 0:
        bytes[at] = static_cast<char>(random_());
        break;
      case 1:
        bytes.erase(at, 1 + below(8));
        break;
      case 2:
        bytes.insert(at, bytes.substr(below(bytes.size()), below(20)));
        break;
      default:
        bytes.insert(at, 1, "0123456789.-+xpeE# \t\r\n\0"[below(23)]);
      }
      if (bytes.empty())
        return;
    }
  }
};

} // namespace haptic_sculpt::fuzz
