// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/surface/Mesh_file_format.h>
#include <haptic_sculpt/surface/io/attribute_in_words.h>
#include <haptic_sculpt/surface/validity/Face_soup.h>

#include <algorithm>
#include <set>
#include <string>
#include <vector>

/// \file
/// What files have for each vertex beside its place, in property maps of a mesh.

namespace haptic_sculpt {

/// One of them in a mesh: a property map of doubles that is called "v:TYPE NAME", e.g. "v:uchar red".
template <class Mesh>
struct Attribute_map {
  /// Of the mesh.
  using Map = typename Mesh::template Property_map<typename Mesh::Vertex_index, double>;
  std::string name;            ///< as in a file: "red"
  Vertex_attribute::Type type; ///< that a file is to have
  Map map;                     ///< refers to the mesh
};

/// All of a mesh, in the order in which they were added.
template <class Mesh>
std::vector<Attribute_map<Mesh>> vertex_attributes(const Mesh& mesh) {
  using Vertex = typename Mesh::Vertex_index;
  std::vector<Attribute_map<Mesh>> found;
  std::set<std::string> names; // maps of other types may have the same one
  for (const std::string& property : mesh.template properties<Vertex>())
    for (int i = 0; i < Vertex_attribute::number_of_types; ++i) {
      const auto type = static_cast<Vertex_attribute::Type>(i);
      const std::string begin = std::string("v:") + name_of(type) + ' ';
      if (property.compare(0, begin.size(), begin) == 0 && names.insert(property).second)
        if (const auto map = find_property_map<Vertex, double>(mesh, property))
          found.push_back({property.substr(begin.size()), type, *map});
    }
  return found;
}

/// Adds one to a mesh, or gives the one that is there. Values are 0 where nothing else is said.
template <class Mesh>
Attribute_map<Mesh> add_vertex_attribute(Mesh& mesh, const std::string& name,
                                         Vertex_attribute::Type type = Vertex_attribute::Type::float64) {
  const std::string property = std::string("v:") + name_of(type) + ' ' + name;
  return {name, type, mesh.template add_property_map<typename Mesh::Vertex_index, double>(property, 0.0).first};
}

/// What a file of this format cannot hold of them, in words, e.g. "colours": PLY holds all, and refuses
/// names that it cannot say (`write_surface()`), OBJ red, green and blue.
template <class Mesh>
std::vector<std::string> attributes_not_held(const Mesh& mesh, Mesh_file_format format) {
  std::vector<std::string> lost;
  const auto attributes = vertex_attributes(mesh);
  const auto has = [&](const char* name) {
    return std::any_of(attributes.begin(), attributes.end(), [&](const auto& a) { return a.name == name; });
  };
  const bool holds_colours = format == Mesh_file_format::obj && has("red") && has("green") && has("blue");
  std::set<std::string> held;
  for (const auto& [name, type, map] : attributes) {
    const bool is_held =
        format == Mesh_file_format::ply || (holds_colours && (name == "red" || name == "green" || name == "blue") &&
                                            held.insert(name).second); // of two maps, e.g. of other types, the first
    const std::string word = internal::attribute_in_words(name);
    if (!is_held && std::find(lost.begin(), lost.end(), word) == lost.end())
      lost.push_back(word);
  }
  return lost;
}

} // namespace haptic_sculpt
