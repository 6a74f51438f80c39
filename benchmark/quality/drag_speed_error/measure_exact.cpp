// SPDX-License-Identifier: GPL-3.0-or-later
#include "drag_speed_error/measure_drags.h"

namespace haptic_sculpt::benchmark {

Drag_counts measure_exact(const Drag_script& script, bool slides) {
  Mesh mesh = mesh_of(script);
  Sculptor<Mesh> sculptor(mesh, parameters::response(slides ? Response::slide : Response::stop));
  return measure_drags(script, sculptor);
}

} // namespace haptic_sculpt::benchmark
