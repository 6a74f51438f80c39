// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/surface/io/Text_scanner.h>
#include <haptic_sculpt/surface/validity/Face_soup.h>

#include <algorithm>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace haptic_sculpt::internal {

/// Pairs of vertices that stand one after another in a face. O(n log n)
inline std::size_t number_of_edges(const Face_soup& soup) {
  std::vector<std::pair<Face_soup::Index, Face_soup::Index>> edges;
  edges.reserve(soup.corners.size());
  for (std::size_t f = 0; f < soup.number_of_faces(); ++f)
    for (const Face_soup::Index *corner = soup.begin(f), *end = soup.end(f); corner != end; ++corner)
      edges.push_back(std::minmax(*corner, corner + 1 != end ? corner[1] : *soup.begin(f)));
  std::sort(edges.begin(), edges.end());
  return std::unique(edges.begin(), edges.end()) - edges.begin();
}

/// Reads the text of an OFF file, one vertex or face a line. Colours, normals and texture coordinates are skipped.
/// The number of edges may be left out, or be 0; any other has to be right. Refused are binary OFF (it holds floats
/// only), and four or n dimensions. \throw Read_error
inline Face_soup parse_off(std::string_view text) {
  Text_scanner scan(text);
  if (!scan.next_line())
    throw Read_error("the file holds no text");
  const std::string keyword(scan.word("'OFF'"));
  if (keyword.size() < 3 || keyword.substr(keyword.size() - 3) != "OFF")
    scan.fail("an OFF file begins with 'OFF', not with " + in_quotes(keyword));
  const std::string prefix = keyword.substr(0, keyword.size() - 3);
  if (prefix.find_first_of("4n") != std::string::npos)
    scan.fail("points of " + in_quotes(keyword) + " have more than three coordinates; write them with three");
  if (prefix.find_first_not_of("STCN") != std::string::npos)
    scan.fail_at(keyword, " is no kind of OFF file known here");

  const auto count = [&](const char* what) {
    const std::string_view word = scan.word_anywhere(what);
    if (word == "BINARY")
      scan.fail("binary OFF holds rounded coordinates only; convert the file to ASCII OFF or PLY");
    return scan.to_number<std::uint64_t>(word, what);
  };
  const std::uint64_t vertices = count("the number of vertices"), faces = count("the number of faces");
  const std::uint64_t edges = scan.has_word() ? count("the number of edges") : 0; // most programs write 0 anyway
  scan.expect_end_of_line("the number of edges");
  check_count(vertices, 6, scan.rest().size(), "vertices"); // "0 0 0" and the line's end
  check_count(faces, 2, scan.rest().size(), "faces");

  const auto next_line = [&](const char* what, std::uint64_t i, std::uint64_t n) {
    if (!scan.next_line())
      throw Read_error("the file ends after " + std::to_string(i) + " of " + std::to_string(n) + " " + what);
  };
  Face_soup soup;
  soup.points.reserve(vertices);
  bool have_more = false;
  for (std::uint64_t i = 0; i < vertices; ++i) {
    next_line("vertices", i, vertices);
    double x[3];
    for (double& coordinate : x)
      coordinate = scan.to_number(scan.word("a coordinate"), "a coordinate");
    if (prefix.empty())
      scan.expect_end_of_line("the three coordinates of a vertex");
    have_more |= scan.has_word();
    scan.skip_rest_of_line();
    soup.add_point(x[0], x[1], x[2]);
  }
  for (const auto& [letter, what] :
       {std::pair{'S', "texture coordinates"}, std::pair{'C', "colours"}, std::pair{'N', "normals"}})
    if (have_more && prefix.find(letter) != std::string::npos)
      soup.leave_out(what);
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
    if (scan.has_word()) {
      soup.leave_out("colours");
      scan.skip_rest_of_line();
    }
  }
  if (scan.next_line())
    scan.fail("text follows after the last face");
  if (edges != 0)
    if (const std::size_t found = number_of_edges(soup); found != edges)
      throw Read_error("the header promises " + std::to_string(edges) + " edges, but the faces have " +
                       std::to_string(found) + ": the file is damaged, or write 0 there, which says nothing");
  return soup;
}

} // namespace haptic_sculpt::internal
