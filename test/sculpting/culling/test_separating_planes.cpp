// SPDX-License-Identifier: GPL-3.0-or-later
// What planes about a star say is apart, the exact sweeps find apart: at any scale, by units in the last place, in
// every rounding mode. And where such planes leave pairs out, impacts, near pairs and collapses are those of all pairs
// in plain loops.
#include "sculpting/culling/all_pairs.h"
#include "sculpting/culling/planes_and_points.h"

#include <haptic_sculpt/sculpting/culling/Separating_planes.h>

#include <boost/test/unit_test.hpp>

#include <numeric>

using namespace haptic_sculpt;
using namespace haptic_sculpt::test;

namespace {

using internal::Coordinates;
using internal::minus;
using internal::Sweep_points;
using internal::Sweep_verdict;
using Outcode = internal::Separating_planes::Outcode;

struct Planes_about_faces {
  internal::Separating_planes planes;

  explicit Planes_about_faces(Faces_and_points& scene) {
    const Rounding in_this_mode(scene.rounding);
    planes.assign(scene.way, scene.spokes, scene.first, scene.last, scene.reach, scene.margin, scene.box);
    planes.compare(scene.outcodes);
  }
  bool beyond_vertex(Outcode sides) const { return (sides & planes.beyond_vertex()) != 0; }
  bool beyond_edge(std::size_t i, Outcode sides) const { return (sides & planes.beyond_edge(i)) != 0; }
  bool beyond_face(std::size_t i, Outcode sides) const { return (sides & planes.beyond_face(i)) != 0; }
};

Box_3 everywhere() {
  return Box_3(Coordinates{-1e300, -1e300, -1e300}).include(Coordinates{1e300, 1e300, 1e300});
}

/// A star among triangles that need not be a mesh: any three of drawn points and of the link's vertices.
struct Soup {
  Mesh mesh;
  internal::Star<Mesh> star;
  Coordinates source, target;
  std::vector<std::array<Vertex_index, 3>> triangles;

  Soup(Random& random, const Drawn_star& drawn, std::size_t number_of_triangles, double size_of_most)
    : source(drawn.source), target(drawn.target) {
    const auto add = [&](const Coordinates& p) { return mesh.add_vertex(Point_3(p[0], p[1], p[2])); };
    star.centre = add(source);
    // The names are not in the link's order.
    std::vector<std::size_t> order(drawn.link.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::shuffle(order.begin(), order.end(), random);
    star.link.resize(order.size());
    for (const std::size_t i : order)
      star.link[i] = add(drawn.link[i]);
    star.link_points = drawn.link;
    std::uniform_real_distribution<double> number(-1, 1);
    std::vector<Vertex_index> others;
    const auto draw = [&](const Coordinates& about) {
      if (random() % 6 == 0)
        return star.link[random() % star.link.size()];
      if (!others.empty() && random() % 3 == 0)
        return others[random() % others.size()];
      Coordinates p = drawn.draw_still(random);
      if (random() % 4 != 0)
        for (int i = 0; i < 3; ++i)
          p[i] = about[i] + size_of_most * drawn.size() * number(random);
      others.push_back(add(p));
      return others.back();
    };
    while (triangles.size() < number_of_triangles) {
      const Coordinates about = drawn.draw_still(random);
      Vertex_index a = draw(about), b = draw(about), c = draw(about);
      if (random() % 8 == 0) { // a needle through the star with both ends far from it, along something in it
        const double far = std::ldexp(1.0, static_cast<int>(random() % 45));
        const Coordinates from = random() % 2 == 0 ? drawn.source : drawn.link[random() % drawn.link.size()],
                          to = random() % 2 == 0 ? drawn.target : drawn.link[random() % drawn.link.size()];
        const internal::Vector along = internal::scaled(minus(to, from), far);
        a = add(internal::plus(from, along)), b = add(minus(from, along));
      }
      if (are_apart(a, b) && are_apart(b, c) && are_apart(c, a) &&
          (number_of_triangles > 100 || is_wanted(random, {a, b, c})))
        triangles.push_back({a, b, c});
      else
        --number_of_triangles;
    }
  }

  void fill(internal::Candidate_list<Mesh>& list) const {
    std::vector<Mesh::Face_index> faces;
    for (std::size_t k = 0; k < triangles.size(); ++k)
      faces.emplace_back(static_cast<Mesh::size_type>(k));
    list.assign(mesh, [this](auto f) { return triangles[f]; }, star, faces, everywhere());
  }

  /// False where the link has an edge without length, which no surface has and the sweeps may not be asked about.
  bool has_edges() const {
    for (std::size_t i = 0; i < star.link.size(); ++i)
      if (!are_apart(star.link[i], star.link[(i + 1) % star.link.size()]))
        return false;
    return true;
  }

private:
  bool are_apart(Vertex_index a, Vertex_index b) const { return a != b && mesh.point(a) != mesh.point(b); }

  /// Few of those that are in the way from the start, not all that come later: impacts are to be at all times, and none
  /// often.
  bool is_wanted(Random& random, const std::array<Vertex_index, 3>& triangle) const {
    const std::size_t chance = random() % 16;
    if (chance == 0)
      return true;
    bool meets = false, meets_at_start = false;
    All_pairs(mesh, star, {triangle})
        .for_each_hit(source, target,
                      [&](Impact_feature, const std::array<Vertex_index, 3>&, const Sweep_points& points,
                          const Sweep_verdict& verdict) {
                        meets = true;
                        meets_at_start = meets_at_start || internal::filtered_time(points, verdict).first <= 0;
                      });
    return !meets_at_start && (!meets || chance > 8);
  }
};

std::size_t draw_valence(Random& random) {
  static constexpr std::size_t special[] = {3, 4, 13, 14, 15, 16, 27, 28, 29, 32, 40, 61, 90};
  return random() % 3 == 0 ? special[random() % 13] : 3 + random() % 12;
}

/// Working memory is shared by all scenes, as in a long session.
struct Session {
  Filter_counters counters;
  internal::Candidate_list<Mesh> list;
  internal::Narrow_phase<Mesh> narrow{Exact_sweep_traits<Mesh>(&counters)};
  internal::Edit_proof<Mesh, Filter_counters> proof{counters};
  Star_impacts<Mesh> found;
  std::size_t motions = 0, blocked = 0, several = 0, late = 0, collapses = 0, refused = 0, balls = 0, covered = 0,
              met = 0, meeting = 0, left_out = 0, wrong = 0;

