// SPDX-License-Identifier: GPL-3.0-or-later
// Drags vertices of real and generated meshes at random and on purpose, and checks every promise afterwards.
#include "meshes/generated_meshes.h"

#include <haptic_sculpt/sculpting.h>
#include <haptic_sculpt/surface.h>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <chrono>
#include <fstream>
#include <iostream>

namespace {

using namespace haptic_sculpt;
using Mesh = meshes::Mesh;
using Point_3 = meshes::Point_3;
using Vector_3 = meshes::Kernel::Vector_3;
using Vertex_index = Mesh::Vertex_index;
using Random = std::mt19937_64;
using Json = nlohmann::ordered_json;

enum Exit {
  all_kept = 0,
  usage = 2,
  not_embedded = 10,   ///< validate() found a fault after drags
  lazy_short = 11,     ///< fewer than 95 % of the short random drags arrived
  lazy_long = 12,      ///< a push through the object stayed at its start though it had more than two clearances to go
  wrongly_accepted = 13, ///< a mesh that has to be refused was not
  wrongly_refused = 14,  ///< a mesh that has to be accepted was refused
  mesh_changed = 15      ///< a vertex that was not in hand has moved
};

struct Tally {
  std::size_t drags = 0, reached = 0, blocked = 0;
  std::size_t short_asked = 0, short_arrived = 0;
  std::size_t through_asked = 0, through_stayed = 0, through_lazy = 0;
  std::size_t validations = 0, invalid = 0, changed = 0, slow_stops = 0;
  double largest_stop_error = 0; ///< in clearances; stops with one contact whose plane is determined
  double nanoseconds = 0;

  Tally& operator+=(const Tally& t) {
    drags += t.drags, reached += t.reached, blocked += t.blocked;
    short_asked += t.short_asked, short_arrived += t.short_arrived;
    through_asked += t.through_asked, through_stayed += t.through_stayed, through_lazy += t.through_lazy;
    validations += t.validations, invalid += t.invalid, changed += t.changed, slow_stops += t.slow_stops;
    largest_stop_error = std::max(largest_stop_error, t.largest_stop_error);
    nanoseconds += t.nanoseconds;
    return *this;
  }
  Json json() const {
    return {{"drags", drags},
            {"reached", reached},
            {"blocked", blocked},
            {"short_asked", short_asked},
            {"short_arrived", short_arrived},
            {"through_asked", through_asked},
            {"through_stayed", through_stayed},
            {"through_lazy", through_lazy},
            {"validations", validations},
            {"invalid", invalid},
            {"changed_elsewhere", changed},
            {"stops_beyond_two_clearances", slow_stops},
            {"largest_stop_error_in_clearances", largest_stop_error},
            {"mean_ns", drags > 0 ? nanoseconds / static_cast<double>(drags) : 0}};
  }
};

/// One batch of drags, each batch on a fresh copy of the mesh.
class Batch {
public:
  Batch(const Mesh& mesh, std::uint64_t seed, std::size_t validate_every)
    : mesh_(mesh), sculptor_(mesh_), random_(seed), validate_every_(validate_every) {
    for (const Vertex_index v : mesh_.vertices())
      if (!mesh_.is_isolated(v))
        vertices_.push_back(v);
  }

