// SPDX-License-Identifier: GPL-3.0-or-later
#include "make_batches.h"

#include <haptic_sculpt/surface/broad_phase/Box_tree_broad_phase.h>

namespace haptic_sculpt::robustness {

template Batch_made<Drag_tally> drag_batch<Box_tree_broad_phase<Mesh>>(const Mesh&, const Batch&, Keep);
template Batch_made<Edit_tally> edit_batch<Box_tree_broad_phase<Mesh>>(const Mesh&, const Batch&, Keep);

} // namespace haptic_sculpt::robustness
