// SPDX-License-Identifier: GPL-3.0-or-later
// What each format refuses, and where it says that the fault is.
#include <haptic_sculpt/surface/read_surface.h>
#include <haptic_sculpt/surface/write_surface.h>

#include <meshes/generated_meshes.h>
#include <surface/Temporary_folder.h>
#include <surface/bad_files.h>

#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <cstring>
#include <limits>

using namespace haptic_sculpt;
using meshes::Mesh;

BOOST_AUTO_TEST_SUITE(bad_input)

BOOST_AUTO_TEST_CASE(off) {
  const Temporary_folder folder;
  const auto off = [&](const std::string& text) { return folder.file("m.off", text); };
  BOOST_TEST(refusal<Error>(off(tetrahedron)) == "");
  BOOST_TEST(refusal<Error>(
                 off("# a comment\n\n" + replaced(tetrahedron, "\n1 0 0", "\n\n# and one\n+1 0.0e5 .0 # here"))) == "");
  BOOST_TEST(refusal<Error>(off(replaced(tetrahedron, "OFF\n4 4 0", "OFF 4 4 0\r"))) == "");
  BOOST_TEST(refusal<Error>(off(replaced(tetrahedron, "OFF", "COFF"))) == "");
  BOOST_TEST(refusal<Error>(off(replaced(tetrahedron, "3 0 2 1", "3 0 2 1 255 0 0"))) == "");
  check_unreadable(off(replaced(tetrahedron, "4 4 0", "99999999999 4 0")), "promises 99999999999 vertices");
  check_unreadable(off(replaced(tetrahedron, "4 4 0", "4 4000000000 0")), "promises 4000000000 faces");
  check_unreadable(off(replaced(tetrahedron, "4 4 0", "-4 4 0")), "line 2: '-4'");
  check_unreadable(off(replaced(tetrahedron, "4 4 0", "4 4.5 0")), "line 2: '4.5'");
  check_unreadable(off(replaced(tetrahedron, "4 4 0", "123456789012345678901234567890 4 0")), "too large");
  check_unreadable(off(replaced(tetrahedron, "1 0 0", "1 0 zero")), "line 4: 'zero'");
  check_unreadable(off(replaced(tetrahedron, "1 0 0", "1 0 0x1p3")), "line 4: '0x1p3'");
  check_unreadable(off(replaced(tetrahedron, "1 0 0", "1 0 1e999")), "line 4: '1e999'");
  check_unreadable(off(replaced(tetrahedron, "1 0 0", "1 0")), "line 4");
  check_unreadable(off(replaced(tetrahedron, "1 0 0", "1 0 0 0 1 0")), "line 4: '0' stands after");
  check_unreadable(off(replaced(tetrahedron, "1 0 0", "1,0 0 0")), "line 4: '1,0'");
  check_unreadable(off(replaced(tetrahedron, "3 2 0 3", "3 2 0 4")), "face 3 names vertex 4, but there are only 4");
  check_unreadable(off(replaced(tetrahedron, "3 2 0 3", "3 2 0 -1")), "line 10: '-1'");
  check_unreadable(off(replaced(tetrahedron, "3 2 0 3", "4000000000 2 0 3")), "line 10");
  check_unreadable(off(tetrahedron + "3 0 1 2\n"), "line 11: text follows");
  check_unreadable(off(replaced(tetrahedron, "OFF", "4OFF")), "more than three coordinates");
  check_unreadable(off(replaced(tetrahedron, "OFF", "OFF BINARY")), "binary OFF");
  check_unreadable(off("OFF\n4 0 0\n" + points), "no faces");
  // 1e-400 is nearest to 0, as 0.1 is nearest to what is not 0.1.
  BOOST_TEST(refusal<Error>(off(replaced(tetrahedron, "1 0 0", "1 0 1e-400"))) == "");
}