  void check_motion(const All_pairs& all, const Coordinates& source, const Coordinates& target,
                    std::size_t rounding) {
    const Star_impacts<Mesh> expected = all.first_impacts(source, target);
    bool is_free;
    {
      const Rounding in_this_mode(rounding);
      narrow.first_impacts(all.star, list, source, target, found);
      is_free = narrow.is_free(all.star, list, source, target);
    }
    ++motions, blocked += !expected.empty(), several += expected.size() > 1;
    late += !expected.empty() && expected[0].impact().time().second > 0;
    wrong += !same(found, expected) || is_free != expected.empty();
  }

  /// Of all pairs that meet on the way, not only the first, none has been left out of the runs of the star's faces.
  void check_left_out(const All_pairs& all, const Coordinates& source, const Coordinates& target,
                      std::size_t rounding) {
    if (all.star.valence() == 0)
      return;
    using Pair = std::pair<Impact_feature, std::array<Vertex_index, 3>>;
    std::set<Pair> asked;
    const auto& link = all.star.link;
    const auto index = [this](std::size_t v) { return list.vertices()[v].index; };
    {
      const Rounding in_this_mode(rounding);
      internal::Star_motion motion(source, target);
      narrow.runs().for_each_run(all.star, list, motion, 0, [&](const auto& run) {
        run.for_each_edge_pair([&](std::size_t i, std::uint32_t e) {
          const Vertex_index a = index(list.edges()[e][0]), b = index(list.edges()[e][1]);
          return asked.insert({Impact_feature::edge_edge, {link[i], std::min(a, b), std::max(a, b)}}).second;
        });
        run.for_each_vertex_pair([&](std::size_t i, std::uint32_t v) {
          return asked.insert({Impact_feature::face_vertex, {link[i], link[all.star.next(i)], index(v)}}).second;
        });
        return true;
      });
    }
    all.for_each_hit(
        source, target,
        [&](Impact_feature feature, const std::array<Vertex_index, 3>& vertices, const auto&, const auto&) {
          if (feature == Impact_feature::vertex_face)
            return; // no matter of runs in a large star
          ++meeting;
          left_out += asked.count({feature, vertices}) == 0;
        });
  }

