// SPDX-License-Identifier: GPL-3.0-or-later
#include "make_batches.h"

#include <haptic_sculpt/sculpting/paper_1997/Six_list_broad_phase.h>

namespace haptic_sculpt::robustness {

template Batch_made<Drag_tally> drag_batch<Six_list_broad_phase<Mesh>>(const Mesh&, const Batch&, Keep);
template Batch_made<Edit_tally> edit_batch<Six_list_broad_phase<Mesh>>(const Mesh&, const Batch&, Keep);

} // namespace haptic_sculpt::robustness
