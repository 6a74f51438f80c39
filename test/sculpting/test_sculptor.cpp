// SPDX-License-Identifier: GPL-3.0-or-later
// What the facade promises beside geometry.
#include "sculpting/Random_scene.h"

#include <haptic_sculpt/sculpting/paper_1997.h>
#include <haptic_sculpt/surface/broad_phase/Brute_force_broad_phase.h>

#include <boost/test/unit_test.hpp>

#include <cmath>
#include <limits>
#include <memory>
#include <new>
#include <set>

using namespace haptic_sculpt;
using namespace haptic_sculpt::test;

namespace {

/// Traits that see nothing, and count how often they are asked.
class Blind_traits : public Exact_sweep_traits<Mesh> {
public:
  struct Sweep {
    std::size_t* asked;

    template <class... Points>
    std::optional<Impact_3> operator()(const Points&...) const { return ++*asked, std::nullopt; }
    template <class... Points>
    bool do_collide(const Points&...) const { return ++*asked, false; }
  };
  using Vertex_face_sweep_3 = Sweep;
  using Edge_edge_sweep_3 = Sweep;
  using Face_vertex_sweep_3 = Sweep;

  explicit Blind_traits(std::size_t& asked) : asked_(&asked) {}
  Sweep vertex_face_sweep_3_object() const { return {asked_}; }
  Sweep edge_edge_sweep_3_object() const { return {asked_}; }
  Sweep face_vertex_sweep_3_object() const { return {asked_}; }

private:
  std::size_t* asked_;
};

/// Traits whose functors refer to them, and ask whether they live.
class Own_traits : public Exact_sweep_traits<Mesh> {
public:
  static inline std::set<const Own_traits*> living;
  static inline std::size_t asked = 0, asked_of_dead = 0;

  struct Sweep {
    const Own_traits* traits;

    template <class... Points>
    std::optional<Impact_3> operator()(const Points&...) const {
      return ask(), std::nullopt;
    }
    template <class... Points>
    bool do_collide(const Points&...) const {
      return ask(), false;
    }
    void ask() const { ++asked, asked_of_dead += living.count(traits) == 0; }
  };
  using Vertex_face_sweep_3 = Sweep;
  using Edge_edge_sweep_3 = Sweep;
  using Face_vertex_sweep_3 = Sweep;

  Own_traits() { living.insert(this); }
  Own_traits(const Own_traits& other) : Exact_sweep_traits<Mesh>(other) { living.insert(this); }
  ~Own_traits() { living.erase(this); }
  Sweep vertex_face_sweep_3_object() const { return {this}; }
  Sweep edge_edge_sweep_3_object() const { return {this}; }
  Sweep face_vertex_sweep_3_object() const { return {this}; }
};

} // namespace

BOOST_AUTO_TEST_CASE(an_invalid_mesh_is_refused_and_named) {
  Mesh mesh = ball();
  mesh.point(Vertex_index(3)) = mesh.point(Vertex_index(7));
  BOOST_CHECK_EXCEPTION(Sculptor<Mesh>{mesh}, Invalid_surface, [](const Invalid_surface& error) {
    return error.report().coincident_vertices.size() == 1 && std::string(error.what()).find('7') != std::string::npos;
  });
  Mesh open = ball();
  CGAL::Euler::remove_face(open.halfedge(*open.faces().begin()), open);
  BOOST_CHECK_EXCEPTION(Sculptor<Mesh>{open}, Invalid_surface,
                        [](const Invalid_surface& error) { return error.report().boundary_edges.size() == 3; });
}

