// SPDX-License-Identifier: GPL-3.0-or-later
// Colours and other numbers of vertices go from file to mesh, through edits and repair, and back.
#include <haptic_sculpt/sculpting.h>
#include <haptic_sculpt/surface.h>
#include <haptic_sculpt/surface/repair.h>

#include <seeds_and_sizes.h>
#include <meshes/generated_meshes.h>
#include <sculpting/public_functions/Callers_mode.h>
#include <surface/Temporary_folder.h>

#include <boost/test/unit_test.hpp>

#include <cfenv>
#include <cmath>
#include <fstream>
#include <iterator>
#include <map>
#include <random>

using namespace haptic_sculpt;
using meshes::Mesh;
using V = Mesh::Vertex_index;
using Type = Vertex_attribute::Type;

namespace {

constexpr const char* names[] = {"a", "red", "b", "c", "d", "e", "heat", "f"}; // one of each type

/// A ball whose vertices have a number of each type, the ends of the ranges among them.
Mesh ball() {
  Mesh mesh = meshes::to_mesh(meshes::icosphere(1));
  std::mt19937_64 random(haptic_sculpt::test::seed_from_environment(41));
  for (int type = 0; type < 8; ++type) {
    const auto attribute = add_vertex_attribute(mesh, names[type], static_cast<Type>(type));
    for (const V v : mesh.vertices()) {
      const double x = (static_cast<double>(random() >> 11) * 0x1p-53 - 0.5) * (type == 7   ? 1e300
                                                                                : type == 6 ? 1e30
                                                                                            : 1e10);
      put(attribute.map, v,
          rounded_to(attribute.type, v.idx() == 0   ? -1e300
                                     : v.idx() == 1 ? (type == 6 ? 3e38 : 1e300)
                                                    : x));
    }
  }
  put(add_vertex_attribute(mesh, "heat", Type::float32).map, V(0), static_cast<double>(-1e38f));
  return mesh;
}

using Values = std::map<std::string, std::pair<int, std::vector<double>>>;
Values values_of(const Mesh& mesh) {
  Values values;
  for (const auto& attribute : vertex_attributes(mesh))
    for (const V v : mesh.vertices()) {
      values[attribute.name].first = static_cast<int>(attribute.type);
      values[attribute.name].second.push_back(get(attribute.map, v));
    }
  return values;
}

BOOST_AUTO_TEST_SUITE(attributes)

BOOST_AUTO_TEST_CASE(numbers_of_types_are_the_nearest_whatever_mode_the_caller_has) {
  std::fesetround(FE_UPWARD);
  const double byte = rounded_to(Type::uint8, 10.2), real = rounded_to(Type::float32, 1 + 0x1p-30);
  std::fesetround(FE_TONEAREST);
  BOOST_TEST(byte == 10);
  BOOST_TEST(real == 1);
  for (const Type type : {Type::int8, Type::uint8, Type::int16, Type::uint16, Type::int32, Type::uint32})
    BOOST_TEST(!std::signbit(rounded_to(type, -0.25))); // integers have one 0
}

BOOST_AUTO_TEST_CASE(what_could_not_be_written_again_is_left_out) {
  const Temporary_folder folder;
  const auto path = folder / "odd.ply";
  write_surface(path, ball());
  std::ifstream file(path, std::ios::binary);
  std::string bytes((std::istreambuf_iterator<char>(file)), {});
  const std::string name = "property float heat\n";
  bytes.replace(bytes.find(name), name.size(), "property float hea\x01\n");
  folder.file("odd.ply", bytes);
  std::vector<std::string> left_out;
  const Mesh mesh = read_surface<Mesh>(path, 0, &left_out);
  BOOST_TEST(left_out.size() == 1u);
  BOOST_TEST(vertex_attributes(mesh).size() == 7u);
  BOOST_CHECK_NO_THROW(write_surface(path, mesh));
}

BOOST_AUTO_TEST_CASE(what_faces_have_is_told_apart_from_what_vertices_have) {
  const Temporary_folder folder;
  const std::string path = folder.file(
      "both.ply", "ply\nformat ascii 1.0\nelement vertex 4\nproperty double x\nproperty double y\nproperty double z\n"
                  "property uchar red\nelement face 4\nproperty list uchar int vertex_indices\nproperty uchar red\n"
                  "end_header\n0 0 0 1\n1 0 0 2\n0 1 0 3\n0 0 1 4\n"
                  "3 0 2 1 9\n3 0 1 3 9\n3 1 2 3 9\n3 0 3 2 9\n");
  std::vector<std::string> left_out;
  const Mesh mesh = read_surface<Mesh>(path, 0, &left_out);
  BOOST_TEST((left_out == std::vector<std::string>{"colours of faces"}));
  BOOST_TEST(vertex_attributes(mesh).size() == 1u);
}

BOOST_AUTO_TEST_CASE(ply_brings_every_type_back_in_text_and_in_bytes_and_in_the_order_asked_for) {
  const Temporary_folder folder;
  const Mesh mesh = ball();
  BOOST_TEST(values_of(mesh).size() == 8u);
  for (const auto encoding : {Write_parameters::Encoding::ascii, Write_parameters::Encoding::binary}) {
    Write_parameters options;
    options.encoding(encoding);
    write_surface(folder / "m.ply", mesh, options);
    const Mesh back = read_surface<Mesh>(folder / "m.ply");
    BOOST_TEST((values_of(back) == values_of(mesh)));
    for (const V v : mesh.vertices()) {
      BOOST_TEST(back.point(v) == mesh.point(v));
      options.vertices_order.emplace_back(static_cast<Mesh::size_type>(mesh.number_of_vertices() - 1 - v));
    }
    write_surface(folder / "m.ply", mesh, options);
    const Mesh turned = read_surface<Mesh>(folder / "m.ply");
    for (const V v : mesh.vertices()) {
      const V other(static_cast<Mesh::size_type>(mesh.number_of_vertices() - 1 - v));
      BOOST_TEST(turned.point(v) == mesh.point(other));
      for (std::size_t k = 0; k < 8; ++k)
        BOOST_TEST(get(vertex_attributes(turned)[k].map, v) == get(vertex_attributes(mesh)[k].map, other));
    }
    // CGAL reads the same.
    CGAL::Surface_mesh<meshes::Point_3> theirs;
    std::ifstream in(folder / "m.ply", std::ios::binary);
    BOOST_REQUIRE(CGAL::IO::read_PLY(in, theirs));
    const auto heat = find_property_map<V, float>(theirs, "v:heat");
    const auto d = find_property_map<V, std::int32_t>(theirs, "v:d");
    BOOST_REQUIRE((heat && d));
    for (const V v : theirs.vertices()) {
      BOOST_TEST(theirs.point(v) == turned.point(v));
      BOOST_TEST(get(*heat, v) == get(vertex_attributes(turned)[6].map, v));
      BOOST_TEST(get(*d, v) == get(vertex_attributes(turned)[4].map, v));
    }
  }
}

BOOST_AUTO_TEST_CASE(obj_has_colours_from_0_to_1_and_what_a_format_cannot_hold_is_named) {
  const Temporary_folder folder;
  const auto path = folder.file("t.obj", "v 0 0 0 1 0.5 0\nv 1 0 0 0 0 0\nv 0 1 0 0.25 0 1\nv 0 0 1 1 0.1 0.2 0.3\n"
                                         "f 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n");
  const Mesh mesh = read_surface<Mesh>(path);
  const Values expected{
      {"red", {7, {1, 0, 0.25, 0.1}}}, {"green", {7, {0.5, 0, 0, 0.2}}}, {"blue", {7, {0, 0, 1, 0.3}}}};
  BOOST_TEST((values_of(mesh) == expected));
  for (const char* name : {"u.obj", "u.ply"}) {
    write_surface(folder / name, mesh);
    BOOST_TEST((values_of(read_surface<Mesh>(folder / name)) == expected));
  }
  using Words = std::vector<std::string>;
  Words left_out;
  const auto some = folder.file("s.obj", "v 0 0 0 1 0.5 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n"
                                         "f 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n");
  BOOST_TEST((values_of(read_surface<Mesh>(some, 0, &left_out)) == Values()));
  BOOST_TEST((left_out == Words{"colours that only some vertices have"}));
  Mesh bytes = meshes::to_mesh(meshes::cube());
  for (const char* name : {"red", "green", "blue"})
    put(add_vertex_attribute(bytes, name, Type::uint8).map, V(3), 51);
  write_surface(folder / "b.obj", bytes);
  BOOST_TEST(get(vertex_attributes(read_surface<Mesh>(folder / "b.obj"))[1].map, V(3)) == 0.2);
  Mesh words = meshes::to_mesh(meshes::cube());
  for (const char* name : {"red", "green", "blue"})
    put(add_vertex_attribute(words, name, Type::uint16).map, V(3), 13107);
  write_surface(folder / "w.obj", words);
  BOOST_TEST(get(vertex_attributes(read_surface<Mesh>(folder / "w.obj"))[1].map, V(3)) == 0.2);
  BOOST_TEST((attributes_not_held(bytes, Mesh_file_format::obj) == Words()));
  add_vertex_attribute(words, "red"); // besides the other: the file holds the first
  BOOST_TEST((attributes_not_held(words, Mesh_file_format::obj) == Words{"colours"}));
  words = meshes::to_mesh(meshes::cube());
  for (const char* name : {"red", "green", "blue", "alpha"})
    add_vertex_attribute(words, name, Type::uint16);
  BOOST_TEST((attributes_not_held(words, Mesh_file_format::obj) == Words{"opacity"}));
  add_vertex_attribute(bytes, "heat");
  BOOST_TEST((attributes_not_held(bytes, Mesh_file_format::ply) == Words()));
  BOOST_TEST((attributes_not_held(bytes, Mesh_file_format::obj) == Words{"the property 'heat'"}));
  BOOST_TEST((attributes_not_held(bytes, Mesh_file_format::off) == Words{"colours", "the property 'heat'"}));
}

BOOST_AUTO_TEST_CASE(what_stl_says_besides_is_told) {
  const Temporary_folder folder;
  const Mesh mesh = meshes::to_mesh(meshes::cube());
  const auto left_out = [&](const std::string& bytes) {
    std::vector<std::string> words;
    const std::string path = folder.file("m.stl", bytes);
    BOOST_TEST(read_surface<Mesh>(path, 0, &words).number_of_faces() == 12u);
    return words;
  };
  using Words = std::vector<std::string>;
  write_surface(folder / "a.stl", mesh);
  std::string text = bytes_of(folder / "a.stl");
  BOOST_TEST((left_out(text) == Words()));
  text.insert(text.find("facet normal", text.size() / 2), "endsolid\nsolid other\n");
  BOOST_TEST((left_out(text) == Words{"groups"}));
  write_surface(folder / "b.stl", mesh, Write_parameters().encoding(Write_parameters::Encoding::binary));
  std::string bytes = bytes_of(folder / "b.stl");
  BOOST_TEST((left_out(bytes) == Words()));
  bytes[84 + 50 * 7 - 1] = '\x80'; // of the seventh facet
  BOOST_TEST((left_out(bytes) == Words{"colours"}));
}

BOOST_AUTO_TEST_CASE(maps_of_other_types_with_the_same_name_are_none) {
  const Temporary_folder folder;
  Mesh mesh = meshes::to_mesh(meshes::cube());
  mesh.add_property_map<V, int>("v:uchar red", 7);
  put(add_vertex_attribute(mesh, "red", Type::uint8).map, V(3), 51);
  mesh.add_property_map<V, std::string>("v:uchar red", "none");
  BOOST_TEST(vertex_attributes(mesh).size() == 1u);
  write_surface(folder / "m.ply", mesh);
  BOOST_TEST(get(vertex_attributes(read_surface<Mesh>(folder / "m.ply"))[0].map, V(3)) == 51);
}

BOOST_AUTO_TEST_CASE(edits_give_means_undo_gives_back_and_files_have_numbers_of_their_type) {
  const Temporary_folder folder;
  Mesh mesh = meshes::to_mesh(meshes::icosphere(2));
  const auto red = add_vertex_attribute(mesh, "red", Type::uint8).map;
  for (const V v : mesh.vertices())
    put(red, v, mesh.point(v).z() > 0 ? 200 : 101);
  const Values before = values_of(mesh);
  Sculptor<Mesh> sculptor(mesh);
  keep_vertex_attributes(sculptor);
  const auto e = *mesh.edges().begin();
  const V a = mesh.vertex(e, 0), b = mesh.vertex(e, 1);
  const auto made = sculptor.insert_on_edge(e, CGAL::midpoint(mesh.point(a), mesh.point(b)));
  BOOST_REQUIRE(static_cast<bool>(made));
  BOOST_TEST(std::abs(get(red, *made.vertex) - (get(red, a) + get(red, b)) / 2) <= 1e-9);
  isotropic_remeshing(sculptor, 0.15);
  BOOST_TEST(mesh.number_of_vertices() > 500u);
  for (const V v : mesh.vertices())
    BOOST_TEST((get(red, v) >= 101 - 1e-9 && get(red, v) <= 200 + 1e-9));
  write_surface(folder / "m.ply", mesh);
  const Values after = values_of(read_surface<Mesh>(folder / "m.ply"));
  for (const double value : after.at("red").second)
    BOOST_TEST((value == std::floor(value) && value >= 101 && value <= 200), value);
  while (sculptor.undo())
    ;
  mesh.collect_garbage();
  BOOST_TEST((values_of(mesh) == before));
}

BOOST_AUTO_TEST_CASE(repair_takes_the_values_of_the_nearest_point) {
  Face_soup soup = face_soup(meshes::to_mesh(meshes::icosphere(1)));
  soup.attributes.push_back({"heat", Type::float64, {}});
  for (const auto& p : soup.points)
    soup.attributes[0].values.push_back(p.x());
  Face_soup open = soup;
  open.corners.resize(open.corners.size() - 3), open.first_corner.pop_back(); // a hole
  open.points.push_back(open.points[open.corners[0]]);                        // and a point that is there twice
  open.attributes[0].values.push_back(open.points.back().x());
  open.corners[0] = static_cast<Face_soup::Index>(open.points.size() - 1);
  BOOST_REQUIRE(repair(open).is_repaired());
  BOOST_REQUIRE(open.attributes.size() == 1u);
  BOOST_TEST(open.attributes[0].values.size() == open.points.size());
  for (std::size_t v = 0; v < open.points.size(); ++v)
    BOOST_TEST(open.attributes[0].values[v] == open.points[v].x()); // no point is new
}

BOOST_AUTO_TEST_CASE(names_that_a_header_cannot_hold_are_refused) {
  const Temporary_folder folder;
  for (const char* name : {"x", "z", "", "two words", "a\nend_header", "nx", "bell\a\x1b[2J"}) {
    Mesh mesh = meshes::to_mesh(meshes::tetrahedron());
    add_vertex_attribute(mesh, name);
    BOOST_CHECK_EXCEPTION(write_surface(folder.path() / "named.ply", mesh), Write_error, [](const Write_error& error) {
      const std::string what = error.what();
      return std::all_of(what.begin(), what.end(), [](unsigned char c) { return c >= ' '; });
    });
    BOOST_TEST(!std::filesystem::exists(folder.path() / "named.ply"));
    write_surface(folder.path() / "named.off", mesh);
  }
  Mesh mesh = meshes::to_mesh(meshes::tetrahedron());
  add_vertex_attribute(mesh, "heat", Type::float32), add_vertex_attribute(mesh, "heat", Type::uint8);
  BOOST_CHECK_THROW(write_surface(folder.path() / "twice.ply", mesh), Write_error);
  for (const int number : {997, 998}) { // beside x, y, z: as many as are read
    Mesh many = meshes::to_mesh(meshes::tetrahedron());
    for (int k = 0; k < number; ++k)
      add_vertex_attribute(many, "a" + std::to_string(k));
    if (number == 998) {
      BOOST_CHECK_THROW(write_surface(folder.path() / "many.ply", many), Write_error);
      continue;
    }
    write_surface(folder.path() / "many.ply", many);
    BOOST_TEST(vertex_attributes(read_surface<Mesh>(folder.path() / "many.ply")).size() == 997u);
  }
  std::ofstream(folder.path() / "twice_x.ply")
      << "ply\nformat ascii 1.0\nelement vertex 1\nproperty double x\nproperty double y\nproperty double z\n"
         "property double x\nend_header\n1 2 3 4\n";
  BOOST_CHECK_THROW(read_face_soup(folder.path() / "twice_x.ply"), Read_error);
}

BOOST_AUTO_TEST_CASE(repair_keeps_the_numbers_of_vertices_at_every_scale) {
  for (const double scale : {1., 0x1p-600, 0x1p-1000, 0x1p-1060, 0x1p900}) {
    Face_soup soup = face_soup(meshes::to_mesh(meshes::tetrahedron(scale)));
    soup.attributes.push_back({"heat", Type::float64, {10, 11, 12, 13}});
    std::swap(soup.corners[0], soup.corners[1]); // one face is turned
    {
      const haptic_sculpt::test::Callers_mode mode(FE_TONEAREST, true); // subnormal numbers are 0 to the caller
      BOOST_REQUIRE(repair(soup).is_repaired());
    }
    std::map<std::array<double, 3>, double> heat;
    for (std::size_t v = 0; v < soup.points.size(); ++v)
      heat[{soup.points[v][0] / scale, soup.points[v][1] / scale, soup.points[v][2] / scale}] =
          soup.attributes[0].values[v];
    const Mesh at_first = meshes::to_mesh(meshes::tetrahedron());
    for (const V v : at_first.vertices()) {
      const auto& p = at_first.point(v);
      BOOST_TEST((heat[{p.x(), p.y(), p.z()}] == 10. + v.idx()));
    }
  }
}

BOOST_AUTO_TEST_SUITE_END()

} // namespace
