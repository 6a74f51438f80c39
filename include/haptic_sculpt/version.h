// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef HAPTIC_SCULPT_VERSION_H
#define HAPTIC_SCULPT_VERSION_H

/// The version of the library, as in CMakeLists.txt (which reads it from here).
#define HAPTIC_SCULPT_VERSION "0.1.0"

#endif
