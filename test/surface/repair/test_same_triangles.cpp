// SPDX-License-Identifier: GPL-3.0-or-later
#include <haptic_sculpt/surface/repair.h>

#include "surface/identical.h"
#include "surface/soup_of.h"

#include <meshes/generated_meshes.h>

#include <seeds_and_sizes.h>

#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <cstddef>
#include <memory>
#include <random>
#include <vector>

namespace {

/// While it lives, what is new comes to lie in gaps of the memory in an order of its own.
class Scattered_memory {
  using Block = std::unique_ptr<std::byte[]>;

public:
  explicit Scattered_memory(std::mt19937& random) {
    std::vector<Block> gaps;
    for (int i = 0; i < 400; ++i) {
      gaps.emplace_back(new std::byte[1000 + random() % 9000]);
      walls_.emplace_back(new std::byte[32]); // else two gaps would become one
    }
    std::shuffle(gaps.begin(), gaps.end(), random);
    for (Block& gap : gaps)
      gap.reset();
  }

private:
  std::vector<Block> walls_;
};

} // namespace

BOOST_AUTO_TEST_SUITE(repairing)

// Several sets of triangles close such holes equally well, and unions come in an order of CGAL's own; no address
// decides.
BOOST_AUTO_TEST_CASE(a_mesh_is_repaired_alike_wherever_in_memory) {
  const std::uint64_t seed = haptic_sculpt::test::seed_from_environment(62);
  std::mt19937 random(static_cast<std::uint32_t>(seed));
  const auto pulled_ball = [&] {
    meshes::Triangle_list list = meshes::icosphere(1);
    const auto anywhere = [&] { return random() / 1073741824.0 - 2; };
    const double x = anywhere(), y = anywhere(), z = anywhere();
    list.points[random() % list.points.size()] = meshes::Point_3(x, y, z);
    return list;
  };
  const auto step = [&] { return 0.25 * static_cast<double>(random() % 8); };
  const std::size_t meshes = haptic_sculpt::test::count_from_environment("HAPTIC_SCULPT_REPAIRS", 60);
  std::size_t cut = 0, united = 0;
  for (std::size_t run = 0; run < meshes; ++run) {
    meshes::Triangle_list list = pulled_ball();
    if (run % 4 == 3) {
      meshes::Triangle_list other = meshes::icosphere(1);
      const double x = step(), y = step();
      list += other.scale_and_move(1, x, y, 0.5);
    }
    haptic_sculpt::Face_soup first = haptic_sculpt::test::soup_of(list);
    const haptic_sculpt::Repair_report report = repair(first);
    if (report.steps.empty())
      continue;
    ++(run % 4 == 3 ? united : cut);
    for (int again = 0; again < 3; ++again) {
      const Scattered_memory memory(random);
      haptic_sculpt::Face_soup soup = haptic_sculpt::test::soup_of(list);
      repair(soup);
      BOOST_TEST(reading_and_writing::identical(soup, first), "mesh " << run);
    }
  }
  BOOST_TEST(haptic_sculpt::test::is_enough(cut, 20));
  BOOST_TEST(haptic_sculpt::test::is_enough(united, 10));
}

BOOST_AUTO_TEST_SUITE_END()
