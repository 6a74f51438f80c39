// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Arguments.h"

#include <haptic_sculpt/surface/Validity_report.h>
#include <haptic_sculpt/surface/validity/Face_soup.h>

namespace haptic_sculpt::sculpt_program {

/// Of a mesh that was refused: writes every fault as JSON where `--report` asks for it, and draws them in red where
/// `--picture` does; tells on standard error what cannot be written. Keys: doc/use/sculpt.md.
/// \param soup what was validated, whose points and faces the report names
void write_refusal(const Arguments& arguments, const Face_soup& soup, const Validity_report& report);

} // namespace haptic_sculpt::sculpt_program
