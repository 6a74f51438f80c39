// SPDX-License-Identifier: GPL-3.0-or-later
// A bound on the pairs of a call that moves many vertices: the count against one of the test's own, the same bits and
// the same count with any broad phase, and what a bounded call leaves.
#include "sculpting/many_vertices/many_vertices_scene.h"
#include "sculpting/motion/same_bits.h"

#include <haptic_sculpt/sculpting/paper_1997/Six_list_broad_phase.h>
#include <haptic_sculpt/surface/broad_phase/Brute_force_broad_phase.h>

#include <algorithm>
#include <array>
#include <random>
#include <set>

using namespace haptic_sculpt;
using namespace haptic_sculpt::test;

namespace {

constexpr std::size_t unbounded = std::numeric_limits<std::size_t>::max();

/// Targets by index.
using Points = std::vector<Point_3>;

/// What the documents say a move along one axis counts when it is free, over all pairs of faces.
class Own_count {
public:
  Own_count(const Mesh& mesh, const Points& targets, int axis) : mesh_(mesh), targets_(targets), axis_(axis) {
    std::size_t moving = 0;
    for (const Vertex_index v : mesh.vertices())
      moving += does_move(v);
    are_many_ = 8 * moving >= mesh.number_of_vertices();
  }

  std::size_t operator()() const {
    std::size_t count = 0;
    for (const Face_index f : mesh_.faces()) {
      count += does_move(f);
      for (const Face_index g : mesh_.faces())
        count += f < g && (does_move(f) || does_move(g)) && does_count(f, g);
    }
    return count;
  }

private:
  const Mesh& mesh_;
  const Points& targets_;
  int axis_;
  bool are_many_;

  bool does_move(Vertex_index v) const { return mesh_.point(v) != targets_[v]; }
  std::array<Vertex_index, 3> corners(Face_index f) const {
    const auto h = mesh_.halfedge(f);
    return {mesh_.target(h), mesh_.target(mesh_.next(h)), mesh_.source(h)};
  }
  bool does_move(Face_index f) const {
    const auto v = corners(f);
    return does_move(v[0]) || does_move(v[1]) || does_move(v[2]);
  }
  int side(Face_index f) const {
    const auto seen = [&](Vertex_index v) {
      const Point_3& p = mesh_.point(v);
      return meshes::Kernel::Point_2(p[(axis_ + 1) % 3], p[(axis_ + 2) % 3]);
    };
    const auto v = corners(f);
    return CGAL::orientation(seen(v[0]), seen(v[1]), seen(v[2]));
  }
  bool is_unfolded(Vertex_index v) const {
    std::set<int> sides;
    for (const Face_index f : mesh_.faces_around_target(mesh_.halfedge(v)))
      sides.insert(side(f));
    return (are_many_ || does_move(v)) && sides.size() == 1 && *sides.begin() != 0;
  }
  /// The interval of a coordinate, at the start or at the end.
  std::pair<double, double> interval(Face_index f, int k, bool at_end) const {
    const auto at = [&](Vertex_index v) { return (at_end ? targets_[v] : mesh_.point(v))[k]; };
    const auto v = corners(f);
    return std::minmax({at(v[0]), at(v[1]), at(v[2])});
  }
  bool does_count(Face_index f, Face_index g) const {
    std::vector<Vertex_index> shared;
    for (const Vertex_index v : corners(f))
      for (const Vertex_index w : corners(g))
        if (v == w)
          shared.push_back(v);
    if (!shared.empty())
      return side(f) == 0 || side(f) != side(g) || (shared.size() == 1 && !is_unfolded(shared[0]));
    bool f_is_below = true, g_is_below = true;
    for (const bool at_end : {false, true})
      for (int k = 0; k < 3; ++k) {
        const auto a = interval(f, k, at_end), b = interval(g, k, at_end);
        if (k == axis_)
          f_is_below &= a.second < b.first, g_is_below &= b.second < a.first;
        else if (a.second < b.first || b.second < a.first)
          return false;
      }
    return !f_is_below && !g_is_below;
  }
};

/// A mesh of its own, and calls one after the other.
template <class Broad_phase = Box_tree_broad_phase<Mesh>>
class Player {
public:
  Player(const Mesh& mesh, Points targets) : mesh_(mesh), targets_(std::move(targets)), sculptor_(mesh_) {}

