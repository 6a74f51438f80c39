// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "sculpting/public_functions/Scaled_scene.h"
#include "surface/Temporary_folder.h"

#include <haptic_sculpt/surface.h>

#include <boost/property_map/vector_property_map.hpp>

#include <unistd.h>

#include <filesystem>
#include <fstream>

namespace haptic_sculpt::test {

/// A file that is gone again at the end.
struct Scene_file {
  std::filesystem::path path;
  explicit Scene_file(const char* extension)
      : path(std::filesystem::temp_directory_path() / ("public_functions_" + std::to_string(::getpid()) + extension)) {}
  ~Scene_file() {
    std::error_code ignored;
    std::filesystem::remove(path, ignored);
  }
};

/// The three sweeps, asked the same in every place of a small grid, flat cases among them.
template <class Sweep>
void sweep_over_a_grid(const Sweep& sweep, double unit, Outcome& outcome) {
  const Scaled_scene scene(unit);
  const auto at = [&scene](double x, double y, double z) { return scene.at(x, y, z); };
  for (const double x : {-0.75, 0.0, 0.375})
    for (const double y : {-0.5, 0.0, 1.0})
      for (const double z : {0.0, 0.625}) {
        const Point_3 s = at(x, y, 1), t = at(0.25, 0.125, -z), a = at(1, 0, z), b = at(-1, 0.5, 0),
                      c = at(0.25, -1, y);
        outcome.number(sweep.do_collide(s, t, a, b, c));
        if (const auto impact = sweep(s, t, a, b, c)) {
          outcome.impact(*impact);
          outcome.number(static_cast<int>(compare_time(*impact, *impact)));
          outcome.number(impact->time_bounds().first <= impact->time().second);
        }
      }
}

/// What moves many vertices, each a step farther out: many meet, some do not arrive.
inline void move_the_ball(const Scaled_scene& scene, boost::vector_property_map<Point_3>& targets,
                          std::vector<Vertex_index>& vertices, double along, double share) {
  for (std::size_t i = 0; i < Scaled_scene::ball_size; ++i) {
    const Vertex_index v = Scaled_scene::vertex(i);
    vertices.push_back(v);
    targets[i] = scene.beyond(v, share, along);
  }
}

inline void tell(const Move_report& report, Outcome& outcome) {
  outcome.number(static_cast<double>(report.asked)), outcome.number(static_cast<double>(report.reached));
  outcome.number(static_cast<double>(report.drags));
  outcome.length(report.asked_l2), outcome.length(report.asked_max);
  outcome.length(report.left_l2), outcome.length(report.left_max);
}

/// Those that are no member of a Sculptor.
inline std::vector<Public_function> free_functions() {
  std::vector<Public_function> all;
  all.push_back({"first_impacts first_impact contact_of", [](double unit, Outcome& outcome) {
                   Scaled_scene scene(unit);
                   for (std::size_t i = 0; i < Scaled_scene::ball_size; i += 3) {
                     const Vertex_index v = Scaled_scene::vertex(i);
                     for (const auto& impact : first_impacts(scene.mesh, v, scene.at(1.75, 0.125, 0.25)))
                       outcome.impact(impact.impact());
                     outcome.number(first_impact(scene.mesh, v, scene.beyond(v, -1.25)).has_value());
                   }
                 }});
  all.push_back({"Vertex_face_sweep_3 Edge_edge_sweep_3 Face_vertex_sweep_3 Swept_collision_traits_3 compare_time",
                 [](double unit, Outcome& outcome) {
                   const Swept_collision_traits_3<meshes::Kernel> traits;
                   sweep_over_a_grid(traits.vertex_face_sweep_3_object(), unit, outcome);
                   sweep_over_a_grid(traits.edge_edge_sweep_3_object(), unit, outcome);
                   sweep_over_a_grid(traits.face_vertex_sweep_3_object(), unit, outcome);
                 }});
  all.push_back({"Satisfies_delta_rule_3 validate validate_soup face_soup", [](double unit, Outcome& outcome) {
                   Scaled_scene scene(unit);
                   for (const double delta : {0.0, 0.125, 0.25, 0.5}) {
                     outcome.number(static_cast<double>(validate(scene.mesh, scene.length(delta)).number_of_faults()));
                     const Satisfies_delta_rule_3<meshes::Kernel> rule(scene.length(delta));
                     outcome.number(rule(scene.at(0, 0, 0), scene.at(1, 0, 0), scene.at(0.5, 0.25, 0)));
                   }
                   scene.mesh.point(Scaled_scene::vertex(0)) = scene.at(1.25, 0.0625, 0.25); // through the moon
                   const auto report = validate(scene.mesh);
                   outcome.number(static_cast<double>(report.number_of_faults()));
                   for (const auto& p : face_soup(scene.mesh).points)
                     outcome.length(p.x()), outcome.length(p.y()), outcome.length(p.z());
                 }});
  all.push_back({"add_vertex_attribute vertex_attributes keep_vertex_attributes attributes_not_held",
                 [](double unit, Outcome& outcome) {
                   Scaled_scene scene(unit);
                   const auto red = add_vertex_attribute(scene.mesh, "red", Vertex_attribute::Type::uint8).map;
                   for (const Vertex_index v : scene.mesh.vertices())
                     put(red, v, v.idx() % 256);
                   Sculptor<Mesh> sculptor(scene.mesh);
                   keep_vertex_attributes(sculptor);
                   const auto e = *scene.mesh.edges().begin();
                   outcome.edit(
                       sculptor.insert_on_edge(e, scene.middle(scene.mesh.vertex(e, 0), scene.mesh.vertex(e, 1))));
                   for (const auto& attribute : vertex_attributes(scene.mesh))
                     for (const Vertex_index v : scene.mesh.vertices())
                       outcome.number(get(attribute.map, v));
                   outcome.number(static_cast<double>(attributes_not_held(scene.mesh, Mesh_file_format::off).size()));
                 }});
  for (const char* extension : {".off", ".ply", ".obj", ".stl"})
    all.push_back({"read_surface write_surface surface_bytes read_face_soup make_surface mesh_of",
                   [=](double unit, Outcome& outcome) {
                     Scaled_scene scene(unit);
                     const Scene_file file(extension);
                     write_surface(file.path, scene.mesh);
                     outcome.number(surface_bytes(scene.mesh, file.path) == bytes_of(file.path));
                     outcome.mesh(read_surface<Mesh>(file.path));
                     outcome.mesh(make_surface<Mesh>(read_face_soup(file.path)));
                     outcome.mesh(mesh_of<Mesh>(read_face_soup(file.path)));
                     outcome.number(static_cast<double>(read_face_soup(file.path).number_of_faces()));
                   }});
  for (const Guard_policy policy :
       {Guard_policy::back_off, Guard_policy::stop, Guard_policy::slide, Guard_policy::whole})
    all.push_back({"guarded_point_map", [=](double unit, Outcome& outcome) {
                     Scaled_scene scene(unit);
                     Sculptor<Mesh> sculptor(scene.mesh);
                     const auto map = guarded_point_map(sculptor, policy);
                     for (std::size_t i = 0; i < Scaled_scene::ball_size; ++i) {
                       const Vertex_index v = Scaled_scene::vertex(i);
                       outcome.point(get(map, v));
                       put(map, v, scene.beyond(v, i % 2 == 0 ? -0.375 : 1.25, 0.5));
                     }
                     outcome.number(static_cast<double>(map.refused()));
                     outcome.length(map.counts().asked), outcome.length(map.counts().left);
                     outcome.mesh(scene.mesh);
                   }});
  all.push_back({"allow_embedded_move", [](double unit, Outcome& outcome) {
                   Scaled_scene scene(unit);
                   Sculptor<Mesh> sculptor(scene.mesh);
                   const auto allow = allow_embedded_move(sculptor, scene.mesh);
                   for (std::size_t i = 0; i < Scaled_scene::ball_size; ++i) {
                     const Vertex_index v = Scaled_scene::vertex(i);
                     outcome.number(allow(v, scene.mesh.point(v), scene.beyond(v, i % 2 == 0 ? 1.5 : -0.5)));
                   }
                   outcome.mesh(scene.mesh);
                 }});
  for (const double along : {0.0625, 0.25})
    for (const double share : {0.5, 1.5, -1.0})
      all.push_back({"move_vertices", [=](double unit, Outcome& outcome) {
                       Scaled_scene scene(unit);
                       Sculptor<Mesh> sculptor(scene.mesh);
                       boost::vector_property_map<Point_3> targets;
                       std::vector<Vertex_index> vertices, behind;
                       move_the_ball(scene, targets, vertices, along * share, share);
                       tell(move_vertices(sculptor, vertices, targets, Move_parameters(), std::back_inserter(behind)),
                            outcome);
                       outcome.number(static_cast<double>(behind.size()));
                       outcome.mesh(scene.mesh);
                     }});
  all.push_back({"apply_guarded", [](double unit, Outcome& outcome) {
                   Scaled_scene scene(unit);
                   Sculptor<Mesh> sculptor(scene.mesh);
                   tell(apply_guarded(sculptor, [&](auto&, auto map) {
                     for (std::size_t i = 0; i < Scaled_scene::ball_size; ++i)
                       put(map, Scaled_scene::vertex(i), scene.beyond(Scaled_scene::vertex(i), 1.25));
                   }), outcome);
                   outcome.mesh(scene.mesh);
                 }});
  for (const Brush_kind kind :
       {Brush_kind::grab, Brush_kind::inflate, Brush_kind::smooth, Brush_kind::flatten, Brush_kind::pinch})
    for (const bool has_direction : {false, true})
      all.push_back({"apply_brush mirrored touched_vertices fill_brush_targets "
                     "largest_strength", [=](double unit, Outcome& outcome) {
                       Scaled_scene scene(unit);
                       const bool is_length = kind == Brush_kind::grab || kind == Brush_kind::inflate;
                       Dab_3<meshes::Kernel> dab{kind,
                                                 scene.at(0.5, 0.25, 0.5),
                                                 scene.length(0.75),
                                                 is_length ? scene.length(0.125) : 0.5,
                                                 {}};
                       if (has_direction)
                         dab.direction =
                             meshes::Kernel::Vector_3(scene.length(1), scene.length(0.5), scene.length(0.25));
                       // A plane is given by a direction, of any length, and a place.
                       const auto plane = [&] {
                         const internal::Rounding_to_nearest rounding; // its constructor multiplies
                         const meshes::Kernel::Plane_3 made(scene.at(0.25, 0, 0),
                                                            meshes::Kernel::Vector_3(1, 0.5, 0.25));
                         return meshes::Kernel::Plane_3(1, 0.5, 0.25, Scaled_scene::computed(made.d()));
                       }();
                       const auto other = mirrored(dab, plane);
                       outcome.point(other.centre);
                       boost::vector_property_map<Point_3> targets;
                       const auto touched = touched_vertices(scene.mesh, dab, Scaled_scene::vertex(1));
                       fill_brush_targets(touched, scene.mesh, dab, targets,
                                          boost::static_property_map<double, Vertex_index>(0.5));
                       outcome.number(largest_strength(scene.mesh, dab, Scaled_scene::vertex(1)) > dab.strength);
                       for (const Vertex_index v : touched) {
                         outcome.index(v);
                         outcome.point(targets[static_cast<std::size_t>(v)]);
                       }
                       Sculptor<Mesh> sculptor(scene.mesh);
                       tell(apply_brush(sculptor, std::array<Dab_3<meshes::Kernel>, 2>{dab, other}), outcome);
                       outcome.mesh(scene.mesh);
                     }});
  for (const double along : {0.125, 1.0})
    all.push_back({"move_rigidly", [=](double unit, Outcome& outcome) {
                     Scaled_scene scene(unit);
                     Sculptor<Mesh> sculptor(scene.mesh);
                     std::vector<Vertex_index> ball;
                     for (std::size_t i = 0; i < Scaled_scene::ball_size; ++i)
                       ball.push_back(Scaled_scene::vertex(i));
                     using Transformation = CGAL::Aff_transformation_3<meshes::Kernel>;
                     const double x = scene.length(along);
                     for (const auto& t : {Transformation(1, 0, 0, x, 0, 1, 0, 0, 0, 0, 1, 0),
                                           Transformation(0.6, -0.8, 0, scene.length(-along / 8), 0.8, 0.6, 0,
                                                          scene.length(along / 4), 0, 0, 1, 0)}) {
                       const auto report = move_rigidly(sculptor, ball, t);
                       outcome.number(report.share), outcome.number(static_cast<double>(report.asked));
                       for (const auto& contact : report.contacts) {
                         outcome.number(static_cast<int>(contact.kind));
                         for (const auto v : contact.vertices)
                           outcome.index(v);
                       }
                     }
                     outcome.mesh(scene.mesh);
                   }});
  all.push_back({"isotropic_remeshing", [](double unit, Outcome& outcome) {
                   Scaled_scene scene(unit);
                   Sculptor<Mesh> sculptor(scene.mesh);
                   const auto report =
                       isotropic_remeshing(sculptor, scene.length(0.375), CGAL::parameters::number_of_iterations(2),
                                           Remeshing_parameters().feature_angle(60));
                   outcome.number(static_cast<double>(report.splits.done)),
                       outcome.number(static_cast<double>(report.collapses.done));
                   outcome.number(static_cast<double>(report.flips.done)),
                       outcome.number(static_cast<double>(report.moves.done));
                   outcome.mesh(scene.mesh);
                 }});
  return all;
}

} // namespace haptic_sculpt::test
