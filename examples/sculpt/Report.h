// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Run_result.h"

#include <iosfwd>
#include <string>
#include <vector>

namespace haptic_sculpt::sculpt_program {

/// A vertex that `--nearest` found.
struct Near_vertex {
  std::size_t number;
  Edit_record::Coordinates position;
  double distance;
};

/// Without overflow, as far as the distance itself is a double.
double distance(const Edit_record::Coordinates& p, const Edit_record::Coordinates& q);

/// The report: JSON, one edit a line. doc/use/report.md lists its keys. Doubles come back bit for bit.
/// \param notes what people have been told besides \param nearest what `--nearest` found; empty: it was not asked for
std::string report_of(const Run_result& result, const std::vector<std::string>& notes,
                      const std::vector<Near_vertex>& nearest);

/// The totals, and a line for each edit that was blocked or refused, up to 40 of them.
void print_table(std::ostream& out, const Run_result& result, const Mesh& mesh);

/// One a line.
void print_nearest(std::ostream& out, const Edit_record::Coordinates& to, const std::vector<Near_vertex>& nearest);

} // namespace haptic_sculpt::sculpt_program