  const Mesh& mesh() const { return mesh_; }
  auto& sculptor() { return sculptor_; }
  Move_report move(const Move_parameters& parameters) {
    auto map = mesh_.template add_property_map<Vertex_index, Point_3>("v:target").first;
    for (const Vertex_index v : mesh_.vertices())
      map[v] = targets_[v];
    const auto report = move_vertices(sculptor_, mesh_.vertices(), map, parameters);
    mesh_.remove_property_map(map);
    return report;
  }

private:
  Mesh mesh_;
  Points targets_;
  Sculptor<Mesh, Broad_phase> sculptor_;
};

/// All, or those on one side, by up to a length along each axis or along one.
Points targets_of(const Mesh& mesh, std::mt19937_64& random, double length, bool are_all, int axis = -1) {
  Points targets;
  for (const Vertex_index v : mesh.vertices()) {
    std::array<double, 3> d;
    for (double& x : d)
      x = std::uniform_real_distribution<double>(-length, length)(random);
    for (int k = 0; k < 3; ++k)
      if (axis != -1 && k != axis)
        d[k] = 0;
    const bool moves = are_all || static_cast<std::size_t>(v) < mesh.number_of_vertices() / 16;
    targets.push_back(moves ? mesh.point(v) + Vector_3(d[0], d[1], d[2]) : mesh.point(v));
  }
  return targets;
}

bool same(const Move_report& a, const Move_report& b) {
  return a.reached == b.reached && a.drags == b.drags && a.counted == b.counted && a.pairs == b.pairs &&
         a.out_of_work == b.out_of_work && same_bits(a.left_l2, b.left_l2) && same_bits(a.left_max, b.left_max);
}

/// The same calls with another broad phase.
template <class Broad_phase>
void check_same(const char* which, const Mesh& mesh, const Points& targets, const Move_parameters& parameters,
                const std::vector<Move_report>& reports, const Mesh& end) {
  Player<Broad_phase> player(mesh, targets);
  for (const Move_report& report : reports) {
    const Move_report other = player.move(parameters);
    BOOST_TEST(same(report, other), which << ": " << report.pairs << " and " << other.pairs << " pairs");
  }
  BOOST_TEST(same_bits(player.mesh(), end), which);
}

} // namespace

BOOST_AUTO_TEST_CASE(a_free_move_counts_what_the_documents_say) {
  const std::uint64_t seed = seed_from_environment(81);
  std::mt19937_64 random(seed);
  std::size_t checked = 0, folded = 0;
  for (const auto& [name, mesh] : scenes(false))
    for (int axis = 0; axis < 3; ++axis)
      for (const bool are_all : {true, false}) {
        const Points targets = targets_of(mesh, random, 0.05 * mean_edge(mesh), are_all, axis);
        Player<> player(mesh, targets);
        const Move_report report = player.move(Move_parameters().drags(false).most_pairs(unbounded));
        if (report.left() != 0)
          continue; // more rounds
        const std::size_t expected = Own_count(mesh, targets, axis)();
        BOOST_TEST(report.pairs == expected, name << ", axis " << axis << ", seed " << seed);
        ++checked, folded += expected > mesh.number_of_faces();
        // What does not count leaves the report alone, and what does changes no result.
        Player<> other(mesh, targets);
        BOOST_TEST(other.move(Move_parameters().drags(false)).pairs == 0u);
        BOOST_TEST(same_bits(player.mesh(), other.mesh()));
      }
  BOOST_TEST_MESSAGE("seed " << seed << ": " << checked << " moves");
  BOOST_TEST(checked >= 20u);
  BOOST_TEST(folded >= 10u);
}

