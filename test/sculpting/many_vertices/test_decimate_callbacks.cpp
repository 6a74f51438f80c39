// SPDX-License-Identifier: GPL-3.0-or-later
// Decimation and what it calls: policies, visitors. What was drawn for nothing goes back, whatever they do.
#include "sculpting/many_vertices/Policy_optional.h"

#include <haptic_sculpt/sculpting/decimate.h>
#include <haptic_sculpt/surface.h>

#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Midpoint_placement.h>

#include <meshes/generated_meshes.h>
#include <surface/identical.h>

#include <boost/property_map/function_property_map.hpp>
#include <boost/test/unit_test.hpp>

#include <cmath>
#include <functional>
#include <limits>
#include <set>
#include <string>
#include <utility>

namespace SMS = CGAL::Surface_mesh_simplification;
using haptic_sculpt::Policy_optional;
using haptic_sculpt::Sculptor;
using meshes::Mesh;

namespace {

/// Compares where the points of a profile are with where they were when it was made.
struct Watching_policy {
  using Update_tag = CGAL::Tag_true;
  int *moved, *heard;
  template <class... Others>
  void initialize(const Mesh&, const Others&...) const {}
  template <class Profile, class Placement>
  Policy_optional<double> operator()(const Profile& profile, const Placement&) const {
    return Policy_optional<double>(CGAL::squared_distance(profile.p0(), profile.p1()));
  }
  template <class Profile>
  void update_after_collapse(const Profile& profile, Mesh::Vertex_index) const {
    const auto* const now = profile.surface_mesh().points().data() + std::size_t(profile.v0());
    *moved += &profile.p0() != now, ++*heard;
  }
};

} // namespace

BOOST_AUTO_TEST_SUITE(decimation)

// Where the draw mends altitudes that a delta would not let be so low again.
BOOST_AUTO_TEST_CASE(what_was_drawn_for_nothing_goes_back_whatever_delta_is) {
  Mesh mesh;
  const auto a = mesh.add_vertex({-1, -1, 0}), b = mesh.add_vertex({1, -1, 0}), c = mesh.add_vertex({0, 1, 0}),
             top = mesh.add_vertex({0, 0, 1});
  mesh.add_face(a, c, b), mesh.add_face(a, b, top), mesh.add_face(b, c, top), mesh.add_face(c, a, top);
  Sculptor<Mesh> sculptor(mesh);
  BOOST_REQUIRE(sculptor.drag(top, {0, -0.9, 0.1}).reached);
  BOOST_REQUIRE(sculptor.drag(top, {0, 0, 1}).reached);
  sculptor.set_delta(0.5);
  BOOST_REQUIRE(static_cast<bool>(sculptor.undo()));
  const Mesh before = mesh;
  const auto cost = [](const auto& profile, const auto&) {
    return Policy_optional<double>(CGAL::squared_distance(profile.p0(), profile.p1()));
  };
  const auto placement = [](const auto&) { return Policy_optional<meshes::Point_3>(meshes::Point_3(0, 0, 2)); };
  const auto report = haptic_sculpt::decimate(
      sculptor, [](const auto&, const auto&, std::size_t, std::size_t) { return false; },
      CGAL::parameters::get_cost(cost).get_placement(placement));
  BOOST_TEST(report.collapsed == 0u);
  BOOST_TEST(report.refused > 0u);
  BOOST_TEST(reading_and_writing::identical(mesh, before));
  BOOST_TEST(sculptor.history().number_of_undo_steps() == 1u);
  BOOST_TEST(sculptor.history().number_of_redo_steps() == 1u);
  BOOST_TEST(sculptor.parameters().delta_length > 0);
}

BOOST_AUTO_TEST_CASE(what_was_drawn_goes_back_where_a_visitor_keeps_the_collapse_from_being_made) {
  struct Throwing_visitor : haptic_sculpt::Default_edit_visitor {
    bool throws_at_draws = false;
    void vertex_moved(Mesh::Vertex_index) {
      if (throws_at_draws)
        throw haptic_sculpt::Error("the visitor throws");
    }
    void edge_dies(Mesh::Edge_index) { throw haptic_sculpt::Error("the visitor throws"); }
  };
  for (const bool throws_at_draws : {false, true}) {
    Mesh mesh = meshes::to_mesh(meshes::bumpy_sphere(2, 0.3));
    const Mesh before = mesh;
    Throwing_visitor visitor;
    visitor.throws_at_draws = throws_at_draws;
    Sculptor<Mesh, haptic_sculpt::Box_tree_broad_phase<Mesh>, Throwing_visitor> sculptor(mesh, {}, visitor);
    const auto never = [](const auto&, const auto&, std::size_t, std::size_t) { return false; };
    BOOST_CHECK_THROW(haptic_sculpt::decimate(sculptor, never), haptic_sculpt::Error);
    BOOST_TEST(reading_and_writing::identical(mesh, before));
    BOOST_TEST(sculptor.history().number_of_undo_steps() == 0u);
  }
}

