// SPDX-License-Identifier: GPL-3.0-or-later
#include <haptic_sculpt/surface/read_surface.h>
#include <haptic_sculpt/surface/write_surface.h>

#include <meshes/generated_meshes.h>
#include <surface/Temporary_folder.h>
#include <surface/identical.h>

#include <CGAL/Simple_cartesian.h>

#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <cstring>
#include <locale>
#include <random>

using namespace haptic_sculpt;
using meshes::Mesh;
using meshes::to_mesh;
namespace fs = std::filesystem;

BOOST_AUTO_TEST_SUITE(reading_and_writing)

namespace {

/// Coordinates of nearly all exponents that are in range, subnormals and negative zero among them, in a valid surface.
Mesh all_exponents() {
  meshes::Triangle_list list;
  for (int exponent = -1060; exponent < 1000; exponent += 19) {
    auto part = meshes::tetrahedron();
    const double x = std::ldexp(1.1, exponent), s = std::ldexp(1.0 / 7, exponent - 3);
    list += part.transform([=](const meshes::Point_3& p) {
      return meshes::Point_3(-x + s * p.x(), p.y() == 0 ? -0.0 : s * p.y(), s * p.z());
    });
  }
  return to_mesh(list);
}

const std::vector<std::pair<std::string, Write_parameters::Encoding>> lossless{
    {"m.off", Write_parameters::Encoding::automatic},
    {"m.ply", Write_parameters::Encoding::ascii},
    {"m.ply", Write_parameters::Encoding::binary},
    {"m.obj", Write_parameters::Encoding::automatic},
    {"m.PLY", Write_parameters::Encoding::automatic}};

} // namespace

BOOST_AUTO_TEST_CASE(every_bit_comes_back) {
  const Temporary_folder folder;
  const Mesh meshes_[] = {to_mesh(meshes::cube()),
                          to_mesh(meshes::bumpy_sphere(3, 0.4, 0.01, 3)),
                          all_exponents(),
                          to_mesh(meshes::c_tube(1e-12)),
                          to_mesh(meshes::nearly_pinched(1e-300)),
                          to_mesh(meshes::ball_in_a_cavity())};
  for (const Mesh& mesh : meshes_) {
    BOOST_REQUIRE(validate(mesh).is_valid());
    for (const auto& [name, encoding] : lossless) {
      Write_parameters options;
      options.encoding(encoding);
      write_surface(folder / name, mesh, options);
      const Mesh back = read_surface<Mesh>(folder / name);
      BOOST_TEST(identical(mesh, back), name);
      BOOST_TEST(validate(back).is_valid());
      BOOST_TEST(back.is_valid(false));
    }
  }
  BOOST_TEST(folder.number_of_files() == 4u); // and no temporary file
}

BOOST_AUTO_TEST_CASE(random_doubles_come_back) {
  constexpr unsigned seed = 77;
  BOOST_TEST_MESSAGE("seed " << seed);
  std::mt19937_64 random(seed);
  Mesh mesh = to_mesh(meshes::tetrahedron());
  for (int i = 0; i < 20000; ++i) { // points without faces may lie anywhere
    const auto any = [&] {
      double x;
      do {
        const std::uint64_t pattern = random();
        std::memcpy(&x, &pattern, sizeof x);
      } while (!haptic_sculpt::is_in_range(x));
      return x;
    };
    mesh.add_vertex({any(), any(), any()});
  }
  const Temporary_folder folder;
  for (const auto& [name, encoding] : lossless) {
    Write_parameters options;
    options.encoding(encoding);
    write_surface(folder / name, mesh, options);
    const Face_soup soup = read_face_soup(folder / name);
    BOOST_TEST(soup.number_of_faces() == mesh.number_of_faces());
    BOOST_REQUIRE(soup.points.size() == mesh.number_of_vertices());
    const auto bits = [](const auto& q) {
      return reading_and_writing::bits(std::vector{Face_soup::Point_3(q.x(), q.y(), q.z())});
    };
    std::size_t changed = 0;
    for (const auto v : mesh.vertices())
      changed += bits(soup.points[v]) != bits(mesh.point(v));
    BOOST_TEST(changed == 0u, name);
    BOOST_CHECK_THROW(read_surface<Mesh>(folder / name), Invalid_surface);
  }
}

