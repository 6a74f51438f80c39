// SPDX-License-Identifier: GPL-3.0-or-later
// Does not compile, and the message names the parameter: UNSERVED is one of CGAL's that are not served.
#include "meshes/generated_meshes.h"

#include <haptic_sculpt/sculpting/isotropic_remeshing.h>

void remesh(meshes::Mesh& mesh) {
  haptic_sculpt::Sculptor<meshes::Mesh> sculptor(mesh);
  haptic_sculpt::isotropic_remeshing(sculptor, 1, CGAL::parameters::UNSERVED);
}