BOOST_AUTO_TEST_CASE(bad_arguments_are_refused_and_change_nothing) {
  Mesh mesh = ball();
  BOOST_CHECK_THROW(Sculptor<Mesh>(mesh, parameters::clearance(0)), Invalid_parameter);
  BOOST_CHECK_THROW(Sculptor<Mesh>(mesh, parameters::clearance(1e-9).delta(-1)), Invalid_parameter);
  BOOST_CHECK_THROW(Sculptor<Mesh>(mesh, parameters::delta(10)), Invalid_surface);
  meshes::Triangle_list list = meshes::box(1, 1);
  Mesh far = meshes::to_mesh(list.scale_and_move(1, 0x1p50, 0, 0)); // an ulp there is a quarter of its extent
  BOOST_CHECK_EXCEPTION(Sculptor<Mesh>(far, parameters::clearance(0.25)), Invalid_parameter, [](const Error& error) {
    return std::string(error.what()).find("no clearance serves this scene") == 0;
  });
  Sculptor<Mesh> sculptor(mesh);
  BOOST_CHECK_THROW(sculptor.grab(Vertex_index(4711)), Unknown_vertex);
  BOOST_CHECK_THROW(sculptor.grab(Vertex_index()), Unknown_vertex);
  auto grab = sculptor.grab(Vertex_index(0));
  const Point_3 before = mesh.point(Vertex_index(0));
  const double infinity = std::numeric_limits<double>::infinity();
  BOOST_CHECK_THROW(grab.drag_to(Point_3(infinity, 0, 0)), Non_finite_point);
  BOOST_CHECK_THROW(grab.drag_to(Point_3(0, std::nan(""), 0)), Non_finite_point);
  BOOST_CHECK_THROW(sculptor.set_delta(10), Invalid_surface);
  BOOST_CHECK_THROW(sculptor.set_drag_parameters(Drag_parameters().clearance(-1)), Invalid_parameter);
  BOOST_TEST((mesh.point(Vertex_index(0)) == before));
  BOOST_TEST(sculptor.parameters().delta_length == 0);
  BOOST_TEST(grab.drag_to(before).reached);
}

BOOST_AUTO_TEST_CASE(delta_changes_between_steps_of_the_history_only) {
  Mesh mesh = ball();
  Sculptor<Mesh> sculptor(mesh);
  const Vertex_index v(0);
  const Point_3 near(0.99 * mesh.point(v).x(), 0.99 * mesh.point(v).y(), 0.99 * mesh.point(v).z());
  auto grab = sculptor.grab(v);
  {
    const auto stroke = sculptor.stroke();
    BOOST_TEST(grab.drag_to(near).reached);
    BOOST_CHECK_THROW(sculptor.set_delta(1e-6), Open_stroke);
    BOOST_TEST(sculptor.parameters().delta_length == 0);
    BOOST_TEST(stroke.is_open());
    BOOST_TEST((grab.drag_to(near).end == Drag_end::reached)); // the grab is not stale
    BOOST_TEST(sculptor.history().number_of_undo_steps() == 1u);
  }
  sculptor.set_delta(1e-6);
  BOOST_TEST(sculptor.parameters().delta_length == 1e-6);
  sculptor.apply(Edit::of(Edit_kind::stroke));
  BOOST_CHECK_THROW(sculptor.set_delta(0), Open_stroke);
  BOOST_TEST(static_cast<bool>(sculptor.undo())); // ends a stroke
  sculptor.set_delta(0);
}

// Each leg is asked for again on a copy of the mesh in which the vertex stands where the leg begins.
BOOST_AUTO_TEST_CASE(the_way_of_a_drag_is_made_of_free_legs) {
  Random random(seed_from_environment(16));
  std::uniform_real_distribution<double> unit(-2, 2);
  const auto point = [&] {
    const double x = unit(random), y = unit(random), z = unit(random);
    return Point_3(x, y, z);
  };
  int with_bends = 0, still = 0;
  for (const Response response : {Response::slide, Response::stop, Response::paper()}) {
    Mesh mesh = ball();
    Sculptor<Mesh> sculptor(mesh, parameters::response(response));
    for (int i = 0; i < 200; ++i) {
      const Vertex_index v(static_cast<Mesh::size_type>(random() % mesh.number_of_vertices()));
      const Point_3 start = mesh.point(v), target = i % 10 == 0 ? start : point();
      Mesh before = mesh;
      std::vector<Point_3> way;
      const auto result = sculptor.grab(v).drag_to(target, way);
      BOOST_REQUIRE_EQUAL(way.size(), static_cast<std::size_t>(result.legs) + 1);
      BOOST_TEST((way.front() == start && way.back() == result.position));
      for (std::size_t leg = 1; leg < way.size(); ++leg) {
        before.point(v) = way[leg - 1];
        BOOST_TEST(!first_impact(before, v, way[leg]).has_value());
      }
      with_bends += way.size() > 2;
      still += way.size() == 1;
      if (i % 4 == 0)
        sculptor.undo();
    }
    std::vector<Point_3> way;
    const auto swept = sculptor.probe(Point_3(3, 3, 3)).drag_to(Point_3(0.1, 0.2, 0.3), way);
    BOOST_TEST((way.front() == Point_3(3, 3, 3) && way.back() == swept.position));
  }
  BOOST_TEST(with_bends > 50);
  BOOST_TEST(still >= 60);
}

