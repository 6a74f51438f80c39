// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstddef>

namespace haptic_sculpt::internal {

/// What a container of n elements that is full grows to: so growing by one again and again costs a constant each time.
inline std::size_t grown(std::size_t n) { return n + n / 2; }

/// Makes room for this many elements in all, and for more where there is none. \throw std::bad_alloc, and nothing has
/// changed.
template <class Vector>
void make_room(Vector& vector, std::size_t elements) {
  if (elements > vector.capacity())
    vector.reserve(std::max(elements, grown(vector.capacity())));
}

} // namespace haptic_sculpt::internal
