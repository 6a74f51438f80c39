// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/surface/io/Binary_scanner.h>
#include <haptic_sculpt/surface/io/Text_scanner.h>
#include <haptic_sculpt/surface/io/attribute_in_words.h>
#include <haptic_sculpt/surface/validity/Face_soup.h>

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace haptic_sculpt::internal {

using Ply_type = Vertex_attribute::Type;

inline std::size_t size_of(Ply_type type) {
  constexpr std::size_t sizes[] = {1, 1, 2, 2, 4, 4, 4, 8};
  return sizes[static_cast<int>(type)];
}

struct Ply_property {
  std::string name;
  Ply_type type;                         // of the value, or of the items of a list
  std::optional<Ply_type> length_type{}; // for lists
};

struct Ply_element {
  std::string name;
  std::uint64_t count;
  std::vector<Ply_property> properties;
};

/// Elements of a file, and properties of an element: names are looked up one by one.
constexpr std::size_t most_names = 1000;

struct Ply_header {
  enum class Encoding { ascii, little_endian, big_endian } encoding;
  std::vector<Ply_element> elements;
  std::size_t size; // in bytes
  std::size_t lines;
};

/// \throw Read_error
[[gnu::cold]] inline Ply_header parse_ply_header(std::string_view bytes) {
  Text_scanner scan(bytes, 0);
  if (!scan.next_line() || scan.word("'ply'") != "ply")
    throw Read_error("a PLY file begins with 'ply'");
  const auto type = [&]() {
    const std::string_view word = scan.word("a type");
    constexpr std::string_view names[2][8] = {
        {"char", "uchar", "short", "ushort", "int", "uint", "float", "double"},
        {"int8", "uint8", "int16", "uint16", "int32", "uint32", "float32", "float64"}};
    for (int i = 0; i < 8; ++i)
      if (word == names[0][i] || word == names[1][i])
        return static_cast<Ply_type>(i);
    scan.fail_at(word, " is no type of PLY");
  };
  Ply_header header{};
  bool has_format = false;
  for (;;) {
    if (!scan.next_line())
      throw Read_error("the file ends within its header");
    const std::string_view keyword = scan.word("a keyword");
    if (keyword == "comment" || keyword == "obj_info") {
      scan.skip_rest_of_line();
    } else if (keyword == "format") {
      const std::string_view name = scan.word("a format");
      if (name == "ascii")
        header.encoding = Ply_header::Encoding::ascii;
      else if (name == "binary_little_endian")
        header.encoding = Ply_header::Encoding::little_endian;
      else if (name == "binary_big_endian")
        header.encoding = Ply_header::Encoding::big_endian;
      else
        scan.fail_at(name, " is no format of PLY");
      has_format = true;
    } else if (keyword == "element") {
      std::string name(scan.word("a name"));
      const auto count = scan.to_number<std::uint64_t>(scan.word("a number of elements"), "a number of elements");
      if (header.elements.size() == most_names)
        scan.fail("a file has at most " + std::to_string(most_names) + " elements");
      header.elements.push_back({std::move(name), count, {}});
    } else if (keyword == "property") {
      if (header.elements.empty())
        scan.fail("a property stands before the first element");
      auto& properties = header.elements.back().properties;
      if (properties.size() == most_names)
        scan.fail("an element has at most " + std::to_string(most_names) + " properties");
      Text_scanner ahead = scan;
      if (ahead.word("a type") == "list") {
        scan.word("'list'");
        const Ply_type length = type(), item = type();
        if (length >= Ply_type::float32)
          scan.fail("the length of a list has to be an integer");
        properties.push_back({std::string(scan.word("a name")), item, length});
      } else {
        const Ply_type value = type();
        properties.push_back({std::string(scan.word("a name")), value});
      }
      const std::string& name = properties.back().name;
      if (std::any_of(properties.begin(), properties.end() - 1, [&](const auto& p) { return p.name == name; }))
        scan.fail("property " + in_quotes(name) + " stands twice");
    } else if (keyword == "end_header") {
      if (!has_format)
        scan.fail("the header names no format");
      header.size = bytes.size() - scan.rest().size();
      header.lines = std::count(bytes.begin(), bytes.begin() + header.size, '\n');
      return header;
    } else {
      scan.fail_at(keyword, " is no line of a PLY header");
    }
  }
}

/// The body of a PLY file, in text or in bytes: a value of a given type as a double, which holds all of them exactly.
class Ply_values {
public:
  Ply_values(std::string_view body, const Ply_header& header)
      : text_(header.encoding == Ply_header::Encoding::ascii)
      , scan_text_(body, 0, header.lines)
      , scan_bytes_(body, header.encoding == Ply_header::Encoding::big_endian) {}

  double take(Ply_type type) {
    switch (type) {
    case Ply_type::int8:
      return take_as<std::int8_t>();
    case Ply_type::uint8:
      return take_as<std::uint8_t>();
    case Ply_type::int16:
      return take_as<std::int16_t>();
    case Ply_type::uint16:
      return take_as<std::uint16_t>();
    case Ply_type::int32:
      return take_as<std::int32_t>();
    case Ply_type::uint32:
      return take_as<std::uint32_t>();
    case Ply_type::float32:
      return take_as<float>();
    case Ply_type::float64:
      break;
    }
    return take_as<double>();
  }

  /// The bytes left; an ASCII file ends with blanks.
  bool at_end() {
    return text_ ? !scan_text_.has_word() && !scan_text_.next_line()
                 : scan_bytes_.rest().find_first_not_of(" \t\r\n") == std::string_view::npos;
  }

private:
  template <class Number>
  double take_as() {
    return text_ ? scan_text_.to_number<Number>(scan_text_.word_anywhere("a value"), "a value of its type")
                 : scan_bytes_.take<Number>();
  }

  bool text_;
  Text_scanner scan_text_;
  Binary_scanner scan_bytes_;
};

/// Reads a PLY file, ASCII or binary: x, y, z and further numbers of the element `vertex`, and the list
/// `vertex_indices` (or `vertex_index`) of the element `face`. Normals, which a drag makes wrong, and everything else
/// is skipped. \throw Read_error
inline Face_soup parse_ply(std::string_view bytes) {
  const Ply_header header = parse_ply_header(bytes);
  const bool text = header.encoding == Ply_header::Encoding::ascii;
  const std::string_view body = bytes.substr(header.size);
  Ply_values values(body, header);
  Face_soup soup;
  bool has_vertices = false, has_faces = false;
  for (const Ply_element& element : header.elements) {
    std::size_t least = 0;
    for (const Ply_property& property : element.properties)
      least += text ? 2 : size_of(property.length_type.value_or(property.type)); // in text a digit and a blank
    if (least == 0 && element.count > 0)
      throw Read_error("the element " + in_quotes(element.name) + " has no properties");
    if (element.count > 0)
      check_count(element.count, least, body.size(), "elements " + in_quotes(element.name));

    const bool is_vertex = element.name == "vertex" || element.name == "vertices";
    const bool is_face = element.name == "face" || element.name == "faces";
    if ((is_vertex && has_vertices) || (is_face && has_faces))
      throw Read_error("the element " + in_quotes(element.name) + " stands twice in the header");
    std::array<std::optional<std::size_t>, 3> coordinate;
    std::optional<std::size_t> indices;
    for (std::size_t i = 0; i < element.properties.size(); ++i) {
      const Ply_property& property = element.properties[i];
      if (!property.length_type && property.name.size() == 1 && property.name[0] >= 'x' && property.name[0] <= 'z')
        coordinate[property.name[0] - 'x'] = i;
      if (property.length_type && property.type < Ply_type::float32 &&
          (property.name == "vertex_indices" || property.name == "vertex_index")) {
        if (is_face && indices)
          throw Read_error("the faces have a list 'vertex_indices' and a list 'vertex_index'; leave one of them out");
        indices = i;
      }
    }
    if (is_vertex && !(coordinate[0] && coordinate[1] && coordinate[2]))
      throw Read_error("the vertices lack one of the properties x, y and z");
    if (is_face && !indices)
      throw Read_error("the faces lack the list of integers 'vertex_indices'");
    std::vector<std::size_t> attributes; // properties by index
    for (std::size_t i = 0; (is_vertex || is_face) && i < element.properties.size(); ++i) {
      const Ply_property& property = element.properties[i];
      if ((is_vertex && (coordinate[0] == i || coordinate[1] == i || coordinate[2] == i)) || (is_face && indices == i))
        continue;
      const auto has_this_name = [&](const Vertex_attribute& a) { return a.name == property.name; };
      const bool is_new = property.name != "x" && property.name != "y" && property.name != "z" &&
                          std::none_of(soup.attributes.begin(), soup.attributes.end(), has_this_name);
      if (is_vertex && !property.length_type && is_new && is_single_word(property.name) &&
          attribute_in_words(property.name) != "normals") {
        soup.attributes.push_back({property.name, property.type, {}});
        attributes.push_back(i);
      } else {
        soup.leave_out(attribute_in_words(property.name) + (is_face ? " of faces" : ""));
      }
    }
    if (!is_vertex && !is_face && element.count > 0)
      soup.leave_out("the element " + in_quotes(element.name));
    has_vertices |= is_vertex;
    has_faces |= is_face;
    if (is_vertex)
      soup.points.reserve(element.count);
    for (std::size_t k = 0; k < attributes.size(); ++k)
      soup.attributes[k].values.reserve(element.count);

    const auto take = [&](Ply_type type, std::uint64_t item) {
      try {
        return values.take(type);
      } catch (const Read_error& error) {
        throw Read_error(escaped(element.name) + " " + std::to_string(item) + " of " + std::to_string(element.count) +
                         ": " + error.what());
      }
    };
    std::vector<double> row(element.properties.size());
    for (std::uint64_t item = 0; item < element.count; ++item) {
      for (std::size_t i = 0; i < element.properties.size(); ++i) {
        const Ply_property& property = element.properties[i];
        if (!property.length_type) {
          row[i] = take(property.type, item);
          continue;
        }
        const double length = take(*property.length_type, item);
        if (length < 0)
          throw Read_error(escaped(element.name) + " " + std::to_string(item) + " has a list of negative length");
        for (double k = 0; k < length; ++k) {
          const double value = take(property.type, item); // an absurd length soon finds the end of the file
          if (!is_face || i != *indices)
            continue;
          if (value < 0 || value >= UINT32_MAX)
            throw Read_error("face " + std::to_string(item) + " names vertex " +
                             std::to_string(static_cast<std::int64_t>(value)) + ", which cannot be");
          soup.corners.push_back(static_cast<Face_soup::Index>(value));
        }
      }
      if (is_vertex)
        soup.add_point(row[*coordinate[0]], row[*coordinate[1]], row[*coordinate[2]]);
      for (std::size_t k = 0; k < attributes.size(); ++k)
        soup.attributes[k].values.push_back(row[attributes[k]]);
      if (is_face)
        soup.close_face();
    }
  }
  if (!has_vertices || !has_faces)
    throw Read_error("the header promises no vertices, or no faces");
  if (!values.at_end())
    throw Read_error("data follow after the last element that the header promises");
  for (std::size_t f = 0; f < soup.number_of_faces(); ++f)
    for (const auto* corner = soup.begin(f); corner != soup.end(f); ++corner)
      if (*corner >= soup.points.size())
        throw Read_error("face " + std::to_string(f) + " names vertex " + std::to_string(*corner) +
                         ", but there are only " + std::to_string(soup.points.size()));
  return soup;
}

} // namespace haptic_sculpt::internal
