// SPDX-License-Identifier: GPL-3.0-or-later
// Functions that are given to a call may look at the mesh meanwhile, and change nothing: what they try is refused by
// name, and the call leads to the same bits.
#include "sculpting/many_vertices/many_vertices_scene.h"

#include <haptic_sculpt/sculpting/apply_guarded.h>
#include <haptic_sculpt/sculpting/brushes.h>
#include <haptic_sculpt/sculpting/isotropic_remeshing.h>
#include <haptic_sculpt/sculpting/move_rigidly.h>
#include <haptic_sculpt/sculpting/move_vertices.h>

#include <boost/iterator/function_output_iterator.hpp>
#include <boost/property_map/function_property_map.hpp>

#include <functional>

using namespace haptic_sculpt;
using namespace haptic_sculpt::test;

namespace {

using Change = std::function<void(Sculptor<Mesh>&)>;
using Asked = std::function<void()>; ///< called in the middle of a call

struct Named_change {
  const char* name;
  Change change;
};

/// All that changes a mesh, or what a call under way relies on.
std::vector<Named_change> changes() {
  const Vertex_index v(1);
  const Point_3 p(0.1, 0.2, 0.3);
  return {{"undo", [](auto& s) { s.undo(); }},
          {"redo", [](auto& s) { s.redo(); }},
          {"grab", [=](auto& s) { s.grab(v); }},
          {"release", [](auto& s) { s.release(); }},
          {"drag", [=](auto& s) { s.drag(v, p); }},
          {"move if free", [=](auto& s) { s.move_if_free(v, p); }},
          {"remove", [=](auto& s) { s.remove(v); }},
          {"collapse", [=](auto& s) { s.collapse(s.mesh().halfedge(v)); }},
          {"flip", [=](auto& s) { s.flip(s.mesh().edge(s.mesh().halfedge(v))); }},
          {"insert on face", [=](auto& s) { s.insert_on_face(s.mesh().face(s.mesh().halfedge(v)), p); }},
          {"insert on edge", [=](auto& s) { s.insert_on_edge(s.mesh().edge(s.mesh().halfedge(v)), p); }},
          {"shift", [=](auto& s) { s.shift(0, {{v, 0.5}}); }},
          {"apply", [](auto& s) { s.apply(Edit::of(Edit_kind::move, {1, 0, 0}, {0.1, 0.2, 0.3})); }},
          {"stroke", [](auto& s) { static_cast<void>(s.stroke()); }},
          {"set delta", [](auto& s) { s.set_delta(1e-9); }},
          {"set drag parameters", [](auto& s) { s.set_drag_parameters(Drag_parameters()); }},
          {"set history limit", [](auto& s) { s.set_history_limit({}); }},
          {"forget history", [](auto& s) { s.forget_history(); }},
          {"reserve", [](auto& s) { s.reserve(1, 1); }},
          {"rigid move", [=](auto& s) {
             move_rigidly(s, std::vector<Vertex_index>{v},
                          CGAL::Aff_transformation_3<meshes::Kernel>(CGAL::TRANSLATION, Vector_3(1, 0, 0)));
           }}};
}

/// Has one value everywhere, and asks where it is read or written.
template <class Key, class Value>
struct Asked_property {
  using key_type = Key;
  using value_type = Value;
  using reference = Value;
  using category = boost::read_write_property_map_tag;
  Value value;
  Asked asked;
  friend Value get(const Asked_property& map, Key) { return map.asked(), map.value; }
  friend void put(const Asked_property& map, Key, Value) { map.asked(); }
};
template <class Key, class Value>
Asked_property<Key, Value> asked_map(Value value, const Asked& asked) {
  return {value, asked};
}

/// Calls that take functions of the caller's.
struct Named_call {
  const char* name;
  std::function<void(Sculptor<Mesh>&, const Asked&)> call;
};

std::vector<Named_call> calls() {
  const auto targets = [](Sculptor<Mesh>& s) {
    return boost::make_function_property_map<Vertex_index>(
        [&mesh = s.mesh()](Vertex_index v) { return mesh.point(v) + Vector_3(0.3, 0.1 * (v % 3), 0.2); });
  };
  const auto moves = [](const Asked& asked) {
    return Move_parameters().progress([asked](const Move_progress&) { return asked(), true; });
  };
  const auto remeshes = [](const Asked& asked) {
    return Remeshing_parameters().progress([asked](const Remeshing_progress&) { return asked(), true; });
  };
  const auto dab = [](const Mesh& mesh) {
    return std::array<Dab_3<meshes::Kernel>, 1>{{{Brush_kind::grab, mesh.point(Vertex_index(0)), 2, 0.2}}};
  };
  return {
      {"move_vertices", [=](auto& s, const Asked& a) { move_vertices(s, s.mesh().vertices(), targets(s), moves(a)); }},
      {"move_vertices, one by one",
       [=](auto& s, const Asked& a) { move_vertices(s, s.mesh().vertices(), targets(s), moves(a).steps(false)); }},
      {"its targets",
       [=](auto& s, const Asked& a) {
         const std::function<Point_3(Vertex_index)> target = [&s, a](Vertex_index v) {
           return a(), s.mesh().point(v) + Vector_3(0.1, 0, 0);
         };
         move_vertices(s, s.mesh().vertices(), boost::make_function_property_map<Vertex_index>(target));
       }},
      {"those it left behind",
       [=](auto& s, const Asked& a) {
         const auto left_behind = boost::make_function_output_iterator([a](Vertex_index) { a(); });
         const std::vector<Vertex_index> some = {Vertex_index(1), Vertex_index(5), Vertex_index(9)};
         move_vertices(s, some, boost::static_property_map<Point_3, Vertex_index>({0, 0, 0}), Move_parameters(),
                       left_behind);
       }},
      {"move_rigidly",
       [=](auto& s, const Asked& a) {
         const std::vector<Vertex_index> all(s.mesh().vertices().begin(), s.mesh().vertices().end());
         const CGAL::Aff_transformation_3<meshes::Kernel> translation(CGAL::TRANSLATION, Vector_3(1, 2, 3));
         move_rigidly(s, all, translation, moves(a));
       }},
      {"apply_brush",
       [=](auto& s, const Asked& a) {
         apply_brush(s, dab(s.mesh()), boost::static_property_map<double, Vertex_index>(1), moves(a).drags(false));
       }},
      {"its mask",
       [=](auto& s, const Asked& a) {
         const std::function<double(Vertex_index)> mask = [a](Vertex_index) { return a(), 1.0; };
         apply_brush(s, dab(s.mesh()), boost::make_function_property_map<Vertex_index>(mask));
       }},
      {"isotropic_remeshing",
       [=](auto& s, const Asked& a) {
         isotropic_remeshing(s, 0.6, CGAL::parameters::number_of_iterations(2), remeshes(a));
       }},
      {"its projection",
       [=](auto& s, const Asked& a) {
         const auto project = [&s, a](Vertex_index v) { return a(), s.mesh().point(v); };
         isotropic_remeshing(s, 0.6, CGAL::parameters::projection_functor(project));
       }},
      {"its constrained edges",
       [=](auto& s, const Asked& a) {
         isotropic_remeshing(s, 0.6, CGAL::parameters::edge_is_constrained_map(asked_map<Edge_index>(false, a)));
       }},
      {"its constrained vertices",
       [=](auto& s, const Asked& a) {
         isotropic_remeshing(s, 0.6, CGAL::parameters::vertex_is_constrained_map(asked_map<Vertex_index>(false, a)));
       }},
      {"its patches",
       [=](auto& s, const Asked& a) {
         isotropic_remeshing(s, 0.6, CGAL::parameters::face_patch_map(asked_map<Mesh::Face_index>(std::size_t(7), a)));
       }},
      {"apply_guarded", [=](auto& s, const Asked& a) {
         apply_guarded(s, [&](Mesh& copy, auto points) {
           for (int k = 0; k < 6; ++k)
             a();
           for (const Vertex_index v : copy.vertices())
             put(points, v, copy.point(v) + Vector_3(0.1, 0, 0));
         });
       }}};
}

/// What a call leads to where its function does this, in one of its calls.
Mesh_snapshot snapshot_after(const Named_call& call, std::size_t at, const Change& meanwhile) {
  Mesh mesh = meshes::to_mesh(meshes::bumpy_sphere(1, 0.2));
  Sculptor<Mesh> sculptor(mesh);
  sculptor.drag(Vertex_index(3), mesh.point(Vertex_index(3)) + Vector_3(0, 0, 0.125)); // there is something to undo
  std::size_t times = 0;
  call.call(sculptor, [&] {
    if (times++ == at)
      meanwhile(sculptor);
  });
  BOOST_TEST(times > 0u);
  BOOST_TEST(validate(mesh).is_valid());
  sculptor.check_unchanged();
  return snapshot(sculptor);
}

} // namespace

