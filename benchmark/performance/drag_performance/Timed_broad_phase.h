// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "drag_performance/Latencies.h"

#include <haptic_sculpt/surface/broad_phase/Box_tree_broad_phase.h>

namespace haptic_sculpt::benchmark {

/// The box tree with a stopwatch in front of it.
template <class Mesh>
class Timed_broad_phase : public Broad_phase_base<Mesh, Timed_broad_phase<Mesh>> {
public:
  using Face_index = typename Mesh::Face_index;

  explicit Timed_broad_phase(const Mesh& mesh) : Broad_phase_base<Mesh, Timed_broad_phase>(mesh), tree_(mesh) {}

  void query(const Box_3& box, std::vector<Face_index>& faces) {
    const std::uint64_t start = Query_timer::now();
    tree_.query(box, faces);
    asking() += timer().nanoseconds(start, Query_timer::now());
  }
  bool query_star(const Swept_star_3& star, std::vector<Face_index>& faces,
                  std::size_t most = std::numeric_limits<std::size_t>::max()) {
    const std::uint64_t start = Query_timer::now();
    const bool is_whole = tree_.query_star(star, faces, most);
    asking() += timer().nanoseconds(start, Query_timer::now());
    return is_whole;
  }
  void fetch_ahead(const Box_3& box) { tree_.fetch_ahead(box); }
  void fetch_on() { tree_.fetch_on(); }
  template <class Faces>
  void faces_moved(const Faces& faces) {
    const std::uint64_t start = Query_timer::now();
    tree_.faces_moved(faces);
    updating() += timer().nanoseconds(start, Query_timer::now());
  }
  template <class Faces>
  void faces_inserted(const Faces& faces) { tree_.faces_inserted(faces); }
  template <class Faces>
  void faces_removed(const Faces& faces) { tree_.faces_removed(faces); }

  /// Nanoseconds in queries and in updates since they were set to 0. Of all objects: a Sculptor makes its own.
  static double& asking() { static double time = 0; return time; }
  static double& updating() { static double time = 0; return time; }

private:
  Box_tree_broad_phase<Mesh> tree_;
};

} // namespace haptic_sculpt::benchmark
