// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/no_fast_math.h>
#include <haptic_sculpt/surface/Invalid_surface.h>
#include <haptic_sculpt/surface/Validity_report.h>
#include <haptic_sculpt/surface/broad_phase/Box_tree_broad_phase.h>
#include <haptic_sculpt/surface/broad_phase/Brute_force_broad_phase.h>
#include <haptic_sculpt/surface/delta_rule.h>
#include <haptic_sculpt/surface/read_surface.h>
#include <haptic_sculpt/surface/validate.h>
#include <haptic_sculpt/surface/vertex_attributes.h>
#include <haptic_sculpt/surface/write_surface.h>
