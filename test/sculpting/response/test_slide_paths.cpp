// SPDX-License-Identifier: GPL-3.0-or-later
// Slides as a hand makes them, a thousand a second: few legs, no jumps, no seams, and contacts that do not wear out.
#include <boost/test/unit_test.hpp>

#include "sculpting/Mover_hand.h"
#include "sculpting/response/Slide_faults.h"
#include "sculpting/clearances.h"
#include "sculpting/response/optimum_check.h"
#include "sculpting/response/outside_scenes.h"

using namespace haptic_sculpt;
using namespace haptic_sculpt::test;

namespace {

/// From one point to the next with the least jerk, as hands move; never outside of their convex hull.
Point_3 hand_path(const Point_3& a, const Point_3& b, double t) {
  return a + t * t * t * (10 + t * (6 * t - 15)) * (b - a);
}

double length_of(const Vector_3& v) { return std::sqrt(v.squared_length()); }

/// How many legs drags took.
struct Legs {
  std::vector<std::size_t> count = std::vector<std::size_t>(64);
  void add(int legs) { ++count.at(static_cast<std::size_t>(legs)); }
  std::size_t total() const {
    std::size_t sum = 0;
    for (const std::size_t n : count)
      sum += n;
    return sum;
  }
  std::size_t median() const {
    std::size_t legs = 0;
    for (std::size_t sum = count[0]; 2 * sum < total(); sum += count[legs])
      ++legs;
    return legs;
  }
  std::size_t most() const {
    std::size_t legs = count.size() - 1;
    while (legs > 0 && count[legs] == 0)
      --legs;
    return legs;
  }
};

constexpr int steps_per_move = 1000;

/// A jump of T - x is the surface's where x falls off a convex edge; else no longer than the step of the hand. The ends
/// are right to within some clearances.
constexpr double most_jump = 1.001, jump_slack = 8;

/// How far an end may stay behind the hand along a surface. Its coordinates are rounded, so it may be an ulp or two
/// nearer to the surface or farther from it than the optimum is; and an end that is farther from the target than the
/// start, exactly, is not taken. A way d along the surface shortens the distance D by d^2 / 2 D only.
double held_by_rounding(const Mesh& mesh, const Point_3& at, const Point_3& target) {
  return std::sqrt(2 * length_of(target - at) * 2 * ulp_of(mesh, at));
}

/// Of one step of a hand, whatever it does: slide, meet, or fall over an edge from deep behind it.
constexpr int most_legs_of_a_step = 8;

/// Of a drag over a plane cut into triangles, beside those of the same drag over one triangle.
constexpr int most_legs_for_seams = 3;

/// A device pushes back long before the hand is so far in a solid, in half extents of the scene.
constexpr double deepest_hand = 0.25;

} // namespace

BOOST_AUTO_TEST_CASE(a_smooth_hand_feels_no_jump_on_planes_and_in_concave_features) {
  const std::size_t rounds = count_from_environment("HAPTIC_SCULPT_HAND_PATHS", 1);
  Random random(seed_from_environment(505));
  Slide_faults jumps("jump"), many_legs("legs");
  Legs all, held;
  double worst = 0;
  std::size_t left = 0;
  for (std::size_t round = 0; round < rounds; ++round)
    for (const Convex_scene& scene : convex_scenes(random)) {
      Mover_hand grab(scene.mesh, scene.moved, parameters::response(response_under_test()));
      const Mesh& mesh = grab.mesh;
      auto& sculptor = grab.sculptor;
      if (random() % 2 == 0)
        sculptor.set_drag_parameters(Drag_parameters().response(response_under_test()).clearance(1e-9));
      Point_3 hand = mesh.point(scene.moved), next = scene.target(random, hand);
      // Over a rim, which the planes do not know: from there on they are not what holds it.
      bool has_left = false;
      for (int move = 0; move < 4 && !has_left; ++move) {
        const Point_3 from = hand;
        for (int i = 1; i <= steps_per_move; ++i) {
          const Point_3 source = mesh.point(scene.moved),
                        target = hand_path(from, next, static_cast<double>(i) / steps_per_move);
          const Vector_3 before = hand - source;
          const double step = length_of(target - hand), c = sculptor.clearance(target);
          const auto r = grab.drag_to(target);
          has_left = r.reached && !is_beyond_no_plane(scene, target);
          if (has_left)
            break;
          const double jump = length_of((target - r.position) - before);
          all.add(r.legs);
          if (!r.reached)
            held.add(r.legs);
          if (step > 1e4 * c)
            worst = std::fmax(worst, jump / step);
          if (jump > most_jump * step + jump_slack * c + held_by_rounding(mesh, r.position, target))
            jumps.add(scene.name, mesh, scene.moved, source, target, c,
                      "T - x jumps by " + std::to_string(jump / step) + " hand steps, from hand at " +
                          exact_text(hand) + " to " + exact_text(r.position));
          if (r.legs > most_legs_of_a_step)
            many_legs.add(scene.name, mesh, scene.moved, source, target, c, std::to_string(r.legs) + " legs");
          hand = target;
        }
        next = scene.target(random, mesh.point(scene.moved));
      }
      left += has_left;
      BOOST_REQUIRE(validate(grab.surface()).is_valid());
    }
  BOOST_TEST_MESSAGE(left << " hands led out of a groove; " << all.total() << " steps, " << held.total()
                          << " held, legs " << held.median() << " median, " << all.most() << " most; jump at most "
                          << worst << " hand steps");
  BOOST_TEST(left <= all.total() / (4 * steps_per_move));
  BOOST_TEST(jumps.count() == 0u);
  BOOST_TEST(held.total() > all.total() / 3);
  BOOST_TEST(all.median() <= 1u);
  BOOST_TEST(held.median() <= 1u);
  BOOST_TEST(many_legs.count() == 0u);
}

