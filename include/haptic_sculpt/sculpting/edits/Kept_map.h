// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/sculpting/Property_origin.h>
#include <haptic_sculpt/sculpting/edits/Element_ids.h>

#include <boost/container/small_vector.hpp>
#include <boost/property_map/property_map.hpp>

#include <algorithm>
#include <map>
#include <type_traits>
#include <variant>
#include <vector>

namespace haptic_sculpt::internal {

/// An edit that is under way, as property maps see it.
struct Edit_under_way {
  const Change* change;
  bool is_back;                  ///< whether it is taken back
  std::array<double, 3> weights; ///< of the vertices of the edit, for one that is created in the middle of these

  /// How many these are.
  std::size_t size() const { return change->edit.kind == Edit_kind::insert_on_face ? 3 : 2; }
};

/// A property map whose values live through edits: those of what dies are kept for undo and redo, and new elements get
/// values of what they come from. Of the four kinds of elements a map takes those that are its keys.
template <class Mesh>
class Kept_map {
public:
  using Element = std::variant<typename Mesh::Vertex_index, typename Mesh::Halfedge_index, typename Mesh::Edge_index,
                               typename Mesh::Face_index>;
  virtual ~Kept_map() = default;

  /// \name In this order, for each edit; one that is not made ends with the next begin()
  ///@{
  virtual void begin() noexcept = 0;
  /// Each element that will die, while it is in the mesh.
  virtual void dies(const Element& element, const Element_ids& ids) = 0;
  /// The mesh is about to change: what is to be allocated for the record is allocated here.
  /// \param first, number of the oldest edit in the history, and of this one; `no_id` where it is not recorded
  /// \param is_new whether it is made for the first time \param is_reversal whether it is the one before reversed,
  /// as that was broken off
  virtual void prepare(std::size_t first, std::size_t number, bool is_new, bool is_reversal) = 0;
  /// Each element that has been created, when the mesh is complete again.
  virtual void created(const Element& element, const Element_ids& ids, const Edit_under_way& under_way,
                       const Vertex_ids<Mesh>& vertices) = 0;
  /// \param is_whole whether nothing was thrown for what has been created
  virtual void end(bool is_whole) noexcept = 0;
  ///@}
};

/// One of these. \tparam Carry makes a value of a Property_origin \tparam is_recorded whether undo and redo give the
/// values back; else what they revive is carried on as what is new
template <class Mesh, class Map, class Carry, bool is_recorded = true>
class Kept_map_of : public Kept_map<Mesh> {
  using Element = typename Kept_map<Mesh>::Element;
  using Key = typename boost::property_traits<Map>::key_type;
  using Value = typename boost::property_traits<Map>::value_type;
  static constexpr bool is_directed = std::is_same<Key, typename Mesh::Halfedge_index>::value;

public:
  Kept_map_of(Map map, Carry carry) : map_(map), carry_(std::move(carry)) {}

  void dies(const Element& element, const Element_ids& ids) override {
    if (const Key* key = std::get_if<Key>(&element))
      dead_.push_back({ids, Value(get(map_, *key))});
  }

  void prepare(std::size_t first, std::size_t number, bool is_new, bool is_reversal) override {
    std::sort(dead_.begin(), dead_.end(), [](const Entry& a, const Entry& b) { return a.ids < b.ids; });
    if (!is_reversal)
      unwritten_.clear(), broken_off_ = no_id;
    for (const Entry& saved : unwritten_)
      if (Entry* dead = find(dead_, saved.ids))
        dead->value = saved.value;
    store_.erase(store_.begin(), number == no_id ? store_.end() : store_.lower_bound(first)); // none where it is off
    if (!is_recorded || number == no_id)
      return;
    if (is_reversal && number == broken_off_) // what it was to carry on is carried on when it is made
      dead_.erase(std::remove_if(dead_.begin(), dead_.end(),
                                 [this](const Entry& dead) { return find(unwritten_, dead.ids) == nullptr; }),
                  dead_.end());
    number_ = number;
    alive_again_ = &(is_new ? fresh_ : store_)[number];
  }

