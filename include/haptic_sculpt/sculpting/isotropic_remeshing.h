// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef HAPTIC_SCULPT_SCULPTING_ISOTROPIC_REMESHING_H
#define HAPTIC_SCULPT_SCULPTING_ISOTROPIC_REMESHING_H

#include <haptic_sculpt/sculpting/Sculptor.h>
#include <haptic_sculpt/sculpting/many_vertices/Remesher.h>

#include <CGAL/Named_function_parameters.h>
#include <CGAL/property_map.h>

namespace haptic_sculpt {

/// Remeshes a range of faces to triangles with edges of about `target_edge_length` and about six at a vertex: as CGAL's
/// function of that name does, but every operation is proven, so the mesh is embedded at every moment; what cannot be
/// done is left out.
///
/// \param faces a range of faces of the mesh; edges on its border are not changed
/// \param target_edge_length a length > 0; edges longer than 4/3 of it are split, edges shorter than 4/5 collapsed
/// \param np CGAL's named parameters of these names, with its defaults: number_of_iterations (1),
/// edge_is_constrained_map, vertex_is_constrained_map, protect_constraints (false), collapse_constraints (true),
/// do_split, do_collapse, do_flip, do_project (all true), number_of_relaxation_steps (1), projection_functor. Others
/// are ignored. \param parameters what CGAL does not have: feature angle, progress
///
/// A constrained edge that is split hands its constraint on, a vertex on a line of them goes only along the line, none
/// is flipped, and relaxation leaves their ends; the map of edges is written as edges come and go. Undo does not write
/// it. The whole is one stroke. The mesh has removed elements afterwards; who collects garbage needs a new Sculptor.
/// \throw Out_of_range, Invalid_parameter: nothing has changed; Mesh_changed, and what the progress function throws
/// Cost: about 10 microseconds an operation.
template <class Face_range, class Sculptor, class Named_parameters = CGAL::parameters::Default_named_parameters>
Remeshing_report isotropic_remeshing(const Face_range& faces, Sculptor& sculptor, double target_edge_length,
                                     const Named_parameters& np = CGAL::parameters::default_values(),
                                     const Remeshing_parameters& parameters = Remeshing_parameters()) {
  using Mesh = typename Sculptor::Mesh_type;
  using CGAL::parameters::choose_parameter;
  using CGAL::parameters::get_parameter;
  namespace names = CGAL::internal_np;
  using No_edges = CGAL::Static_boolean_property_map<typename Mesh::Edge_index, false>;
  using No_vertices = CGAL::Static_boolean_property_map<typename Mesh::Vertex_index, false>;

  const internal::Rounding_to_nearest rounding;
  internal::check_range("the target edge length", target_edge_length);
  if (!(target_edge_length > 0))
    throw Invalid_parameter("the target edge length must be > 0, not " + internal::number(target_edge_length));
  const double angle = parameters.feature_angle_degrees;
  if (!(angle >= 0 && angle <= 180))
    throw Invalid_parameter("the feature angle must be from 0 to 180 degrees, not " + internal::number(angle));

  internal::Remeshing_options options;
  options.target_edge_length = target_edge_length;
  options.iterations = choose_parameter(get_parameter(np, names::number_of_iterations), 1u);
  options.relaxation_steps = choose_parameter(get_parameter(np, names::number_of_relaxation_steps), 1u);
  options.protect_constraints = choose_parameter(get_parameter(np, names::protect_constraints), false);
  options.collapse_constraints = choose_parameter(get_parameter(np, names::collapse_constraints), true);
  options.do_split = choose_parameter(get_parameter(np, names::do_split), true);
  options.do_collapse = choose_parameter(get_parameter(np, names::do_collapse), true);
  options.do_flip = choose_parameter(get_parameter(np, names::do_flip), true);

  const std::vector<typename Mesh::Face_index> range(faces.begin(), faces.end());
  for (const typename Mesh::Face_index f : range)
    if (!f.is_valid() || static_cast<std::size_t>(f) >= sculptor.mesh().num_faces() || sculptor.mesh().is_removed(f))
      throw Invalid_parameter("face " + std::to_string(static_cast<std::size_t>(f)) +
                              " is not in the mesh, or was removed: give faces of mesh.faces()");
  if (range.empty())
    return {};
  const auto edge_map = choose_parameter(get_parameter(np, names::edge_is_constrained), No_edges());
  const auto vertex_map = choose_parameter(get_parameter(np, names::vertex_is_constrained), No_vertices());
  using Edge_map = std::decay_t<decltype(edge_map)>;
  using Marks = internal::Remeshing_marks<Mesh, Edge_map>;
  const auto stroke = sculptor.stroke();
  Marks marks(sculptor.mesh(), range, edge_map, vertex_map);
  if (angle < 180)
    marks.constrain_features(angle);

  const auto run = [&](auto&& project) {
    return internal::Remesher<Sculptor, Marks, std::decay_t<decltype(project)>>(sculptor, marks, project, options,
                                                                                parameters)
        .run();
  };
  const auto projection = get_parameter(np, names::projection_functor);
  using Projection = std::decay_t<decltype(projection)>;
  const bool projects = choose_parameter(get_parameter(np, names::do_project), true);
  if constexpr (std::is_same<Projection, names::Param_not_found>::value)
    return run(internal::Projection_onto_input<Mesh>(sculptor.mesh(), range, projects));
  else if (projects)
    return run(internal::Projection_by_function<Mesh, Projection>(projection));
  else
    return run(internal::Projection_onto_input<Mesh>(sculptor.mesh(), range, false));
}

/// The same for all faces.
template <class Sculptor, class Named_parameters = CGAL::parameters::Default_named_parameters>
Remeshing_report isotropic_remeshing(Sculptor& sculptor, double target_edge_length,
                                     const Named_parameters& np = CGAL::parameters::default_values(),
                                     const Remeshing_parameters& parameters = Remeshing_parameters()) {
  return isotropic_remeshing(sculptor.mesh().faces(), sculptor, target_edge_length, np, parameters);
}

} // namespace haptic_sculpt

#endif
