// SPDX-License-Identifier: GPL-3.0-or-later
// A bound on the work of a drag ends it at the same pair whatever the broad phase: the same drags, and the same moves
// of many vertices, give the same bits and the same count with four of them.
#include "sculpting/many_vertices/many_vertices_scene.h"
#include "sculpting/motion/same_bits.h"

#include <haptic_sculpt/sculpting/paper_1997/Six_list_broad_phase.h>
#include <haptic_sculpt/surface/broad_phase/Brute_force_broad_phase.h>

#include <shared_data.h>

#include <boost/test/unit_test.hpp>

using namespace haptic_sculpt;
using namespace haptic_sculpt::test;

namespace {

/// Answers with every face, in another order each time: all that the concept permits.
template <class M>
class Careless_broad_phase : public Broad_phase_base<M, Careless_broad_phase<M>> {
public:
  using Face_index = typename M::Face_index;

  explicit Careless_broad_phase(const M& mesh) : Broad_phase_base<M, Careless_broad_phase>(mesh) {}
  void query(const Box_3&, std::vector<Face_index>& faces) {
    const auto first = static_cast<std::ptrdiff_t>(faces.size());
    for (const Face_index f : this->mesh().faces())
      faces.push_back(f);
    std::shuffle(faces.begin() + first, faces.end(), random_);
  }
  template <class Faces>
  void faces_moved(const Faces&) {}
  template <class Faces>
  void faces_inserted(const Faces&) {}
  template <class Faces>
  void faces_removed(const Faces&) {}

private:
  Random random_{1};
};

template <class T>
struct Type_of {
  using type = T;
};

double uniform(Random& random) { return static_cast<double>(random() >> 11) * 0x1p-52 - 1; }

/// A mesh of its own and the same script for each broad phase.
template <class Broad_phase>
class Player {
public:
  Player(const Mesh& mesh, const Sculptor_parameters& options) : mesh_(mesh), sculptor_(mesh_, options) {}

  const Mesh& mesh() const { return mesh_; }
  Sculptor<Mesh, Broad_phase>& sculptor() { return sculptor_; }

  /// Some drags of one vertex, short and long, each repeated where it was cut short.
  std::vector<Drag_result<Mesh>> drags(Random random, double edge) {
    std::vector<Drag_result<Mesh>> results;
    const Vertex_index v(static_cast<Mesh::size_type>(random() % mesh_.number_of_vertices()));
    auto grab = sculptor_.grab(v);
    const double reach = edge * std::exp2(uniform(random) * 4);
    const Vector_3 way(uniform(random), uniform(random), uniform(random));
    for (int i = 0; i < 6; ++i) {
      const Vector_3 aside(uniform(random), uniform(random), uniform(random));
      const Point_3 target = mesh_.point(v) + reach * (way + 0.5 * aside);
      for (int again = 0; again < 3; ++again) {
        results.push_back(grab.drag_to(target));
        if (results.back().end != Drag_end::work_limit)
          break;
      }
    }
    return results;
  }

  /// A brush: the vertices within a distance of one of them along its normal.
  Move_report brush(Random random, double edge) {
    const Vertex_index centre(static_cast<Mesh::size_type>(random() % mesh_.number_of_vertices()));
    const double radius = (2 + 6 * std::abs(uniform(random))) * edge, height = 2 * uniform(random) * edge;
    const Vector_3 up = normal(mesh_, centre);
    std::vector<Vertex_index> vertices;
    Point_map targets = mesh_.template add_property_map<Vertex_index, Point_3>("v:brush").first;
    for (const Vertex_index v : mesh_.vertices())
      if (CGAL::squared_distance(mesh_.point(v), mesh_.point(centre)) < radius * radius) {
        vertices.push_back(v);
        targets[v] = mesh_.point(v) + height * up;
      }
    const Move_report report =
        move_vertices(sculptor_, vertices, targets, Move_parameters().steps(false).most_drags(4 * vertices.size()));
    mesh_.remove_property_map(targets);
    return report;
  }

private:
  Mesh mesh_;
  Sculptor<Mesh, Broad_phase> sculptor_;
};

bool same(const Move_report& a, const Move_report& b) {
  return a.reached == b.reached && a.drags == b.drags && a.out_of_work == b.out_of_work &&
         same_bits(a.left_l2, b.left_l2) && same_bits(a.left_max, b.left_max);
}

std::size_t cut_short = 0, drags = 0, dabs = 0;

/// The same with this broad phase as with the first of them.
template <class Broad_phase>
class Twin {
public:
  Twin(Player<Box_tree_broad_phase<Mesh>>& first, const Mesh& mesh, const Sculptor_parameters& options,
       const char* which)
      : first_(&first), other_(mesh, options), which_(which) {}

