// SPDX-License-Identifier: GPL-3.0-or-later
#include "device_speed_error/measure_implementation.h"

namespace haptic_sculpt::benchmark {

template void measure<float>(const char*, const Population&, int, int, nlohmann::json&);
template void measure<double>(const char*, const Population&, int, int, nlohmann::json&);
template void measure<long double>(const char*, const Population&, int, int, nlohmann::json&);

} // namespace haptic_sculpt::benchmark
