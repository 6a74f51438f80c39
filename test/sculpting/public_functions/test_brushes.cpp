// SPDX-License-Identifier: GPL-3.0-or-later
// The brushes of the programs in a scene 2^k times as large: the same dabs, number by number.
#include <boost/test/unit_test.hpp>

#include "../examples/brushes.h"
#include "sculpting/public_functions/Scaled_scene.h"

#include <boost/property_map/vector_property_map.hpp>

using namespace haptic_sculpt;
using namespace haptic_sculpt::test;

namespace {

/// Where a dab wants vertices. \return how many it moves
std::size_t dab(brushes::Kind kind, double unit, bool has_direction, Outcome& outcome) {
  const Scaled_scene scene(unit);
  const bool is_length = kind == brushes::Kind::grab || kind == brushes::Kind::inflate;
  brushes::Dab<meshes::Kernel> dab{
      kind, scene.at(0.5, 0.25, 0.5), scene.length(0.75), is_length ? scene.length(0.125) : 0.5, {}};
  if (has_direction)
    dab.direction = scene.at(1, 0.5, 0.25) - scene.at(0, 0, 0);
  boost::vector_property_map<Point_3> targets;
  std::size_t moved = 0;
  for (const Vertex_index v : brushes::fill_targets(scene.mesh, dab, targets)) {
    outcome.index(v);
    outcome.point(targets[static_cast<std::size_t>(v)]);
    moved += targets[static_cast<std::size_t>(v)] != scene.mesh.point(v);
  }
  // A plane is told by a direction, of any length, and a place.
  const meshes::Kernel::Plane_3 plane(scene.at(0.25, 0, 0), meshes::Kernel::Vector_3(1, 0.5, 0.25));
  outcome.point(brushes::mirrored(dab, plane).centre);
  return moved;
}

} // namespace

BOOST_AUTO_TEST_CASE(brushes_act_alike_at_all_scales) {
  using brushes::Kind;
  for (const Kind kind : {Kind::grab, Kind::inflate, Kind::smooth, Kind::flatten, Kind::pinch})
    for (const bool has_direction : {false, true}) {
      Outcome at_scale_1;
      BOOST_TEST(dab(kind, 1, has_direction, at_scale_1) > 4u);
      for (const int k : {-900, -511, -333, -259, 259, 333, 511, 900, 998}) {
        Outcome outcome;
        BOOST_TEST(dab(kind, std::ldexp(1.0, k), has_direction, outcome) > 4u);
        BOOST_TEST(outcome.first_difference(at_scale_1, k) == at_scale_1.size(),
                   "brush " << static_cast<int>(kind) << " at 2^" << k);
      }
    }
}
