// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Run.h"

#include <ostream>

namespace haptic_sculpt::loop_program {

/// The JSON report. \param notes what people were shown
std::string report_of(const Run_result& result, const Settings& settings, const std::vector<std::string>& notes);

/// The same, short, for people.
void print_summary(std::ostream& out, const Run_result& result, const Settings& settings);

} // namespace haptic_sculpt::loop_program
