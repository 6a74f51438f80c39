// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "oracle/Sweep_kind.h"

#include <cstdlib>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace haptic_sculpt::test {

/// One line of a file of published queries.
struct Sample_query {
  int line;
  Sweep_kind kind;
  std::string set;      ///< the scene it was taken from
  Sweep_coordinates x;
  bool truth;           ///< the published answer
};

/// Reads lines of `VF|EE|FV`, the name of a set, fifteen hexadecimal doubles and 0 or 1.
/// \throw std::runtime_error naming the line that is not of this form, or the file that cannot be read
inline std::vector<Sample_query> read_sample_queries(const std::string& file) {
  std::ifstream in(file);
  if (!in)
    throw std::runtime_error("cannot read " + file);
  std::vector<Sample_query> queries;
  std::string text;
  for (int line = 1; std::getline(in, text); ++line) {
    const auto malformed = [&] {
      return std::runtime_error(file + ": line " + std::to_string(line) + " is malformed");
    };
    std::istringstream words(text);
    std::string kind, number, end;
    Sample_query query{line, Sweep_kind::vertex_face, {}, {}, false};
    words >> kind >> query.set;
    bool known = false;
    for (Sweep_kind k : sweep_kinds)
      if (kind == sweep_name(k)) {
        query.kind = k;
        known = true;
      }
    for (double& x : query.x) {
      words >> number; // through strtod: operator>> does not read hexadecimal doubles
      char* rest = nullptr;
      x = std::strtod(number.c_str(), &rest);
      if (!words || *rest != '\0')
        throw malformed();
    }
    if (!known || !(words >> query.truth) || (words >> end))
      throw malformed();
    queries.push_back(query);
  }
  return queries;
}

} // namespace haptic_sculpt::test