BOOST_AUTO_TEST_CASE(a_bounded_call_knows_no_broad_phase) {
  const std::uint64_t seed = seed_from_environment(82);
  std::mt19937_64 random(seed);
  std::size_t ended = 0, runs = 0;
  const auto all_scenes = scenes(false);
  for (std::size_t k = 0; k < all_scenes.size(); k += 2) // six lists and brute force take their time
    for (const bool are_all : {true, false}) {
      const auto& [name, mesh] = all_scenes[k];
      const Points targets = targets_of(mesh, random, 1.2 * mean_edge(mesh), are_all);
      for (const bool drags : {true, false}) {
        Player<> whole(mesh, targets), counted(mesh, targets);
        const auto options = Move_parameters().drags(drags).most_drags(4 * mesh.number_of_vertices());
        const Move_report free = whole.move(options);
        const Move_report all = counted.move(Move_parameters(options).most_pairs(unbounded));
        BOOST_TEST(same_bits(whole.mesh(), counted.mesh()), name);
        BOOST_TEST((free.drags == all.drags && free.out_of_work == all.out_of_work));
        // Looking ahead takes at most half of what is left, so a bound that is just enough is not as none.
        for (const std::size_t bound :
             {std::size_t{0}, std::size_t{1}, all.pairs / 7, all.pairs / 2, 1000 * all.pairs + 1}) {
          BOOST_TEST_CONTEXT(name << ", bound " << bound << " of " << all.pairs << ", seed " << seed) {
            const auto bounded = Move_parameters(options).most_pairs(bound);
            Player<> player(mesh, targets);
            std::vector<Move_report> reports;
            for (int call = 0; call < (bound > all.pairs ? 1 : 2); ++call) {
              reports.push_back(player.move(bounded));
              BOOST_TEST(reports.back().pairs <= bound);
              ended += reports.back().out_of_work, ++runs;
            }
            if (bound == 0)
              BOOST_TEST((same_bits(player.mesh(), mesh) && (reports[0].out_of_work == (reports[0].left() != 0))));
            if (bound > all.pairs) // as without
              BOOST_TEST(same(reports[0], all));
            else
              BOOST_TEST((reports[0].left() == 0 || reports[0].out_of_work));
            BOOST_TEST(validate(player.mesh()).is_valid());
            check_same<Six_list_broad_phase<Mesh>>("six lists", mesh, targets, bounded, reports, player.mesh());
            check_same<Brute_force_broad_phase<Mesh>>("brute force", mesh, targets, bounded, reports, player.mesh());
          }
        }
      }
    }
  BOOST_TEST_MESSAGE("seed " << seed << ": " << ended << " of " << runs << " calls ended by a bound");
  BOOST_TEST(ended > runs / 4);
}

BOOST_AUTO_TEST_CASE(the_same_call_again_goes_on) {
  // Each bound serves for the move along one axis at least.
  const Mesh mesh = meshes::to_mesh(meshes::bumpy_sphere(3, 0.3, 0.05));
  Points targets;
  for (const Vertex_index v : mesh.vertices())
    targets.push_back(mesh.point(v) + 2 * mean_edge(mesh) * Vector_3(1, 0.7, -0.3));
  Player<> whole(mesh, targets);
  const std::size_t pairs = whole.move(Move_parameters().most_pairs(unbounded)).pairs;
  BOOST_TEST(pairs > 0u);
  for (const std::size_t bound : {pairs / 2, 2 * pairs / 3}) {
    Player<> player(mesh, targets);
    const Mesh_snapshot before = snapshot(player.sculptor());
    double left = std::numeric_limits<double>::infinity();
    int calls = 0;
    for (bool is_there = false; !is_there && calls < 20; ++calls) {
      const Move_report report = player.move(Move_parameters().most_pairs(bound));
      is_there = report.left() == 0;
      BOOST_TEST(report.out_of_work == !is_there);
      BOOST_TEST(report.pairs <= bound);
      BOOST_REQUIRE(report.left_l2 < left);
      left = report.left_l2;
      BOOST_TEST(validate(player.mesh()).is_valid());
    }
    BOOST_TEST(left == 0);
    BOOST_TEST(calls >= 2);
    for (int call = 0; call < calls; ++call) // each is one step
      player.sculptor().undo();
    BOOST_TEST((snapshot(player.sculptor()) == before));
  }
}