BOOST_AUTO_TEST_CASE(a_gap_of_1e_minus_12_survives) {
  const Temporary_folder folder;
  const Mesh mesh = to_mesh(meshes::c_tube(1e-12));
  for (const char* name : {"gap.off", "gap.ply", "gap.obj", "gap.stl"}) {
    write_surface((folder / name).string(), mesh); // a std::string, and below a const char*, will do
    BOOST_TEST(validate(read_surface<Mesh>((folder / name).c_str())).is_valid());
  }
  // Six digits, CGAL's default, would have closed it.
  std::ofstream(folder / "six.off") << to_mesh(meshes::c_tube(1e-12).scale_and_move(1, 1, 0, 0));
  BOOST_CHECK_THROW(read_surface<Mesh>(folder / "six.off"), Error);
}

BOOST_AUTO_TEST_CASE(shuffled_faces_are_read_in_file_order) {
  constexpr unsigned seed = 9;
  BOOST_TEST_MESSAGE("seed " << seed);
  std::mt19937 random(seed);
  const Temporary_folder folder;
  for (int round = 0; round < 20; ++round) {
    auto list = meshes::torus(9, 7);
    std::shuffle(list.faces.begin(), list.faces.end(), random);
    std::string text = "OFF\n63 126 0\n";
    std::ostringstream out;
    out.precision(17);
    for (const auto& p : list.points)
      out << p << '\n';
    for (const auto& f : list.faces)
      out << "3 " << f[0] << ' ' << f[1] << ' ' << f[2] << '\n';
    const Mesh mesh = read_surface<Mesh>(folder.file("t.off", text + out.str()));
    BOOST_REQUIRE(mesh.number_of_faces() == 126u);
    for (std::size_t f = 0; f < 126; ++f) {
      std::vector<std::size_t> corners;
      for (const auto v : CGAL::vertices_around_face(mesh.halfedge(F(f)), mesh))
        corners.push_back(v);
      std::sort(corners.begin(), corners.end());
      auto expected = list.faces[f];
      std::sort(expected.begin(), expected.end());
      BOOST_TEST(std::equal(expected.begin(), expected.end(), corners.begin()));
    }
  }
}

