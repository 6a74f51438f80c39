// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace haptic_sculpt::window_program {

/// What a key does.
enum class Order {
  tool_drag,
  tool_probe,
  tool_create,
  tool_remove,
  tool_brush,
  tool_object, // as Tool has them
  brush_grab,
  brush_inflate,
  brush_smooth,
  brush_flatten,
  brush_pinch,
  brush_mask,
  brush_unmask, // as Brush_use has them
  symmetry_x,
  symmetry_y,
  symmetry_z,
  next_brush,
  unmask_all,
  remesh_here,
  remesh_all,
  remesh_always,
  larger,
  smaller,
  stronger,
  weaker,
  flip,
  collapse,
  undo,
  redo,
  let_go,
  response,
  save,
  open,
  record,
  screenshot,
  quit,
  fit,
  view_x,
  view_y,
  view_z,
  view_back,
  turn_left,
  turn_right,
  turn_up,
  turn_down,
  zoom_in,
  zoom_out,
  help,
  panels,
  figures,
  edges
};

struct Key {
  const char* name; ///< as in scripts and in the overlay, e.g. "ctrl+z"
  int code;         ///< GLFW's
  bool ctrl, shift;
  Order order;
  const char* what;
};

/// All, in the order in which the overlay lists them.
const std::vector<Key>& keys();
std::optional<Key> key_named(const std::string& name);
/// \param code GLFW's
std::optional<Key> key_pressed(int code, bool ctrl, bool shift);

/// Whether a key that is held does it again and again: what makes something more, and switches nothing.
bool goes_on(Order order);

/// What the mouse does, line by line: buttons, then what they do.
struct Mouse_use {
  const char* how;
  const char* what;
};
const std::vector<Mouse_use>& mouse_uses();

} // namespace haptic_sculpt::window_program
