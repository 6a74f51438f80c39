// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/sculpting/response/Other_walk.h>
#include <haptic_sculpt/surface/vertex_coordinates.h>

namespace haptic_sculpt::internal {

/// The ground of one drag. Refers to all that it is given. \tparam Guard as Guarded_star
template <class Mesh, class Guard>
class Ground_of_hand final : public Walk_ground {
public:
  /// \param leg what the last leg says; kept by the caller, to allocate no more
  Ground_of_hand(Guard& guard, const Mesh& mesh, const Drag_rules& rules, Drag_result<Mesh>& leg)
      : guard_(guard), mesh_(mesh), rules_(rules), leg_(leg) {}

  Coordinates leg(const Coordinates& source, const Coordinates& target) override {
    return guard_.leg(source, target, rules_, leg_);
  }

  std::optional<Stop> stop() const override {
    for (const Contact_3<Mesh>& contact : leg_.contacts)
      if (contact.kind == Contact_kind::vertex_face && !contact.is_flat)
        return Stop{face(contact.vertices[0], contact.vertices[1], contact.vertices[2]), contact.location,
                    contact.side};
    return std::nullopt;
  }

  bool is_spent() const override { return guard_.is_spent(); }

  Vertex moving() const override { return guard_.star().valence() != 0 ? number(guard_.star().centre) : none; }

  Coordinates point(Vertex v) const override { return vertex_coordinates(mesh_, Vertex_index(v)); }

  void find_faces(Vertex v, std::vector<Face>& faces) const override {
    faces.clear();
    const auto first = mesh_.halfedge(Vertex_index(v));
    auto h = first; // runs over the halfedges to v
    do {
      faces.push_back(face(Vertex_index(v), mesh_.target(mesh_.next(h)), mesh_.source(h)));
      h = mesh_.opposite(mesh_.next(h));
    } while (h != first);
  }

private:
  using Vertex_index = typename Mesh::Vertex_index;

  Guard& guard_;
  const Mesh& mesh_;
  const Drag_rules& rules_;
  Drag_result<Mesh>& leg_;

  static Vertex number(Vertex_index v) { return static_cast<Vertex>(v); }
  static Face face(Vertex_index a, Vertex_index b, Vertex_index c) { return {number(a), number(b), number(c)}; }
};

} // namespace haptic_sculpt::internal
