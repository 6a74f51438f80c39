// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Arguments.h"

#include "../common/Log_text.h"

namespace haptic_sculpt::sculpt_program {

/// What is to be done of a script, after what a log has of it.
struct Rest {
  std::vector<Command> commands; ///< at first the settings that the script had made, where others are in force now
  std::size_t after = 0;     ///< the last line that was carried out already; 0: none
  bool is_new_pass = true;   ///< from the beginning
  bool is_announced = false; ///< the log's last pass is the one that goes on, so the log need not say which it is
};

/// Where a script goes on. One that was interrupted does so after its last line in the log; one that is complete begins
/// again, if that is asked for. \throw Usage_error if it is complete and that is not asked for
Rest rest_of(const std::vector<Command>& script, const std::string& script_hash, const Log_contents& log,
             const Arguments& arguments);

/// Whether a `move` of this script broke off at the end of the log: the script makes it again from its beginning.
bool ends_within_move(const std::vector<Command>& script, const std::string& script_hash, const Log_contents& log);

/// The settings that the options ask for.
Settings settings_of(const Arguments& arguments);

/// Options hold from the first edit on, so they cannot be others than when the log was begun; nor, before a new pass,
/// than what holds at its end. \throw Usage_error that names the option, what the log says, and what to do
void check_options(const Arguments& arguments, const Log_contents& log, bool is_new_pass);

} // namespace haptic_sculpt::sculpt_program
