// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <CGAL/version.h>

#include <boost/optional.hpp>

#include <optional>
#include <type_traits>

namespace haptic_sculpt {

/// What CGAL's costs and placements of simplification give.
template <class T>
using Policy_optional = std::conditional_t<(CGAL_VERSION_MAJOR < 6), boost::optional<T>, std::optional<T>>;

} // namespace haptic_sculpt
