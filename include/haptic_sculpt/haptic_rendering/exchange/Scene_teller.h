// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef HAPTIC_SCULPT_HAPTIC_RENDERING_EXCHANGE_SCENE_TELLER_H
#define HAPTIC_SCULPT_HAPTIC_RENDERING_EXCHANGE_SCENE_TELLER_H

#include <haptic_sculpt/haptic_rendering/exchange/Scene_copy.h>
#include <haptic_sculpt/sculpting/Edit_visitor.h>

namespace haptic_sculpt {

/// An EditVisitor that passes changes of a mesh on by value: to a viewer, and into a copy under way.
template <class Mesh>
class Scene_teller : public Default_edit_visitor {
public:
  using Vertex_index = typename Mesh::Vertex_index; ///< of the mesh
  using Face_index = typename Mesh::Face_index;     ///< of the mesh
  using Kind = Scene_change::Kind;                  ///< of the changes told
  /// Vertices and where they were moved to, one after the other.
  using Moves = std::vector<std::pair<Vertex_index, typename Mesh::Point>>;

  /// Tells nobody at first. \param mesh refers to it; it must outlive this and its copies
  explicit Scene_teller(const Mesh& mesh) : mesh_(&mesh) {}

  /// To nobody: nullptr.
  void tell_to(Scene_feed* feed) { feed_ = feed; }
  void tell_to(Scene_copy* copy) { copy_ = copy; } ///< beside the feed; to none: nullptr
  void tell_to(Moves* moves) { moves_ = moves; }   ///< moves are listed there, too; nowhere: nullptr

  const Scene_feed* feed() const { return feed_; } ///< that hears of changes; none: nullptr
  const Scene_copy* copy() const { return copy_; } ///< that hears of changes; none: nullptr

  /// \name What the Sculptor calls
  ///@{

  /// Tells its new point.
  void vertex_moved(Vertex_index v) {
    tell(Kind::vertex_moved, v);
    if (moves_ != nullptr)
      moves_->emplace_back(v, mesh_->point(v));
  }
  /// Tells its point and the number that lasts.
  void vertex_created(Vertex_index v, std::size_t id) { tell(Kind::vertex_created, v, id); }
  void vertex_dies(Vertex_index v, std::size_t) { tell(Kind::vertex_dies, v); } ///< tells its index
  /// Tells the indices of its corners.
  void face_created(Face_index f) { tell(Kind::face_created, f, Scene_copy::corners_of(*mesh_, f)); }
  void face_dies(Face_index f) { tell(Kind::face_dies, f, {}); } ///< tells its index
  ///@}

private:
  const Mesh* mesh_;
  Scene_feed* feed_ = nullptr;
  Scene_copy* copy_ = nullptr;
  Moves* moves_ = nullptr;

  void tell(Kind kind, Vertex_index v, std::size_t id = 0) {
    if (feed_ == nullptr && copy_ == nullptr)
      return;
    Scene_change change;
    change.kind = kind, change.index = static_cast<std::uint32_t>(v), change.id = id;
    const auto& p = mesh_->point(v);
    change.point = {p.x(), p.y(), p.z()};
    pass(change);
  }
  void tell(Kind kind, Face_index f, const std::array<std::uint32_t, 3>& corners) {
    Scene_change change;
    change.kind = kind, change.index = static_cast<std::uint32_t>(f), change.corners = corners;
    pass(change);
  }
  void pass(Scene_change change) {
    if (feed_ != nullptr)
      change = feed_->tell(change);
    if (copy_ != nullptr)
      copy_->follow(change);
  }
};

} // namespace haptic_sculpt

#endif
