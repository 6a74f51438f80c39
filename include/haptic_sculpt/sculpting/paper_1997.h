// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

/// \file
/// What the 1997 paper has for a response and for a broad phase, to compare with: Response::paper(),
/// Six_list_broad_phase. No other header includes it.

#include <haptic_sculpt/sculpting/paper_1997/Paper_response.h>
#include <haptic_sculpt/sculpting/paper_1997/Six_list_broad_phase.h>