BOOST_AUTO_TEST_CASE(stl) {
  const Temporary_folder folder;
  const Mesh mesh = to_mesh(meshes::bumpy_sphere(2));
  Write_parameters binary;
  binary.encoding(Write_parameters::Encoding::binary);
  BOOST_CHECK_EXCEPTION(write_surface(folder / "b.stl", mesh, binary), Write_error,
                        [](const Error& e) { return std::string(e.what()).find("floats") != std::string::npos; });
  BOOST_TEST(folder.number_of_files() == 0u);
  binary.allow_rounding();
  write_surface(folder / "b.stl", mesh, binary);
  BOOST_TEST(fs::file_size(folder / "b.stl") == 84 + 50 * mesh.number_of_faces());
  const Mesh rounded = read_surface<Mesh>(folder / "b.stl");
  BOOST_TEST(rounded.number_of_faces() == mesh.number_of_faces());
  // What has been rounded is lossless from now on, up to the numbering.
  binary.allow_rounding(false);
  write_surface(folder / "c.stl", rounded, binary);
  BOOST_TEST(identical(rounded, read_surface<Mesh>(folder / "c.stl")));
  // A gap of 1e-12 beside coordinates of 1 ... survives floats at 0; moved to 1 it closes, and is refused.
  Mesh gap = to_mesh(meshes::c_tube(1e-12).scale_and_move(1, 1, 0, 0));
  BOOST_REQUIRE(validate(gap).is_valid());
  binary.allow_rounding();
  BOOST_CHECK_EXCEPTION(write_surface(folder / "g.stl", gap, binary), Write_error, [](const Error& e) {
    return std::string(e.what()).find("no longer valid") != std::string::npos;
  });
  BOOST_TEST(!fs::exists(folder / "g.stl"));
  // ASCII: lossless up to the numbering, which is by first appearance.
  write_surface(folder / "a.stl", gap);
  const Mesh back = read_surface<Mesh>(folder / "a.stl");
  const auto sorted = [](const Mesh& m) {
    auto found = bits(face_soup(m).points);
    std::sort(found.begin(), found.end());
    return found;
  };
  BOOST_TEST((sorted(back) == sorted(gap)));
  BOOST_TEST(bytes_of(folder / "a.stl").substr(0, 5) == "solid");
  std::size_t highest = 0;
  for (const auto f : back.faces()) {
    std::vector<std::size_t> corners;
    for (const auto v : CGAL::vertices_around_face(back.halfedge(f), back))
      corners.push_back(v);
    for (const std::size_t v : corners)
      BOOST_TEST(v <= highest + 3);
    highest = std::max(highest, *std::max_element(corners.begin(), corners.end()));
  }
  const V stray = gap.add_vertex({9, 9, 9}), last = gap.add_vertex({8, 8, 8});
  gap.remove_vertex(stray); // the file would close up what is behind it
  BOOST_CHECK_EXCEPTION(write_surface(folder / "p.stl", gap), Write_error, [&](const Error& e) {
    return std::string(e.what()).find("vertex " + std::to_string(std::size_t(last))) != std::string::npos;
  });
}

BOOST_AUTO_TEST_CASE(polygons_beyond_a_byte_are_written_as_text) {
  const Temporary_folder folder;
  Mesh mesh;
  std::vector<V> corners, backwards;
  constexpr int number = 300;
  for (int i = 0; i < number; ++i)
    corners.push_back(mesh.add_vertex({std::cos(2 * CGAL_PI * i / number), std::sin(2 * CGAL_PI * i / number), 0}));
  backwards.assign(corners.rbegin(), corners.rend());
  mesh.add_face(corners), mesh.add_face(backwards);
  Write_parameters as_text, as_bytes;
  as_text.encoding(Write_parameters::Encoding::ascii), as_bytes.encoding(Write_parameters::Encoding::binary);
  BOOST_CHECK_THROW(write_surface(folder / "m.ply", mesh, as_bytes), Write_error);
  write_surface(folder / "m.ply", mesh, as_text);
  const Face_soup soup = read_face_soup(folder / "m.ply");
  BOOST_TEST(soup.number_of_faces() == 2u);
  BOOST_TEST(soup.number_of_corners(0) == 300u);
  BOOST_TEST(soup.number_of_corners(1) == 300u);
}

