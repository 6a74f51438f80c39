// SPDX-License-Identifier: GPL-3.0-or-later
#include "Script_runner.h"

#include <haptic_sculpt/surface/broad_phase/Box_tree_broad_phase.h>

template haptic_sculpt::sculpt_program::Run_result
haptic_sculpt::sculpt_program::run_script<haptic_sculpt::Box_tree_broad_phase<haptic_sculpt::sculpt_program::Mesh>>(
    Mesh&, const std::vector<Command>&, const Sculptor_parameters&, const Run_hooks&);