BOOST_AUTO_TEST_CASE(what_takes_these_parameters_takes_the_bound) {
  const Mesh start = meshes::to_mesh(meshes::bumpy_sphere(3, 0.3, 0.05));
  const double l = mean_edge(start);
  const auto by = [&](auto&& call) {
    Mesh mesh = start;
    Sculptor<Mesh> sculptor(mesh);
    const auto report = call(sculptor, Move_parameters().drags(false).most_pairs(unbounded));
    BOOST_TEST(report.pairs > start.number_of_faces() / 100);
    BOOST_TEST(!report.out_of_work);
    for (const std::size_t bound : {std::size_t{0}, report.pairs / 2, report.pairs}) {
      Mesh copy = start;
      Sculptor<Mesh> other(copy);
      const auto bounded = call(other, Move_parameters().drags(false).most_pairs(bound));
      BOOST_TEST(bounded.pairs <= bound);
      BOOST_TEST(bounded.out_of_work == (bound < report.pairs));
      BOOST_TEST(same_bits(copy, mesh) == (bound == report.pairs));
      BOOST_TEST(same_bits(copy, start) == (bound == 0));
      BOOST_TEST(validate(copy).is_valid());
    }
  };
  by([&](auto& sculptor, const Move_parameters& parameters) {
    const Dab_3<meshes::Kernel> dab{Brush_kind::grab, start.point(Vertex_index(3)), 5 * l, l, Vector_3(1, 2, 3)};
    return apply_brush(sculptor, std::array{dab}, boost::static_property_map<double, Vertex_index>(1.0), parameters);
  });
  by([&](auto& sculptor, const Move_parameters& parameters) {
    return apply_guarded(
        sculptor,
        [&](auto& mesh, auto map) {
          for (const Vertex_index v : mesh.vertices())
            put(map, v, get(map, v) + 3 * l * Vector_3(1, 1, 1));
        },
        parameters);
  });
}

BOOST_AUTO_TEST_CASE(an_object_stops_where_the_bound_ends_it) {
  meshes::Triangle_list list = meshes::icosphere(2);
  const std::size_t own = list.points.size();
  list += meshes::icosphere(2).transform([](const Point_3& p) { return p + Vector_3(4, 0, 0); });
  const Mesh start = meshes::to_mesh(list);
  std::vector<Vertex_index> ball;
  for (std::size_t v = 0; v < own; ++v)
    ball.emplace_back(static_cast<Mesh::size_type>(v));
  const CGAL::Aff_transformation_3<meshes::Kernel> far(CGAL::TRANSLATION, Vector_3(6, 0.1, 0));
  const auto moved = [&](const Move_parameters& parameters) {
    Mesh mesh = start;
    Sculptor<Mesh> sculptor(mesh);
    const auto report = move_rigidly(sculptor, ball, far, parameters);
    for (std::size_t v = 0; v < own; ++v) {
      const Point_3 &p = start.point(ball[v]), &q = mesh.point(ball[v]);
      BOOST_TEST(std::abs(q.x() - p.x() - 6 * report.share) < 1e-12);
    }
    BOOST_TEST(validate(mesh).is_valid());
    return report;
  };
  const auto whole = moved(Move_parameters()), counted = moved(Move_parameters().most_pairs(unbounded));
  BOOST_TEST((whole.share > 0 && whole.share < 1 && !whole.contacts.empty() && whole.pairs == 0 && !whole.out_of_work));
  BOOST_TEST((counted.share == whole.share && counted.contacts.size() == whole.contacts.size()));
  for (const std::size_t bound : {std::size_t{0}, std::size_t{1}, counted.pairs / 2, counted.pairs - 1}) {
    const auto report = moved(Move_parameters().most_pairs(bound));
    BOOST_TEST((report.out_of_work && report.contacts.empty() && report.pairs <= bound && report.share <= whole.share));
  }
  const auto all = moved(Move_parameters().most_pairs(counted.pairs));
  BOOST_TEST((!all.out_of_work && all.share == whole.share && all.contacts.size() == whole.contacts.size()));
  // The other two limits.
  const auto one = moved(Move_parameters().most_drags(own));
  BOOST_TEST((one.out_of_work && one.drags == own && one.share == 0));
  std::size_t calls = 0;
  const auto cancelled = moved(Move_parameters().progress([&](const Move_progress&) { return ++calls < 4; }));
  BOOST_TEST((cancelled.cancelled && !cancelled.out_of_work && calls == 4 && cancelled.contacts.empty()));
}
