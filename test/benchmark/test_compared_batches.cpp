// SPDX-License-Identifier: GPL-3.0-or-later
// Whether `robustness` notices a broad phase that leads elsewhere, and uses the clearance it is given.
#include "robustness/robustness/Compared_batches.h"

#include <haptic_sculpt/surface/broad_phase/Brute_force_broad_phase.h>

#include <boost/test/unit_test.hpp>

#include <cmath>
#include <fstream>
#include <random>

using namespace haptic_sculpt;
using namespace haptic_sculpt::robustness;

namespace {

using All = Brute_force_broad_phase<Mesh>;
const Broad_phase_choice right{drag_batch<All>, edit_batch<All>};

/// A planted fault: what a broad phase would do that leads elsewhere in the last bit of one coordinate.
Mesh one_ulp_off(Mesh mesh) {
  Point_3& p = mesh.point(Vertex_index(0));
  p = Point_3(std::nextafter(p.x(), 2 * p.x() + 1), p.y(), p.z());
  return mesh;
}
const Broad_phase_choice wrong{
    [](const Mesh& mesh, const Batch& batch, Keep keep) { return drag_batch<All>(one_ulp_off(mesh), batch, keep); },
    [](const Mesh& mesh, const Batch& batch, Keep keep) { return edit_batch<All>(one_ulp_off(mesh), batch, keep); }};

std::string first_line(const std::filesystem::path& file) {
  std::ifstream in(file);
  std::string line;
  std::getline(in, line);
  return line;
}

struct Folder {
  std::filesystem::path path =
      std::filesystem::temp_directory_path() / ("compared_batches_" + std::to_string(std::random_device()()));
  ~Folder() { std::filesystem::remove_all(path); }
};

} // namespace

BOOST_AUTO_TEST_CASE(a_broad_phase_that_leads_elsewhere_has_other_bits_and_its_case_is_written) {
  const Mesh mesh = meshes::to_mesh(meshes::torus(16, 9));
  const Folder folder;
  Batch batch;
  batch.count = 100, batch.seed = 5;
  Compared_batches::Counts counts;
  const Compared_batches same({right, right}, folder.path, Keep::what_fails);
  BOOST_TEST(same.make(mesh, batch, &Broad_phase_choice::drag_batch, "right", counts).drags == 100);
  same.make(mesh, batch, &Broad_phase_choice::edit_batch, "right", counts);
  BOOST_TEST(counts.compared == 2);
  BOOST_TEST(counts.other_bits == 0);
  BOOST_TEST(!std::filesystem::exists(folder.path));

  const Compared_batches different({right, wrong}, folder.path, Keep::what_fails);
  different.make(mesh, batch, &Broad_phase_choice::drag_batch, "drags", counts);
  BOOST_TEST(counts.other_bits == 1);
  different.make(mesh, batch, &Broad_phase_choice::edit_batch, "edits", counts);
  BOOST_TEST(counts.other_bits == 2);
  for (const char* name : {"drags", "edits"}) {
    BOOST_TEST(first_line(folder.path / (std::string(name) + ".script")) + '\n' == other_bits_line);
    BOOST_TEST(std::filesystem::exists(folder.path / (std::string(name) + ".off")));
  }
  BOOST_TEST(counts.unwritten == 0);
}

// As on a full disk.
BOOST_AUTO_TEST_CASE(a_case_that_cannot_be_written_costs_nothing_else) {
  const Mesh mesh = meshes::to_mesh(meshes::torus(16, 9));
  Batch batch;
  batch.count = 100, batch.seed = 5;
  Compared_batches::Counts counts;
  const Compared_batches different({right, wrong}, "/dev/null/nowhere", Keep::what_fails);
  BOOST_TEST(different.make(mesh, batch, &Broad_phase_choice::drag_batch, "drags", counts).drags == 100);
  BOOST_TEST(counts.other_bits == 1);
  BOOST_TEST(counts.unwritten == 1);
}

BOOST_AUTO_TEST_CASE(a_clearance_that_does_not_serve_is_counted_and_one_that_does_is_used) {
  const Mesh mesh = meshes::to_mesh(meshes::torus(16, 9));
  const Compared_batches batches({right}, {}, Keep::all);
  Batch batch;
  batch.count = 30, batch.clearance = 1e6;
  Compared_batches::Counts counts;
  BOOST_TEST(batches.make(mesh, batch, &Broad_phase_choice::drag_batch, "wide", counts).drags == 0);
  BOOST_TEST(counts.clearance_refused == 1);
  batch.clearance = 1e-3;
  const auto narrow = drag_batch<All>(mesh, batch, Keep::all);
  batch.clearance.reset();
  const auto usual = drag_batch<All>(mesh, batch, Keep::all);
  BOOST_TEST(narrow.tally.drags == 30);
  BOOST_TEST(narrow.bits != usual.bits); // what is stopped is stopped a thousandth before it
  BOOST_TEST((narrow.script.find("\nclearance 0x") != std::string::npos));
  BOOST_TEST((usual.script.find("clearance") == std::string::npos));
}

// An ulp of numbers below 1 serves until a coordinate is past 1.
BOOST_AUTO_TEST_CASE(a_batch_that_outgrows_its_clearance_keeps_what_it_has_made) {
  Mesh mesh = meshes::to_mesh(meshes::torus(16, 9));
  double largest = 0;
  for (const Vertex_index v : mesh.vertices())
    largest = std::max(largest, internal::largest_magnitude(vertex_coordinates(mesh, v)));
  for (const Vertex_index v : mesh.vertices()) {
    const auto p = vertex_coordinates(mesh, v);
    mesh.point(v) = Point_3(p[0] / largest * 0.99, p[1] / largest * 0.99, p[2] / largest * 0.99);
  }
  Batch batch;
  batch.count = 3000, batch.clearance = 0x1p-53;
  Compared_batches::Counts counts;
  const Compared_batches batches({right, right}, {}, Keep::what_fails);
  const std::size_t drags = batches.make(mesh, batch, &Broad_phase_choice::drag_batch, "outgrown", counts).drags;
  BOOST_TEST(0u < drags);
  BOOST_TEST(drags < 3000u);
  BOOST_TEST(counts.clearance_refused == 1u);
  BOOST_TEST(counts.other_bits == 0u);
}