  Tally run(std::size_t drags) {
    // Short steps first: once the mesh is crumpled by long pushes, most vertices are in contact and held with reason.
    while (tally_.drags < drags / 3) {
      const Vertex_index v = vertices_[random_() % vertices_.size()];
      drag(v, mesh_.point(v) + 0.1 * edge_length(v) * direction(), Kind::short_random);
    }
    while (tally_.drags < drags) {
      const Vertex_index v = vertices_[random_() % vertices_.size()];
      if (random_() % 500 == 0) { // the same contact again and again
        const Point_3 target = through(v);
        for (int push = 0; push < 100 && tally_.drags < drags; ++push)
          drag(v, target, Kind::other);
        continue;
      }
      switch (random_() % 9) {
      case 0: case 1: drag(v, mesh_.point(v) + 0.1 * edge_length(v) * direction(), Kind::other); break;
      case 2: case 3: drag(v, through(v), Kind::through); break;
      case 4: drag(v, mesh_.point(v) + 5 * edge_length(v) * direction(), Kind::other); break;
      case 5: drag(v, mesh_.point(vertices_[random_() % vertices_.size()]), Kind::other); break;
      case 6: drag(v, on_a_neighbour(v), Kind::other); break;
      case 7: drag(v, along_an_axis(v), Kind::other); break;
      default: drag(v, in_the_plane_of_a_face(v), Kind::other);
      }
    }
    check();
    try {
      sculptor_.check_unchanged();
    } catch (const Mesh_changed&) {
      ++tally_.changed;
    }
    return tally_;
  }

private:
  enum class Kind { short_random, through, other };

  Mesh mesh_;
  Sculptor<Mesh> sculptor_;
  Random random_;
  std::size_t validate_every_;
  std::vector<Vertex_index> vertices_;
  Tally tally_;

  double number() { return static_cast<double>(random_() >> 11) * 0x1p-53; }
  Vector_3 direction() {
    for (;;) {
      const double x = 2 * number() - 1, y = 2 * number() - 1, z = 2 * number() - 1, square = x * x + y * y + z * z;
      if (square > 0.01 && square < 1)
        return Vector_3(x, y, z) / std::sqrt(square);
    }
  }
  Vertex_index neighbour(Vertex_index v) {
    auto h = mesh_.halfedge(v);
    for (std::size_t turns = random_() % 8; turns > 0; --turns)
      h = mesh_.opposite(mesh_.next(h));
    return mesh_.source(h);
  }
  /// Of the shortest of a few edges: the step has to suit the star. Half of the differences, for they may overflow.
  double edge_length(Vertex_index v) {
    double shortest = std::numeric_limits<double>::infinity();
    for (const auto h : mesh_.halfedges_around_target(mesh_.halfedge(v)))
      shortest = std::min(shortest, internal::path_length(vertex_coordinates(mesh_, v), vertex_coordinates(mesh_, mesh_.source(h))));
    return shortest;
  }
  /// To the other side of another vertex far away, through what lies between.
  Point_3 through(Vertex_index v) {
    const Point_3 p = mesh_.point(v), q = mesh_.point(vertices_[random_() % vertices_.size()]);
    return q + 0.5 * (q - p);
  }
  Point_3 on_a_neighbour(Vertex_index v) {
    const Point_3 a = mesh_.point(neighbour(v)), b = mesh_.point(neighbour(neighbour(v)));
    switch (random_() % 3) {
    case 0: return a;
    case 1: return CGAL::midpoint(a, b);
    default: return CGAL::centroid(a, b, mesh_.point(neighbour(v)));
    }
  }
  Point_3 along_an_axis(Vertex_index v) {
    std::array<double, 3> p = vertex_coordinates(mesh_, v);
    p[random_() % 3] += (4 * number() - 2) * edge_length(v);
    return {p[0], p[1], p[2]};
  }
  Point_3 in_the_plane_of_a_face(Vertex_index v) {
    const Point_3 p = mesh_.point(v), a = mesh_.point(neighbour(v));
    return p + (4 * number() - 2) * (a - p); // along an edge, both ways: in two planes at once
  }