  void created(const Element& element, const Element_ids& ids, const Edit_under_way& under_way,
               const Vertex_ids<Mesh>& vertices) override {
    if (!std::holds_alternative<Key>(element))
      return;
    const Key key = std::get<Key>(element);
    if (const Entry* saved = alive_again_ ? find(*alive_again_, ids) : nullptr) {
      put(map_, key, saved->value);
      return;
    }
    Property_origin<Value> origin;
    boost::container::small_vector<Value, 3> around; // values of vertices that stay
    if constexpr (std::is_same<Key, typename Mesh::Vertex_index>::value) {
      if (under_way.is_back) // the map was given while it was dead, so nothing is known of it
        return give_default(key);
      for (std::size_t k = 0; k < under_way.size(); ++k)
        around.push_back(get(map_, vertices.vertex(under_way.change->edit.vertices[k])));
      for (std::size_t k = 0; k < under_way.size(); ++k)
        origin.add(around[k], under_way.weights[k]);
    } else {
      const Edit_lineage lineage(*under_way.change, under_way.is_back, is_directed);
      if (const auto same = lineage.only_origin(ids)) {
        if (const Entry* old = find(dead_, *same))
          origin.add(old->value, 1);
      } else {
        for (const Entry& old : dead_)
          if (origin.size < origin.values.size() && lineage.comes_from(ids, old.ids))
            origin.add(old.value, 1);
      }
      for (std::size_t k = 0; k < origin.size; ++k)
        origin.weights[k] = 1.0 / static_cast<double>(origin.size);
    }
    if (origin.size == 0)
      return give_default(key);
    put(map_, key, carry_(static_cast<const Property_origin<Value>&>(origin)));
  }

  void end(bool is_whole) noexcept override {
    if (alive_again_)
      alive_again_->swap(dead_);
    unwritten_.clear(), broken_off_ = no_id;
    if (alive_again_ && !is_whole)
      unwritten_.swap(dead_), broken_off_ = number_;
    if (!fresh_.empty()) { // what could be redone before it cannot be any more
      store_.erase(store_.lower_bound(fresh_.begin()->first), store_.end());
      store_.merge(fresh_);
    }
    begin();
  }
  void begin() noexcept override {
    dead_.clear();
    fresh_.clear();
    alive_again_ = nullptr;
  }

private:
  struct Entry {
    Element_ids ids;
    Value value;
  };
  using Entries = std::vector<Entry>;

  Map map_;
  Carry carry_;
  Entries dead_; ///< by the edit under way
  std::map<std::size_t, Entries>
      store_, ///< by number of edit: what it killed, or, while it is taken back, what it had made
      fresh_; ///< of a new edit, until it is made
  Entries* alive_again_ = nullptr; ///< that of the edit under way
  Entries unwritten_;              ///< of the edit before, if it was broken off: what it was to write
  std::size_t number_ = no_id, broken_off_ = no_id; ///< of the edit under way; of the one before, if it was broken off

  /// Where a descriptor is used again, the mesh sees to this in maps of its own.
  void give_default(const Key& key) {
    if constexpr (is_recorded && std::is_default_constructible<Value>::value &&
                  !std::is_same<Map, typename Mesh::template Property_map<Key, Value>>::value)
      put(map_, key, Value());
  }
  /// \return nullptr where there is none
  template <class Range>
  static auto find(Range& entries, const Element_ids& ids) -> decltype(&*entries.begin()) {
    const auto at = std::lower_bound(entries.begin(), entries.end(), ids,
                                     [](const Entry& entry, const Element_ids& n) { return entry.ids < n; });
    return at != entries.end() && at->ids == ids ? &*at : nullptr;
  }
};

} // namespace haptic_sculpt::internal
