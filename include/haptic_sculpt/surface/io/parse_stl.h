// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/surface/io/Binary_scanner.h>
#include <haptic_sculpt/surface/io/Text_scanner.h>
#include <haptic_sculpt/surface/validity/Face_soup.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdint>
#include <cstring>
#include <initializer_list>
#include <string>
#include <string_view>
#include <unordered_map>

namespace haptic_sculpt::internal {

/// Other in each run: a file written so that all its points have one hash would take quadratic time.
struct Seeded_hash {
  std::uint64_t seed = static_cast<std::uint64_t>(std::chrono::steady_clock::now().time_since_epoch().count());

  std::size_t operator()(const std::array<std::uint64_t, 3>& key) const {
    std::uint64_t hash = seed;
    for (const std::uint64_t bits : key) { // the last steps of MurmurHash3, which is in the public domain
      hash ^= bits;
      hash = (hash ^ (hash >> 33)) * 0xff51afd7ed558ccdU;
      hash = (hash ^ (hash >> 33)) * 0xc4ceb9fe1a85ec53U;
      hash ^= hash >> 33;
    }
    return hash;
  }
};

/// Makes vertices of the corners of an STL file: exactly equal points are one vertex (0 and -0 are equal), numbered in
/// the order of first appearance.
class Stl_vertices {
public:
  explicit Stl_vertices(Face_soup& soup) : soup_(soup) {}

  void add_corner(double x, double y, double z) {
    Key key;
    std::size_t k = 0;
    for (double coordinate : {x, y, z}) {
      if (coordinate == 0)
        coordinate = 0; // the sign of zero
      std::memcpy(&key[k++], &coordinate, sizeof coordinate);
    }
    const auto [place, is_new] = index_.emplace(key, static_cast<Face_soup::Index>(soup_.points.size()));
    if (is_new)
      soup_.add_point(x, y, z);
    soup_.corners.push_back(place->second);
  }

private:
  using Key = std::array<std::uint64_t, 3>;

  Face_soup& soup_;
  std::unordered_map<Key, Face_soup::Index, Seeded_hash> index_;
};

/// Whether the word is this keyword, which stands in small letters; the word may stand in capitals.
inline bool is_keyword(std::string_view word, std::string_view keyword) {
  return std::equal(word.begin(), word.end(), keyword.begin(), keyword.end(), [](char c, char small) {
    return c == small || (c >= 'A' && c <= 'Z' && c - 'A' + 'a' == small);
  });
}

/// Takes these keywords, on later lines if need be. \throw Read_error
inline void expect_keywords(Text_scanner& scan, std::initializer_list<const char*> keywords) {
  for (const char* expected : keywords)
    if (const std::string_view word = scan.word_anywhere(expected); !is_keyword(word, expected))
      scan.fail_at(word, " stands where '", expected, "' should");
}

/// ASCII STL, one or several solids. Coordinates are doubles; normals are skipped. Keywords may stand in capitals.
/// \throw Read_error
inline Face_soup parse_ascii_stl(std::string_view text) {
  Text_scanner scan(text, 0);
  const auto skip_words = [&](int n) {
    for (int i = 0; i < n; ++i)
      scan.word_anywhere("a normal");
  };
  Face_soup soup;
  Stl_vertices vertices(soup);
  std::size_t solids = 0;
  while (scan.has_word() || scan.next_line()) {
    expect_keywords(scan, {"solid"});
    scan.skip_rest_of_line(); // its name
    if (++solids == 2)
      soup.leave_out("groups");
    for (;;) {
      const std::string_view word = scan.word_anywhere("'facet' or 'endsolid'");
      if (is_keyword(word, "endsolid"))
        break;
      if (!is_keyword(word, "facet"))
        scan.fail_at(word, " stands where 'facet' or 'endsolid' should");
      expect_keywords(scan, {"normal"});
      skip_words(3);
      expect_keywords(scan, {"outer", "loop"});
      for (int corner = 0; corner < 3; ++corner) {
        expect_keywords(scan, {"vertex"});
        double x[3];
        for (double& coordinate : x)
          coordinate = scan.to_number(scan.word_anywhere("a coordinate"), "a coordinate");
        vertices.add_corner(x[0], x[1], x[2]);
      }
      expect_keywords(scan, {"endloop", "endfacet"});
      soup.close_face();
    }
    scan.skip_rest_of_line();
  }
  return soup;
}

/// Binary STL: floats. \throw Read_error
inline Face_soup parse_binary_stl(std::string_view bytes, std::uint32_t faces) {
  Binary_scanner scan(bytes.substr(84), false);
  Face_soup soup;
  Stl_vertices vertices(soup);
  soup.first_corner.reserve(faces + std::size_t(1));
  soup.corners.reserve(3 * std::size_t(faces));
  for (std::uint32_t f = 0; f < faces; ++f) {
    for (int k = 0; k < 3; ++k)
      scan.take<float>(); // the normal
    for (int corner = 0; corner < 3; ++corner) {
      const float x = scan.take<float>(), y = scan.take<float>(), z = scan.take<float>();
      vertices.add_corner(x, y, z);
    }
    if (scan.take<std::uint16_t>() != 0) // attributes
      soup.leave_out("colours");
    soup.close_face();
  }
  return soup;
}

/// A file is binary iff its size is that which a binary file with its count has. \throw Read_error
inline Face_soup parse_stl(std::string_view bytes) {
  constexpr std::size_t header = 84, facet = 50;
  const std::string_view text = without_bom(bytes);
  const std::size_t start = std::min(text.find_first_not_of(" \t\r\n"), text.size());
  const bool looks_like_text = is_keyword(text.substr(start, 5), "solid");
  if (bytes.size() >= header) {
    const auto faces = Binary_scanner(bytes.substr(80), false).take<std::uint32_t>();
    const std::uint64_t size = header + std::uint64_t(facet) * faces;
    if (bytes.size() == size)
      return parse_binary_stl(bytes, faces);
    if (!looks_like_text)
      throw Read_error("the header promises " + std::to_string(faces) + " triangles, which take " +
                       std::to_string(size) + " bytes, but the file has " + std::to_string(bytes.size()));
  } else if (!looks_like_text) {
    throw Read_error("the file is neither text that begins with 'solid' nor long enough for a binary STL file");
  }
  return parse_ascii_stl(text);
}

} // namespace haptic_sculpt::internal
