// SPDX-License-Identifier: GPL-3.0-or-later
#include "keys.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

namespace haptic_sculpt::window_program {

const std::vector<Key>& keys() {
  static const std::vector<Key> all = {
      {"1", GLFW_KEY_1, false, false, Order::tool_drag, "tool: drag a vertex"},
      {"2", GLFW_KEY_2, false, false, Order::tool_probe, "tool: touch with a probe"},
      {"3", GLFW_KEY_3, false, false, Order::tool_create, "tool: create a vertex and drag it"},
      {"4", GLFW_KEY_4, false, false, Order::tool_remove, "tool: remove a vertex"},
      {"5", GLFW_KEY_5, false, false, Order::tool_brush, "tool: brush"},
      {"6", GLFW_KEY_6, false, false, Order::tool_object, "tool: move an object"},
      {"g", GLFW_KEY_G, false, false, Order::brush_grab, "brush: grab"},
      {"i", GLFW_KEY_I, false, false, Order::brush_inflate, "brush: inflate"},
      {"a", GLFW_KEY_A, false, false, Order::brush_smooth, "brush: smooth"},
      {"l", GLFW_KEY_L, false, false, Order::brush_flatten, "brush: flatten"},
      {"k", GLFW_KEY_K, false, false, Order::brush_pinch, "brush: pinch"},
      {"m", GLFW_KEY_M, false, false, Order::brush_mask, "brush: mask"},
      {"shift+m", GLFW_KEY_M, false, true, Order::brush_unmask, "brush: unmask"},
      {"ctrl+m", GLFW_KEY_M, true, false, Order::unmask_all, "mask nothing"},
      {"b", GLFW_KEY_B, false, false, Order::next_brush, "next brush"},
      {"shift+x", GLFW_KEY_X, false, true, Order::symmetry_x, "symmetry in x on and off"},
      {"shift+y", GLFW_KEY_Y, false, true, Order::symmetry_y, "symmetry in y"},
      {"shift+z", GLFW_KEY_Z, false, true, Order::symmetry_z, "symmetry in z"},
      {"d", GLFW_KEY_D, false, false, Order::remesh_here, "new triangles under the brush"},
      {"shift+d", GLFW_KEY_D, false, true, Order::remesh_all, "new triangles everywhere"},
      {"ctrl+d", GLFW_KEY_D, true, false, Order::remesh_always, "new triangles where the brush goes"},
      {"]", GLFW_KEY_RIGHT_BRACKET, false, false, Order::larger, "larger brush; deeper probe"},
      {"[", GLFW_KEY_LEFT_BRACKET, false, false, Order::smaller, "smaller brush; less deep probe"},
      {".", GLFW_KEY_PERIOD, false, false, Order::stronger, "stronger brush"},
      {",", GLFW_KEY_COMMA, false, false, Order::weaker, "weaker brush; below 0 the other way"},
      {"e", GLFW_KEY_E, false, false, Order::flip, "flip the edge pointed at"},
      {"c", GLFW_KEY_C, false, false, Order::collapse, "collapse it, its nearer end into the other"},
      {"u", GLFW_KEY_U, false, false, Order::undo, "undo"},
      {"shift+u", GLFW_KEY_U, false, true, Order::redo, "redo"},
      {"ctrl+z", GLFW_KEY_Z, true, false, Order::undo, "undo"},
      {"ctrl+y", GLFW_KEY_Y, true, false, Order::redo, "redo"},
      {"escape", GLFW_KEY_ESCAPE, false, false, Order::let_go, "close what is open; else let go, break off remeshing"},
      {"t", GLFW_KEY_T, false, false, Order::response, "what is blocked slides, or stops"},
      {"s", GLFW_KEY_S, false, false, Order::save, "save"},
      {"ctrl+s", GLFW_KEY_S, true, false, Order::save, "save"},
      {"o", GLFW_KEY_O, false, false, Order::open, "open a mesh"},
      {"r", GLFW_KEY_R, false, false, Order::record, "record a script, or end that"},
      {"p", GLFW_KEY_P, false, false, Order::screenshot, "screenshot"},
      {"q", GLFW_KEY_Q, false, false, Order::quit, "quit"},
      {"f", GLFW_KEY_F, false, false, Order::fit, "see all of the mesh"},
      {"x", GLFW_KEY_X, false, false, Order::view_x, "look along x"},
      {"y", GLFW_KEY_Y, false, false, Order::view_y, "look along y"},
      {"z", GLFW_KEY_Z, false, false, Order::view_z, "look along z"},
      {"v", GLFW_KEY_V, false, false, Order::view_back, "look from the other side"},
      {"left", GLFW_KEY_LEFT, false, false, Order::turn_left, "turn"},
      {"right", GLFW_KEY_RIGHT, false, false, Order::turn_right, "turn"},
      {"up", GLFW_KEY_UP, false, false, Order::turn_up, "turn"},
      {"down", GLFW_KEY_DOWN, false, false, Order::turn_down, "turn"},
      {"=", GLFW_KEY_EQUAL, false, false, Order::zoom_in, "zoom in"},
      {"-", GLFW_KEY_MINUS, false, false, Order::zoom_out, "zoom out"},
      {"h", GLFW_KEY_H, false, false, Order::help, "this list"},
      {"f1", GLFW_KEY_F1, false, false, Order::help, "this list"},
      {"tab", GLFW_KEY_TAB, false, false, Order::panels, "panels on and off"},
      {"f2", GLFW_KEY_F2, false, false, Order::figures, "figures of the loop on and off"},
      {"w", GLFW_KEY_W, false, false, Order::edges, "edges of triangles on and off"}};
  return all;
}

std::optional<Key> key_named(const std::string& name) {
  for (const Key& key : keys())
    if (name == key.name)
      return key;
  return std::nullopt;
}

std::optional<Key> key_pressed(int code, bool ctrl, bool shift) {
  for (const Key& key : keys())
    if (key.code == code && key.ctrl == ctrl && key.shift == shift)
      return key;
  return std::nullopt;
}

bool goes_on(Order order) {
  const bool is_of_size = order >= Order::larger && order <= Order::weaker,
             is_of_view = order >= Order::turn_left && order <= Order::zoom_out;
  return is_of_size || is_of_view || order == Order::undo || order == Order::redo;
}

const std::vector<Mouse_use>& mouse_uses() {
  static const std::vector<Mouse_use> all = {{"left", "the tool; beside the mesh: turn"},
                                             {"shift + left", "a brush smooths; a vertex goes along its normal"},
                                             {"ctrl + left", "a brush works the other way"},
                                             {"right", "turn"},
                                             {"middle, ctrl + right", "shift the picture"},
                                             {"wheel", "zoom"},
                                             {"ctrl + wheel", "size of the brush, depth of the probe"},
                                             {"shift + wheel", "strength of the brush"}};
  return all;
}

} // namespace haptic_sculpt::window_program