BOOST_AUTO_TEST_CASE(ply) {
  const Temporary_folder folder;
  const auto ply = [&](const std::string& text) { return folder.file("m.ply", text); };
  const std::string good = ply_head + points + ply_faces;
  BOOST_TEST(refusal<Error>(ply(good)) == "");
  BOOST_TEST(refusal<Error>(ply(replaced(good, "property double x", "comment x\nobj_info y\nproperty float x"))) == "");
  check_unreadable(ply(replaced(good, "vertex 4", "vertex 400000000000")), "promises 400000000000");
  check_unreadable(ply(replaced(good, "face 4", "face 4000000")), "promises 4000000");
  check_unreadable(ply(replaced(good, "vertex 4", "vertex 5")), "");
  check_unreadable(ply(replaced(good, "face 4", "face 3")), "data follow");
  check_unreadable(ply(good + "garbage"), "data follow");
  check_unreadable(ply(replaced(good, "end_header\n", "")), "line 9");
  check_unreadable(ply(ply_head.substr(0, 60)), "");
  check_unreadable(ply(replaced(good, "ascii", "utf8")), "line 2: 'utf8'");
  check_unreadable(ply(replaced(good, "format ascii 1.0\n", "")), "no format");
  check_unreadable(ply(replaced(good, "double z", "double w")), "x, y and z");
  check_unreadable(ply(replaced(good, "double z", "quad z")), "line 6: 'quad'");
  check_unreadable(ply(replaced(good, "vertex_indices", "corners")), "vertex_indices");
  check_unreadable(ply(replaced(good, "3 1 2 3", "3 1 2 7")), "face 2 names vertex 7");
  check_unreadable(ply(replaced(good, "3 1 2 3", "3 1 2 -3")), "face 2 names vertex -3");
  check_unreadable(ply(replaced(good, "3 1 2 3", "255 1 2 3")), "face 2 of 4");
  check_unreadable(ply(replaced(good, "3 1 2 3", "3 1 2 x")), "line 16: 'x'");
  check_unreadable(ply(replaced(good, "list uchar", "list float")), "length of a list");
  check_unreadable(ply(replaced(good, "element face", "element vertex")), "twice");
  check_unreadable(ply(replaced(good, "end_header", "property list uchar int vertex_index\nend_header")),
                   "'vertex_indices' and a list 'vertex_index'");
  const auto report = report_of(ply(replaced(good, "1 0 0", "nan 0 0")));
  BOOST_TEST(report.non_finite_vertices.size() == 1u);
}

