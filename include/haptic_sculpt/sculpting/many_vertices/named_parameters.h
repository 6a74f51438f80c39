// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <CGAL/Named_function_parameters.h>

namespace haptic_sculpt::internal {

/// CGAL's named parameters are tagged by types that CGAL does not document: they are named here only.
namespace named = CGAL::internal_np;
using CGAL::parameters::choose_parameter;
using CGAL::parameters::get_parameter;

template <class Named_parameters, class Tag>
constexpr bool is_not_given = CGAL::parameters::is_default_parameter<Named_parameters, Tag>::value;

} // namespace haptic_sculpt::internal
