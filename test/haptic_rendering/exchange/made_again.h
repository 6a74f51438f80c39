// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "haptic_rendering/exchange/Surface.h"

#include <boost/test/unit_test.hpp>

namespace exchange_tests {

using Entries = std::vector<Edit>;

/// What a journal says, made again by other means: no tool, no slide, each leg by itself.
inline Surface made_again(Mesh mesh, const Entries& entries) {
  Sculptor<Mesh> sculptor(mesh, parameters::response(Response::stop));
  std::vector<Sculptor<Mesh>::Stroke_type> strokes;
  std::size_t failed = 0;
  for (const Edit& e : entries) {
    using Kind = Edit_kind;
    const Mesh::Point p(e.point[0], e.point[1], e.point[2]);
    const auto& v = e.vertices;
    switch (e.kind) {
    case Kind::move:
      failed += !sculptor.grab(sculptor.vertex(v[0])).drag_to(p).reached;
      break;
    case Kind::insert_on_face:
      failed += !sculptor.insert_on_face(sculptor.face_of(v[0], v[1], v[2]), p);
      break;
    case Kind::insert_on_edge:
      failed += !sculptor.insert_on_edge(sculptor.edge_of(v[0], v[1]), p);
      break;
    case Kind::collapse: {
      auto h = mesh.halfedge(sculptor.edge_of(v[0], v[1]));
      h = mesh.target(h) == sculptor.vertex(v[1]) ? h : mesh.opposite(h);
      failed += !sculptor.collapse(h);
      break;
    }
    case Kind::flip:
      failed += !sculptor.flip(sculptor.edge_of(v[0], v[1]));
      break;
    case Kind::remove: // is said as a collapse
      ++failed;
      break;
    case Kind::undo:
      failed += !sculptor.undo();
      break;
    case Kind::redo:
      failed += !sculptor.redo();
      break;
    case Kind::stroke:
      strokes.push_back(sculptor.stroke());
      break;
    case Kind::end:
      strokes.pop_back();
      break;
    case Kind::none: // the end of a tick
      break;
    case Kind::shift: {
      std::vector<std::pair<Mesh::Vertex_index, double>> ways;
      for (const auto& [id, coordinate] : e.ways)
        ways.emplace_back(sculptor.vertex(id), coordinate);
      failed += !sculptor.shift(e.axis, ways);
      break;
    }
    }
  }
  BOOST_TEST(failed == 0u);
  return surface_of(mesh, sculptor);
}

} // namespace exchange_tests
