// SPDX-License-Identifier: GPL-3.0-or-later
#include <haptic_sculpt/surface/read_surface.h>
#include <haptic_sculpt/surface/write_surface.h>

#include <meshes/generated_meshes.h>
#include <surface/Temporary_folder.h>

#include <CGAL/IO/polygon_soup_io.h>
#include <CGAL/Simple_cartesian.h>

#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstring>
#include <locale>
#include <random>

#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

using namespace haptic_sculpt;
using meshes::Mesh;
using meshes::to_mesh;
namespace fs = std::filesystem;

namespace {

using V = Mesh::Vertex_index;
using F = Mesh::Face_index;

std::vector<std::array<std::uint64_t, 3>> bits(const std::vector<meshes::Point_3>& points) {
  std::vector<std::array<std::uint64_t, 3>> found;
  for (const auto& p : points) {
    const double x[3] = {p.x(), p.y(), p.z()};
    std::memcpy(found.emplace_back().data(), x, sizeof x);
  }
  return found;
}

/// Same points to the bit and same faces, in the same order, each from the same corner on.
bool identical(const Mesh& a, const Mesh& b) {
  const Face_soup s = face_soup(a), t = face_soup(b);
  return bits(s.points) == bits(t.points) && s.corners == t.corners && s.first_corner == t.first_corner;
}

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

const std::vector<std::pair<std::string, Write_options::Encoding>> lossless{
    {"m.off", Write_options::Encoding::automatic},
    {"m.ply", Write_options::Encoding::ascii},
    {"m.ply", Write_options::Encoding::binary},
    {"m.obj", Write_options::Encoding::automatic},
    {"m.PLY", Write_options::Encoding::automatic}};

} // namespace

BOOST_AUTO_TEST_SUITE(reading_and_writing)

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
      Write_options options;
      options.encoding = encoding;
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
  for (int i = 0; i < 20000; ++i) { // isolated vertices may lie anywhere
    const auto any = [&] {
      double x;
      do {
        const std::uint64_t pattern = random();
        std::memcpy(&x, &pattern, sizeof x);
      } while (!haptic_sculpt::internal::is_in_range(x));
      return x;
    };
    mesh.add_vertex({any(), any(), any()});
  }
  const Temporary_folder folder;
  for (const auto& [name, encoding] : lossless) {
    Write_options options;
    options.encoding = encoding;
    write_surface(folder / name, mesh, options);
    BOOST_TEST(identical(mesh, read_surface<Mesh>(folder / name)), name);
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
  Write_options binary;
  binary.encoding = Write_options::Encoding::binary;
  BOOST_CHECK_EXCEPTION(write_surface(folder / "b.stl", mesh, binary), Write_error,
                        [](const Error& e) { return std::string(e.what()).find("floats") != std::string::npos; });
  BOOST_TEST(folder.number_of_files() == 0u);
  binary.allow_rounding = true;
  write_surface(folder / "b.stl", mesh, binary);
  BOOST_TEST(fs::file_size(folder / "b.stl") == 84 + 50 * mesh.number_of_faces());
  const Mesh rounded = read_surface<Mesh>(folder / "b.stl");
  BOOST_TEST(rounded.number_of_faces() == mesh.number_of_faces());
  // What has been rounded is lossless from now on, up to the numbering.
  binary.allow_rounding = false;
  write_surface(folder / "c.stl", rounded, binary);
  BOOST_TEST(identical(rounded, read_surface<Mesh>(folder / "c.stl")));
  // A gap of 1e-12 beside coordinates of 1 ... survives floats at 0; moved to 1 it closes, and is refused.
  Mesh gap = to_mesh(meshes::c_tube(1e-12).scale_and_move(1, 1, 0, 0));
  BOOST_REQUIRE(validate(gap).is_valid());
  binary.allow_rounding = true;
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
  gap.add_vertex({9, 9, 9});
  BOOST_CHECK_THROW(write_surface(folder / "p.stl", gap), Write_error);
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
  Write_options options;
  for (std::size_t i = 12; i-- > 4;)
    options.vertex_order.emplace_back(i);
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
  options.vertex_order.back() = V(0);
  BOOST_TEST(message().find("vertex 0, which") != std::string::npos);
  options.vertex_order.back() = V(8);
  BOOST_TEST(message().find("vertex 8 twice") != std::string::npos);
  options.vertex_order.pop_back();
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

BOOST_AUTO_TEST_CASE(a_file_is_replaced_whole_or_not_at_all) {
  const Temporary_folder folder;
  const Mesh mesh = to_mesh(meshes::icosphere(4));
  const auto target = folder.file("m.off", "precious");
  fs::permissions(target, fs::perms::owner_all | fs::perms::group_read);

  // The disk is full: files may not grow beyond 10,000 bytes.
  rlimit before{};
  BOOST_REQUIRE(::getrlimit(RLIMIT_FSIZE, &before) == 0);
  const auto old_handler = std::signal(SIGXFSZ, SIG_IGN);
  rlimit small = before;
  small.rlim_cur = 10000;
  BOOST_REQUIRE(::setrlimit(RLIMIT_FSIZE, &small) == 0);
  std::string message;
  try {
    write_surface(target, mesh);
  } catch (const Write_error& error) {
    message = error.what();
  }
  ::setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, old_handler);
  BOOST_TEST(message.find("m.off") != std::string::npos, message);
  BOOST_TEST(bytes_of(target) == "precious");
  BOOST_TEST(folder.number_of_files() == 1u);

  write_surface(target, mesh);
  BOOST_TEST(identical(read_surface<Mesh>(target), mesh));
  BOOST_TEST(int(fs::status(target).permissions()) == int(fs::perms::owner_all | fs::perms::group_read));

  // Through a symbolic link, whose target is replaced.
  fs::create_symlink(target, folder / "link.off");
  write_surface(folder / "link.off", to_mesh(meshes::cube()));
  BOOST_TEST(fs::is_symlink(folder / "link.off"));
  BOOST_TEST(read_surface<Mesh>(target).number_of_faces() == 12u);
  fs::remove(folder / "link.off");

  fs::create_directory(folder / "d.off");
  for (const fs::path& path :
       {folder / "d.off", folder / "missing" / "m.off", fs::path("/proc/m.off"), folder / "m.txt", folder / "m"})
    BOOST_CHECK_THROW(write_surface(path, mesh), Write_error);
  BOOST_CHECK_THROW(replace_file("/dev/full", "x"), Write_error);
  BOOST_TEST(fs::is_character_file("/dev/full"));
  Mesh infinite = mesh;
  infinite.point(V(7)) = {0, 0, std::numeric_limits<double>::infinity()};
  BOOST_CHECK_THROW(write_surface(target, infinite), Write_error);
  BOOST_TEST(read_surface<Mesh>(target).number_of_faces() == 12u);
  BOOST_TEST(folder.number_of_files() == 2u);
}

