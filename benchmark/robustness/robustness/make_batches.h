// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Drag_batch.h"
#include "Edit_batch.h"

namespace haptic_sculpt::robustness {

template <class Broad_phase>
Batch_made<Drag_tally> drag_batch(const Mesh& mesh, const Batch& batch, Keep keep) {
  return Drag_batch<Broad_phase>(mesh, batch).run(keep);
}

template <class Broad_phase>
Batch_made<Edit_tally> edit_batch(const Mesh& mesh, const Batch& batch, Keep keep) {
  return Edit_batch<Broad_phase>(mesh, batch).run(keep);
}

} // namespace haptic_sculpt::robustness
