// SPDX-License-Identifier: GPL-3.0-or-later
// Whatever the format: files that are none, that are cut short or damaged, and surfaces that are not valid.
#include <haptic_sculpt/surface/read_surface.h>
#include <haptic_sculpt/surface/write_surface.h>

#include <meshes/generated_meshes.h>
#include <surface/Temporary_folder.h>
#include <surface/bad_files.h>

#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <random>

#include <sys/stat.h>

using namespace haptic_sculpt;
using meshes::Mesh;

BOOST_AUTO_TEST_SUITE(bad_input)

BOOST_AUTO_TEST_CASE(files_that_are_none) {
  const Temporary_folder folder;
  check_unreadable(folder / "missing.off", "no such file");
  std::filesystem::create_directory(folder / "folder.off");
  check_unreadable(folder / "folder.off", "directory");
  check_unreadable(folder.file("empty.off", ""), "empty");
  check_unreadable(folder.file("blank.ply", " \n\n\t\n"), "empty");
  check_unreadable(folder.file("mesh.txt", tetrahedron), "extension");
  check_unreadable(folder.file("mesh", tetrahedron), "extension");
  BOOST_REQUIRE(::mkfifo((folder / "pipe.off").c_str(), 0600) == 0);
  check_unreadable(folder / "pipe.off", "regular");
  for (const char* name : {"e.off", "e.ply", "e.obj", "e.stl"}) {
    check_unreadable(folder.file(name, ""), "empty");
    check_unreadable(folder.file(name, "<html>not found</html>"), "");
    check_unreadable(folder.file(name, std::string(200, '\0')), "");
  }
}

// Whatever prefix of a text file is left, it is refused, or it is the same surface (a blank at the end is missing).
BOOST_AUTO_TEST_CASE(truncated_text) {
  const Temporary_folder folder;
  const Mesh mesh = meshes::to_mesh(meshes::icosphere(0));
  Write_parameters ascii;
  ascii.encoding(Write_parameters::Encoding::ascii);
  for (const char* name : {"m.off", "m.ply", "m.obj"}) {
    write_surface(folder / name, mesh, ascii);
    std::string whole = bytes_of(folder / name);
    whole.resize(whole.find_last_of("0123456789") + 2); // a comment of the writer's may follow
    std::size_t accepted = 0;
    for (std::size_t n = 0; n < whole.size(); ++n)
      if (refusal<Error>(folder.file(std::string("t") + name, whole.substr(0, n))).empty()) {
        ++accepted;
        BOOST_TEST(whole.find_first_not_of(" \n", n) == std::string::npos,
                   std::string(name) + " cut at " + std::to_string(n));
      }
    BOOST_TEST(accepted <= 3u);
  }
}

// Random damage never does worse than a refusal: no crash, no hang, no invalid mesh.
BOOST_AUTO_TEST_CASE(damaged_files) {
  constexpr unsigned seed = 12;
  BOOST_TEST_MESSAGE("seed " << seed);
  std::mt19937 random(seed);
  const Temporary_folder folder;
  const Mesh mesh = meshes::to_mesh(meshes::icosphere(0));
  std::size_t refused = 0, accepted = 0;
  for (const auto& [name, encoding] :
       {std::pair("m.off", Write_parameters::Encoding::ascii), std::pair("m.ply", Write_parameters::Encoding::ascii),
        std::pair("m.ply", Write_parameters::Encoding::binary), std::pair("m.obj", Write_parameters::Encoding::ascii),
        std::pair("m.stl", Write_parameters::Encoding::ascii),
        std::pair("m.stl", Write_parameters::Encoding::binary)}) {
    Write_parameters options;
    options.encoding(encoding);
    options.allow_rounding();
    write_surface(folder / name, mesh, options);
    const std::string whole = bytes_of(folder / name);
    for (int i = 0; i < 400; ++i) {
      std::string bytes = whole;
      for (std::size_t n = 1 + random() % 3; n-- > 0;)
        bytes[random() % (i % 2 ? std::min<std::size_t>(bytes.size(), 250) : bytes.size())] =
            i % 4 < 2 ? char(random()) : "0123456789-.e \n"[random() % 15];
      try {
        const Mesh back = read_surface<Mesh>(folder.file(std::string("t") + name, bytes));
        BOOST_TEST(validate(back).is_valid());
        ++accepted;
      } catch (const Error&) {
        ++refused;
      }
    }
  }
  BOOST_TEST_MESSAGE(refused << " refused, " << accepted << " accepted (damage to digits, colours, comments)");
  BOOST_TEST(refused > 500u);
  BOOST_TEST(accepted > 50u);
}

