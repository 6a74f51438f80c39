// SPDX-License-Identifier: GPL-3.0-or-later
#include "device_speed_error/measure_implementation.h"

namespace haptic_sculpt::benchmark {

template void measure<device_populations::Mpfr<34>>(const char*, const Population&, int, int, nlohmann::json&);

} // namespace haptic_sculpt::benchmark
