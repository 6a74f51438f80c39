// SPDX-License-Identifier: GPL-3.0-or-later
// Whoever shares the work of axis moves and of validation: the same bits and reports with any number of threads, also
// where those were begun in another rounding mode.
#include "meshes/broken_meshes.h"
#include "sculpting/Random_scene.h"
#include "sculpting/motion/embedding_oracle_input.h"

#include <haptic_sculpt/sculpting.h>
#include <haptic_sculpt/surface.h>

#include <boost/test/unit_test.hpp>

#ifdef CGAL_LINKED_WITH_TBB
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>
#endif

#include <atomic>
#include <cfenv>
#include <chrono>
#include <thread>

using namespace haptic_sculpt;
using namespace haptic_sculpt::test;

namespace {

using Ways = std::vector<std::pair<Vertex_index, double>>;
using Points = std::vector<std::array<double, 3>>;

/// What came of some motions of a mesh, and of validating a broken one.
struct Threads_outcome {
  std::vector<Points> points;
  std::vector<std::vector<std::size_t>> numbers;
};

void note(Threads_outcome& outcome, const Mesh& mesh, std::vector<std::size_t> numbers) {
  Points& points = outcome.points.emplace_back();
  for (const Vertex_index v : mesh.vertices())
    points.push_back(vertex_coordinates(mesh, v));
  outcome.numbers.push_back(std::move(numbers));
}

/// Of the order of `size`; with many vertices they stand in each other's way.
template <class Tag>
void move_about(Threads_outcome& outcome, const meshes::Triangle_list& list, double size, double delta,
                std::uint64_t seed) {
  Mesh mesh = meshes::to_mesh(list);
  Sculptor<Mesh> sculptor(mesh, parameters::delta(delta));
  Random random(seed);
  std::uniform_real_distribution<double> number(-1, 1);
  for (const double length : {0.05, 1.0}) {
    for (int axis = 0; axis < 3; ++axis) {
      Ways ways;
      for (const Vertex_index v : mesh.vertices())
        ways.emplace_back(v, vertex_coordinates(mesh, v)[axis] + length * size * number(random));
      const auto result = sculptor.template shift<Tag>(axis, ways);
      std::vector<std::size_t> elements;
      if (!result)
        elements.assign(result.refusal->elements.begin(), result.refusal->elements.end());
      note(outcome, mesh, elements);
    }
    auto targets = mesh.add_property_map<Vertex_index, Point_3>("v:targets").first;
    for (const Vertex_index v : mesh.vertices())
      targets[v] =
          mesh.point(v) + length * size * meshes::Kernel::Vector_3(number(random), number(random), number(random));
    std::vector<std::size_t> left;
    const auto moved = move_vertices<Tag>(sculptor, mesh.vertices(), targets, Move_parameters().drags(false),
                                          std::back_inserter(left));
    left.push_back(moved.drags);
    note(outcome, mesh, left);
    Mesh other = mesh; // a bound on the pairs is asked of sums of what threads have counted
    Sculptor<Mesh> bounded(other, parameters::delta(delta));
    for (const std::size_t most : {20000, 100000}) {
      const auto report = move_vertices<Tag>(bounded, mesh.vertices(), targets, Move_parameters().most_pairs(most));
      note(outcome, other, {report.pairs, report.reached, report.out_of_work});
    }
  }
  const CGAL::Aff_transformation_3<meshes::Kernel> up(CGAL::TRANSLATION, {size, 20 * size, 0});
  std::vector<Vertex_index> half;
  for (const Vertex_index v : mesh.vertices())
    if (mesh.point(v).z() > 0)
      half.push_back(v);
  const auto rigid = move_rigidly<Tag>(sculptor, half, up);
  note(outcome, mesh, {rigid.contacts.size(), rigid.contacts.empty() ? 0 : std::size_t{rigid.contacts[0].vertices[0]}});
}

/// One dab of each kind that touches most of it, one after the other.
template <class Tag>
void dab_about(Threads_outcome& outcome, const meshes::Triangle_list& list, double size) {
  Mesh mesh = meshes::to_mesh(list);
  Sculptor<Mesh> sculptor(mesh);
  const Point_3 centre = mesh.point(Vertex_index(0));
  for (const Brush_kind kind :
       {Brush_kind::grab, Brush_kind::inflate, Brush_kind::smooth, Brush_kind::flatten, Brush_kind::pinch}) {
    const std::vector<Dab_3<meshes::Kernel>> dabs(2, {kind, centre, 1.5, kind == Brush_kind::smooth ? 0.5 : size, {}});
    const auto report = apply_brush<Tag>(sculptor, dabs);
    note(outcome, mesh, {report.asked, report.reached});
  }
}

template <class Tag>
void validate_about(Threads_outcome& outcome, const meshes::Triangle_list& list) {
  Face_soup soup;
  soup.points = list.points;
  for (const auto& f : list.faces)
    soup.add_face(f);
  for (const std::size_t most : {std::size_t{1}, std::size_t{10}, Validity_report::all_intersections}) {
    const auto report = validate_soup<Tag>(soup, 0, most);
    std::vector<std::size_t> numbers{report.has_more_intersections, report.is_valid()};
    for (const auto& [f, g] : report.intersecting_faces)
      numbers.push_back(f), numbers.push_back(g);
    outcome.numbers.push_back(numbers);
  }
}

template <class Tag>
Threads_outcome outcome_by(std::uint64_t seed) {
  Threads_outcome outcome;
  move_about<Tag>(outcome, meshes::bumpy_sphere(4, 0.2, 0.02), 0.06, 0, seed); // 5,120 faces
  move_about<Tag>(outcome, meshes::torus(80, 40), 0.05, 0.002, seed + 1);
  move_about<Tag>(outcome, meshes::box(20), 1.0 / 20, 0, seed + 2); // faces in planes along the axes
  move_about<Tag>(outcome, meshes::ball_in_a_cavity(3), 0.1, 0, seed + 3);
  dab_about<Tag>(outcome, meshes::bumpy_sphere(4, 0.2, 0.02), 0.4);
  validate_about<Tag>(outcome, meshes::bumpy_sphere(6, 0.2, 0.02)); // 81,920 faces: several slabs
  validate_about<Tag>(outcome, meshes::overlapping_balls(5));       // many pairs
  validate_about<Tag>(outcome, meshes::bipyramid(20000));           // long faces
  for (const auto& [name, list] : meshes::broken_meshes())
    validate_about<Tag>(outcome, list);
  return outcome;
}

} // namespace