BOOST_AUTO_TEST_CASE(a_smooth_hand_around_solids_makes_few_legs) {
  const std::size_t rounds = count_from_environment("HAPTIC_SCULPT_HAND_PATHS", 1);
  Random random(seed_from_environment(506));
  Slide_faults many_legs("legs"), tunnelled("tunnelled");
  Legs all, held;
  Legs deep, at_jumps;
  std::size_t jumps = 0;
  for (std::size_t round = 0; round < rounds; ++round)
    for (const Outside_scene& scene : outside_scenes(random)) {
      Mover_hand grab(scene.mesh, scene.moved, parameters::response(response_under_test()));
      const Mesh& mesh = grab.mesh;
      auto& sculptor = grab.sculptor;
      Containment_check containment(scene);
      Point_3 hand = mesh.point(scene.moved);
      for (int move = 0; move < 2; ++move) {
        const Point_3 from = hand, next = Point_3(0, 0, 0) + uniform_vector(random, 1.2 * scene.size);
        for (int i = 1; i <= steps_per_move; ++i) {
          const Point_3 source = mesh.point(scene.moved),
                        target = hand_path(from, next, static_cast<double>(i) / steps_per_move);
          const Vector_3 before = hand - source;
          const double step = length_of(target - hand), c = sculptor.clearance(target);
          const auto r = grab.drag_to(target);
          const bool has_jumped = length_of((target - r.position) - before) >
                                  most_jump * step + jump_slack * c + held_by_rounding(mesh, r.position, target);
          const bool is_deep = length_of(target - r.position) > deepest_hand * scene.size ||
                               length_of(before) > deepest_hand * scene.size;
          jumps += has_jumped;
          all.add(r.legs);
          if (is_deep)
            (has_jumped ? at_jumps : deep).add(r.legs);
          if (!r.reached)
            held.add(r.legs);
          if (r.legs > most_legs_of_a_step)
            many_legs.add(scene.name, mesh, scene.moved, source, target, c,
                          std::to_string(r.legs) + " legs, step " + std::to_string(i) + (has_jumped ? ", a fall" : ""));
          hand = target;
        }
        if (!containment.holds(mesh.point(scene.moved)))
          tunnelled.add(scene.name, mesh, scene.moved, from, next, sculptor.clearance(next),
                        "on the other side of a surface");
      }
      BOOST_REQUIRE(validate(grab.surface()).is_valid());
    }
  BOOST_TEST_MESSAGE(all.total() << " steps, " << held.total() << " held, legs " << held.median() << " median, "
                                 << all.most() << " most; " << many_legs.count() << " steps with more than "
                                 << most_legs_of_a_step << "; " << deep.total()
                                 << " steps with the hand deep in a solid, " << deep.most()
                                 << " legs most; T - x jumped " << jumps << " times, over convex edges, "
                                 << at_jumps.total() << " times from deep, " << at_jumps.most() << " legs most");
  BOOST_TEST(held.total() > all.total() / 10);
  BOOST_TEST(all.median() <= 1u);
  BOOST_TEST(many_legs.count() == 0u);
  BOOST_TEST(tunnelled.count() == 0u);
}

