// A stranger's program: sweeps by the installed package.
#include <haptic_sculpt/collision.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

int main() {
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  using Point_3 = Kernel::Point_3;
  const haptic_sculpt::Swept_collision_traits_3<Kernel> traits;
  const auto impact = traits.vertex_face_sweep_3_object()(Point_3(0.25, 0.25, 1), Point_3(0.25, 0.25, -1),
                                                          Point_3(0, 0, 0), Point_3(1, 0, 0), Point_3(0, 1, 0));
  return impact && impact->exact_time() == mpq_class(1, 2) ? 0 : 1;
}
