// SPDX-License-Identifier: GPL-3.0-or-later
// Slides whose end is known: the unique constrained optimum of planes, cavities and corners, for vertices and for
// probes.
#include <boost/test/unit_test.hpp>

#include "sculpting/Mover_hand.h"
#include "sculpting/response/Slide_faults.h"
#include "sculpting/clearances.h"
#include "sculpting/response/optimum_check.h"

using namespace haptic_sculpt;
using namespace haptic_sculpt::test;

namespace {

constexpr double default_length = 0; ///< stands for the default clearance
/// The default one, and from the least at which 0.1 c is above the rounding to one that a hand may use.
constexpr double clearances[] = {default_length, 1e-11, 1e-9, 1e-6};

struct Errors {
  double largest = 0; ///< in c; by default in c / least singular value
  std::size_t pushes = 0, held = 0, reached_beside = 0, most_legs = 0;
};

struct Findings {
  Slide_faults optimum{"optimum"}, tunnelled{"tunnelled"}, end{"end"};
  std::map<std::string, Errors> errors[2]; ///< by default clearance, by one that is set
};

template <class Result>
void check_end(const Convex_scene& scene, const Mesh& mesh, const Point_3& source, const Point_3& target, double c,
               bool is_default, const Result& r, const std::string& which, Findings& found,
               const Drag_history* history = nullptr) {
  Errors& errors = found.errors[is_default ? 0 : 1][scene.name];
  ++errors.pushes;
  errors.held += !r.reached;
  errors.most_legs = std::max(errors.most_legs, static_cast<std::size_t>(r.legs));
  const auto fault = [&](Slide_faults& faults, const std::string& what) {
    faults.add(scene.name, mesh, scene.moved, source, target, c,
               what + "; " + name_of(r.end) + " at " + exact_text(r.position) + ", " + std::to_string(r.legs) +
                   " legs, " + which,
               history);
  };
  // The triangles of one side of a turned cube are coplanar to within an ulp only.
  if (!Offset_half_spaces(scene.half_spaces, -4 * ulp_of(mesh, target)).contains(rational(r.position)))
    fault(found.tunnelled, "beyond a plane");
  if (r.reached != (r.position == target) || r.end != (r.reached ? Drag_end::reached : Drag_end::held))
    if (r.position != source || r.end != Drag_end::no_progress) // it may be where it has to be
      fault(found.end, "neither reached nor held");
  // Clearance is kept from what is in the way. Where J reaches a target beyond no plane nothing was, though planes may
  // be nearer to it than a clearance: a drag that ends at its target has no error. Counted apart.
  if (r.reached && is_beyond_no_plane(scene, target)) {
    errors.reached_beside += !Offset_half_spaces(scene.half_spaces, c).contains(rational(target));
    return;
  }
  const Optimum_check check(scene, r.position, target, c, is_default);
  errors.largest = std::fmax(errors.largest, check.error / c * (is_default ? check.least_singular_value : 1));
  if (!check.is_right) {
    std::ostringstream what;
    what << "error " << check.error / c << " c, " << check.planes << " planes, least singular value "
         << check.least_singular_value;
    fault(found.optimum, what.str());
  }
}

void report(const Findings& found) {
  for (const auto& by_scene : found.errors)
    for (const auto& [name, e] : by_scene) {
      const bool is_default = &by_scene == found.errors;
      BOOST_TEST_MESSAGE(name << (is_default ? ", default clearance: " : ": ") << e.pushes << " pushes, " << e.held
                              << " held, " << e.reached_beside
                              << " reached less than a clearance from a plane, error at most " << e.largest
                              << (is_default ? " c / least singular value, " : " c, ") << e.most_legs << " legs");
    }
  BOOST_TEST(found.optimum.count() == 0u);
  BOOST_TEST(found.tunnelled.count() == 0u);
  BOOST_TEST(found.end.count() == 0u);
}

} // namespace

BOOST_AUTO_TEST_CASE(pushes_end_at_the_unique_optimum) {
  const std::size_t pushes = count_from_environment("HAPTIC_SCULPT_SLIDES", 3000);
  Random random(seed_from_environment(501));
  constexpr std::size_t pushes_per_grab = 10;
  Findings found;
  std::size_t done = 0;
  while (done < pushes)
    for (const Convex_scene& scene : convex_scenes(random))
      for (const double length : clearances) {
        const bool is_default = length == default_length;
        Mover_hand grab(scene.mesh, scene.moved, parameters::response(response_under_test()));
        const Mesh& mesh = grab.mesh;
        auto& sculptor = grab.sculptor;
        if (!is_default)
          sculptor.set_drag_parameters(Drag_parameters(sculptor.parameters().drag).clearance(length));
        Drag_history history{mesh.point(scene.moved), {}};
        for (std::size_t i = 0; i < pushes_per_grab; ++i, ++done) {
          const Point_3 source = mesh.point(scene.moved), target = scene.target(random, source);
          history.targets.push_back(target);
          const auto r = grab.drag_to(target);
          BOOST_REQUIRE(r.position == mesh.point(scene.moved));
          check_end(scene, mesh, source, target, is_default ? largest_clearance(sculptor, target) : length, is_default,
                    r, "push " + std::to_string(i), found, &history);
        }
        BOOST_REQUIRE(validate(grab.surface()).is_valid());
      }
  BOOST_TEST_MESSAGE(done << " pushes");
  report(found);
}

BOOST_AUTO_TEST_CASE(probes_end_at_the_unique_optimum) {
  const std::size_t pushes = count_from_environment("HAPTIC_SCULPT_SLIDES", 3000) / 3;
  Random random(seed_from_environment(504));
  Findings found;
  std::size_t done = 0;
  while (done < pushes)
    for (const Convex_scene& scene : convex_scenes(random)) {
      if (!scene.mesh.is_isolated(scene.moved))
        continue;
      for (const double length : clearances) {
        Mesh mesh = without_probes(scene.mesh);
        Sculptor<Mesh> sculptor(mesh, parameters::response(response_under_test()));
        if (length != default_length)
          sculptor.set_drag_parameters(Drag_parameters(sculptor.parameters().drag).clearance(length));
        const Point_3 source = scene.mesh.point(scene.moved);
        for (int i = 0; i < 10; ++i, ++done) { // each without contacts
          const Point_3 target = scene.target(random, source);
          const auto r = sculptor.probe(source, Probe_start::anywhere).drag_to(target);
          check_end(scene, scene.mesh, source, target,
                    length == default_length ? largest_clearance(sculptor, target) : length, length == default_length,
                    r, "probe", found);
        }
        sculptor.check_unchanged();
      }
    }
  BOOST_TEST_MESSAGE(done << " probes");
  report(found);
}
