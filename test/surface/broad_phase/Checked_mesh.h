// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "surface/broad_phase/Changing_mesh.h"

#include <boost/test/unit_test.hpp>

#include <gmpxx.h>

#include <cmath>
#include <limits>

namespace broad_phase_tests {

/// A changing mesh of which the broad phases are asked the same as brute force and exact sweeps.
struct Checked_mesh : Changing_mesh {
  using Changing_mesh::Changing_mesh;
  std::size_t parts = 0, given_up = 0; ///< how often a part of a way was asked for, and an answer was not whole

  /// Asks all models, and the ones built anew, the same.
  void check_box(const Box_3& box) {
    std::vector<Face_index> expected, lists, leaves, rounded;
    brute_force.query(box, expected);
    six_lists.query(box, lists);
    tree.query(box, leaves);
    // Of the tree it is known exactly what it should say: which of the rounded boxes meet.
    const internal::Float_box around = internal::Broad_phase_access::scale(tree).query(box);
    for (const Face_index f : mesh.faces()) {
      internal::Box_node node;
      node.set(0, internal::Broad_phase_access::scale(tree).around(face_box(mesh, f)));
      if (node.meeting(around) == 1)
        rounded.push_back(f);
    }
    BOOST_TEST((sorted(lists) == sorted(expected)));
    BOOST_TEST((sorted(leaves) == rounded));
    BOOST_TEST(std::includes(rounded.begin(), rounded.end(), expected.begin(), expected.end()));
  }
  template <class Model>
  void check_star(Model& model, const Swept_star_3& star, const std::vector<Face_index>& swept) {
    std::vector<Face_index> found;
    model.query_star(star, found);
    found = sorted(found);
    BOOST_TEST((std::adjacent_find(found.begin(), found.end()) == found.end()));
    for (const Face_index f : found)
      BOOST_TEST((static_cast<std::size_t>(f) < mesh.num_faces() && !mesh.is_removed(f)));
    BOOST_TEST(std::includes(found.begin(), found.end(), swept.begin(), swept.end()));
  }
  void check_star(const Swept_star_3& star) {
    const std::vector<Face_index> swept = swept_faces(mesh, star);
    check_star(brute_force, star, swept);
    check_star(six_lists, star, swept);
    check_star(tree, star, swept);
    check_giving_up(star);
  }
  /// An answer that is said to be whole is; and one that is small enough, is.
  void check_giving_up(const Swept_star_3& star) {
    std::vector<Face_index> all, found;
    tree.query_star(star, all);
    for (const std::size_t most : {std::size_t(0), all.size() / 2, all.size(), 8 * all.size() + 1}) {
      found.clear();
      const bool is_whole = tree.query_star(star, found, most);
      BOOST_TEST((!is_whole || (all.size() <= most && sorted(found) == sorted(all))));
      BOOST_TEST((is_whole || most <= all.size() || found.empty())); // else there were many nodes to read
      given_up += !is_whole && most < all.size();
    }
  }
  /// A part of a way, where its end is a point: swept up to there, asked as the beginning of a longer way.
  void check_part(Swept_star_3 star, int halvings) {
    const Swept_star_3 part = star;
    star.until = std::ldexp(1.0, -halvings);
    for (int i = 0; i < 3; ++i) {
      star.target[i] = star.source[i] + std::ldexp(part.target[i] - star.source[i], halvings);
      if (!std::isfinite(star.target[i]))
        return;
      const mpq_class way = mpq_class(part.target[i]) - mpq_class(star.source[i]);
      if (mpq_class(star.target[i]) != mpq_class(star.source[i]) + way * (1 << halvings))
        return;
    }
    ++parts;
    const std::vector<Face_index> swept = swept_faces(mesh, part);
    check_star(brute_force, star, swept);
    check_star(six_lists, star, swept);
    check_star(tree, star, swept);
  }
  /// The centre anywhere in a box: some ways in it.
  void check_anywhere(Swept_star_3 star, Random& random) {
    const Box_3 path = Box_3(star.source).include(star.target);
    Swept_star_3 anywhere = star;
    anywhere.is_box = true;
    for (int k = 0; k < 2; ++k) {
      for (Coordinates* p : {&star.source, &star.target})
        for (int i = 0; i < 3; ++i) {
          const double share = random() % 3 == 0 ? 0 : random() % 3 == 0 ? 1 : 0.5 * uniform(random) + 0.5;
          (*p)[i] =
              std::fmin(path.upper[i], std::fmax(path.lower[i], (1 - share) * path.lower[i] + share * path.upper[i]));
        }
      const std::vector<Face_index> swept = swept_faces(mesh, star);
      check_star(brute_force, anywhere, swept);
      check_star(six_lists, anywhere, swept);
      check_star(tree, anywhere, swept);
    }
  }
  void check(Random& random) {
    const Coordinates a = frame(random_point(random, 1.5)), b = frame(random_point(random, 1.5));
    Box_3 box(a);
    if (random() % 3 != 0) { // else a point
      Coordinates other = b;
      if (random() % 3 == 0) // a flat box
        other[random() % 3] = a[0], other[0] = a[0];
      box.include(other);
    }
    check_box(box);
    check_box(face_box(mesh, mesh.face(mesh.halfedge(random_vertex(random))))); // touches its neighbours' boxes
    internal::Star<Mesh> star;
    const Vertex_index v = random_vertex(random);
    star.collect(mesh, v);
    const Coordinates s = vertex_coordinates(mesh, v);
    Coordinates t = random() % 4 == 0 ? s : frame(random_point(random, 4));
    if (random() % 3 == 0)
      t[random() % 3] = s[0];
    check_star(star.swept(s, t));
    check_star(star.swept(s, vertex_coordinates(mesh, random_vertex(random))));
    check_part(star.swept(s, t), 1 + static_cast<int>(random() % 8));
    // A long edge far sideways: what it sweeps is a sheet.
    const Coordinates tip = frame(random_point(random, 4));
    check_star(star.swept(tip, t));
    check_part(star.swept(tip, t), 1 + static_cast<int>(random() % 8));
    check_star(star.swept(tip, star.link_points[random() % star.valence()])); // a spike that is drawn in
    for (int i = 0; i < 3; ++i)
      t[i] = tip[i] + (t[i] - tip[i]) / 16;
    check_anywhere(star.swept(tip, t), random);
    star.clear();
    check_star(star.swept(a, b));
  }
  void check_everything() {
    const double infinity = std::numeric_limits<double>::infinity(), largest = std::numeric_limits<double>::max();
    check_box(Box_3());
    for (const double end : {infinity, largest, static_cast<double>(std::numeric_limits<float>::max())})
      check_box(Box_3({-end, -end, -end}).include({end, end, end}));
    check_box(Box_3({infinity, infinity, infinity}));
    check_box(Box_3({0, 0, 0}));
  }
};

} // namespace broad_phase_tests
