// SPDX-License-Identifier: GPL-3.0-or-later
#include "drag_speed_error/Rounded_sweep_traits_3.h"
#include "drag_speed_error/measure_drags.h"

namespace haptic_sculpt::benchmark {

using Traits = Rounded_sweep_traits_3<CGAL::Exact_predicates_inexact_constructions_kernel>;

bool is_way_free(const Mesh& mesh, Mesh::Vertex_index v, const Mesh::Point& target) {
  return !first_impact(mesh, v, target, Traits(Arithmetic::rationals));
}

Drag_counts measure_rounded(const Drag_script& script, bool slides, Arithmetic arithmetic) {
  Mesh mesh = mesh_of(script);
  Sculptor<Mesh, Box_tree_broad_phase<Mesh>, Default_edit_visitor, Traits> sculptor(
      mesh, parameters::response(slides ? Response::slide : Response::stop), {}, Traits(arithmetic));
  return measure_drags(script, sculptor);
}

} // namespace haptic_sculpt::benchmark