BOOST_AUTO_TEST_CASE(a_visitor_sees_the_parameters_that_were_set) {
  struct Watching_visitor : haptic_sculpt::Default_edit_visitor {
    const haptic_sculpt::Sculptor_parameters* parameters = nullptr;
    std::size_t moves = 0, others = 0;
    void vertex_moved(Mesh::Vertex_index) { ++moves, others += parameters->delta_length != 0x1p-10; }
  };
  Mesh mesh = meshes::to_mesh(meshes::bumpy_sphere(2, 0.3));
  Sculptor<Mesh, haptic_sculpt::Box_tree_broad_phase<Mesh>, Watching_visitor> sculptor(mesh);
  sculptor.set_delta(0x1p-10);
  sculptor.visitor().parameters = &sculptor.parameters();
  // Places beside the surface: many a draw is for nothing, and goes back.
  const auto placement = [](const auto& profile) {
    return Policy_optional<meshes::Point_3>(CGAL::midpoint(profile.p0(), profile.p1()) +
                                            meshes::Kernel::Vector_3(0.2, 0, 0));
  };
  const auto stop = [](const auto&, const auto&, std::size_t, std::size_t edges) { return edges < 100; };
  const auto report = haptic_sculpt::decimate(sculptor, stop, CGAL::parameters::get_placement(placement));
  BOOST_TEST(report.refused > 0u);
  BOOST_TEST(sculptor.visitor().moves > 0u);
  BOOST_TEST(sculptor.visitor().others == 0u);
}

BOOST_AUTO_TEST_CASE(policies_may_not_edit) {
  for (const std::string asked : {"stop", "cost", "placement", "constraint"})
    BOOST_TEST_CONTEXT(asked) {
      Mesh mesh = meshes::to_mesh(meshes::bumpy_sphere(2, 0.3));
      const Mesh before = mesh;
      Sculptor<Mesh> sculptor(mesh);
      std::size_t calls = 0;
      const auto edit = [&](const char* here) {
        if (asked == here && ++calls == 40)
          sculptor.undo();
      };
      using Profile =
          SMS::Edge_profile<const Mesh, boost::property_map<Mesh, CGAL::vertex_point_t>::const_type, meshes::Kernel>;
      const auto stop = [&](double, const Profile&, std::size_t, std::size_t edges) {
        edit("stop");
        return edges < 100;
      };
      const auto cost = [&](const Profile& profile, const Policy_optional<meshes::Point_3>&) {
        edit("cost");
        return Policy_optional<double>(CGAL::squared_distance(profile.p0(), profile.p1()));
      };
      const auto placement = [&](const Profile& profile) {
        edit("placement");
        return Policy_optional<meshes::Point_3>(CGAL::midpoint(profile.p0(), profile.p1()));
      };
      const std::function<bool(Mesh::Edge_index)> constraint = [&](Mesh::Edge_index) {
        edit("constraint");
        return false;
      };
      BOOST_CHECK_THROW(
          haptic_sculpt::decimate(sculptor, stop,
                                  CGAL::parameters::get_cost(cost).get_placement(placement).edge_is_constrained_map(
                                      boost::make_function_property_map<Mesh::Edge_index>(constraint))),
          haptic_sculpt::Reentrant_call);
      BOOST_TEST(haptic_sculpt::validate(mesh).is_valid());
      sculptor.check_unchanged();
      sculptor.undo(); // what was done by then is one step, or none
      BOOST_TEST(mesh.number_of_faces() == before.number_of_faces());
      BOOST_TEST(sculptor.history().number_of_undo_steps() == 0u);
    }
}

