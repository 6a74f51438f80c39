// SPDX-License-Identifier: GPL-3.0-or-later
// The meshes of the shared folder, if it is there.
#include <haptic_sculpt/surface/read_surface.h>
#include <haptic_sculpt/surface/write_surface.h>

#include <surface/Temporary_folder.h>
#include <surface/identical.h>

#include <CGAL/IO/polygon_soup_io.h>

#include <shared_data.h>

#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <chrono>

using namespace haptic_sculpt;
using meshes::Mesh;
namespace fs = std::filesystem;

BOOST_AUTO_TEST_SUITE(reading_and_writing)

// The readers of CGAL see the same in good files, and count the same intersections.
BOOST_AUTO_TEST_CASE(shared_meshes) {
  const auto shared = haptic_sculpt::test::shared_data("meshes");
  if (!shared)
    return;
  const Temporary_folder folder;
  std::size_t good = 0, refused = 0;
  for (const auto& entry : fs::directory_iterator(*shared)) {
    const fs::path path = entry.path();
    if (!mesh_file_format(path) || fs::file_size(path) > 5000000)
      continue; // the million is read by the case below
    std::vector<meshes::Point_3> points;
    std::vector<std::vector<std::size_t>> polygons;
    BOOST_REQUIRE(CGAL::IO::read_polygon_soup(path.string(), points, polygons, CGAL::parameters::verbose(false)));
    const Face_soup soup = read_face_soup(path);
    BOOST_TEST((bits(points) == bits(soup.points)), path);
    BOOST_REQUIRE(polygons.size() == soup.number_of_faces());
    for (std::size_t f = 0; f < polygons.size(); ++f)
      BOOST_REQUIRE(std::equal(polygons[f].begin(), polygons[f].end(), soup.begin(f), soup.end(f)));
    if (path.filename() == "cgal_elk.off") {
      try {
        read_surface<Mesh>(path);
        BOOST_ERROR("the elk intersects itself");
      } catch (const Invalid_surface& error) {
        ++refused;
        BOOST_TEST(error.report().intersecting_faces.size() == 7u);
        BOOST_TEST(error.report().number_of_faults() == 7u);
        BOOST_TEST_MESSAGE(error.what());
      }
      continue;
    }
    const Mesh mesh = read_surface<Mesh>(path);
    const Validity_report report = validate(mesh);
    BOOST_TEST(report.is_valid(), path.string() + " " + report.message());
    BOOST_TEST(report.number_of_components == 1u);
    // The tetrahedron of CGAL has its normals inside.
    BOOST_TEST(report.inside_out_components.empty() == (path.filename() != "cgal_tetrahedron.off"), path);
    for (const char* name : {"m.off", "m.ply", "m.obj"}) {
      write_surface(folder / name, mesh);
      BOOST_TEST(identical(mesh, read_surface<Mesh>(folder / name)), path.string() + " as " + name);
    }
    ++good;
  }
  BOOST_TEST_MESSAGE(good << " shared meshes valid and unchanged by OFF, PLY, OBJ; " << refused << " refused");
  BOOST_TEST(good > 10u);
}

BOOST_AUTO_TEST_CASE(the_million) {
  const auto path = haptic_sculpt::test::shared_data("meshes/gen_cgal_knot_loop4.ply");
  if (!path)
    return;
  using Clock = std::chrono::steady_clock;
  const auto seconds = [](Clock::time_point from, Clock::time_point to) {
    return std::chrono::duration<double>(to - from).count();
  };
  const auto start = Clock::now();
  const Face_soup soup = read_face_soup(*path);
  const auto parsed = Clock::now();
  const Validity_report report = validate_soup(soup);
  const auto validated = Clock::now();
  BOOST_TEST(report.is_valid());
  const Mesh mesh = mesh_of<Mesh>(soup);
  const auto built = Clock::now();
  const Temporary_folder folder;
  write_surface(folder / "m.ply", mesh);
  const auto written = Clock::now();
  BOOST_TEST(identical(mesh_of<Mesh>(read_face_soup(folder / "m.ply")), mesh));
  BOOST_TEST_MESSAGE(soup.number_of_faces()
                     << " triangles: parsed " << seconds(start, parsed) << " s, validated "
                     << seconds(parsed, validated) << " s, made a mesh " << seconds(validated, built) << " s, written "
                     << seconds(built, written) << " s");
}

BOOST_AUTO_TEST_SUITE_END()