  void check_drags(const std::vector<Drag_result<Mesh>>& results, const Random& random, double edge,
                   const std::string& name) {
    const auto others = other_.drags(random, edge);
    for (std::size_t i = 0; i < std::min(results.size(), others.size()); ++i)
      BOOST_REQUIRE_MESSAGE(same_bits(results[i], others[i]) && results[i].work == others[i].work,
                            "drag " << i << " differs: " << name << ", " << which_ << ": " << name_of(results[i].end)
                                    << ' ' << name_of(others[i].end) << ", work " << results[i].work << ' '
                                    << others[i].work);
    BOOST_REQUIRE(results.size() == others.size());
    check_mesh(name);
  }
  void check_brush(const Move_report& report, const Random& random, double edge, const std::string& name) {
    BOOST_REQUIRE_MESSAGE(same(report, other_.brush(random, edge)),
                          "reports of a brush differ: " << name << ", " << which_);
    check_mesh(name);
  }

private:
  Player<Box_tree_broad_phase<Mesh>>* first_;
  Player<Broad_phase> other_;
  const char* which_;

  void check_mesh(const std::string& name) {
    BOOST_REQUIRE_MESSAGE(same_bits(first_->mesh(), other_.mesh()), "meshes differ: " << name << ", " << which_);
  }
};

void play(const Named_mesh& scene, std::size_t bound, std::uint64_t seed, int turns) {
  Random random(seed);
  const double edge = mean_edge(scene.mesh);
  const Sculptor_parameters options = parameters::work_limit(bound)
                                          .response(seed % 4 == 0 ? Response::stop : Response::slide)
                                          .delta(seed % 8 == 1 ? 0x1p-40 * edge : 0);
  Player<Box_tree_broad_phase<Mesh>> first(scene.mesh, options);
  Twin<Six_list_broad_phase<Mesh>> six_lists(first, scene.mesh, options, "six lists");
  Twin<Brute_force_broad_phase<Mesh>> brute_force(first, scene.mesh, options, "brute force");
  Twin<Careless_broad_phase<Mesh>> careless(first, scene.mesh, options, "all faces");
  const std::string name = scene.name + ", bound " + std::to_string(bound) + ", seed " + std::to_string(seed);
  for (int turn = 0; turn < turns; ++turn) {
    const Random here(random());
    if (random() % 4 != 0) {
      const auto results = first.drags(here, edge);
      drags += results.size();
      for (const auto& result : results)
        cut_short += result.end == Drag_end::work_limit;
      six_lists.check_drags(results, here, edge, name);
      brute_force.check_drags(results, here, edge, name);
      careless.check_drags(results, here, edge, name);
    } else {
      ++dabs;
      const Move_report report = first.brush(here, edge);
      six_lists.check_brush(report, here, edge, name);
      brute_force.check_brush(report, here, edge, name);
      careless.check_brush(report, here, edge, name);
    }
  }
}

} // namespace

BOOST_AUTO_TEST_CASE(a_bound_on_the_work_knows_no_broad_phase) {
  const std::uint64_t seed = seed_from_environment(65);
  const std::size_t scripts = count_from_environment("HAPTIC_SCULPT_BOUNDED_SCRIPTS", 48);
  auto meshes = scenes();
  meshes.push_back({"long blades", meshes::to_mesh(meshes::bipyramid(40))});
  for (const char* name : {"gen_extreme_exponent_tet.off", "gen_sliver_stack_2p-39.off", "cgal_oblong.off"})
    if (const auto path = haptic_sculpt::test::shared_data(std::string("meshes/") + name))
      meshes.push_back({name, read_surface<Mesh>(*path)});
  for (std::size_t k = 0; k < scripts; ++k)
    play(meshes[k % meshes.size()], std::size_t{20} << (seed + k / meshes.size()) % 8, seed + k, 12);
  BOOST_TEST_MESSAGE(drags << " drags, of which " << cut_short << " cut short; " << dabs << " dabs of a brush");
  if (scripts >= 10)
    BOOST_TEST(cut_short > drags / 20);
}

BOOST_AUTO_TEST_CASE(a_brush_on_a_machine_part_knows_no_broad_phase) {
  const auto file = haptic_sculpt::test::shared_data("meshes/cgal_joint.off");
  if (!file)
    return;
  const Mesh mesh = read_surface<Mesh>(*file);
  const auto dab = [&](auto broad_phase) {
    using Broad_phase = typename decltype(broad_phase)::type;
    Mesh copy = mesh;
    Sculptor<Mesh, Broad_phase> sculptor(copy);
    Point_map targets = copy.add_property_map<Vertex_index, Point_3>("v:brush").first;
    for (const Vertex_index v : copy.vertices())
      targets[v] = copy.point(v) + normal(copy, v);
    const Move_report report = move_vertices(sculptor, copy.vertices(), targets, Move_parameters().steps(false));
    copy.remove_property_map(targets);
    return std::make_pair(copy, report);
  };
  const auto first = dab(Type_of<Box_tree_broad_phase<Mesh>>()), second = dab(Type_of<Six_list_broad_phase<Mesh>>());
  BOOST_TEST(first.second.reached == second.second.reached);
  BOOST_TEST(same_bits(first.first, second.first));
}