BOOST_AUTO_TEST_CASE(bytes_are_read_as_their_file_is) {
  const Temporary_folder folder;
  const Mesh mesh = to_mesh(meshes::bumpy_sphere(2));
  for (const char* const name : {"m.off", "m.ply", "m.obj", "m.stl"}) {
    write_surface(folder / name, mesh);
    const std::string bytes = bytes_of(folder / name);
    fs::remove(folder / name);
    const Mesh back = make_surface<Mesh>(read_face_soup(folder / name, bytes));
    write_surface(folder / name, back);
    BOOST_TEST((bytes_of(folder / name) == bytes), name);
  }
  const auto names = [](const char* what) {
    return [what](const Error& e) { return std::string(e.what()).find(what) != std::string::npos; };
  };
  BOOST_CHECK_EXCEPTION(read_face_soup("there.off", " \n"), Read_error, names("'there.off': the file is empty"));
  BOOST_CHECK_EXCEPTION(read_face_soup("there.txt", "OFF"), Read_error, names("'there.txt': the extension"));
  const Face_soup flat = read_face_soup("there.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
  BOOST_CHECK_EXCEPTION(make_surface<Mesh>(flat, 0, "'there.off'"), Invalid_surface, names("'there.off' is not"));
  Face_soup from = flat;
  const Face_soup to = std::move(from);
  BOOST_TEST(from.number_of_faces() == 0u); // NOLINT: what is left is a list without faces
  BOOST_TEST(to.number_of_faces() == 1u);
}

BOOST_AUTO_TEST_CASE(removed_vertices_and_vertex_order) {
  const Temporary_folder folder;
  auto list = meshes::tetrahedron();
  auto cube = meshes::cube();
  list += cube.scale_and_move(1, 5, 0, 0);
  Mesh mesh = to_mesh(list);
  for (int f = 0; f < 4; ++f)
    CGAL::Euler::remove_face(mesh.halfedge(F(f)), mesh);
  BOOST_REQUIRE(mesh.number_of_removed_vertices() == 4u);
  write_surface(folder / "m.off", mesh);
  Mesh back = read_surface<Mesh>(folder / "m.off");
  BOOST_TEST(identical(back, to_mesh(cube)));
  Write_parameters options;
  for (std::size_t i = 12; i-- > 4;)
    options.vertices_order.emplace_back(i);
  write_surface(folder / "m.off", mesh, options);
  back = read_surface<Mesh>(folder / "m.off");
  for (std::size_t i = 0; i < 8; ++i)
    BOOST_TEST(back.point(V(i)) == mesh.point(V(11 - i)));
  const auto message = [&] {
    try {
      write_surface(folder / "x.off", mesh, options);
    } catch (const Write_error& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  options.vertices_order.back() = V(0);
  BOOST_TEST(message().find("vertex 0, which") != std::string::npos);
  options.vertices_order.back() = V(8);
  BOOST_TEST(message().find("vertex 8 twice") != std::string::npos);
  options.vertices_order.pop_back();
  BOOST_TEST(message().find("7 of 8") != std::string::npos);
  BOOST_TEST(folder.number_of_files() == 1u);
}

BOOST_AUTO_TEST_CASE(other_kernels) {
  using Simple = CGAL::Surface_mesh<CGAL::Simple_cartesian<double>::Point_3>;
  const Temporary_folder folder;
  const Simple mesh = to_mesh<Simple>(meshes::bumpy_sphere(2));
  write_surface(folder / "m.ply", mesh);
  const Simple back = read_surface<Simple>(folder / "m.ply");
  for (const auto v : mesh.vertices())
    BOOST_TEST((mesh.point(v) == back.point(v)));
}

BOOST_AUTO_TEST_CASE(the_global_locale_changes_nothing) {
  struct Comma : std::numpunct<char> {
    char do_decimal_point() const override { return ','; }
    char do_thousands_sep() const override { return '.'; }
    std::string do_grouping() const override { return "\3"; }
  };
  const Temporary_folder folder;
  const Mesh mesh = to_mesh(meshes::torus(40, 30));
  const std::locale before = std::locale::global(std::locale(std::locale::classic(), new Comma));
  for (const char* name : {"m.off", "m.ply", "m.obj", "m.stl"})
    write_surface(folder / name, mesh);
  Write_parameters ascii;
  ascii.encoding(Write_parameters::Encoding::ascii);
  write_surface(folder / "a.ply", mesh, ascii);
  std::vector<Mesh> back;
  for (const char* name : {"m.off", "m.ply", "m.obj", "a.ply", "m.stl"})
    back.push_back(read_surface<Mesh>(folder / name));
  std::locale::global(before);
  for (std::size_t i = 0; i < 4; ++i)
    BOOST_TEST(identical(back[i], mesh));
  BOOST_TEST(back[4].number_of_faces() == mesh.number_of_faces());
}

BOOST_AUTO_TEST_SUITE_END()
