// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

/// The version of the library, as in CMakeLists.txt (which reads it from here).
#define HAPTIC_SCULPT_VERSION "0.1.0"