BOOST_AUTO_TEST_CASE(surfaces_that_are_not_valid) {
  const Temporary_folder folder;
  const auto off = [&](std::size_t n, std::size_t m, const std::string& rest) {
    return report_of(folder.file("m.off", "OFF\n" + std::to_string(n) + " " + std::to_string(m) + " 0\n" + rest));
  };
  using Pair = std::pair<std::size_t, std::size_t>;
  const auto pair = [](const auto& p) { return Pair(p.first, p.second); };
  // A quadrangle.
  auto report = off(5, 5, "0 0 0\n1 0 0\n1 1 0\n0 1 0\n0 0 1\n4 3 2 1 0\n3 0 1 4\n3 1 2 4\n3 2 3 4\n3 3 0 4\n");
  BOOST_TEST(report.number_of_faults() == 1u);
  BOOST_TEST(std::size_t(report.non_triangular_faces.at(0)) == 0u);
  // Boundary.
  report = off(4, 3, points + "3 0 2 1\n3 0 1 3\n3 1 2 3\n");
  BOOST_TEST(report.number_of_faults() == 3u);
  BOOST_TEST((pair(report.boundary_edges.at(0)) == Pair(0, 2)));
  // An edge of four faces: two tetrahedra share the edge 0-1.
  report =
      off(6, 8, points + "0 -1 0\n0 0 -1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n3 0 4 1\n3 0 1 5\n3 1 4 5\n3 4 0 5\n");
  BOOST_TEST(report.number_of_faults() == 1u);
  BOOST_TEST((pair(report.non_manifold_edges.at(0)) == Pair(0, 1)));
  // Two tetrahedra share the vertex 0.
  report =
      off(7, 8,
          points + "-1 0 0\n0 -1 0\n0 0 -1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n3 0 4 5\n3 0 6 4\n3 4 6 5\n3 5 6 0\n");
  BOOST_TEST(report.number_of_faults() == 1u);
  BOOST_TEST(std::size_t(report.non_manifold_vertices.at(0)) == 0u);
  // The same vertex twice.
  report = off(
      8, 8,
      points +
          "0 0 0\n-1 0 0\n0 -1 0\n0 0 -1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n3 4 5 6\n3 4 7 5\n3 5 7 6\n3 6 7 4\n");
  BOOST_TEST((pair(report.coincident_vertices.at(0)) == Pair(0, 4)));
  BOOST_TEST(report.coincident_vertices.size() == 1u);
  BOOST_TEST(report.intersecting_faces.size() == 9u);
  // A face of no area, and one with a repeated corner.
  report = off(5, 6, "0 0 0\n2 0 0\n0 2 0\n0 0 2\n1 0 0\n3 0 2 1\n3 0 4 3\n3 4 1 3\n3 1 2 3\n3 2 0 3\n3 0 1 4\n");
  BOOST_TEST(report.number_of_faults() == 3u);
  BOOST_TEST(std::size_t(report.degenerate_faces.at(0)) == 5u);
  BOOST_TEST(report.intersecting_faces.size() == 2u); // 0 with 1 and 2, along the edge they do not share
  report = off(4, 5, points + "3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n3 1 1 2\n");
  BOOST_TEST(std::size_t(report.degenerate_faces.at(0)) == 4u);
  // A face turned over.
  report = off(4, 4, points + "3 0 1 2\n3 0 1 3\n3 1 2 3\n3 2 0 3\n");
  BOOST_TEST(report.inconsistently_oriented_edges.size() == 3u);
  // Two tetrahedra through each other; nothing else is wrong.
  report = off(8, 8,
               points + "0.2 0.2 0.2\n1.2 0.2 0.2\n0.2 1.2 0.2\n0.2 0.2 1.2\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n"
                        "3 4 6 5\n3 4 5 7\n3 5 6 7\n3 6 4 7\n");
  BOOST_TEST(!report.intersecting_faces.empty());
  BOOST_TEST(report.number_of_faults() == report.intersecting_faces.size());
  // Not finite.
  report = off(4, 4, replaced(points, "1 0 0", "inf 0 0") + "3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n");
  BOOST_TEST(report.number_of_faults() == 1u);
  BOOST_TEST(std::size_t(report.non_finite_vertices.at(0)) == 1u);
  // The delta rule.
  const auto good = folder.file("m.off", tetrahedron);
  BOOST_CHECK_NO_THROW(read_surface<Mesh>(good, 0.5));
  BOOST_CHECK_THROW(read_surface<Mesh>(good, 0.9), Invalid_surface);
}

BOOST_AUTO_TEST_SUITE_END()