BOOST_AUTO_TEST_CASE(room_that_no_machine_has_is_refused) {
  Mesh mesh = meshes::to_mesh(meshes::tetrahedron());
  Sculptor<Mesh> sculptor(mesh);
  const std::size_t most = std::numeric_limits<std::size_t>::max();
  BOOST_CHECK_THROW(sculptor.reserve(most, 0), std::bad_alloc);
  BOOST_CHECK_THROW(sculptor.reserve(0, most), std::bad_alloc);
  BOOST_CHECK_THROW(sculptor.reserve(std::size_t{1} << 30, 0), std::bad_alloc); // three times the edges
  BOOST_CHECK_THROW(sculptor.reserve(0, std::size_t{1} << 43), std::bad_alloc);
  BOOST_TEST(sculptor.drag(Vertex_index(3), {0, 0, 2}).reached);
}

BOOST_AUTO_TEST_CASE(every_broad_phase_tells_its_memory) {
  Mesh mesh = meshes::to_mesh(meshes::icosphere(2));
  const std::size_t alone = Sculptor<Mesh, Brute_force_broad_phase<Mesh>>(mesh).memory(),
                    lists = Sculptor<Mesh, Six_list_broad_phase<Mesh>>(mesh).memory(),
                    tree = Sculptor<Mesh>(mesh).memory();
  BOOST_TEST(alone > 0u);
  BOOST_TEST(lists - alone >= 154 * mesh.number_of_faces()); // doc/use/broad_phases.md
  BOOST_TEST(tree - alone >= 35 * mesh.number_of_faces());
}

BOOST_AUTO_TEST_CASE(a_target_may_be_a_point_of_the_path) {
  Mesh mesh = meshes::to_mesh(meshes::tetrahedron());
  Sculptor<Mesh> sculptor(mesh);
  std::vector<Mesh::Point> path;
  auto grab = sculptor.grab(Vertex_index(3));
  const Mesh::Point start = mesh.point(Vertex_index(3));
  BOOST_TEST(grab.drag_to({0.25, 0.5, 3}, path).reached);
  BOOST_TEST(grab.drag_to(path.front(), path).reached);
  BOOST_TEST((path.size() == 2u && path.back() == start && mesh.point(Vertex_index(3)) == start));
}

BOOST_AUTO_TEST_CASE(property_maps_survive) {
  Mesh mesh = ball();
  auto weight = mesh.add_property_map<Vertex_index, int>("v:weight", 0).first;
  for (const Vertex_index v : mesh.vertices())
    weight[v] = static_cast<int>(v) * 3;
  Sculptor<Mesh> sculptor(mesh);
  sculptor.grab(Vertex_index(2)).drag_to(Point_3(0.1, 0.2, 0.3));
  for (const Vertex_index v : mesh.vertices())
    BOOST_TEST(weight[v] == static_cast<int>(v) * 3);
}

BOOST_AUTO_TEST_CASE(a_vertex_without_faces_is_refused) {
  Mesh mesh = ball();
  const Vertex_index alone = mesh.add_vertex(Point_3(0.05, 0.02, 3));
  try {
    Sculptor<Mesh> sculptor(mesh);
    BOOST_ERROR("a vertex without faces is no surface");
  } catch (const Invalid_surface& error) {
    BOOST_REQUIRE(error.report().number_of_faults() == 1u);
    BOOST_TEST(
        (error.report().isolated_vertices.at(0) == Validity_report::Vertex_index(static_cast<std::size_t>(alone))));
    BOOST_TEST(std::string(error.what()).find("1 vertex(es) without faces: 42") != std::string::npos);
  }
  mesh.remove_vertex(alone);
  Sculptor<Mesh> sculptor(mesh);
}

BOOST_AUTO_TEST_CASE(an_inside_out_mesh_is_guarded_like_any_other) {
  Mesh mesh = meshes::to_mesh(meshes::icosphere(1).turn_inside_out());
  Sculptor<Mesh> sculptor(mesh);
  const Point_3 start = mesh.point(Vertex_index(0));
  const auto result = sculptor.grab(Vertex_index(0)).drag_to(Point_3(-3 * start.x(), -3 * start.y(), -3 * start.z()));
  BOOST_TEST(!result.reached);
  BOOST_TEST(validate(mesh).is_valid());
}