BOOST_AUTO_TEST_CASE(seams_between_coplanar_triangles_are_not_felt) {
  Random random(seed_from_environment(507));
  const std::size_t drags = count_from_environment("HAPTIC_SCULPT_SEAM_DRAGS", 200);
  Slide_faults apart("seam"), many_legs("legs at seams");
  std::size_t most_extra = 0, held = 0;
  double worst = 0;
  constexpr std::size_t cells = 71; // 10,082 triangles
  for (const Mover mover : {Mover::probe, Mover::tetrahedron, Mover::bipyramid})
    for (const bool along_axes : {true, false})
      for (const double length : {0.0, 1e-9}) {
        const Rigid_motion motion = along_axes ? Rigid_motion() : Rigid_motion::random(random);
        std::array<Mesh, 2> meshes;
        std::array<std::size_t, 2> moved{};
        for (int i = 0; i < 2; ++i) {
          meshes::Triangle_list list = plate(i == 0 ? 1 : cells);
          moved[i] = add_mover(list, mover, {0.01, 0.02, 0.1}, {0, 0, 1.1}, 0.3);
          meshes[i] = valid_mesh(list.transform(motion), "plate");
        }
        const Vertex_index on_plate(static_cast<Mesh::size_type>(moved[0])), v(static_cast<Mesh::size_type>(moved[1]));
        Mover_hand on_whole(meshes[0], on_plate, parameters::response(response_under_test()));
        Mover_hand on_cut(meshes[1], v, parameters::response(response_under_test()));
        if (length > 0) {
          on_whole.sculptor.set_drag_parameters(Drag_parameters(on_whole.sculptor.parameters().drag).clearance(length));
          on_cut.sculptor.set_drag_parameters(Drag_parameters(on_cut.sculptor.parameters().drag).clearance(length));
        }
        for (std::size_t i = 0; i < drags; ++i) {
          // Also to and along grid lines and vertices.
          const auto coordinate = [&] {
            return random() % 2 == 0 ? uniform(random, -0.9, 0.9)
                                     : 2.0 * static_cast<double>(random() % 60 + 5) / cells - 1;
          };
          const double x = coordinate(), y = coordinate(), z = uniform(random, -0.5, 0.05);
          const Point_3 target = motion(Point_3(x, y, z)), source = on_cut.mesh.point(v);
          const auto a = on_whole.drag_to(target), b = on_cut.drag_to(target);
          const double c = largest_clearance(on_cut.sculptor, target), distance = length_of(a.position - b.position);
          held += !b.reached;
          worst = std::fmax(worst, distance / c);
          if (distance > 4 * c + 8 * ulp_of(on_cut.mesh, b.position)) // two ends, each rounded in three coordinates
            apart.add(std::string("plate, ") + name_of(mover), on_cut.mesh, v, source, target, c,
                      std::to_string(distance / c) + " c apart, drag " + std::to_string(i));
          if (b.legs > a.legs + most_legs_for_seams)
            many_legs.add(std::string("plate, ") + name_of(mover), on_cut.mesh, v, source, target, c,
                          std::to_string(b.legs) + " legs, not " + std::to_string(a.legs));
          if (b.legs > a.legs)
            most_extra = std::max(most_extra, static_cast<std::size_t>(b.legs - a.legs));
        }
      }
  BOOST_TEST_MESSAGE(held << " drags held, at most " << worst << " clearances apart and " << most_extra
                          << " legs more");
  BOOST_TEST(held > 0u);
  BOOST_TEST(apart.count() == 0u);
  BOOST_TEST(many_legs.count() == 0u);
}

