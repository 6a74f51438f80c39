// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/surface/broad_phase/Broad_phase_base.h>

#include <boost/geometry.hpp>
#include <boost/geometry/index/rtree.hpp>

namespace haptic_sculpt::benchmark {

/// Boost.Geometry's R*-tree of the boxes of all faces, packed when built; a face that moves is taken out and put in
/// again. A model of BroadPhase, to compare with. It holds doubles: nothing is to be rounded outward.
template <class Mesh>
class Rtree_broad_phase : public Broad_phase_base<Mesh, Rtree_broad_phase<Mesh>> {
public:
  using Face_index = typename Mesh::Face_index;

  explicit Rtree_broad_phase(const Mesh& mesh)
    : Broad_phase_base<Mesh, Rtree_broad_phase>(mesh), boxes_(mesh.num_faces()) {
    std::vector<Entry> entries;
    entries.reserve(mesh.number_of_faces());
    for (const Face_index f : mesh.faces())
      entries.emplace_back(boxes_[f] = to_boost(face_box(mesh, f)), f);
    tree_ = Tree(entries.begin(), entries.end());
  }

  void query(const Box_3& box, std::vector<Face_index>& faces) {
    for (auto it = tree_.qbegin(boost::geometry::index::intersects(to_boost(box))); it != tree_.qend(); ++it)
      faces.push_back(it->second);
  }

  template <class Faces>
  void faces_moved(const Faces& faces) {
    for (const Face_index f : faces) {
      tree_.remove(Entry(boxes_[f], f));
      tree_.insert(Entry(boxes_[f] = to_boost(face_box(this->mesh(), f)), f));
    }
  }

  template <class Faces>
  void faces_inserted(const Faces& faces) {
    boxes_.resize(std::max(boxes_.size(), static_cast<std::size_t>(this->mesh().num_faces())));
    for (const Face_index f : faces) {
      tree_.remove(Entry(boxes_[f], f)); // told again
      tree_.insert(Entry(boxes_[f] = to_boost(face_box(this->mesh(), f)), f));
    }
  }

  template <class Faces>
  void faces_removed(const Faces& faces) {
    for (const Face_index f : faces)
      tree_.remove(Entry(boxes_[f], f));
  }

private:
  using Boost_point = boost::geometry::model::point<double, 3, boost::geometry::cs::cartesian>;
  using Boost_box = boost::geometry::model::box<Boost_point>;
  using Entry = std::pair<Boost_box, Face_index>;
  struct Equal {
    bool operator()(const Entry& a, const Entry& b) const { return a.second == b.second; }
  };
  using Tree = boost::geometry::index::rtree<Entry, boost::geometry::index::rstar<16>,
                                             boost::geometry::index::indexable<Entry>, Equal>;

  std::vector<Boost_box> boxes_;
  Tree tree_;

  static Boost_box to_boost(const Box_3& box) {
    return {{box.lower[0], box.lower[1], box.lower[2]}, {box.upper[0], box.upper[1], box.upper[2]}};
  }
};

} // namespace haptic_sculpt::benchmark
