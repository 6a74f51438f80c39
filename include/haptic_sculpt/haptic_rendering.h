// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

/// \file
/// What the surface says, the hand feels: from a device's joint angles to drags, and back to torques. Needs CGAL and
/// Eigen.

#include <haptic_sculpt/device.h>
#include <haptic_sculpt/haptic_rendering/Debounced_button.h>
#include <haptic_sculpt/haptic_rendering/simulation/Hand_path.h>
#include <haptic_sculpt/haptic_rendering/Haptic_loop.h>
#include <haptic_sculpt/haptic_rendering/Pose_loop.h>
#include <haptic_sculpt/haptic_rendering/simulation/Simulated_device.h>
#include <haptic_sculpt/haptic_rendering/simulation/Simulated_hand.h>
#include <haptic_sculpt/haptic_rendering/Tick_statistics.h>
#include <haptic_sculpt/haptic_rendering/exchange/Loop_session.h>
#include <haptic_sculpt/haptic_rendering/reach_position.h>
