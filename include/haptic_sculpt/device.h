// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

/// \file
/// The three-leg mechanism of the paper: kinematics, statics and dynamics, templated on the scalar. Needs Eigen only.
/// All assembly modes: device/forward_by_all_modes.h, asked for by itself.

#include <haptic_sculpt/device/Device_parameters.h>
#include <haptic_sculpt/device/Device_pose.h>
#include <haptic_sculpt/device/conditioning.h>
#include <haptic_sculpt/device/ditetrahedral_kinematics.h>
#include <haptic_sculpt/device/dynamics.h>
#include <haptic_sculpt/device/forward_kinematics.h>
#include <haptic_sculpt/device/general_inverse.h>
#include <haptic_sculpt/device/general_kinematics.h>
#include <haptic_sculpt/device/gravity_torque.h>
#include <haptic_sculpt/device/jacobian.h>
#include <haptic_sculpt/device/nine_equations.h>
#include <haptic_sculpt/device/planar_dynamics.h>
#include <haptic_sculpt/device/simulation/Torque_delay.h>
#include <haptic_sculpt/device/simulation/encoder.h>
#include <haptic_sculpt/device/simulation/joint_friction.h>
#include <haptic_sculpt/device/simulation/runge_kutta.h>
#include <haptic_sculpt/device/simulation/simulated_tick.h>
#include <haptic_sculpt/device/simulation/simulation.h>
#include <haptic_sculpt/device/spatial_dynamics.h>
#include <haptic_sculpt/device/workspace.h>
#include <haptic_sculpt/no_fast_math.h>