// An edge without a cost stays, whether an end of it has to stay or not; what is not finite is none.
BOOST_AUTO_TEST_CASE(what_has_no_cost_is_not_collapsed_beside_constrained_edges_either) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();
  for (const Policy_optional<double>& none :
       {Policy_optional<double>(), Policy_optional<double>(nan), Policy_optional<double>(infinity)}) {
    Mesh mesh = meshes::to_mesh(meshes::icosphere(1));
    const auto fixed = *mesh.edges().begin();
    auto map = mesh.add_property_map<Mesh::Edge_index, bool>("e:constrained", false).first;
    map[fixed] = true;
    const std::set<Mesh::Vertex_index> ends{mesh.vertex(fixed, 0), mesh.vertex(fixed, 1)};
    Sculptor<Mesh> sculptor(mesh);
    const auto cost = [&](const auto& profile, const Policy_optional<meshes::Point_3>&) {
      return ends.count(profile.v0()) + ends.count(profile.v1()) != 0
                 ? none
                 : Policy_optional<double>(CGAL::squared_distance(profile.p0(), profile.p1()));
    };
    std::size_t asked = 0;
    const auto stop = [&](double of, const auto& profile, std::size_t, std::size_t) {
      asked += !std::isfinite(of) || ends.count(profile.v0()) + ends.count(profile.v1()) != 0;
      return false;
    };
    const auto report = haptic_sculpt::decimate(
        sculptor, stop,
        CGAL::parameters::get_cost(cost).get_placement(SMS::Midpoint_placement<Mesh>()).edge_is_constrained_map(map));
    BOOST_TEST(report.collapsed > 5u);
    BOOST_TEST(asked == 0u);
    BOOST_TEST(haptic_sculpt::validate(mesh).is_valid());
  }
}

// Nor does an edge go into an end where it has none, when its placement is refused: of these edges one end has a cost.
BOOST_AUTO_TEST_CASE(an_edge_does_not_go_into_an_end_without_a_cost) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  Mesh mesh = meshes::to_mesh(meshes::icosphere(1));
  Sculptor<Mesh> sculptor(mesh);
  const auto is_dear = [](const meshes::Point_3& p) { return p.z() < 0; };
  const auto number_of_others = [&] {
    std::size_t count = 0;
    for (const auto v : mesh.vertices())
      count += !is_dear(mesh.point(v));
    return count;
  };
  const auto cost = [&](const auto& profile, const Policy_optional<meshes::Point_3>& p) {
    const bool is_mixed = is_dear(profile.p0()) != is_dear(profile.p1());
    return Policy_optional<double>(is_mixed && p && !is_dear(*p) ? 1.0 : nan);
  };
  const auto placement = [&](const auto& profile) { // beyond the middle of the ball: it is refused
    const meshes::Point_3 middle = CGAL::midpoint(profile.p0(), profile.p1());
    return Policy_optional<meshes::Point_3>(meshes::Point_3(-3 * middle.x(), -3 * middle.y(), 3));
  };
  const std::size_t before = number_of_others();
  const auto report = haptic_sculpt::decimate(
      sculptor, [](const auto&, const auto&, std::size_t, std::size_t now) { return now < 60; },
      CGAL::parameters::get_cost(cost).get_placement(placement));
  BOOST_TEST(report.collapsed > 3u);
  BOOST_TEST(number_of_others() == before);
}

// A policy asks for each edge anew where something about it has changed, and only once.
BOOST_AUTO_TEST_CASE(no_edge_is_asked_of_twice_between_two_collapses) {
  Mesh mesh = meshes::to_mesh(meshes::bumpy_sphere(2, 0.1));
  Sculptor<Mesh> sculptor(mesh);
  std::set<Mesh::Edge_index> asked;
  bool is_of_stop = false; // the edge that is to be collapsed, whose index may be used again
  int twice = 0, collapses = 0;
  const auto cost = [](const auto& profile, const auto&) {
    return Policy_optional<double>(CGAL::squared_distance(profile.p0(), profile.p1()));
  };
  const SMS::Midpoint_placement<Mesh> midpoint;
  const auto placement = [&](const auto& profile) {
    if (!std::exchange(is_of_stop, false))
      twice += !asked.insert(mesh.edge(profile.v0_v1())).second;
    return midpoint(profile);
  };
  haptic_sculpt::decimate(
      sculptor,
      [&](const auto&, const auto&, std::size_t, std::size_t now) {
        ++collapses, asked.clear(), is_of_stop = true;
        return now < 300;
      },
      CGAL::parameters::get_cost(cost).get_placement(placement));
  BOOST_TEST(collapses > 50);
  BOOST_TEST(twice == 0);
}

// Its profile refers to the points.
BOOST_AUTO_TEST_CASE(what_a_policy_is_told_of_stays_where_it_is_also_where_no_garbage_is_used_again) {
  int moved = 0, heard = 0;
  Mesh mesh = meshes::to_mesh(meshes::bumpy_sphere(2, 0.1));
  mesh.set_recycle_garbage(false);
  Sculptor<Mesh> sculptor(mesh);
  const auto report = haptic_sculpt::decimate(
      sculptor, [](const auto&, const auto&, std::size_t, std::size_t now) { return now < 100; },
      CGAL::parameters::get_cost(Watching_policy{&moved, &heard}).get_placement(SMS::Midpoint_placement<Mesh>()));
  BOOST_TEST(report.collapsed > 50u);
  BOOST_TEST(std::size_t(heard) == report.collapsed);
  BOOST_TEST(moved == 0);
}

BOOST_AUTO_TEST_SUITE_END()
