// SPDX-License-Identifier: GPL-3.0-or-later
#include "drag_speed_error/Rounded_sweep_traits_3.h"
#include "drag_speed_error/measure_drags.h"

#include "oracle/Still_surroundings.h"

namespace haptic_sculpt::benchmark {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Traits = Rounded_sweep_traits_3<Kernel>;

bool is_way_free(const Mesh& mesh, Mesh::Vertex_index v, const Mesh::Point& target) {
  const Mesh::Point& start = mesh.point(v);
  return start == target || test::Still_surroundings<Kernel>(mesh, v).is_free_by_oracle(start, target);
}

Drag_counts measure_rounded(const Drag_script& script, bool slides, Arithmetic arithmetic) {
  Mesh mesh = mesh_of(script);
  Sculptor<Mesh, Box_tree_broad_phase<Mesh>, Default_edit_visitor, Traits> sculptor(
      mesh, parameters::response(slides ? Response::slide : Response::stop), {}, Traits(arithmetic));
  return measure_drags(script, sculptor);
}

} // namespace haptic_sculpt::benchmark