BOOST_AUTO_TEST_CASE(a_link_that_leads_nowhere_gets_a_file_and_a_circle_is_refused) {
  const Temporary_folder folder;
  const Mesh mesh = to_mesh(meshes::cube());
  fs::create_directory(folder / "there");
  fs::create_symlink("there/m.off", folder / "first.off"); // relative to the folder of the link
  fs::create_symlink(folder / "first.off", folder / "second.off");
  for (int i = 0; i < 2; ++i) {
    BOOST_TEST(write_surface(folder / "second.off", mesh) == "");
    BOOST_TEST(fs::is_symlink(folder / "first.off"));
    BOOST_TEST(fs::is_symlink(folder / "second.off"));
    BOOST_TEST(identical(read_surface<Mesh>(folder / "there" / "m.off"), mesh));
  }
  fs::create_symlink("b.off", folder / "a.off");
  fs::create_symlink("a.off", folder / "b.off");
  fs::create_symlink("missing/m.off", folder / "c.off");
  for (const char* name : {"a.off", "b.off", "c.off"}) {
    BOOST_CHECK_THROW(write_surface(folder / name, mesh), Write_error);
    BOOST_TEST(fs::is_symlink(folder / name));
  }
  BOOST_TEST(folder.number_of_files() == 6u);
}

BOOST_AUTO_TEST_CASE(rights_that_a_file_lends_are_not_passed_on) {
  const Temporary_folder folder;
  const auto target = folder.file("m.off", "a program");
  for (const mode_t mode : {04755, 02755, 06711, 0640}) {
    BOOST_REQUIRE(::chmod(target.c_str(), mode) == 0);
    replace_file(target, "other bytes");
    struct stat status {};
    BOOST_REQUIRE(::stat(target.c_str(), &status) == 0);
    BOOST_TEST((status.st_mode & 07777) == (mode & 0777));
  }
  if (::geteuid() != 0)
    return; // owners can be given by root only
  BOOST_REQUIRE(::chown(target.c_str(), 12345, 23456) == 0);
  BOOST_TEST(replace_file(target, "more bytes") == "");
  struct stat status {};
  BOOST_REQUIRE(::stat(target.c_str(), &status) == 0);
  BOOST_TEST(status.st_uid == 12345u);
  BOOST_TEST(status.st_gid == 23456u);
}

