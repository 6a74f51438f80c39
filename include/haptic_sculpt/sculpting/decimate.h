// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/Rounding_to_nearest.h>
#include <haptic_sculpt/collision/arithmetic/unit_of.h>
#include <haptic_sculpt/no_fast_math.h>
#include <haptic_sculpt/sculpting/Sculptor.h>
#include <haptic_sculpt/sculpting/many_vertices/Collapse_queue.h>
#include <haptic_sculpt/sculpting/many_vertices/triangle_shape.h>
#include <haptic_sculpt/sculpting/many_vertices/named_parameters.h>

#include <CGAL/Kernel_traits.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Edge_profile.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/LindstromTurk_cost.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/LindstromTurk_placement.h>
#include <CGAL/Surface_mesh_simplification/internal/Edge_collapse.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <type_traits>
#include <utility>
#include <vector>

namespace haptic_sculpt {

/// What decimate() did.
struct Decimation_report {
  std::size_t collapsed = 0; ///< edges; each takes a vertex, three edges and two faces with it
  std::size_t refused = 0;   ///< times an edge was left for later: an intersection, delta, connectivity, a bound on
                             ///< the work, or a normal that would turn was in the way
};

/// Simplifies the mesh as `CGAL::Surface_mesh_simplification::edge_collapse` does, cheapest edge first, with CGAL's
/// policies, but every step is proven: one end of the edge is drawn to the placement, and then the other into it. Where
/// that is refused, as in planes, one end is to go into the other, and from there to the placement if it can: that
/// comes when it is the cheapest, by what the policy says that the end costs. What is refused again is left out until
/// something beside it has changed. So the mesh is embedded at every moment. No face that stays turns its normal by a
/// right angle or more, in rounded numbers; of edges that cost the same the shortest goes first, a cost below 0 is one
/// of 0 that was rounded, and one that is not finite is none: an edge without a
/// cost, or without a placement, stays.
///
/// \param should_stop a model of CGAL's `StopPredicate`, e.g. `Edge_count_stop_predicate` or, in CGAL 5.5,
/// `Count_stop_predicate`; of 10,000 faces a closed mesh has 15,000 edges. Your own: `bool should_stop(cost, profile,
/// edges at first, edges now)`, e.g. `cost > most` to bound the error. Its profile, and that of policies, is of a
/// `const Mesh`.
/// \param np CGAL's named parameters `get_cost`, `get_placement` (default: Lindstrom and Turk's both) and
/// `edge_is_constrained_map`: such an edge and its ends stay as they are. Others are not looked at.
///
/// It is not called edge_collapse, for CGAL's would be found by its arguments, too.
///
/// The whole is one stroke, and no step of undo where nothing has changed; after undo all is as it was. The mesh has
/// removed elements afterwards. Values of property maps go on as Sculptor::keep() says.
/// \throw Mesh_changed, Out_of_range if a placement is, or the mesh for Lindstrom and Turk's costs, which are sixth
/// powers of lengths: coordinates up to 2^160; what the policies throw. What has collapsed by then stays so
/// Cost: that of CGAL's function and two drags an edge.
template <class Sculptor, class Should_stop, class Named_parameters = CGAL::parameters::Default_named_parameters>
Decimation_report decimate(Sculptor& sculptor, const Should_stop& should_stop,
                           const Named_parameters& np = CGAL::parameters::default_values()) {
  namespace SMS = CGAL::Surface_mesh_simplification;
  namespace names = internal::named;
  using internal::choose_parameter;
  using internal::get_parameter;
  using Mesh = typename Sculptor::Mesh_type;
  using Edge_index = typename Mesh::Edge_index;
  using Halfedge_index = typename Mesh::Halfedge_index;
  using Vertex_index = typename Mesh::Vertex_index;
  using Point = typename Mesh::Point;
  using Traits = typename CGAL::Kernel_traits<Point>::Kernel;
  using Points = typename boost::property_map<Mesh, CGAL::vertex_point_t>::const_type;
  using Profile = SMS::Edge_profile<const Mesh, Points, Traits>;

  const internal::Rounding_to_nearest rounding;
  sculptor.check_unchanged();
  const Mesh& mesh = sculptor.mesh();
  const Points points = get(CGAL::vertex_point, mesh);
  const Traits traits;
  const auto get_cost = choose_parameter(get_parameter(np, names::get_cost_policy), SMS::LindstromTurk_cost<Mesh>());
  const auto get_placement =
      choose_parameter(get_parameter(np, names::get_placement_policy), SMS::LindstromTurk_placement<Mesh>());
  auto& guarded = internal::Sculptor_access::guarded(sculptor);
  const auto constraints = choose_parameter(get_parameter(np, names::edge_is_constrained),
                                            CGAL::Static_boolean_property_map<Edge_index, false>());
  const internal::Asked_map<std::decay_t<decltype(guarded)>, std::decay_t<decltype(constraints)>> is_constrained(
      guarded, constraints);
  constexpr bool updates = SMS::internal::Oracles_require_updates<std::decay_t<decltype(get_cost)>>::value;
  if constexpr (updates)
    internal::ask(guarded, [&] { get_cost.initialize(mesh, points, traits); });

  const auto profile_of = [&](Edge_index e) {
    return Profile(mesh.halfedge(e), mesh, traits, get(boost::vertex_index, mesh), points,
                   get(boost::halfedge_index, mesh), false);
  };
  double largest = 0;
  for (const Vertex_index v : mesh.vertices())
    largest = std::fmax(largest, internal::largest_magnitude(vertex_coordinates(mesh, v)));
  constexpr double largest_of_cost = 0x1p160; // CGAL's numbers overflow above 2^170
  constexpr bool is_default = std::is_same<std::decay_t<decltype(get_cost)>, SMS::LindstromTurk_cost<Mesh>>::value;
  if (is_default && largest > largest_of_cost)
    throw Out_of_range("a coordinate of " + internal::number(largest) + " is too large for Lindstrom and Turk's costs" +
                       ": scale the mesh below 2^160, or give get_cost and get_placement");
  // In which areas, and their products, are the same at every scale.
  const double unit = internal::unit_of(largest);
  internal::Collapse_queue<Mesh> queue(mesh, unit);
  // An end of a constrained edge stays where it is; others may go into it.
  const auto is_fixed = [&](Vertex_index v) {
    for (const Halfedge_index h : mesh.halfedges_around_target(mesh.halfedge(v)))
      if (get(is_constrained, mesh.edge(h)))
        return true;
    return false;
  };
  using Placement = std::decay_t<decltype(get_placement(std::declval<Profile>()))>;
  const auto placement_of = [&](const Profile& profile) {
    const auto placement = internal::ask(guarded, get_placement, profile);
    if (placement)
      internal::check_point("the placement of an edge", *placement);
    return placement;
  };
  const auto number_of = [](const auto& cost) { // infinite where there is none
    const double x = cost ? CGAL::to_double(*cost) : std::numeric_limits<double>::infinity();
    return std::isfinite(x) ? x : std::numeric_limits<double>::infinity();
  };
  const auto cost_at_end = [&](const Profile& profile, Vertex_index v) {
    return number_of(internal::ask(guarded, get_cost, profile, Placement(mesh.point(v))));
  };
  const auto offer = [&](Edge_index e) {
    const Vertex_index v = mesh.vertex(e, 0), w = mesh.vertex(e, 1);
    const bool keeps_v = is_fixed(v), keeps_w = is_fixed(w);
    if (keeps_v && keeps_w)
      return queue.leave_out(e);
    const Profile profile = profile_of(e);
    const auto placement = placement_of(profile);
    if (placement && (keeps_v || keeps_w)) {
      const double cost = cost_at_end(profile, keeps_v ? v : w);
      return std::isfinite(cost) ? queue.push(e, cost, true) : queue.leave_out(e);
    }
    const auto asked =
        placement ? internal::ask(guarded, get_cost, profile, placement) : decltype(get_cost(profile, placement))();
    const double cost = number_of(asked);
    std::isfinite(cost) ? queue.push(e, cost, false) : queue.leave_out(e);
  };
  const auto stroke = sculptor.stroke();
  const internal::Edit_trial<std::decay_t<decltype(guarded)>> trial(guarded); // draws for nothing are no edits
  // The source of h into its target, once that is at p. What was drawn there for nothing goes back the way it came.
  const auto collapses = [&](Halfedge_index h, const Point& p) {
    const Vertex_index kept = mesh.target(h);
    const Point before = mesh.point(kept);
    const auto go_back = [&] {
      // It was free a moment ago: neither delta nor a bound on work has a say.
      Drag_parameters unbounded = sculptor.parameters().drag;
      unbounded.work_limit_pairs.reset();
      guarded.move_if_free(kept, before, unbounded, 0);
    };
    const Vertex_index dying = mesh.source(h);
    try {
      if (!sculptor.move_if_free(kept, p))
        return false;
      if (sculptor.collapse(h))
        return true;
    } catch (...) { // a visitor's, or memory's
      try {
        if (!mesh.is_removed(dying) && mesh.point(kept) != before)
          go_back();
      } catch (...) { // the first one counts
      }
      throw;
    }
    go_back();
    return false;
  };
  // Whether a face that stays turns its normal by a right angle or more where both ends of h go to p. Rounded. The
  // guard lets a plane fold onto itself where the corners are rounded, and so not quite in the plane.
  const auto turns_a_face = [&](Halfedge_index h, const Point& p) {
    const auto place = [&](Vertex_index v) { return internal::scaled(vertex_coordinates(mesh, v), unit); };
    const internal::Coordinates to = internal::scaled(internal::coordinates(p), unit);
    for (const Halfedge_index end : {h, mesh.opposite(h)})
      for (const Halfedge_index g : mesh.halfedges_around_target(end)) {
        const Vertex_index a = mesh.source(g), b = mesh.target(mesh.next(g));
        if (a == mesh.source(end) || b == mesh.source(end))
          continue;
        const auto c = place(a), d = place(b);
        if (!internal::point_alike(internal::area_normal(c, place(mesh.target(g)), d),
                                   internal::area_normal(c, to, d)))
          return true;
      }
    return false;
  };
  Decimation_report report;
  std::vector<Edge_index> around; // of the vertex that is kept
  for (const Edge_index e : mesh.edges())
    offer(e);
  const std::size_t edges_at_first = mesh.number_of_edges();
  while (const auto entry = queue.pop()) {
    const Profile profile = profile_of(entry->edge);
    if (internal::ask(guarded, should_stop, typename Traits::FT(entry->cost), profile, edges_at_first,
                      mesh.number_of_edges()))
      break;
    const auto placement = placement_of(profile);
    if (!placement)
      continue;
    const Point place = *placement;
    const Halfedge_index h = mesh.halfedge(entry->edge), back = mesh.opposite(h);
    const Vertex_index source = mesh.source(h), target = mesh.target(h);
    Vertex_index kept = Mesh::null_vertex();
    if (!entry->into_end) {
      if (!turns_a_face(h, place))
        kept = collapses(h, place) ? target : collapses(back, place) ? source : kept;
    } else {
      const bool may_go = !turns_a_face(h, place);
      const bool keeps_source = is_fixed(source), keeps_target = is_fixed(target);
      const bool into_source =
          keeps_source || (!keeps_target && cost_at_end(profile, source) < cost_at_end(profile, target));
      if (!turns_a_face(h, mesh.point(into_source ? source : target)) && sculptor.collapse(into_source ? back : h)) {
        kept = into_source ? source : target;
        if (!keeps_source && !keeps_target && may_go)
          sculptor.move_if_free(kept, place);
      }
    }
    if (!kept.is_valid()) {
      ++report.refused;
      const double cost = std::fmin(cost_at_end(profile, source), cost_at_end(profile, target));
      if (!entry->into_end && std::isfinite(cost))
        queue.push(entry->edge, std::fmax(cost, entry->cost), true);
      continue;
    }
    ++report.collapsed;
    if constexpr (updates)
      internal::ask(guarded, [&] { get_cost.update_after_collapse(profile, kept); });
    around.clear();
    for (const Vertex_index v : mesh.vertices_around_target(mesh.halfedge(kept)))
      for (const Halfedge_index g : mesh.halfedges_around_target(mesh.halfedge(v)))
        around.push_back(mesh.edge(g));
    std::sort(around.begin(), around.end());
    around.erase(std::unique(around.begin(), around.end()), around.end()); // those of the link are met from both ends
    for (const Edge_index e : around)
      offer(e);
  }
  return report;
}

} // namespace haptic_sculpt