  void drag(Vertex_index v, const Point_3& target, Kind kind) {
    const Point_3 start = mesh_.point(v);
    const auto begin = std::chrono::steady_clock::now();
    const Drag_result<Mesh> result = sculptor_.grab(v).drag_to(target);
    tally_.nanoseconds += std::chrono::duration<double, std::nano>(std::chrono::steady_clock::now() - begin).count();
    ++tally_.drags;
    ++(result.reached ? tally_.reached : tally_.blocked);
    const double error = result.stop_error / sculptor_.clearance(target);
    const bool determined = result.contacts.size() == 1 && !result.contacts[0].is_flat;
    if (kind == Kind::short_random) {
      ++tally_.short_asked;
      tally_.short_arrived += result.reached;
    }
    if (kind == Kind::through && start != target) {
      ++tally_.through_asked;
      if (!result.reached && mesh_.point(v) == start) {
        ++tally_.through_stayed;
        tally_.through_lazy += determined && error > 2;
      }
    }
    if (determined) {
      tally_.slow_stops += error > 2;
      tally_.largest_stop_error = std::max(tally_.largest_stop_error, error);
    }
    if (validate_every_ != 0 && tally_.drags % validate_every_ == 0)
      check();
  }

  void check() {
    ++tally_.validations;
    tally_.invalid += !validate(mesh_).is_valid();
  }
};

std::vector<std::pair<std::string, Mesh>> generated() {
  using namespace meshes;
  std::vector<std::pair<std::string, Mesh>> list;
  list.emplace_back("icosphere", to_mesh(icosphere(3)));
  list.emplace_back("terrain", to_mesh(bumpy_sphere(3, 0.2, 0.02, 7)));
  list.emplace_back("flat box", to_mesh(box(12)));
  list.emplace_back("torus", to_mesh(torus(40, 20)));
  list.emplace_back("bipyramid 64", to_mesh(bipyramid(64)));
  list.emplace_back("spheres in a row", to_mesh(row_of_spheres(4)));
  list.emplace_back("ball in a cavity", to_mesh(ball_in_a_cavity()));
  list.emplace_back("C with gap 1e-12", to_mesh(c_tube(1e-12)));
  list.emplace_back("slivers", to_mesh(sliver_stack(30, 1e-9)));
  list.emplace_back("nearly pinched", to_mesh(nearly_pinched(1e-9)));
  list.emplace_back("terrain at 1e6", to_mesh(bumpy_sphere(2, 0.2, 0.02, 8).scale_and_move(1, 1e6, 1e6, 1e6)));
  list.emplace_back("terrain of size 1e-6", to_mesh(bumpy_sphere(2, 0.2, 0.02, 9).scale_and_move(1e-6, 0, 0, 0)));
  list.emplace_back("terrain of size 1e150", to_mesh(bumpy_sphere(2, 0.2, 0.02, 9).scale_and_move(1e150, 0, 0, 0)));
  return list;
}

struct Options {
  std::string folder, json, shard = "0/1";
  std::size_t drags = 10000, drags_on_large = 1000, batch = 1000;
  std::uint64_t seed = 1;
  std::vector<std::string> refuse;
};

constexpr std::size_t large = 200000; ///< faces: from here on drags_on_large, and one validation a batch

class Run {
public:
  explicit Run(const Options& options) : options_(options) {
    std::istringstream text(options.shard);
    char slash = 0;
    if (!(text >> shard_ >> slash >> shards_) || slash != '/' || shard_ >= shards_)
      throw Error("--shard takes i/n with 0 <= i < n, not '" + options.shard + "'");
  }

  void mesh(const std::string& name, const Mesh& mesh) {
    const bool is_large = mesh.number_of_faces() >= large;
    const std::size_t drags = is_large ? options_.drags_on_large : options_.drags;
    Tally tally;
    for (std::size_t done = 0, batch = 0; done < drags; done += options_.batch, ++batch)
      if (unit_++ % shards_ == shard_)
        tally += Batch(mesh, options_.seed * 1000003 + unit_, is_large ? 0 : 100).run(std::min(options_.batch, drags - done));
    if (tally.drags == 0)
      return;
    total_ += tally;
    Json row = {{"mesh", name}, {"faces", mesh.number_of_faces()}};
    row.update(tally.json());
    rows_.push_back(row);
    std::cout << name << ": " << tally.drags << " drags, " << tally.blocked << " blocked, short "
              << tally.short_arrived << '/' << tally.short_asked << ", through stayed " << tally.through_stayed << '/'
              << tally.through_asked << " (lazy " << tally.through_lazy << "), stop error up to " << tally.largest_stop_error
              << " c, " << tally.invalid << " invalid of " << tally.validations << ", "
              << tally.nanoseconds / static_cast<double>(tally.drags) << " ns\n" << std::flush;
  }