BOOST_AUTO_TEST_CASE(temporary_files_of_killed_processes_are_removed) {
  const Temporary_folder folder;
  const auto target = folder / "m.off";
  const pid_t child = ::fork();
  BOOST_REQUIRE(child >= 0);
  if (child == 0) { // is killed while it writes
    const internal::Temporary_file half(target);
    ::kill(::getpid(), SIGKILL);
  }
  BOOST_REQUIRE(::waitpid(child, nullptr, 0) == child);
  BOOST_REQUIRE(folder.number_of_files() == 1u);
  const internal::Temporary_file living(target);
  BOOST_REQUIRE(folder.number_of_files() == 2u);
  const auto other = folder.file(".m.off.haptic_sculpt-new-no", "somebody's");
  replace_file(target, "bytes");
  BOOST_TEST(bytes_of(target) == "bytes");
  BOOST_TEST(bytes_of(other) == "somebody's");
  BOOST_TEST(folder.number_of_files() == 3u); // these, and the one of the living
  struct stat status {};
  BOOST_TEST(::fstat(living.descriptor(), &status) == 0);
  BOOST_TEST(status.st_nlink == 1u);
  // A name as long as names may be.
  const fs::path longest = folder / (std::string(251, 'x') + ".off");
  replace_file(longest, "bytes");
  BOOST_TEST(bytes_of(longest) == "bytes");
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
  Write_options ascii;
  ascii.encoding = Write_options::Encoding::ascii;
  write_surface(folder / "a.ply", mesh, ascii);
  std::vector<Mesh> back;
  for (const char* name : {"m.off", "m.ply", "m.obj", "a.ply", "m.stl"})
    back.push_back(read_surface<Mesh>(folder / name));
  std::locale::global(before);
  for (std::size_t i = 0; i < 4; ++i)
    BOOST_TEST(identical(back[i], mesh));
  BOOST_TEST(back[4].number_of_faces() == mesh.number_of_faces());
}

// The readers of CGAL see the same in good files, and count the same intersections.
BOOST_AUTO_TEST_CASE(shared_meshes) {
  const fs::path shared = fs::path(HAPTIC_SCULPT_SHARED_DATA) / "meshes";
  if (!fs::is_directory(shared)) {
    BOOST_TEST_MESSAGE("skipped: no " << shared);
    return;
  }
  const Temporary_folder folder;
  std::size_t good = 0, refused = 0;
  for (const auto& entry : fs::directory_iterator(shared)) {
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
  const fs::path path = fs::path(HAPTIC_SCULPT_SHARED_DATA) / "meshes" / "gen_cgal_knot_loop4.ply";
  if (!fs::exists(path)) {
    BOOST_TEST_MESSAGE("skipped: no " << path);
    return;
  }
  using Clock = std::chrono::steady_clock;
  const auto seconds = [](Clock::time_point from, Clock::time_point to) {
    return std::chrono::duration<double>(to - from).count();
  };
  const auto start = Clock::now();
  const Face_soup soup = read_face_soup(path);
  const auto parsed = Clock::now();
  const Validity_report report = validate_soup(soup);
  const auto validated = Clock::now();
  BOOST_TEST(report.is_valid());
  const Mesh mesh = internal::mesh_of<Mesh>(soup);
  const auto built = Clock::now();
  const Temporary_folder folder;
  write_surface(folder / "m.ply", mesh);
  const auto written = Clock::now();
  BOOST_TEST(identical(internal::mesh_of<Mesh>(read_face_soup(folder / "m.ply")), mesh));
  BOOST_TEST_MESSAGE(soup.number_of_faces()
                     << " triangles: parsed " << seconds(start, parsed) << " s, validated "
                     << seconds(parsed, validated) << " s, made a mesh " << seconds(validated, built) << " s, written "
                     << seconds(built, written) << " s");
}

BOOST_AUTO_TEST_SUITE_END()