BOOST_AUTO_TEST_CASE(a_push_held_long_keeps_its_gap) {
  const std::size_t steps = count_from_environment("HAPTIC_SCULPT_HELD_STEPS", 2000);
  Random random(seed_from_environment(508));
  Slide_faults gap("gap"), lift("lift"), slide("slide after"), wander("wander");
  double least = 1e300, most = 0;
  std::size_t held = 0, lifts = 0;
  for (const double length : {0.0, 1e-9})
    for (const Convex_scene& scene : convex_scenes(random)) {
      Mover_hand grab(scene.mesh, scene.moved, parameters::response(response_under_test()));
      const Mesh& mesh = grab.mesh;
      auto& sculptor = grab.sculptor;
      if (length > 0)
        sculptor.set_drag_parameters(Drag_parameters(sculptor.parameters().drag).clearance(length));
      Point_3 target;
      std::vector<std::size_t> active;
      double c = 0;
      const auto is_pushed = [&] { // far enough beyond the planes for a tremor not to lift it
        const auto optimum = Offset_half_spaces(scene.half_spaces, c).nearest({target.x(), target.y(), target.z()});
        active = optimum.active;
        return !active.empty() && distance(optimum.point, rational(target)) > 1e-3;
      };
      do {
        target = scene.target(random, mesh.point(scene.moved));
        c = largest_clearance(sculptor, target);
      } while (!is_pushed());
      ++held;
      const Offset_half_spaces permitted(scene.half_spaces, c);
      const auto height = [&](std::size_t i, const Point_3& p) {
        const std::array<double, 3>& a = scene.half_spaces[i].plane[0];
        const std::array<double, 3>& n = permitted.normal(i);
        return static_cast<double>((static_cast<long double>(p.x()) - a[0]) * n[0] +
                                   (static_cast<long double>(p.y()) - a[1]) * n[1] +
                                   (static_cast<long double>(p.z()) - a[2]) * n[2]);
      };
      Point_3 first;
      // Half of the time exactly the same push, then with a tremor.
      for (std::size_t i = 0; i < steps; ++i) {
        const Point_3 hand = i < steps / 2 ? target : target + uniform_vector(random, 1e-7);
        const Point_3 source = mesh.point(scene.moved);
        const auto r = grab.drag_to(hand);
        if (i == 0)
          first = r.position;
        if (i + 1 == steps / 2 && length_of(r.position - first) > 4 * c / permitted.least_singular_value(active))
          wander.add(scene.name, mesh, scene.moved, source, hand, c,
                     "an unchanged push has moved it by " + std::to_string(length_of(r.position - first) / c) + " c");
        // What is kept is a clearance of the triangle in contact, which is in its plane to two or three ulps of the
        // scene only.
        const double least_kept = sculptor.clearance(r.position), most_kept = largest_clearance(sculptor, r.position),
                     flatness = 3 * ulp_of(mesh, r.position);
        for (const std::size_t plane : active) {
          const double h = height(plane, r.position);
          least = std::fmin(least, (h + flatness) / least_kept);
          // With a tremor another set of planes may hold it for a while.
          if (i < steps / 2)
            most = std::fmax(most, (h - flatness) / most_kept);
          if (h < 0.5 * least_kept - flatness || (h > 2 * most_kept + flatness && i < steps / 2))
            gap.add(scene.name, mesh, scene.moved, source, hand, c,
                    "gap " + std::to_string(h / c) + " c after " + std::to_string(i) + " steps");
        }
      }
      const Point_3 source = mesh.point(scene.moved);
      Vector_3 off(0, 0, 0);
      for (const std::size_t i : active)
        off = off + Vector_3(permitted.normal(i)[0], permitted.normal(i)[1], permitted.normal(i)[2]);
      const Point_3 lifted = source + 1e-3 / length_of(off) * off;
      const auto up = grab.drag_to(lifted);
      // Where planes meet at a sharp angle the sum of their normals may lead into one of them.
      const bool is_free = is_beyond_no_plane(scene, lifted);
      lifts += is_free;
      if (is_free && (!up.reached || up.legs != 1 || !up.contacts.empty()))
        lift.add(scene.name, mesh, scene.moved, source, lifted, c,
                 "does not lift off at once: " + std::to_string(up.legs) + " legs");
      grab.drag_to(target);
      const Point_3 again = mesh.point(scene.moved), sideways = scene.target(random, again);
      const auto r = grab.drag_to(sideways);
      const Optimum_check check(scene, r.position, sideways,
                                length == 0 ? largest_clearance(sculptor, sideways) : length, length == 0);
      if (!check.is_right && !(r.reached && is_beyond_no_plane(scene, sideways)))
        slide.add(scene.name, mesh, scene.moved, again, sideways, c, "error " + std::to_string(check.error / c) + " c");
    }
  BOOST_TEST_MESSAGE(held << " pushes held for " << steps << " steps; gaps from " << least << " c to " << most << " c");
  BOOST_TEST(gap.count() == 0u);
  BOOST_TEST(wander.count() == 0u);
  BOOST_TEST(lift.count() == 0u);
  BOOST_TEST(lifts > held / 2);
  BOOST_TEST(slide.count() == 0u);
}
