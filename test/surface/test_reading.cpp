// SPDX-License-Identifier: GPL-3.0-or-later
#include <haptic_sculpt/surface/read_surface.h>
#include <haptic_sculpt/surface/write_surface.h>

#include <meshes/generated_meshes.h>
#include <surface/Temporary_folder.h>

#include <boost/test/unit_test.hpp>

#include <cfenv>
#include <chrono>
#include <cstring>
#include <random>

#if defined(__SSE2__)
#include <immintrin.h>
#endif

using namespace haptic_sculpt;
using meshes::Mesh;
using meshes::to_mesh;

namespace {

bool same_bits(const Face_soup& s, const Face_soup& t) {
  return s.corners == t.corners && s.points.size() == t.points.size() &&
         std::equal(s.points.begin(), s.points.end(), t.points.begin(), [](const auto& p, const auto& q) {
           const double x[3] = {p.x(), p.y(), p.z()}, y[3] = {q.x(), q.y(), q.z()};
           return std::memcmp(x, y, sizeof x) == 0;
         });
}

std::string refusal(const std::filesystem::path& path) {
  try {
    read_surface<Mesh>(path);
    return {};
  } catch (const Error& error) {
    return error.what();
  }
}

void check_refused(const std::filesystem::path& path, const std::string& words) {
  const std::string message = refusal(path);
  BOOST_TEST(message.find(words) != std::string::npos, "'" + message + "' lacks '" + words + "'");
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  for (auto at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
    text.replace(at, from.size(), to);
  return text;
}

const std::string tetrahedron = "OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n";
const std::string ascii_stl =
    "solid\nfacet normal 0 0 -1\nouter loop\nvertex 0 0 0\nvertex 0 1 0\nvertex 1 0 0\nendloop\nendfacet\n"
    "facet normal 0 -1 0\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 0 1\nendloop\nendfacet\n"
    "facet normal 1 1 1\nouter loop\nvertex 1 0 0\nvertex 0 1 0\nvertex 0 0 1\nendloop\nendfacet\n"
    "facet normal -1 0 0\nouter loop\nvertex 0 1 0\nvertex 0 0 0\nvertex 0 0 1\nendloop\nendfacet\nendsolid\n";

/// Triangles that all cross near one point.
Face_soup crossing_triangles(std::size_t n) {
  constexpr unsigned seed = 4;
  BOOST_TEST_MESSAGE("seed " << seed);
  std::mt19937 random(seed);
  const auto draw = [&] { return random() / 2147483648.0 - 1; };
  Face_soup soup;
  for (std::size_t i = 0; i < n; ++i) {
    const double a[3] = {draw(), draw(), draw()}, b[3] = {draw(), draw(), draw()};
    soup.points.emplace_back(a[0], a[1], a[2]);
    soup.points.emplace_back(b[0], b[1], b[2]);
    soup.points.emplace_back(1e-3 * draw() - a[0] - b[0], -a[1] - b[1], -a[2] - b[2]);
    soup.add_face(std::array<std::size_t, 3>{3 * i, 3 * i + 1, 3 * i + 2});
  }
  return soup;
}

} // namespace

BOOST_AUTO_TEST_SUITE(reading)

BOOST_AUTO_TEST_CASE(numbers_have_one_sign) {
  const Temporary_folder folder;
  const auto off = [&](const std::string& x) {
    return folder.file("m.off", replaced(tetrahedron, "1 0 0", x + " 0 0"));
  };
  for (const char* good : {"1", "+1", "1.", "1e0", "+.5e1"})
    BOOST_TEST(refusal(off(good)) == "", good);
  for (const char* bad : {"+-1", "-+1", "++1", "--1", "+", "-", "+e1", "1+", "0x1"})
    check_refused(off(bad), "line 4: '" + std::string(bad) + "' is not a coordinate");
  check_refused(folder.file("m.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 +-2\n"), "line 5: '+-2'");
}

BOOST_AUTO_TEST_CASE(off_counts_its_edges) {
  const Temporary_folder folder;
  const auto off = [&](const std::string& counts) {
    return folder.file("m.off", replaced(tetrahedron, "4 4 0", counts));
  };
  for (const char* good : {"4 4 0", "4 4 6", "4 4", "4 4 # none"})
    BOOST_TEST(refusal(off(good)) == "", good);
  for (const char* bad : {"4 4 5", "4 4 7", "4 4 12", "4 4 18446744073709551615"})
    check_refused(off(bad), "edges, but the faces have 6");
  check_refused(off("4 4 -6"), "line 2: '-6' is not the number of edges");
  check_refused(off("4 4 six"), "line 2: 'six'");
  check_refused(off("4 4 6 1"), "line 2: '1' stands after the number of edges");
}

BOOST_AUTO_TEST_CASE(stl_in_capitals) {
  const Temporary_folder folder;
  const auto upper = [](std::string text) {
    for (char& c : text)
      c = c >= 'a' && c <= 'z' ? char(c - 'a' + 'A') : c;
    return text;
  };
  BOOST_TEST(refusal(folder.file("m.stl", ascii_stl)) == "");
  BOOST_TEST(refusal(folder.file("m.stl", upper(ascii_stl))) == "");
  BOOST_TEST(refusal(folder.file("m.stl", "  \r\n Solid name" + ascii_stl.substr(5))) == "");
  BOOST_TEST(refusal(folder.file("m.stl", replaced(ascii_stl, "facet normal", "Facet Normal"))) == "");
  check_refused(folder.file("m.stl", "SOLIDUS" + upper(ascii_stl).substr(5)), "'SOLIDUS' stands where 'solid'");
}

BOOST_AUTO_TEST_CASE(messages_hold_no_control_bytes) {
  const Temporary_folder folder;
  const std::string order = "\x1b[2J\x07\x7f\x80\xff\\";
  const std::string shown = "\\x1b[2J\\x07\\x7f\\x80\\xff\\\\";
  const std::string ply =
      "ply\nformat ascii 1.0\nelement vertex 1\nproperty double x\nproperty double y\n"
      "property double z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n";
  const std::pair<const char*, std::string> files[] = {
      {"m.off", replaced(tetrahedron, "1 0 0", order + " 0 0")},
      {"m.off", replaced(tetrahedron, "1 0 0", "1 0 0 " + order)},
      {"m.off", order + "OFF\n"},
      {"m.off", order},
      {"m.obj", order + "\n"},
      {"m.obj", "v " + order + " 0 0\n"},
      {"m.ply", replaced(ply, "double x", order + " x")},
      {"m.ply", replaced(ply, "ascii", order)},
      {"m.ply", replaced(ply, "element face", order + " face")},
      {"m.ply", replaced(ply, "element face 1", "element " + order + " 1") + "3 0 x 0\n"},
      {"m.ply", replaced(ply, "element face 1", "element " + order + " 99999")},
      {"m.ply", replaced(ply, "element face 1", "element " + order + " 1\nelement face 1")},
      {"m.stl", replaced(ascii_stl, "outer", order)},
      {"m.stl", replaced(ascii_stl, "facet", order)}};
  for (const auto& [name, contents] : files) {
    const std::string message = refusal(folder.file(name, contents));
    BOOST_TEST(message.find(shown) != std::string::npos, message);
    for (const char c : message)
      BOOST_TEST((c >= ' ' && c <= '~'), message);
  }
  // A long word is cut.
  BOOST_TEST(refusal(folder.file("m.obj", std::string(100000, 'x'))).size() < 200u);
  // The name of a file keeps its letters, of any alphabet.
  check_refused(folder / "\xc3\xbc\xe2\x88\x9e\x1b\n\xff\xc2\x85.off",
                "/\xc3\xbc\xe2\x88\x9e\\x1b\\x0a\\xff\\xc2\\x85.off'");
}

BOOST_AUTO_TEST_CASE(refusals_name_the_first_pairs) {
  const Face_soup soup = crossing_triangles(8000);
  const auto start = std::chrono::steady_clock::now();
  const Validity_report report = validate_soup(soup);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  BOOST_TEST_MESSAGE("8,000 crossing triangles refused in " << seconds << " s");
  BOOST_TEST(report.intersecting_faces.size() == Validity_report::default_most_intersections);
  BOOST_TEST(report.has_more_intersections);
  BOOST_TEST(report.boundary_edges.size() == 24000u); // the other kinds are reported in full
  BOOST_TEST(report.message().find("\nat least 1000 pair(s) of intersecting faces: ") != std::string::npos);
  BOOST_TEST(std::is_sorted(report.intersecting_faces.begin(), report.intersecting_faces.end()));
  BOOST_TEST((validate_soup(soup).intersecting_faces == report.intersecting_faces));
}

BOOST_AUTO_TEST_CASE(as_many_pairs_as_are_asked_for) {
  const Face_soup soup = crossing_triangles(60);
  const auto all = validate_soup(soup, 0, Validity_report::all_intersections);
  const std::size_t n = all.intersecting_faces.size();
  BOOST_REQUIRE(n > 1000u);
  BOOST_TEST(!all.has_more_intersections);
  BOOST_TEST(all.message().find("at least") == std::string::npos);
  for (const std::size_t most : {std::size_t(0), std::size_t(1), n - 1, n, n + 1}) {
    const auto report = validate_soup(soup, 0, most);
    BOOST_TEST(report.intersecting_faces.size() == std::min(std::max<std::size_t>(most, 1), n));
    BOOST_TEST(report.has_more_intersections == (most < n));
    BOOST_TEST(std::includes(all.intersecting_faces.begin(), all.intersecting_faces.end(),
                             report.intersecting_faces.begin(), report.intersecting_faces.end()));
  }
}

namespace {

/// Writes and reads meshes in a mode of arithmetic that `set` and `is_set` know; all bits have to be as they are in the
/// usual one, and the mode has to be the caller's again after each call.
template <class Set, class Is_set>
void check_mode(const Set& set, const Is_set& is_set, const std::function<void()>& reset) {
  constexpr unsigned seed = 6;
  std::mt19937_64 random(seed);
  Mesh mesh = to_mesh(meshes::sliver_stack(3, 0x1p-1070));
  for (int i = 0; i < 2000; ++i) { // vertices without faces may lie anywhere
    double x[3];
    for (double& coordinate : x)
      do {
        const std::uint64_t pattern = random();
        std::memcpy(&coordinate, &pattern, sizeof coordinate);
      } while (!haptic_sculpt::is_in_range(coordinate));
    mesh.add_vertex({x[0], x[1], x[2]});
  }
  const Mesh thin = to_mesh(meshes::c_tube(1e-12));
  const Temporary_folder folder;
  Write_parameters ascii;
  ascii.encoding(Write_parameters::Encoding::ascii);
  for (const char* name : {"m.off", "m.ply", "m.obj", "m.stl"}) {
    const Mesh& written = std::string(name) == "m.stl" ? thin : mesh;
    write_surface(folder / name, written, ascii);
    const std::string usual = bytes_of(folder / name);
    const Face_soup expected = read_face_soup(folder / name);
    set();
    write_surface(folder / name, written, ascii);
    const bool kept_by_writing = is_set();
    const Face_soup back = read_face_soup(folder / name);
    const bool kept_by_reading = is_set();
    const std::size_t faults = validate(written).number_of_faults();
    const bool kept_by_validating = is_set();
    bool refused = false;
    try {
      read_surface<Mesh>(folder / "missing.off");
    } catch (const Read_error&) {
      refused = true;
    }
    const bool kept_by_refusing = is_set();
    reset();
    BOOST_TEST((bytes_of(folder / name) == usual), name);
    BOOST_TEST(same_bits(back, expected), name);
    BOOST_TEST(faults == (&written == &mesh ? 2000u : 0u)); // points without faces
    BOOST_TEST(refused);
    BOOST_TEST((kept_by_writing && kept_by_reading && kept_by_validating && kept_by_refusing));
  }
}

} // namespace

BOOST_AUTO_TEST_CASE(the_callers_rounding_changes_nothing) {
  for (const int mode : {FE_TONEAREST, FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO})
    BOOST_TEST_CONTEXT("mode " << mode)
  check_mode([=] { std::fesetround(mode); }, [=] { return std::fegetround() == mode; },
             [] { std::fesetround(FE_TONEAREST); });
}

#if defined(__SSE2__)
BOOST_AUTO_TEST_CASE(flushed_subnormals_change_nothing) {
  const unsigned usual = _mm_getcsr(), flushing = 0x8040;
  check_mode([=] { _mm_setcsr(usual | flushing); }, [=] { return (_mm_getcsr() & flushing) == flushing; },
             [=] { _mm_setcsr(usual); });
}
#endif

BOOST_AUTO_TEST_SUITE_END()
