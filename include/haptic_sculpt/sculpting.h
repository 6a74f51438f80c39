// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

/// \file
/// Dragging the vertices of a closed triangle mesh so that no surface ever passes through a surface.

#include <haptic_sculpt/sculpting/Allow_embedded_move.h>
#include <haptic_sculpt/sculpting/Sculptor.h>
#include <haptic_sculpt/sculpting/apply_guarded.h>
#include <haptic_sculpt/sculpting/brushes.h>
#include <haptic_sculpt/sculpting/first_impact.h>
#include <haptic_sculpt/sculpting/guarded_point_map.h>
#include <haptic_sculpt/sculpting/isotropic_remeshing.h>
#include <haptic_sculpt/sculpting/keep_vertex_attributes.h>
#include <haptic_sculpt/sculpting/move_rigidly.h>
#include <haptic_sculpt/sculpting/move_vertices.h>
