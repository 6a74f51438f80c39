// SPDX-License-Identifier: GPL-3.0-or-later
// Does not compile, and each message names the parameter: these of CGAL's are not served.
#include "meshes/generated_meshes.h"

#include <haptic_sculpt/sculpting/isotropic_remeshing.h>

void remesh(haptic_sculpt::Sculptor<meshes::Mesh>& sculptor) {
  haptic_sculpt::isotropic_remeshing(sculptor, 1, CGAL::parameters::vertex_point_map(0));
  haptic_sculpt::isotropic_remeshing(sculptor, 1, CGAL::parameters::geom_traits(0));
  haptic_sculpt::isotropic_remeshing(sculptor, 1, CGAL::parameters::face_index_map(0));
}
