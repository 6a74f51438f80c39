// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/sculpting/Sculptor.h>
#include <haptic_sculpt/sculpting/many_vertices/Remesher.h>
#include <haptic_sculpt/sculpting/many_vertices/check_remeshing.h>

#include <CGAL/property_map.h>

namespace haptic_sculpt {

/// Remeshes a range of faces to triangles with edges of about `target_edge_length` and about six at a vertex: as CGAL's
/// function of that name does, but every operation is proven, so the mesh is embedded at every moment; what cannot be
/// done is left out.
///
/// \param faces a range of faces of the mesh, const; edges on its border are not changed
/// \param target_edge_length a length > 0; edges longer than 4/3 of it are split, edges shorter than 4/5 collapsed
/// \param np CGAL's named parameters of these names, with its defaults: number_of_iterations (1),
/// edge_is_constrained_map, vertex_is_constrained_map, face_patch_map, protect_constraints (false),
/// collapse_constraints (true), relax_constraints (false), do_split, do_collapse, do_flip, do_project (all true),
/// number_of_relaxation_steps (1), projection_functor. The others that CGAL documents for its function do not compile.
/// \param parameters what CGAL does not have: feature angle, distance to the input, number of faces, progress
///
/// A constrained edge that is split hands its constraint on, a vertex on a line of them goes only along the line, none
/// is flipped, and relaxation leaves their ends, or moves them along the line (relax_constraints). The borders between
/// patches are constrained. The maps of edges and of patches are written as edges and faces come. Undo does not write
/// them. The whole is one stroke. The mesh has removed elements afterwards; who collects garbage needs a new Sculptor.
///
/// Whatever power of two all coordinates and lengths are multiplied by, the same comes out, multiplied by it, bit for
/// bit, as long as no coordinate is subnormal or out of range.
/// \throw Out_of_range, Invalid_parameter: nothing has changed; Mesh_changed, std::bad_alloc, and what the progress
/// function throws: what has changed by then stays so. Cost: about 10 microseconds an operation, and an iteration some
/// passes over all of the mesh, whatever the range.
template <class Face_range, class Sculptor, class Named_parameters = CGAL::parameters::Default_named_parameters>
Remeshing_report isotropic_remeshing(const Face_range& faces, Sculptor& sculptor, double target_edge_length,
                                     const Named_parameters& np = CGAL::parameters::default_values(),
                                     const Remeshing_parameters& parameters = Remeshing_parameters()) {
  using Mesh = typename Sculptor::Mesh_type;
  using internal::choose_parameter;
  using internal::get_parameter;
  namespace names = internal::named;
  using No_edges = CGAL::Static_boolean_property_map<typename Mesh::Edge_index, false>;
  using No_vertices = CGAL::Static_boolean_property_map<typename Mesh::Vertex_index, false>;
  internal::check_named_parameters<Named_parameters>();

  const internal::Rounding_to_nearest rounding;
  internal::check_remeshing(target_edge_length, parameters);
  sculptor.check_unchanged();
  std::vector<typename Mesh::Face_index> range; // each once, however often it is given
  std::vector<bool> is_in_range(sculptor.mesh().num_faces());
  for (const typename Mesh::Face_index f : faces) {
    const auto i = static_cast<std::size_t>(f);
    if (!f.is_valid() || i >= is_in_range.size() || sculptor.mesh().is_removed(f))
      throw Invalid_parameter("face " + std::to_string(i) +
                              " is not in the mesh, or was removed: give faces of mesh.faces()");
    if (!is_in_range[i])
      range.push_back(f);
    is_in_range[i] = true;
  }
  if (range.empty())
    return {};

  const internal::Scaled_points<Mesh> points(sculptor.mesh(), target_edge_length, range);
  internal::Remeshing_named_parameters named;
  named.target_edge_length = points.in_unit(target_edge_length);
  named.iterations = internal::checked_count("number_of_iterations",
                                             choose_parameter(get_parameter(np, names::number_of_iterations), 1u));
  named.relaxation_steps = internal::checked_count(
      "number_of_relaxation_steps", choose_parameter(get_parameter(np, names::number_of_relaxation_steps), 1u));
  named.protect_constraints = choose_parameter(get_parameter(np, names::protect_constraints), false);
  named.collapse_constraints = choose_parameter(get_parameter(np, names::collapse_constraints), true);
  named.relax_constraints = choose_parameter(get_parameter(np, names::relax_constraints), false);
  named.do_split = choose_parameter(get_parameter(np, names::do_split), true);
  named.do_collapse = choose_parameter(get_parameter(np, names::do_collapse), true);
  named.do_flip = choose_parameter(get_parameter(np, names::do_flip), true);
  constexpr bool has_functor = !internal::is_not_given<Named_parameters, names::projection_functor_t>;
  const bool projects = choose_parameter(get_parameter(np, names::do_project), true);
  const double infinity = std::numeric_limits<double>::infinity();
  const double distance = parameters.most_distance.value_or(has_functor && projects ? infinity : target_edge_length);
  named.max_distance = distance < infinity ? points.in_unit(distance) : infinity;

  auto& guarded = internal::Sculptor_access::guarded(sculptor);
  const auto asked = [&guarded](const auto& map) {
    using Map = std::decay_t<decltype(map)>;
    if constexpr (std::is_same<Map, internal::No_face_patches>::value)
      return map;
    else
      return internal::Asked_map<std::decay_t<decltype(guarded)>, Map>(guarded, map);
  };
  const auto edge_map = asked(choose_parameter(get_parameter(np, names::edge_is_constrained), No_edges()));
  const auto vertex_map = asked(choose_parameter(get_parameter(np, names::vertex_is_constrained), No_vertices()));
  const auto patch_map = asked(choose_parameter(get_parameter(np, names::face_patch), internal::No_face_patches()));
  using Marks = internal::Remeshing_marks<Mesh, std::decay_t<decltype(edge_map)>, std::decay_t<decltype(patch_map)>>;
  Marks marks(sculptor.mesh(), range, edge_map, vertex_map, patch_map);
  if (named.do_split)
    internal::check_number_of_faces(
        sculptor.mesh(), points, range, named, target_edge_length, parameters, [&](typename Mesh::Edge_index e) {
          return marks.is_inside(e) && !(named.protect_constraints && marks.is_constrained(e));
        });
  const auto stroke = sculptor.stroke();
  if (parameters.feature_angle_degrees < 180)
    marks.constrain_features(points, parameters.feature_angle_degrees);
  marks.connect_patches();

  const auto run = [&](auto&& project) {
    using Project = std::decay_t<decltype(project)>;
    return internal::Remesher<Sculptor, Marks, Project>(sculptor, points, marks, project, named, parameters).run();
  };
  if constexpr (has_functor) {
    const auto functor = get_parameter(np, names::projection_functor);
    if (projects)
      return run(internal::Projection_by_function<Mesh, std::decay_t<decltype(functor)>>(functor));
  }
  return run(internal::Projection_onto_input<Mesh>(sculptor.mesh(), points, range, marks.patches(),
                                                   projects && !has_functor));
}

/// The same for all faces.
// Sculptors alone: else CGAL's (faces, length, mesh) would be as good a call of this one.
template <class Sculptor, class Named_parameters = CGAL::parameters::Default_named_parameters,
          class = typename Sculptor::Mesh_type>
Remeshing_report isotropic_remeshing(Sculptor& sculptor, double target_edge_length,
                                     const Named_parameters& np = CGAL::parameters::default_values(),
                                     const Remeshing_parameters& parameters = Remeshing_parameters()) {
  return isotropic_remeshing(sculptor.mesh().faces(), sculptor, target_edge_length, np, parameters);
}

} // namespace haptic_sculpt