BOOST_AUTO_TEST_CASE(what_changes_something_is_refused_within_a_function_that_was_given) {
  for (const Named_call& call : calls()) {
    const Mesh_snapshot undisturbed = snapshot_after(call, 0, [](auto&) {});
    for (const Named_change& change : changes())
      for (const std::size_t at : {0, 1, 5}) {
        BOOST_TEST_INFO_SCOPE(call.name << ", " << change.name << ", call " << at);
        const auto refused = [&](Sculptor<Mesh>& s) { BOOST_CHECK_THROW(change.change(s), Reentrant_call); };
        BOOST_TEST((snapshot_after(call, at, refused) == undisturbed));
      }
  }
}

BOOST_AUTO_TEST_CASE(looking_is_allowed_within_a_function_that_was_given) {
  const auto look = [](Sculptor<Mesh>& s) {
    const Point_3 p = s.mesh().point(Vertex_index(1));
    BOOST_TEST(s.nearest_vertex(p, 1) == Vertex_index(1));
    BOOST_TEST(s.first_hit(Point_3(9, 9, 9), p).has_value());
    BOOST_TEST(!s.is_inside_out(Vertex_index(1)));
    s.first_impact(Vertex_index(1), Point_3(9, 9, 9));
    BOOST_TEST(s.vertex(s.id(Vertex_index(1))) == Vertex_index(1));
    s.probe(Point_3(9, 9, 9)).drag_to(Point_3(8, 9, 9));
    s.check_unchanged();
  };
  for (const Named_call& call : calls()) {
    BOOST_TEST_INFO_SCOPE(call.name);
    BOOST_TEST((snapshot_after(call, 1, look) == snapshot_after(call, 0, [](auto&) {})));
  }
}

