// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef HAPTIC_SCULPT_SURFACE_PARSE_OFF_H
#define HAPTIC_SCULPT_SURFACE_PARSE_OFF_H

#include <haptic_sculpt/surface/Face_soup.h>
#include <haptic_sculpt/surface/Text_scanner.h>

#include <string>
#include <string_view>

namespace haptic_sculpt {
namespace internal {

/// Reads the text of an OFF file, one vertex or face a line. Colours, normals and texture coordinates are skipped.
/// Refused are binary OFF (it holds floats only), and four or n dimensions. \throw Read_error
inline Face_soup parse_off(std::string_view text) {
  Text_scanner scan(text);
  if (!scan.next_line())
    throw Read_error("the file holds no text");
  const std::string keyword(scan.word("'OFF'"));
  if (keyword.size() < 3 || keyword.substr(keyword.size() - 3) != "OFF")
    scan.fail("an OFF file begins with 'OFF', not with '" + keyword.substr(0, 20) + "'");
  const std::string prefix = keyword.substr(0, keyword.size() - 3);
  if (prefix.find_first_of("4n") != std::string::npos)
    scan.fail("points of '" + keyword + "' have more than three coordinates; write them with three");
  if (prefix.find_first_not_of("STCN") != std::string::npos)
    scan.fail("'" + keyword + "' is no kind of OFF file known here");

  const auto count = [&](const char* what) {
    const std::string_view word = scan.word_anywhere(what);
    if (word == "BINARY")
      scan.fail("binary OFF holds rounded coordinates only; convert the file to ASCII OFF or PLY");
    return scan.to_number<std::uint64_t>(word, what);
  };
  const std::uint64_t vertices = count("the number of vertices"), faces = count("the number of faces");
  scan.skip_rest_of_line();                                 // the number of edges, which nobody keeps
  check_count(vertices, 6, scan.rest().size(), "vertices"); // "0 0 0" and the line's end
  check_count(faces, 2, scan.rest().size(), "faces");

  const auto next_line = [&](const char* what, std::uint64_t i, std::uint64_t n) {
    if (!scan.next_line())
      throw Read_error("the file ends after " + std::to_string(i) + " of " + std::to_string(n) + " " + what);
  };
  Face_soup soup;
  soup.points.reserve(vertices);
  for (std::uint64_t i = 0; i < vertices; ++i) {
    next_line("vertices", i, vertices);
    double x[3];
    for (double& coordinate : x)
      coordinate = scan.to_number(scan.word("a coordinate"), "a coordinate");
    if (prefix.empty())
      scan.expect_end_of_line("the three coordinates of a vertex");
    scan.skip_rest_of_line();
    soup.points.emplace_back(x[0], x[1], x[2]);
  }
  for (std::uint64_t i = 0; i < faces; ++i) {
    next_line("faces", i, faces);
    const auto corners = scan.to_number<std::uint64_t>(scan.word("a number of corners"), "a number of corners");
    for (std::uint64_t k = 0; k < corners; ++k) {
      const auto v = scan.to_number<std::uint64_t>(scan.word("the index of a vertex"), "the index of a vertex");
      if (v >= vertices)
        scan.fail("face " + std::to_string(i) + " names vertex " + std::to_string(v) + ", but there are only " +
                  std::to_string(vertices));
      soup.corners.push_back(static_cast<Face_soup::Index>(v));
    }
    soup.close_face();
    scan.skip_rest_of_line(); // a colour
  }
  if (scan.next_line())
    scan.fail("text follows after the last face");
  return soup;
}

} // namespace internal
} // namespace haptic_sculpt

#endif
