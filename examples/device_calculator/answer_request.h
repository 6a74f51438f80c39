// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <nlohmann/json.hpp>

namespace haptic_sculpt::examples {

/// What the mechanism answers to a request. Numbers of it may be infinite or NaN.
/// \throw No_answer, Bad_request, Invalid_device_parameters
nlohmann::json answer_request(const nlohmann::json& request);

} // namespace haptic_sculpt::examples