BOOST_AUTO_TEST_CASE(binary_ply) {
  const Temporary_folder folder;
  const auto head = [](const std::string& endian, const std::string& real, const std::string& length) {
    return "ply\nformat binary_" + endian + "_endian 1.0\nelement vertex 4\nproperty " + real + " x\nproperty " + real +
           " y\nproperty uchar red\nproperty " + real + " z\nelement face 4\nproperty list " + length +
           " int vertex_indices\nproperty list uchar float weights\nend_header\n";
  };
  const auto body = [](bool big, auto real, auto length, double last = 1) {
    std::string bytes;
    const auto put = [&](auto value) {
      char raw[sizeof value];
      std::memcpy(raw, &value, sizeof value);
      if (big) // this machine is little-endian, like all that Debian's packages here are built for
        std::reverse(raw, raw + sizeof value);
      bytes.append(raw, sizeof value);
    };
    for (const auto& p : {std::array<double, 3>{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, last}}) {
      put(decltype(real)(p[0]));
      put(decltype(real)(p[1]));
      put(std::uint8_t(200));
      put(decltype(real)(p[2]));
    }
    for (const auto& f : {std::array<int, 3>{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}) {
      put(length);
      for (const std::int32_t v : f)
        put(v);
      put(std::uint8_t(1));
      put(0.5f);
    }
    return bytes;
  };
  for (const bool big : {false, true}) {
    const std::string endian = big ? "big" : "little";
    const auto doubles = folder.file("d.ply", head(endian, "double", "uchar") + body(big, 0.0, std::uint8_t(3), 0.1));
    BOOST_TEST(read_surface<Mesh>(doubles).point(Mesh::Vertex_index(3)).z() == 0.1);
    const auto floats = folder.file("f.ply", head(endian, "float32", "int") + body(big, 0.f, std::int32_t(3), 0.1));
    BOOST_TEST(read_surface<Mesh>(floats).point(Mesh::Vertex_index(3)).z() == double(0.1f));
    // Cut short anywhere it is refused.
    const std::string whole = head(endian, "double", "uchar") + body(big, 0.0, std::uint8_t(3));
    for (std::size_t n = 1; n < whole.size(); ++n)
      BOOST_TEST(refusal<Error>(folder.file("t.ply", whole.substr(0, n))) != "");
    check_unreadable(folder.file("t.ply", whole + "x"), "data follow");
    check_unreadable(folder.file("n.ply", head(endian, "double", "int") + body(big, 0.0, std::int32_t(-3))),
                     "negative");
    check_unreadable(folder.file("n.ply", head(endian, "double", "uint") + body(big, 0.0, std::uint32_t(4000000000u))),
                     "face 0 of 4: the file ends");
    const auto nan =
        folder.file("n.ply", head(endian, "double", "uchar") + body(big, 0.0, std::uint8_t(3), std::nan("")));
    BOOST_TEST(report_of(nan).non_finite_vertices.size() == 1u);
  }
}

BOOST_AUTO_TEST_CASE(obj) {
  const Temporary_folder folder;
  const auto obj = [&](const std::string& text) { return folder.file("m.obj", text); };
  const std::string v = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n";
  const std::string f = "f 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";
  BOOST_TEST(refusal<Error>(obj(v + f)) == "");
  BOOST_TEST(refusal<Error>(obj("# c\nmtllib x.mtl\no name\nvt 0 0\nvn 0 0 1\ns off\n" + v +
                                "g a\nusemtl red\nf 1/1/1 3/1/1 2/1/1\nf "
                                "-4//1 -3//1 -1//1\nf 2/1 3/1 4/1\nf 3 1 4\nl 1 2\n")) == "");
  BOOST_TEST(refusal<Error>(obj(f + v)) == ""); // faces may come first
  check_unreadable(obj(v + replaced(f, "3 1 4", "3 1 5")), "face 3 (counted from 0) names vertex 5");
  check_unreadable(obj(v + replaced(f, "3 1 4", "3 1 0")), "line 8");
  check_unreadable(obj(v + replaced(f, "3 1 4", "3 1 -5")), "line 8");
  check_unreadable(obj(v + replaced(f, "3 1 4", "3 1 4x")), "line 8: '4x'");
  check_unreadable(obj(v + replaced(f, "3 1 4", "3 1 99999999999")), "line 8");
  check_unreadable(obj(replaced(v, "v 1 0 0", "v 1 0") + f), "line 2");
  check_unreadable(obj(replaced(v, "v 1 0 0", "v 1 0 0 2") + f), "weight");
  check_unreadable(obj(v + f + "garbage\n"), "line 9: 'garbage'");
  check_unreadable(obj(v), "no faces");
  BOOST_TEST(report_of(obj(replaced(v, "v 1 0 0", "v 1 0 inf") + f)).non_finite_vertices.size() == 1u);
}

BOOST_AUTO_TEST_CASE(stl) {
  const Temporary_folder folder;
  const Mesh mesh = meshes::to_mesh(meshes::tetrahedron());
  write_surface(folder / "a.stl", mesh);
  const std::string ascii = bytes_of(folder / "a.stl");
  const auto stl = [&](const std::string& text) { return folder.file("m.stl", text); };
  BOOST_TEST(refusal<Error>(stl(ascii)) == "");
  BOOST_TEST(refusal<Error>(stl(replaced(ascii, "solid", "solid facet of a name\r"))) == "");
  check_unreadable(stl(ascii + "garbage"), "'garbage' stands where 'solid'");
  check_unreadable(stl(replaced(ascii, "endloop", "vertex 0 0 0\nendloop")), "'vertex' stands where 'endloop'");
  check_unreadable(stl(replaced(ascii, "vertex 0 0 0", "vertex 0 0 zero")), "'zero'");
  BOOST_TEST(report_of(stl(replaced(ascii, "vertex 0 0 0", "vertex 0 0 nan"))).non_finite_vertices.size() == 1u);
  const std::size_t end = ascii.find("endsolid");
  for (std::size_t n = 1; n < end; ++n)
    BOOST_TEST(refusal<Error>(stl(ascii.substr(0, n))) != "");

  Write_parameters binary;
  binary.encoding(Write_parameters::Encoding::binary);
  write_surface(folder / "b.stl", mesh, binary);
  const std::string bytes = bytes_of(folder / "b.stl");
  BOOST_TEST(refusal<Error>(stl(bytes)) == "");
  BOOST_TEST(refusal<Error>(stl("solid" + bytes.substr(5))) == ""); // some programs begin binary files so
  for (std::size_t n = 1; n < bytes.size(); ++n)
    BOOST_TEST(refusal<Error>(stl(bytes.substr(0, n))) != "");
  check_unreadable(stl(bytes + "x"), "promises 4 triangles");
  std::string huge = bytes;
  huge[83] = '\x7f';
  check_unreadable(stl(huge), "promises 2130706436 triangles");
  std::string infinite = bytes;
  const float infinity = std::numeric_limits<float>::infinity();
  std::memcpy(&infinite[84 + 12], &infinity, 4);
  BOOST_TEST(!report_of(stl(infinite)).non_finite_vertices.empty());
}

BOOST_AUTO_TEST_SUITE_END()