BOOST_AUTO_TEST_CASE(the_refusal_may_end_the_call_and_all_works_on) {
  for (const Named_call& call : calls()) {
    BOOST_TEST_INFO_SCOPE(call.name);
    Mesh mesh = meshes::to_mesh(meshes::bumpy_sphere(1, 0.2));
    Sculptor<Mesh> sculptor(mesh);
    const Mesh_snapshot before = snapshot(sculptor);
    BOOST_CHECK_THROW(call.call(sculptor, [&] { sculptor.remove(Vertex_index(1)); }), Reentrant_call);
    sculptor.check_unchanged();
    while (sculptor.undo())
      ;
    BOOST_TEST((snapshot(sculptor) == before));
    BOOST_TEST(static_cast<bool>(sculptor.remove(Vertex_index(1))));
    BOOST_TEST(validate(mesh).is_valid());
  }
}

BOOST_AUTO_TEST_CASE(progress_of_a_remeshing_is_asked_where_nothing_is_left_to_do) {
  Mesh mesh = meshes::to_mesh(meshes::tetrahedron());
  Sculptor<Mesh> sculptor(mesh);
  std::size_t calls = 0;
  const auto report = isotropic_remeshing(
      sculptor, 100.0, CGAL::parameters::number_of_iterations(1000000).do_collapse(false).do_project(false),
      Remeshing_parameters().progress([&](const Remeshing_progress&) { return ++calls < 100; }));
  BOOST_TEST(report.cancelled);
  BOOST_TEST(calls == 100u);
}