  /// A part of the way is looked at first: what comes first in it is reported.
  void check_part(const All_pairs& all, const Coordinates& source, const Coordinates& target,
                  double until) {
    Swept_star_3 part = all.star.swept(source, target);
    part.until = until;
    const Star_impacts<Mesh> expected = all.first_impacts(source, target);
    narrow.first_impacts_near(all.star, list, source, target, part.path(), found);
    if (!expected.empty() &&
        internal::exact_time(expected[0].impact().coordinates(), expected[0].impact().verdict()) <= mpq_class(until))
      wrong += !same(found, expected);
  }

  void check_collapse(const All_pairs& all, const Coordinates& centre, std::size_t pivot) {
    const std::vector<Vertex_index> expected = all.in_the_way(centre, pivot);
    std::vector<Vertex_index> in_the_way;
    const bool is_free = proof.can_collapse(all.star, list, centre, pivot, in_the_way);
    ++collapses, refused += !expected.empty();
    wrong += is_free != expected.empty() || in_the_way != expected;
  }

  void check_ball(Random& random, const All_pairs& all, const Coordinates& source, double size) {
    std::uniform_real_distribution<double> number(-1, 1);
    const auto away = [&](double distance) {
      const double x = number(random), y = number(random), z = number(random);
      return internal::advanced(source, distance, {x, y, z});
    };
    internal::Near_pairs<Mesh> pairs;
    pairs.assign(all.star, list, narrow.runs(), source, away(std::ldexp(size, -4 - static_cast<int>(random() % 12))));
    if (!pairs.cover(source, source))
      return;
    ++balls;
    for (int i = 0; i < 6; ++i) {
      Coordinates target = away(size);
      for (int k = 0; !pairs.cover(source, target); ++k) // rounded, a step may never become shorter
        target = k < 100 ? internal::advanced(source, 0.7, minus(target, source)) : source;
      const Star_impacts<Mesh> expected = all.first_impacts(source, target);
      narrow.first_impacts(all.star, list, pairs, source, target, found);
      ++covered, met += !expected.empty();
      wrong += !same(found, expected) || narrow.is_free(all.star, list, pairs, source, target) != expected.empty();
    }
  }