  void folder() {
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::directory_iterator(options_.folder))
      if (mesh_file_format(entry.path()))
        files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    for (const auto& file : files) {
      const std::string name = file.filename().string();
      const bool has_to_be_refused = std::find(options_.refuse.begin(), options_.refuse.end(), name) != options_.refuse.end();
      try {
        const Mesh read = read_surface<Mesh>(file);
        wrongly_accepted_ += has_to_be_refused;
        mesh(name, read);
      } catch (const Invalid_surface& error) {
        std::cout << name << ": refused: " << error.what() << '\n';
        wrongly_refused_ += !has_to_be_refused;
      }
    }
  }

  Exit finish() const {
    const bool lazy = static_cast<double>(total_.short_arrived) < 0.95 * static_cast<double>(total_.short_asked);
    const Exit exit = total_.invalid > 0           ? not_embedded
                      : total_.changed > 0         ? mesh_changed
                      : wrongly_accepted_ > 0      ? wrongly_accepted
                      : wrongly_refused_ > 0       ? wrongly_refused
                      : total_.through_lazy > 0    ? lazy_long
                      : lazy                       ? lazy_short
                                                   : all_kept;
    std::cout << "in all " << total_.drags << " drags, seed " << options_.seed << ", exit " << exit << '\n';
    if (!options_.json.empty())
      replace_file(options_.json, Json{{"seed", options_.seed}, {"shard", options_.shard}, {"meshes", rows_},
                                       {"total", total_.json()}, {"wrongly_accepted", wrongly_accepted_},
                                       {"wrongly_refused", wrongly_refused_}, {"exit", static_cast<int>(exit)}}
                                          .dump(1) + '\n');
    return exit;
  }

private:
  Options options_;
  std::size_t shard_ = 0, shards_ = 1, unit_ = 0, wrongly_accepted_ = 0, wrongly_refused_ = 0;
  Tally total_;
  Json rows_ = Json::array();
};

} // namespace

int main(int argc, char** argv) {
  Options options;
  CLI::App app("Drags vertices at random and on purpose, and checks every promise.\n"
               "Exit: 0 all kept, 2 usage or a file that cannot be read, 10 a mesh is no longer embedded, 11 fewer than 95 % of the short "
               "drags arrived, 12 a push through the object did not move without reason, 13 a mesh that has to be refused "
               "was accepted, 14 one was refused without being named by --refuse, 15 an element not in hand has changed.");
  app.add_option("--meshes", options.folder, "Folder of meshes to drag, beside the generated ones")->check(CLI::ExistingDirectory);
  app.add_option("--refuse", options.refuse, "File names in the folder that have to be refused");
  app.add_option("--drags", options.drags, "Drags on each mesh")->capture_default_str();
  app.add_option("--drags-on-large", options.drags_on_large, "Drags on meshes of 200,000 faces or more")->capture_default_str();
  app.add_option("--seed", options.seed, "Seed")->capture_default_str();
  app.add_option("--shard", options.shard, "i/n: every n-th batch of 1000 drags, for job arrays")->capture_default_str();
  app.add_option("--json", options.json, "Where the report goes");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : usage;
  }
  try {
    Run run(options);
    for (const auto& [name, mesh] : generated())
      run.mesh(name, mesh);
    if (!options.folder.empty())
      run.folder();
    return run.finish();
  } catch (const Error& error) {
    std::cerr << "robustness: " << error.what() << '\n';
    return usage;
  }
}
