// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef HAPTIC_SCULPT_EXAMPLES_REPORT_H
#define HAPTIC_SCULPT_EXAMPLES_REPORT_H

#include "Run_result.h"

#include <iosfwd>
#include <string>
#include <vector>

namespace haptic_sculpt::sculpt_program {

/// The report: JSON, one edit a line. doc/sculpt.md lists its keys. Doubles come back bit for bit.
/// \param notes what people have been told besides
std::string report_of(const Run_result& result, const std::vector<std::string>& notes);

/// The totals, and a line for each edit that was blocked or refused, up to 40 of them.
void print_table(std::ostream& out, const Run_result& result, const Mesh& mesh);

} // namespace haptic_sculpt::sculpt_program

#endif