  friend std::ostream& operator<<(std::ostream& out, const Session& s) {
    return out << s.motions << " motions, " << s.blocked << " blocked, " << s.several << " of them by several, "
               << s.late << " later than the start; " << s.balls << " balls, " << s.covered << " motions in them, "
               << s.met << " blocked; " << s.collapses << " collapses, " << s.refused << " refused; " << s.meeting
               << " pairs that meet, " << s.left_out << " of them left out; " << s.wrong << " wrong";
  }
};

} // namespace

BOOST_AUTO_TEST_CASE(what_planes_about_spokes_say_is_apart_is_apart) {
  Random random(seed_from_environment(91));
  const std::size_t stars = count_from_environment("HAPTIC_SCULPT_STARS", 7000);
  Count vertex, edge, face;
  for (std::size_t k = 0; k < stars; ++k) {
    Faces_and_points scene(random, 3 + random() % 14, draw_exponent(random), internal::Separating_planes::most_faces,
                           true);
    check(random, scene, Planes_about_faces(scene), vertex, edge, face);
  }
  BOOST_TEST_MESSAGE("vertex: " << vertex << "; edges: " << edge << "; faces: " << face);
  for (const Count& count : {vertex, edge, face}) {
    BOOST_TEST(count.wrong == 0u);
    BOOST_TEST(count.apart * 4 > count.asked);
  }
}

BOOST_AUTO_TEST_CASE(impacts_in_soups_are_those_of_all_pairs) {
  Random random(seed_from_environment(92));
  const std::size_t scenes = count_from_environment("HAPTIC_SCULPT_SOUPS", 3000);
  Session session;
  for (std::size_t k = 0; k < scenes; ++k) {
    const bool is_large = k % 256 == 255;
    const std::size_t valence = is_large ? 300 + random() % 701 : draw_valence(random);
    const Drawn_star drawn(random, valence, draw_exponent(random), draw_offset(random));
    const std::size_t triangles = is_large ? random() % 40 : k % 64 == 0 ? 200 + random() % 200 : random() % 10;
    Soup soup(random, drawn, triangles, std::ldexp(1.0, 1 - static_cast<int>(random() % 12)));
    if (random() % 16 == 0)
      soup.star.clear(); // a probe
    if (!soup.has_edges())
      continue;
    soup.fill(session.list);
    const All_pairs all(soup.mesh, soup.star, soup.triangles);
    BOOST_TEST(all.are_in(session.list));
    session.check_motion(all, soup.source, soup.target, random() % 8 < 4 ? 0 : random());
    session.check_left_out(all, soup.source, soup.target, random() % 4);
    session.check_part(all, soup.source, soup.target, std::ldexp(1.0, -static_cast<int>(random() % 8)));
    session.check_ball(random, all, soup.source, drawn.size());
    if (!is_large && soup.star.valence() != 0)
      session.check_collapse(all, soup.source, random() % valence);
  }
  BOOST_TEST_MESSAGE(session);
  BOOST_TEST(session.wrong == 0u);
  BOOST_TEST(session.left_out == 0u);
  BOOST_TEST(session.blocked > session.motions / 10);
  BOOST_TEST(session.late > session.motions / 10);
  BOOST_TEST(session.blocked < session.motions * 9 / 10);
  BOOST_TEST(session.met > session.covered / 20);
  BOOST_TEST(session.refused > session.collapses / 20);
  BOOST_TEST(session.refused < session.collapses * 19 / 20);
}

BOOST_AUTO_TEST_CASE(impacts_in_meshes_are_those_of_all_pairs) {
  Random random(seed_from_environment(93));
  const std::size_t motions = count_from_environment("HAPTIC_SCULPT_MESH_MOTIONS", 400);
  std::vector<meshes::Triangle_list> lists = {meshes::bumpy_sphere(2, 0.3), meshes::torus(12, 6), meshes::box(3),
                                              meshes::sliver_stack(6, 0x1p-20), meshes::bipyramid(15, 0.5),
                                              meshes::bipyramid(33, 0.01), meshes::bipyramid(300, 1)};
  Session session;
  for (std::size_t k = 0; k < motions; ++k) {
    const std::size_t which = random() % (k % 16 == 0 ? lists.size() : lists.size() - 1);
    const Mesh mesh = meshes::to_mesh(lists[which]);
    std::vector<std::array<Vertex_index, 3>> triangles;
    std::vector<Mesh::Face_index> faces(mesh.faces().begin(), mesh.faces().end());
    for (const auto f : faces)
      triangles.push_back(internal::corners_of_face(mesh, f));
    const std::size_t n = mesh.number_of_vertices();
    internal::Star<Mesh> star;
    // the last vertices of a bipyramid are its apices
    star.collect(mesh, Vertex_index(static_cast<Mesh::size_type>(random() % 2 == 0 ? n - 1 : random() % n)));
    internal::Candidate_list<Mesh>& list = session.list;
    list.assign(mesh, [&](auto f) { return triangles[f]; }, star, faces, everywhere());
    const All_pairs all(mesh, star, triangles);
    BOOST_TEST(all.are_in(list));
    std::uniform_real_distribution<double> number(-1, 1);
    const Coordinates source = vertex_coordinates(mesh, star.centre);
    const double x = number(random), y = number(random), z = number(random);
    const Coordinates target =
        random() % 4 == 0
            ? vertex_coordinates(mesh, Vertex_index(static_cast<Mesh::size_type>(random() % n)))
            : internal::advanced(source, std::ldexp(4, -static_cast<int>(random() % 8)), {x, y, z});
    session.check_motion(all, source, target, random() % 4);
    session.check_left_out(all, source, target, random() % 4);
    session.check_part(all, source, target, std::ldexp(1.0, -static_cast<int>(random() % 4)));
    session.check_ball(random, all, source, 0.25);
    session.check_collapse(all, source, random() % star.valence());
  }
  BOOST_TEST_MESSAGE(session);
  BOOST_TEST(session.wrong == 0u);
  BOOST_TEST(session.left_out == 0u);
  BOOST_TEST(session.blocked > session.motions / 10);
  BOOST_TEST(is_enough(session.refused, 0));
}
