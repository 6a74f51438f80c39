// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

/// \file
/// Lists of indices as numbers, to be compared and printed. In the namespace of the suite.

#include <meshes/generated_meshes.h>

#include <utility>
#include <vector>

namespace validity {

using V = meshes::Mesh::Vertex_index;
using F = meshes::Mesh::Face_index;

template <class Index>
std::vector<std::size_t> numbers(const std::vector<Index>& list) {
  return {list.begin(), list.end()};
}
template <class Index>
std::vector<std::pair<std::size_t, std::size_t>> pairs(const std::vector<std::pair<Index, Index>>& list) {
  return {list.begin(), list.end()};
}
using Numbers = std::vector<std::size_t>;
using Pairs = std::vector<std::pair<std::size_t, std::size_t>>;

} // namespace validity
