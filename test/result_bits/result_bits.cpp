// SPDX-License-Identifier: GPL-3.0-or-later

/// \file
/// result_bits MODE [SCALE]: runs seeded calls of each part of the library in a caller's mode of rounding (nearest,
/// upward, downward, towardzero) and prints a digest of all bits of what came of each; of the device, the numbers, for
/// its own are promised to a tolerance only. `test/numerics` compares what several compilers make of it.
///
/// What goes in is made of integers, so that no compiler and no mode rounds it. Exit code 2: wrong use.

#include "scenes.h"

#include <haptic_sculpt/device.h>
#include <haptic_sculpt/sculpting/paper_1997.h>

#include <cfenv>
#include <cstdio>

using namespace haptic_sculpt;
using namespace haptic_sculpt::result_bits;

namespace {

void put_line(const char* part, const Digest& digest) {
  std::printf("%s %016llx\n", part, static_cast<unsigned long long>(digest.value()));
}

template <class Sweep>
void add_sweep(Digest& digest, const Sweep& sweep, const std::array<Point_3, 5>& p) {
  const auto impact = sweep(p[0], p[1], p[2], p[3], p[4]);
  digest.add(impact.has_value());
  if (!impact)
    return;
  const auto tight = impact->tight_time();
  digest.add(tight.first), digest.add(tight.second);
  digest.add(impact->is_at_start());
}

/// Points of few bits, so that many are degenerate, and of many.
void sweeps(int size) {
  Digest digest;
  Draw draw(1);
  const Swept_collision_traits_3<Kernel> traits;
  for (int i = 0; i < 3000 * size; ++i) {
    const int bits = 1 + draw.below(3) * 8;
    std::array<Point_3, 5> p;
    for (auto& q : p)
      q = draw.point(bits);
    if (p[2] == p[3] || p[3] == p[4])
      continue;
    add_sweep(digest, traits.vertex_face_sweep_3_object(), p);
    add_sweep(digest, traits.edge_edge_sweep_3_object(), p);
    add_sweep(digest, traits.face_vertex_sweep_3_object(), p);
  }
  put_line("sweeps", digest);
}

void validation(int size) {
  Digest digest;
  for (int i = 0; i < 4 * size; ++i) {
    Mesh mesh = bumpy_ball(2);
    Draw draw(100 + i);
    for (int k = 0; k < 3 * i; ++k)
      mesh.point(Vertex_index(draw.below(mesh.number_of_vertices()))) = draw.point(12);
    const auto report = validate(mesh);
    digest.add(report.message());
    for (const auto& [f, g] : report.intersecting_faces)
      digest.add(static_cast<int>(f)), digest.add(static_cast<int>(g));
  }
  put_line("validate", digest);
}

void drags(int size, Response response, const char* part) {
  Digest digest;
  Mesh mesh = two_balls();
  Sculptor<Mesh> sculptor(mesh, Sculptor_parameters().response(response));
  Draw draw(2);
  for (int i = 0; i < 150 * size; ++i) {
    const Vertex_index v(draw.below(mesh.number_of_vertices()));
    const auto result = sculptor.drag(v, draw.point(14));
    digest.add(internal::coordinates(result.position));
    digest.add(static_cast<int>(result.end)), digest.add(result.legs);
    digest.add(result.kkt_residual), digest.add(result.stop_error);
    for (const auto& contact : result.contacts)
      digest.add(static_cast<int>(contact.kind));
  }
  add_mesh(digest, mesh);
  put_line(part, digest);
}

/// Vertices along an axis, by lengths of few bits: what is decided is exact, and so are the places.
void axis_moves(int size) {
  Digest digest;
  Mesh mesh = two_balls();
  Sculptor<Mesh> sculptor(mesh);
  Draw draw(3);
  for (int i = 0; i < 60 * size; ++i) {
    std::vector<std::pair<Vertex_index, double>> ways;
    for (const auto v : mesh.vertices())
      if (draw.below(3) == 0)
        ways.emplace_back(v, draw.coordinate(14));
    const auto result = sculptor.shift(i % 3, ways);
    digest.add(static_cast<bool>(result));
  }
  add_mesh(digest, mesh);
  put_line("axis_moves", digest);
}

void many_vertices(int size) {
  Digest digest;
  Mesh mesh = two_balls();
  Sculptor<Mesh> sculptor(mesh);
  Draw draw(4);
  for (int i = 0; i < 12 * size; ++i) {
    Dab_3<Kernel> dab{static_cast<Brush_kind>(i % 5), draw.point(10), 0.75, draw.coordinate(6) / 4, {}};
    const auto report = apply_brush(sculptor, std::array<Dab_3<Kernel>, 1>{dab});
    digest.add(report.left_l2);
  }
  add_mesh(digest, mesh);
  put_line("brushes", digest);
}

void edits(int size) {
  Digest digest;
  Mesh mesh = two_balls();
  Sculptor<Mesh> sculptor(mesh);
  Draw draw(5);
  for (int i = 0; i < 200 * size; ++i) {
    const auto f = Mesh::Face_index(draw.below(mesh.num_faces()));
    const auto h = Mesh::Halfedge_index(draw.below(mesh.num_halfedges()));
    const Point_3 p = draw.point(12);
    switch (draw.below(5)) {
    case 0:
      digest.add(static_cast<bool>(sculptor.insert_on_face(f, p)));
      break;
    case 1:
      digest.add(static_cast<bool>(sculptor.insert_on_edge(mesh.edge(h), p)));
      break;
    case 2:
      digest.add(static_cast<bool>(sculptor.collapse(h)));
      break;
    case 3:
      digest.add(static_cast<bool>(sculptor.flip(mesh.edge(h))));
      break;
    default:
      digest.add(static_cast<bool>(draw.below(2) == 0 ? sculptor.undo() : sculptor.redo()));
    }
  }
  add_mesh(digest, mesh);
  put_line("edits", digest);
}

/// What is near, what a ray meets, where a probe comes.
void finding(int size) {
  Digest digest;
  Mesh mesh = two_balls();
  Sculptor<Mesh> sculptor(mesh);
  Draw draw(6);
  for (int i = 0; i < 100 * size; ++i) {
    digest.add(static_cast<int>(sculptor.nearest_vertex(draw.point(14), 1)));
    const Point_3 source = draw.point(14), target = draw.point(14);
    if (const auto hit = sculptor.first_hit(source, target))
      digest.add(static_cast<int>(hit->face));
  }
  put_line("finding", digest);
  Digest places;
  auto probe = sculptor.probe(Point_3(0, 0, 3));
  for (int i = 0; i < 60 * size; ++i)
    places.add(internal::coordinates(probe.drag_to(draw.point(14)).position));
  put_line("probes", places);
}

void put_numbers(const char* part, const Eigen::Ref<const Eigen::MatrixXd>& numbers) {
  std::printf("%s", part);
  for (Eigen::Index i = 0; i < numbers.size(); ++i)
    std::printf(" %.17g", numbers.data()[i]);
  std::printf("\n");
}

void device() {
  const Device_parameters<double> general(named_design(Named_design::D1, Device_form::general)),
      point(named_design(Named_design::D1, Device_form::ditetrahedral));
  Draw draw(7);
  for (int i = 0; i < 6; ++i) {
    const double a = draw.below(64), b = draw.below(64), c = draw.below(64);
    const Device_vector<double> theta(0.75 + a / 256, 0.75 + b / 256, 0.75 + c / 256);
    const auto apex = forward_kinematics(point, theta), pose = forward_kinematics(general, theta);
    if (!apex || !pose)
      continue;
    put_numbers("device apex", apex->position);
    put_numbers("device platform", pose->position);
    put_numbers("device orientation", pose->orientation);
    if (const auto J = jacobian(general, *pose))
      put_numbers("device jacobian", J->linear);
    if (const auto inverse = general_inverse(general, pose->position, *pose))
      put_numbers("device angles", inverse->theta);
  }
}

} // namespace

int main(int argc, char** argv) {
  const std::string mode = argc > 1 ? argv[1] : "";
  const int size = argc > 2 ? std::atoi(argv[2]) : 1;
  const std::array<std::pair<const char*, int>, 4> modes = {
      {{"nearest", FE_TONEAREST}, {"upward", FE_UPWARD}, {"downward", FE_DOWNWARD}, {"towardzero", FE_TOWARDZERO}}};
  for (const auto& [name, value] : modes)
    if (name == mode && size > 0) {
      std::fesetround(value);
      Digest scene;
      add_mesh(scene, two_balls());
      put_line("scene", scene);
      sweeps(size);
      validation(size);
      axis_moves(size);
      finding(size);
      edits(size);
      drags(size, Response::slide, "slides");
      drags(size, Response::stop, "stops");
      drags(size, Response::paper(), "paper");
      many_vertices(size);
      device();
      const bool stands = std::fegetround() == value;
      std::fesetround(FE_TONEAREST); // CGAL looks at the end
      if (!stands)
        std::puts("the mode of rounding is another one");
      return stands ? 0 : 1;
    }
  std::fputs("usage: result_bits nearest|upward|downward|towardzero [SCALE]\n", stderr);
  return 2;
}
