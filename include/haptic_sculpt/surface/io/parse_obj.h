// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/surface/io/Text_scanner.h>
#include <haptic_sculpt/surface/validity/Face_soup.h>

#include <algorithm>
#include <array>
#include <string>
#include <string_view>
#include <utility>

namespace haptic_sculpt::internal {

/// Reads the text of a Wavefront OBJ file: its `v` and `f` lines, with colours of vertices. Texture coordinates,
/// normals, materials, groups and lines are skipped; free-form surfaces and lines continued by a backslash are refused.
/// \throw Read_error
inline Face_soup parse_obj(std::string_view text) {
  constexpr std::array<std::pair<std::string_view, const char*>, 12> left_out{{{"vt", "texture coordinates"},
                                                                               {"vn", "normals"},
                                                                               {"vp", "curves"},
                                                                               {"g", "groups"},
                                                                               {"o", "groups"},
                                                                               {"s", "groups"},
                                                                               {"mg", "groups"},
                                                                               {"l", "lines"},
                                                                               {"p", "points of their own"},
                                                                               {"usemtl", "materials"},
                                                                               {"mtllib", "materials"},
                                                                               {"usemap", "materials"}}};
  Text_scanner scan(text);
  Face_soup soup;
  std::array<Vertex_attribute, 3> colours{{{"red", {}, {}}, {"green", {}, {}}, {"blue", {}, {}}}};
  std::int64_t highest = -1;
  std::size_t face_with_highest = 0;
  while (scan.next_line()) {
    const std::string_view keyword = scan.word("a keyword");
    if (keyword == "v") {
      std::array<double, 7> x{};
      std::size_t n = 0;
      for (; scan.has_word(); ++n) {
        if (n == x.size())
          scan.fail("a vertex has 3 coordinates, and a weight or a colour");
        x[n] = scan.to_number(scan.word(""), "a coordinate");
      }
      if (n < 3 || n == 5)
        scan.fail("a vertex has 3 coordinates, not " + std::to_string(n));
      if (n % 3 == 1 && x[3] != 1)
        scan.fail("vertices with a weight other than 1 are not supported; divide the coordinates by it");
      for (std::size_t k = 0; n >= 6 && k < 3; ++k)
        colours[k].values.push_back(x[n - 3 + k]);
      soup.add_point(x[0], x[1], x[2]);
    } else if (keyword == "f") {
      const auto face = std::to_string(soup.number_of_faces());
      while (scan.has_word()) {
        const std::string_view corner = scan.word("");
        const auto index = scan.to_number<std::int64_t>(corner.substr(0, corner.find('/')), "the index of a vertex");
        const std::int64_t points = static_cast<std::int64_t>(soup.points.size());
        const std::int64_t v = index > 0 ? index - 1 : points + index; // negative: counted back from here
        if (index == 0 || v < 0 || v >= std::int64_t(UINT32_MAX))
          scan.fail("face " + face + " (counted from 0) names vertex " + std::to_string(index) +
                    ", which cannot be: indices count from 1, or backwards from -1");
        if (v > highest) {
          highest = v;
          face_with_highest = soup.number_of_faces();
        }
        soup.corners.push_back(static_cast<Face_soup::Index>(v));
      }
      soup.close_face();
    } else if (const auto found = std::find_if(left_out.begin(), left_out.end(),
                                               [&](const auto& pair) { return pair.first == keyword; });
               found != left_out.end()) {
      soup.leave_out(found->second);
      scan.skip_rest_of_line();
    } else {
      scan.fail_at(keyword, " is no line of an OBJ mesh");
    }
  }
  const std::size_t coloured = colours[0].values.size();
  if (coloured > 0 && coloured < soup.points.size())
    soup.leave_out("colours that only some vertices have");
  else if (coloured > 0)
    for (Vertex_attribute& part : colours) {
      part.type = Vertex_attribute::Type::float64;
      soup.attributes.push_back(std::move(part));
    }
  if (highest >= static_cast<std::int64_t>(soup.points.size()))
    throw Read_error("face " + std::to_string(face_with_highest) + " (counted from 0) names vertex " +
                     std::to_string(highest + 1) + ", but there are only " + std::to_string(soup.points.size()));
  return soup;
}

} // namespace haptic_sculpt::internal