BOOST_AUTO_TEST_CASE(several_objects_do_not_tunnel) {
  Mesh mesh = meshes::to_mesh(meshes::row_of_spheres(3));
  Sculptor<Mesh> sculptor(mesh);
  for (const Vertex_index v : mesh.vertices()) {
    auto grab = sculptor.grab(v);
    grab.drag_to(Point_3(20, 0.1, 0.2));
    grab.drag_to(Point_3(-20, 0.1, 0.2));
  }
  BOOST_TEST(validate(mesh).is_valid());
  sculptor.check_unchanged();
}

BOOST_AUTO_TEST_CASE(what_stops_a_drag_are_its_traits) {
  Mesh mesh = ball();
  const Vertex_index v(0);
  const Point_3 p = mesh.point(v), target(-1.5 * p.x(), -1.5 * p.y(), -1.5 * p.z());
  std::size_t asked = 0;
  const Blind_traits traits(asked);
  BOOST_TEST(first_impact(mesh, v, target).has_value());
  BOOST_TEST(!first_impact(mesh, v, target, traits).has_value());
  BOOST_TEST(asked > 0u);
  Sculptor<Mesh, Box_tree_broad_phase<Mesh>, Default_edit_visitor, Blind_traits> blind(mesh, {}, {}, traits);
  asked = 0;
  BOOST_TEST(!blind.first_impact(v, target).has_value());
  BOOST_TEST(blind.grab(v).drag_to(target).reached);
  BOOST_TEST(asked > 0u);
  BOOST_TEST(!validate(mesh).is_valid()); // it has gone through: nothing else has stopped it
  BOOST_TEST(bool(blind.undo()));
  BOOST_TEST(validate(mesh).is_valid());
}

BOOST_AUTO_TEST_CASE(copies_of_traits_live_as_long_as_what_they_made) {
  Mesh mesh = ball();
  using Own_sculptor = Sculptor<Mesh, Box_tree_broad_phase<Mesh>, Default_edit_visitor, Own_traits>;
  for (const bool are_given : {false, true}) {
    const auto sculptor = are_given ? std::make_unique<Own_sculptor>(mesh, parameters::clearance(1e-9),
                                                                     Default_edit_visitor(), Own_traits())
                                    : std::make_unique<Own_sculptor>(mesh, parameters::clearance(1e-9));
    const Point_3 p = mesh.point(Vertex_index(0)), target(-1.5 * p.x(), -1.5 * p.y(), -1.5 * p.z());
    Own_traits::asked = 0;
    sculptor->first_impact(Vertex_index(0), target);
    sculptor->probe(Point_3(9, 8, 7)).drag_to(Point_3(-9, -8, -7));
    sculptor->drag(Vertex_index(0), target);
    BOOST_TEST(Own_traits::asked > 0u);
    sculptor->undo();
  }
  BOOST_TEST(Own_traits::asked_of_dead == 0u);
}

// Without a vertex no map has an array of its own.
BOOST_AUTO_TEST_CASE(a_map_of_points_is_kept_by_an_empty_mesh_and_not_where_they_are_the_vertices) {
  Mesh mesh;
  const auto target = mesh.add_property_map<Vertex_index, Point_3>("v:target").first;
  Sculptor<Mesh>(mesh).keep(target);
  Mesh full = ball();
  Sculptor<Mesh> sculptor(full);
  BOOST_CHECK_THROW(sculptor.keep(full.points()), Invalid_parameter);
}

BOOST_AUTO_TEST_CASE(far_targets_and_huge_meshes_are_ordinary) {
  Mesh mesh = ball();
  Sculptor<Mesh> sculptor(mesh);
  auto grab = sculptor.grab(Vertex_index(0));
  const double huge = 1e300;
  grab.drag_to(Point_3(-huge, huge, 0.5 * huge));
  BOOST_TEST(validate(mesh).is_valid());
  Mesh large = meshes::to_mesh(meshes::icosphere(1).scale_and_move(1e150, 0, 0, 0));
  Sculptor<Mesh> other(large);
  other.grab(Vertex_index(1)).drag_to(Point_3(0, 0, 0));
  other.grab(Vertex_index(1)).drag_to(Point_3(-4e150, 0, 0));
  BOOST_TEST(validate(large).is_valid());
}
