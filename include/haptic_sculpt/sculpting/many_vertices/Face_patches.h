// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <boost/property_map/property_map.hpp>

#include <cstdint>
#include <map>
#include <vector>

namespace haptic_sculpt::internal {

/// Stands for a map of patches that was not given.
struct No_face_patches {};

/// The patch of each face of a range, numbered from 0; outside of the range there is none.
///
/// \tparam Map the caller's, which is kept up to date as faces come; or No_face_patches
template <class Mesh, class Map>
class Face_patches {
public:
  using Face_index = typename Mesh::Face_index;
  using Halfedge_index = typename Mesh::Halfedge_index;
  using Patch = std::int32_t;
  static constexpr Patch none = -1;
  static constexpr bool is_given = !std::is_same<Map, No_face_patches>::value;

  template <class Faces>
  Face_patches(const Mesh& mesh, const Faces& faces, const Map& map)
      : mesh_(&mesh), map_(map), patch_(mesh.num_faces(), Patch(none)) {
    for (const Face_index f : faces)
      patch_[static_cast<std::size_t>(f)] = patch_in_map(f);
  }

  Patch operator()(Face_index f) const { return patch_[static_cast<std::size_t>(f)]; }
  std::size_t size() const { return number_; } ///< how many patches there are

  /// For this many new faces.
  void make_room(std::size_t faces) {
    if (patch_.capacity() < mesh_->num_faces() + faces)
      patch_.reserve(2 * (mesh_->num_faces() + faces));
  }
  /// f is a new face, of this patch.
  void set(Face_index f, Patch patch) {
    if (static_cast<std::size_t>(f) >= patch_.size())
      patch_.resize(mesh_->num_faces(), Patch(none));
    patch_[static_cast<std::size_t>(f)] = patch;
    if constexpr (is_given)
      put(map_, f, values_[static_cast<std::size_t>(patch)]);
  }

  /// Where no map was given: patches are what is connected in the range without crossing certain edges.
  template <class Is_border>
  void connect(const Is_border& is_border) {
    if constexpr (!is_given) {
      std::vector<char> is_known(patch_.size(), 0);
      std::vector<Face_index> stack;
      number_ = 0;
      for (const Face_index first : mesh_->faces()) {
        if ((*this)(first) == none || is_known[static_cast<std::size_t>(first)])
          continue;
        is_known[static_cast<std::size_t>(first)] = 1;
        stack.push_back(first);
        while (!stack.empty()) {
          const Face_index f = stack.back();
          stack.pop_back();
          patch_[static_cast<std::size_t>(f)] = static_cast<Patch>(number_);
          for (const Halfedge_index h : mesh_->halfedges_around_face(mesh_->halfedge(f))) {
            const Face_index g = mesh_->face(mesh_->opposite(h));
            if ((*this)(g) == none || is_known[static_cast<std::size_t>(g)] || is_border(mesh_->edge(h)))
              continue;
            is_known[static_cast<std::size_t>(g)] = 1;
            stack.push_back(g);
          }
        }
        ++number_;
      }
    }
  }

private:
  template <class Any_map, bool is_map>
  struct Value_of {
    using type = char;
  };
  template <class Any_map>
  struct Value_of<Any_map, true> {
    using type = typename boost::property_traits<Any_map>::value_type;
  };
  using Value = typename Value_of<Map, is_given>::type;

  const Mesh* mesh_;
  Map map_;
  std::vector<Patch> patch_;
  std::size_t number_ = 1;
  std::map<Value, Patch> index_; ///< of the values in the caller's map
  std::vector<Value> values_;    ///< by patch

  Patch patch_in_map(Face_index f) {
    if constexpr (is_given) {
      const auto [place, is_new] = index_.emplace(get(map_, f), static_cast<Patch>(values_.size()));
      if (is_new)
        values_.push_back(place->first);
      number_ = values_.size();
      return place->second;
    } else {
      (void)f;
      return 0;
    }
  }
};

} // namespace haptic_sculpt::internal