BOOST_AUTO_TEST_CASE(threads_change_no_bit) {
  const std::uint64_t seed = seed_from_environment(29);
  const Threads_outcome expected = outcome_by<CGAL::Sequential_tag>(seed);
  const auto blocked = std::count_if(expected.numbers.begin(), expected.numbers.end(),
                                     [](const auto& numbers) { return numbers.size() > 2; });
  BOOST_TEST(blocked > 20); // refused, held back, or broken
#ifdef CGAL_LINKED_WITH_TBB
  for (const auto& [threads, mode] : {std::pair{4, FE_TONEAREST}, {2, FE_UPWARD}}) {
    const tbb::global_control most(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads));
    std::fesetround(mode); // threads take over the mode of the one that makes the arena
    tbb::task_arena arena(threads);
    arena.initialize();
    Threads_outcome found;
    arena.execute([&seed, &found] {
      std::fesetround(FE_TONEAREST); // what the test itself computes
      found = outcome_by<CGAL::Parallel_tag>(seed);
    });
    std::fesetround(FE_TONEAREST);
    BOOST_TEST((found.points == expected.points), threads << " threads, mode " << mode);
    BOOST_TEST((found.numbers == expected.numbers), threads << " threads, mode " << mode);
  }
#else
  BOOST_TEST_MESSAGE("oneTBB is not there: nothing is shared");
#endif
}

BOOST_AUTO_TEST_CASE(the_tag_serves_with_and_without_onetbb) {
  const Mesh mesh = meshes::to_mesh(meshes::overlapping_balls(3));
  const auto report = haptic_sculpt::validate<CGAL::Parallel_if_available_tag>(mesh);
  BOOST_TEST(!report.is_valid());
  BOOST_TEST((report.intersecting_faces == haptic_sculpt::validate(mesh).intersecting_faces));
}

#ifdef CGAL_LINKED_WITH_TBB
BOOST_AUTO_TEST_CASE(parts_round_to_nearest_and_throw_to_the_caller) {
  const auto run = Part_runner::by<CGAL::Parallel_tag>();
  std::atomic<int> parts_made = 0, rounded_otherwise = 0;
  std::fesetround(FE_UPWARD);
  tbb::task_arena arena(2); // its threads take over this mode
  arena.initialize();
  arena.execute([&] {
    run(1000, [&](std::size_t) {
      ++parts_made;
      rounded_otherwise += std::fegetround() != FE_TONEAREST;
    });
  });
  BOOST_TEST(std::fegetround() == FE_UPWARD);
  std::fesetround(FE_TONEAREST);
  BOOST_TEST(parts_made == 1000);
  BOOST_TEST(rounded_otherwise == 0);
  for (const std::size_t parts : {1, 2, 1000})
    BOOST_CHECK_THROW(run(parts,
                          [](std::size_t k) {
                            if (k == 0)
                              throw Invalid_parameter("on purpose");
                          }),
                      Invalid_parameter);
}

// A thread that waits for what others do of a call begins no other task of the caller's, which might ask for the same
// Sculptor, or for the mutex that guards it.
BOOST_AUTO_TEST_CASE(no_other_task_begins_within_a_call) {
  const tbb::global_control more(tbb::global_control::max_allowed_parallelism, 4); // however few processors there are
  const auto run = Part_runner::by<CGAL::Parallel_tag>();
  std::atomic<int> begun_within = 0, calls = 0;
  static thread_local bool is_within = false;
  tbb::task_arena arena(4);
  arena.execute([&] {
    tbb::parallel_for(std::size_t{0}, std::size_t{1000}, [&](std::size_t call) {
      begun_within += is_within;
      const bool was_within = std::exchange(is_within, true);
      run(3, [&](std::size_t k) { // uneven: some wait for others
        std::this_thread::sleep_for(std::chrono::microseconds((7 * call + 5 * k) % 11 * 20));
      });
      is_within = was_within;
      ++calls;
    });
  });
  BOOST_TEST(calls == 1000);
  BOOST_TEST(begun_within == 0);
}
#endif
