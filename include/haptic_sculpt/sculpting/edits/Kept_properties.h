// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/sculpting/Invalid_parameter.h>
#include <haptic_sculpt/sculpting/edits/Kept_map.h>
#include <haptic_sculpt/sculpting/edits/Lineage_map.h>
#include <haptic_sculpt/sculpting/geometry/vector_3.h>
#include <haptic_sculpt/surface/vertex_coordinates.h>

#include <exception>
#include <memory>

namespace haptic_sculpt::internal {

/// The property maps that a Sculptor keeps. Costs nothing while there is none.
template <class Mesh>
class Kept_properties {
public:
  using Vertex_index = typename Mesh::Vertex_index;
  using Face_index = typename Mesh::Face_index;
  using Edge_index = typename Mesh::Edge_index;

  explicit Kept_properties(const Mesh& mesh) : mesh_(&mesh) {}

  template <class Map, class Carry>
  void add(Map map, Carry carry) {
    using Key = typename boost::property_traits<Map>::key_type;
    static_assert(std::is_same<Key, Vertex_index>::value || std::is_same<Key, typename Mesh::Halfedge_index>::value ||
                      std::is_same<Key, Edge_index>::value || std::is_same<Key, Face_index>::value,
                  "Sculptor::keep: the keys of the map must be vertices, halfedges, edges or faces of the mesh");
    if constexpr (std::is_same<Map, typename Mesh::template Property_map<Vertex_index, typename Mesh::Point>>::value)
      if (mesh_->num_vertices() != 0 &&
          map.data() == mesh_->points().data()) // else a value that is carried would take the place of a proven one
        throw Invalid_parameter("keep() takes no map of where vertices are: edits and undo see to these");
    maps_.push_back(std::make_unique<Kept_map_of<Mesh, Map, Carry>>(map, std::move(carry)));
  }
  /// The visitor hears of what comes from what, if it has the functions for that. \param visitor is called as long as
  /// this lives
  template <class Visitor>
  void tell_lineage(Visitor& visitor) {
    const auto tell = [&](auto key) {
      using Hearing_map = Lineage_map<Visitor, decltype(key)>;
      if constexpr (Hears_of<Visitor, decltype(key)>::value)
        maps_.push_back(std::make_unique<Kept_map_of<Mesh, Hearing_map, Copy_property, false>>(Hearing_map{&visitor},
                                                                                             Copy_property()));
    };
    tell(Edge_index()), tell(Face_index());
  }

  /// Where an edit stands in the history: the numbers of the oldest one there and of its own, which is `no_id` where
  /// it is not recorded; whether it is made for the first time; whether it is the one before reversed, as that was
  /// broken off.
  struct Place {
    std::size_t first, number;
    bool is_new, is_reversal;
  };

  /// \name In this order, for each edit
  ///@{
  void begin(const Change& change, bool is_back, const Place& place) {
    under_way_ = {&change, is_back, {}};
    place_ = place;
    for (const auto& map : maps_)
      map->begin();
  }
  /// \param v the null index where no vertex dies
  template <class Faces, class Halfedges>
  void die(const Vertex_ids<Mesh>& ids, Vertex_index v, const Faces& faces, const Halfedges& halfedges) {
    if (maps_.empty())
      return;
    for (const auto& map : maps_) {
      for_each_element(ids, v, faces, halfedges,
                       [&](const Element& element, const Element_ids& of) { map->dies(element, of); });
      map->prepare(place_.first, place_.number, place_.is_new, place_.is_reversal);
    }
  }
  /// Where a map throws, elements after that one may have the default in it; the others hear of all, and undo knows all
  /// values.
  /// \param v the null index where no vertex was created
  template <class Faces, class Halfedges>
  void create(const Vertex_ids<Mesh>& ids, Vertex_index v, const Faces& faces, const Halfedges& halfedges) {
    if (maps_.empty())
      return;
    if (v.is_valid() && !under_way_.is_back)
      under_way_.weights = weights(ids, vertex_coordinates(*mesh_, v));
    std::exception_ptr thrown;
    for (const auto& map : maps_) {
      bool is_whole = true;
      try {
        for_each_element(ids, v, faces, halfedges, [&](const Element& element, const Element_ids& of) {
          map->created(element, of, under_way_, ids);
        });
      } catch (...) {
        is_whole = false;
        thrown = thrown ? thrown : std::current_exception();
      }
      map->end(is_whole);
    }
    if (thrown)
      std::rethrow_exception(thrown);
  }
  ///@}

private:
  using Element = typename Kept_map<Mesh>::Element;

  const Mesh* mesh_;
  std::vector<std::unique_ptr<Kept_map<Mesh>>> maps_;
  Edit_under_way under_way_{nullptr, false, {}};
  Place place_{0, no_id, true, false};

  template <class Faces, class Halfedges, class Function>
  void for_each_element(const Vertex_ids<Mesh>& ids, Vertex_index v, const Faces& faces, const Halfedges& halfedges,
                        const Function& function) {
    const auto tell = [&](auto element) { function(element, ids_of(*mesh_, ids, element)); };
    if (v.is_valid())
      tell(v);
    for (const auto h : halfedges) {
      tell(h);
      tell(mesh_->opposite(h));
      tell(mesh_->edge(h));
    }
    for (const Face_index f : faces)
      tell(f);
  }

  /// How near p is to each of the vertices around it: shares of the length of an edge, of the area of a face. Rounded.
  std::array<double, 3> weights(const Vertex_ids<Mesh>& ids, const Coordinates& p) const {
    const auto& around = under_way_.change->edit.vertices;
    const std::size_t n = under_way_.size();
    std::array<Vector, 3> way{}; // in units of the longest, lest squares leave the range
    double largest = 0;
    for (std::size_t k = 0; k < n; ++k) {
      way[k] = minus(vertex_coordinates(*mesh_, ids.vertex(around[k])), p);
      largest = std::fmax(largest, largest_magnitude(way[k]));
    }
    for (Vector& w : way)
      for (double& x : w)
        x /= largest;
    std::array<double, 3> result{};
    double sum = 0;
    for (std::size_t k = 0; k < n; ++k)
      sum += result[k] = n == 2 ? length(way[1 - k]) : length(cross(way[(k + 1) % 3], way[(k + 2) % 3]));
    for (std::size_t k = 0; k < n; ++k)
      result[k] = sum > 0 ? result[k] / sum : 1.0 / static_cast<double>(n);
    return result;
  }
};

} // namespace haptic_sculpt::internal
