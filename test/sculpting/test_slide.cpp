// SPDX-License-Identifier: GPL-3.0-or-later
// Slides whose end is known: the unique constrained optimum of planes, cavities and corners; seams; contacts held long.
#include <boost/test/unit_test.hpp>

#include "sculpting/Slide_faults.h"
#include "sculpting/convex_scenes.h"

using namespace haptic_sculpt;
using namespace haptic_sculpt::test;

namespace {

double ulp_of(const Mesh& mesh, const Point_3& target) {
  double largest = 0;
  for (const Vertex_index v : mesh.vertices())
    largest = std::fmax(largest, haptic_sculpt::internal::largest_magnitude(vertex_coordinates(mesh, v)));
  for (int i = 0; i < 3; ++i)
    largest = std::fmax(largest, std::abs(target[i]));
  return unit_in_the_last_place(largest);
}

Rational_point rational(const Point_3& p) { return haptic_sculpt::test::rational({p.x(), p.y(), p.z()}); }

/// Asked for where a plane is nearer than any rounding lets it be met: the default clearance.
constexpr double default_length = 0;

/// The default one, and from the least at which 0.1 c is above the rounding to one that a hand may use.
constexpr double clearances[] = {default_length, 1e-11, 1e-9, 1e-6};

struct Errors {
  double in_clearances = 0;      ///< |x - optimum| / c, or with the default c its multiple of c / least singular value
  std::size_t pushes = 0, held = 0, most_legs = 0;
};

/// Where the clearance is large enough to be kept accurately, 0.1 c and 4 ulp; by default what rounding the planes' distances
/// does to a point they determine badly.
bool is_optimum(const Convex_scene& scene, const Offset_half_spaces& permitted, const Point_3& position, const Point_3& target,
                double c, bool is_default, Errors& errors) {
  // Free where it is, though nearer to a plane than the clearance: nothing was in the way.
  const auto optimum = permitted.nearest({target.x(), target.y(), target.z()});
  const double error = distance(optimum.point, rational(position));
  if (optimum.active.empty())
    return position == target;
  ++errors.held;
  if (is_default) {
    const double sigma = permitted.least_singular_value(optimum.active);
    errors.in_clearances = std::fmax(errors.in_clearances, error * sigma / c);
    return error <= 2 * c / sigma;
  }
  errors.in_clearances = std::fmax(errors.in_clearances, error / c);
  return error <= 0.1 * c + 4 * ulp_of(scene.mesh, target);
}

} // namespace

BOOST_AUTO_TEST_CASE(pushes_end_at_the_unique_optimum) {
  const std::size_t pushes = count_from_environment("HAPTIC_SCULPT_SLIDES", 3000);
  Random random(seed_from_environment(501));
  constexpr std::size_t pushes_per_grab = 10;
  std::map<std::string, Errors> errors[2]; // by default clearance, by one that is set
  Slide_faults wrong("optimum"), tunnelled("tunnelled"), wrong_end("end");
  std::size_t done = 0;
  while (done < pushes)
    for (const Convex_scene& scene : convex_scenes(random))
      for (const double length : clearances) {
        const bool is_default = length == default_length;
        Mesh mesh = scene.mesh;
        Sculptor<Mesh> sculptor(mesh, parameters::response(response_under_test()));
        if (!is_default)
          sculptor.set_clearance(length);
        auto grab = sculptor.grab(scene.moved);
        for (std::size_t i = 0; i < pushes_per_grab; ++i, ++done) {
          const Point_3 source = mesh.point(scene.moved), target = scene.target(random);
          const double c = sculptor.clearance(target);
          const auto r = grab.drag_to(target);
          Errors& e = errors[is_default ? 0 : 1][scene.name];
          ++e.pushes;
          e.most_legs = std::max(e.most_legs, static_cast<std::size_t>(r.legs));
          const auto fault = [&](Slide_faults& faults, const std::string& what) {
            faults.add(scene.name, mesh, scene.moved, source, target, c,
                       what + "; end " + name_of(r.end) + " at " + exact_text(r.position) + ", " + std::to_string(r.legs) +
                           " legs, push " + std::to_string(i));
          };
          // The triangles of one side of a turned cube are coplanar to within an ulp only.
          const Offset_half_spaces permitted(scene.half_spaces, c), free(scene.half_spaces, 0),
              nearly_free(scene.half_spaces, -4 * ulp_of(mesh, target));
          if (!nearly_free.contains(rational(r.position)))
            fault(tunnelled, "beyond a plane");
          if (r.position != mesh.point(scene.moved) || r.reached != (r.position == target) ||
              (r.end != Drag_end::reached && r.end != Drag_end::held))
            fault(wrong_end, "not reached or held");
          // A target closer to a plane than the clearance may be reached, for its way may be free.
          if (r.reached && free.contains(rational(target)))
            continue;
          if (!is_optimum(scene, permitted, r.position, target, c, is_default, e)) {
            const auto optimum = permitted.nearest({target.x(), target.y(), target.z()});
            std::ostringstream what;
            what << "error " << distance(optimum.point, rational(r.position)) / c << " c, " << optimum.active.size()
                 << " planes, least singular value "
                 << (optimum.active.empty() ? 0 : permitted.least_singular_value(optimum.active));
            fault(wrong, what.str());
          }
        }
        BOOST_REQUIRE(validate(mesh).is_valid());
      }
  for (const auto& by_scene : errors)
    for (const auto& [name, e] : by_scene)
      BOOST_TEST_MESSAGE(name << (&by_scene == errors ? ", default clearance: " : ": ") << e.pushes << " pushes, " << e.held
                              << " held, error at most " << e.in_clearances
                              << (&by_scene == errors ? " c / least singular value, " : " c, ") << e.most_legs << " legs");
  BOOST_TEST_MESSAGE(done << " pushes");
  BOOST_TEST(wrong.count() == 0u);
  BOOST_TEST(tunnelled.count() == 0u);
  BOOST_TEST(wrong_end.count() == 0u);
}
