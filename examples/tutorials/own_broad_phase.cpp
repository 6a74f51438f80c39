// SPDX-License-Identifier: GPL-3.0-or-later
// A broad phase of one's own: it may name faces too many, never too few, and no result depends on it.
#include <haptic_sculpt/sculpting.h>
#include <haptic_sculpt/surface.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <iostream>

/// The boxes of all faces, one after another. A model of BroadPhase: it has what its base has not.
/// Edits tell it beforehand how many faces will come: what it does then may fail, what it does later may not.
template <class Mesh>
class Box_list : public haptic_sculpt::Broad_phase_base<Mesh, Box_list<Mesh>> {
public:
  using Face_index = typename Mesh::Face_index;
  explicit Box_list(const Mesh& mesh) : haptic_sculpt::Broad_phase_base<Mesh, Box_list>(mesh) {
    faces_inserted(mesh.faces());
  }

  void query(const haptic_sculpt::Box_3& box, std::vector<Face_index>& faces) const {
    for (std::size_t f = 0; f < boxes_.size(); ++f)
      if (haptic_sculpt::do_meet(boxes_[f], box))
        faces.emplace_back(static_cast<typename Mesh::size_type>(f));
  }

  void reserve(std::size_t faces, std::size_t) { boxes_.reserve(faces); }
  template <class Faces>
  void faces_inserted(const Faces& faces) {
    boxes_.resize(this->mesh().num_faces()); // a default box meets no other
    for (const Face_index f : faces)
      boxes_[f] = haptic_sculpt::face_box(this->mesh(), f);
  }
  template <class Faces>
  void faces_moved(const Faces& faces) {
    faces_inserted(faces);
  }
  template <class Faces>
  void faces_removed(const Faces& faces) {
    for (const Face_index f : faces)
      boxes_[f] = haptic_sculpt::Box_3();
  }

private:
  std::vector<haptic_sculpt::Box_3> boxes_; ///< by index of face
};

int main(int argc, char** argv) try {
  if (argc != 2)
    return std::cerr << "usage: own_broad_phase MESH\n", 2;
  using Mesh = CGAL::Surface_mesh<CGAL::Exact_predicates_inexact_constructions_kernel::Point_3>;
  Mesh mesh = haptic_sculpt::read_surface<Mesh>(argv[1]), same = mesh;
  haptic_sculpt::Sculptor<Mesh, Box_list<Mesh>> sculptor(mesh);
  haptic_sculpt::Sculptor<Mesh> usual(same);
  for (const unsigned v : {145u, 362u, 733u}) {
    const auto ours = sculptor.grab(Mesh::Vertex_index(v)).drag_to({0.2, 0.1, 0.3});
    const auto theirs = usual.grab(Mesh::Vertex_index(v)).drag_to({0.2, 0.1, 0.3});
    std::cout << "vertex " << v << ": " << name_of(ours.end) << " at " << ours.position << '\n';
    if (ours.position != theirs.position || ours.contacts.size() != theirs.contacts.size())
      return 1; // the sweeps decide exactly, so this cannot be
  }
  std::cout << "the same, bit for bit, as with the usual broad phase\n";
} catch (const std::exception& error) {
  std::cerr << error.what() << '\n';
  return 1;
}
