// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "carry_out_line.h"

namespace haptic_sculpt::examples {

/// Makes the lines of a log again: what can be undone afterwards is what could be before. Strokes that are open at the
/// end, end; what is set holds no longer.
template <class Sculptor>
void replay_log(Sculptor& sculptor, const std::vector<Command>& commands) {
  for (const Command& command : commands) {
    if (command.kind != Command::Kind::edit) {
      carry_out_line(sculptor, command);
      continue;
    }
    try {
      sculptor.apply(command.edit);
    } catch (const Invalid_parameter&) { // a clearance that the scene has outgrown: the edit was refused then, too
      sculptor.release();
    }
  }
  while (sculptor.apply(Edit::of(Edit_kind::end)))
    ;
  sculptor.set_drag_parameters(Drag_parameters());
  if (sculptor.parameters().delta_length != 0)
    sculptor.set_delta(0);
}

} // namespace haptic_sculpt::examples
