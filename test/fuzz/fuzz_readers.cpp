// SPDX-License-Identifier: GPL-3.0-or-later

/// \file
/// Whatever bytes a mesh file holds, `read_surface()` throws an `Error`, or returns a valid surface that comes back to
/// the bit from every format it can be written to. The first byte of the input tells the format.

#include <fuzz/Damage.h>
#include <fuzz/Fuzz_target.h>
#include <fuzz/require.h>
#include <fuzz/temporary_folder.h>
#include <meshes/generated_meshes.h>

#include <haptic_sculpt/surface/read_surface.h>
#include <haptic_sculpt/surface/write_surface.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>

namespace {

using namespace haptic_sculpt;
using fuzz::require;
using fuzz::temporary_folder;
using meshes::Mesh;
using Encoding = Write_parameters::Encoding;

constexpr std::array<const char*, 4> extensions{"off", "ply", "obj", "stl"};
std::array<std::size_t, 4> accepted{}, refused{};

bool same_bits(const Mesh& a, const Mesh& b) {
  const Face_soup s = face_soup(a), t = face_soup(b);
  return s.corners == t.corners && s.first_corner == t.first_corner && s.points.size() == t.points.size() &&
         std::equal(s.points.begin(), s.points.end(), t.points.begin(), [](const auto& p, const auto& q) {
           const double x[3] = {p.x(), p.y(), p.z()}, y[3] = {q.x(), q.y(), q.z()};
           return std::memcmp(x, y, sizeof x) == 0;
         });
}

/// Of the numbers of vertices; a NaN is one with another payload.
bool same_attributes(const Mesh& a, const Mesh& b) {
  const auto of_a = vertex_attributes(a), of_b = vertex_attributes(b);
  bool is_same = of_a.size() == of_b.size();
  for (std::size_t k = 0; is_same && k < of_a.size(); ++k) {
    is_same = of_a[k].name == of_b[k].name && of_a[k].type == of_b[k].type;
    for (const auto v : a.vertices()) {
      const double x = get(of_a[k].map, v), y = get(of_b[k].map, v);
      is_same = is_same && (std::memcmp(&x, &y, sizeof x) == 0 || (x != x && y != y));
    }
  }
  return is_same;
}

void check_way_back(const Mesh& mesh, const char* extension, Encoding encoding) {
  Write_parameters options;
  options.encoding(encoding);
  const auto path = temporary_folder() / (std::string("back.") + extension);
  write_surface(path, mesh, options);
  const Mesh back = read_surface<Mesh>(path);
  require(same_bits(back, mesh), "what is written comes back to the bit");
  require(extension != std::string("ply") || same_attributes(back, mesh), "so do numbers of vertices");
}

bool all_floats(const Mesh& mesh) {
  return std::all_of(mesh.vertices().begin(), mesh.vertices().end(), [&](const auto v) {
    const auto& p = mesh.point(v);
    return p.x() == static_cast<float>(p.x()) && p.y() == static_cast<float>(p.y()) &&
           p.z() == static_cast<float>(p.z());
  });
}

/// Good files, the format first.
std::vector<std::string> good_files() {
  auto two = meshes::tetrahedron(), second = meshes::tetrahedron();
  two += second.scale_and_move(0.125, 0.0625, 0.125, 0.25).turn_inside_out();
  std::vector<std::string> seeds;
  for (const auto& list : {meshes::tetrahedron(), two, meshes::cube()})
    for (std::size_t format = 0; format < extensions.size(); ++format)
      for (const Encoding encoding : {Encoding::ascii, Encoding::binary}) {
        if (encoding == Encoding::binary && format % 2 == 0)
          continue; // OFF and OBJ are text
        Write_parameters options;
        options.encoding(encoding);
        const auto path = temporary_folder() / (std::string("seed.") + extensions[format]);
        write_surface(path, meshes::to_mesh(list), options);
        std::ifstream file(path, std::ios::binary);
        seeds.push_back(std::string(1, char(format)) +
                        std::string(std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()));
      }
  seeds.push_back(char(1) + std::string("ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty char x\n"
                                        "property float y\nproperty float z\nproperty uchar red\nproperty float heat\n"
                                        "property uchar red\nproperty list uchar int more\nelement face 4\n"
                                        "property list uchar int vertex_indices\nend_header\n0 0 0 0 255 nan 1 0\n"
                                        "0 1 0 0 3 -1e30 1 1 5\n0 0 1 0 4 2 1 0\n0 0 0 1 5 1 1 0\n3 0 2 1\n3 0 1 3\n"
                                        "3 1 2 3\n3 2 0 3\n"));
  seeds.push_back(char(2) + std::string("v 0 0 0 1 0.5 0\nv 1 0 0\nv 0 1 0 1 0.2 0.3 4\nv 0 0 1\nf 1 3 2\nf 1 2 4\n"
                                        "f 2 3 4\nf 3 1 4\n"));
  return seeds;
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0)
    return 0;
  const std::size_t format = data[0] % extensions.size();
  const auto path = fuzz::temporary_file(std::string("in.") + extensions[format], data + 1, size - 1);
  Mesh mesh;
  try {
    mesh = read_surface<Mesh>(path);
  } catch (const Error& error) {
    require(std::strlen(error.what()) < 100000, "messages are short");
    ++refused[format];
    return 0;
  }
  ++accepted[format];
  require(validate(mesh).is_valid() && mesh.is_valid(false), "what is read is valid");
  check_way_back(mesh, "ply", Encoding::binary);
  if (format == 1)
    check_way_back(mesh, "ply", Encoding::ascii);
  else
    check_way_back(mesh, extensions[format], Encoding::ascii);
  if (format == 3 && all_floats(mesh))
    check_way_back(mesh, "stl", Encoding::binary);
  return 0;
}

std::string fuzz_input(std::mt19937_64& random) {
  static const std::vector<std::string> seeds = good_files();
  return fuzz::Damage(random, seeds)();
}

std::string fuzz_summary() {
  std::string text;
  for (std::size_t i = 0; i < extensions.size(); ++i)
    text += (i ? ", " : "") + std::string(extensions[i]) + ": " + std::to_string(refused[i]) + " refused, " +
            std::to_string(accepted[i]) + " accepted";
  return text;
}
