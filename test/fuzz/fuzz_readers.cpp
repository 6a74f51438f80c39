// SPDX-License-Identifier: GPL-3.0-or-later

/// \file
/// Whatever bytes a mesh file holds, `read_surface()` throws an `Error`, or returns a valid surface that comes back to
/// the bit from every format it can be written to. The first byte of the input tells the format.

#include <fuzz/Fuzz_target.h>
#include <meshes/generated_meshes.h>

#include <haptic_sculpt/surface/read_surface.h>
#include <haptic_sculpt/surface/write_surface.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>

#include <unistd.h>

namespace {

using namespace haptic_sculpt;
using meshes::Mesh;
using Encoding = Write_options::Encoding;

constexpr std::array<const char*, 4> extensions{"off", "ply", "obj", "stl"};
std::array<std::size_t, 4> accepted{}, refused{};

/// A folder of this process in the folder for temporary files.
const std::filesystem::path& folder() {
  struct Folder {
    std::filesystem::path path =
        std::filesystem::temp_directory_path() / ("haptic_sculpt_fuzz_" + std::to_string(::getpid()));
    Folder() { std::filesystem::create_directory(path); }
    ~Folder() {
      std::error_code ignored; // what cannot be removed is left to the system
      std::filesystem::remove_all(path, ignored);
    }
  };
  static const Folder the_folder;
  return the_folder.path;
}

void require(bool holds, const char* promise) {
  if (holds)
    return;
  std::fprintf(stderr, "broken promise: %s\n", promise);
  std::abort();
}

bool same_bits(const Mesh& a, const Mesh& b) {
  const Face_soup s = face_soup(a), t = face_soup(b);
  return s.corners == t.corners && s.first_corner == t.first_corner && s.points.size() == t.points.size() &&
         std::equal(s.points.begin(), s.points.end(), t.points.begin(), [](const auto& p, const auto& q) {
           const double x[3] = {p.x(), p.y(), p.z()}, y[3] = {q.x(), q.y(), q.z()};
           return std::memcmp(x, y, sizeof x) == 0;
         });
}

void check_way_back(const Mesh& mesh, const char* extension, Encoding encoding) {
  Write_options options;
  options.encoding = encoding;
  const auto path = folder() / (std::string("back.") + extension);
  write_surface(path, mesh, options);
  require(same_bits(read_surface<Mesh>(path), mesh), "what is written comes back to the bit");
}

bool all_floats(const Mesh& mesh) {
  return std::all_of(mesh.vertices().begin(), mesh.vertices().end(), [&](const auto v) {
    const auto& p = mesh.point(v);
    return p.x() == static_cast<float>(p.x()) && p.y() == static_cast<float>(p.y()) &&
           p.z() == static_cast<float>(p.z());
  });
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0)
    return 0;
  const std::size_t format = data[0] % extensions.size();
  const auto path = folder() / (std::string("in.") + extensions[format]);
  std::ofstream(path, std::ios::binary).write(reinterpret_cast<const char*>(data + 1), std::streamsize(size - 1));
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

std::vector<std::string> fuzz_seeds() {
  auto two = meshes::tetrahedron(), second = meshes::tetrahedron();
  two += second.scale_and_move(0.125, 0.0625, 0.125, 0.25).turn_inside_out();
  std::vector<std::string> seeds;
  for (const auto& list : {meshes::tetrahedron(), two, meshes::cube()})
    for (std::size_t format = 0; format < extensions.size(); ++format)
      for (const Encoding encoding : {Encoding::ascii, Encoding::binary}) {
        if (encoding == Encoding::binary && format % 2 == 0)
          continue; // OFF and OBJ are text
        Write_options options;
        options.encoding = encoding;
        const auto path = folder() / (std::string("seed.") + extensions[format]);
        write_surface(path, meshes::to_mesh(list), options);
        std::ifstream file(path, std::ios::binary);
        seeds.push_back(std::string(1, char(format)) +
                        std::string(std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()));
      }
  return seeds;
}

std::string fuzz_summary() {
  std::string text;
  for (std::size_t i = 0; i < extensions.size(); ++i)
    text += (i ? ", " : "") + std::string(extensions[i]) + ": " + std::to_string(refused[i]) + " refused, " +
            std::to_string(accepted[i]) + " accepted";
  return text;
}
