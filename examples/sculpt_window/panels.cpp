// SPDX-License-Identifier: GPL-3.0-or-later
/// \file
/// What the window shows over the scene, by Dear ImGui.
#include "Application.h"

#include <imgui.h>

namespace haptic_sculpt::window_program {
namespace {

constexpr int fixed = ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                      ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoTitleBar |
                      ImGuiWindowFlags_NoFocusOnAppearing | ImGuiWindowFlags_NoNav;

ImVec4 color_of(const drawing::Color& c) {
  return {c.x(), c.y(), c.z(), 1};
}

const char* const tool_names[] = {"drag a vertex", "touch with a probe", "create a vertex", "remove a vertex",
                                  "brush",         "move an object"};
const char* const brush_names[] = {"grab  g",  "inflate  i", "smooth  a", "flatten  l",
                                   "pinch  k", "mask  m",    "unmask  M"};

double ms(std::uint64_t ns) {
  return double(ns) / 1e6;
}

} // namespace

void Application::draw_panels() {
  if (choices_.shows_panels)
    draw_state();
  if (choices_.shows_help)
    draw_help();
  draw_question();
  if (!choices_.shows_panels)
    return;
  draw_hints();
  const auto now = Clock::now();
  while (!messages_.empty() && now - messages_.front().first > std::chrono::seconds(8))
    messages_.pop_front();
  if (messages_.empty())
    return;
  ImGui::SetNextWindowPos({8, ImGui::GetIO().DisplaySize.y - 8}, ImGuiCond_Always, {0, 1});
  ImGui::Begin("messages", nullptr, fixed | ImGuiWindowFlags_NoInputs);
  for (const auto& [time, text] : messages_)
    ImGui::TextUnformatted(text.c_str());
  ImGui::End();
}

void Application::draw_state() {
  const Status& s = status_;
  const float margin = 8;
  ImGui::SetNextWindowPos({margin, margin});
  ImGui::SetNextWindowSize({panel_width - margin, 0});
  ImGui::Begin("state", nullptr, fixed & ~ImGuiWindowFlags_AlwaysAutoResize);
  for (int i = 0; i < 6; ++i) {
    const std::string label = std::to_string(i + 1) + "  " + tool_names[i];
    if (ImGui::RadioButton(label.c_str(), int(choices_.tool) == i)) {
      note("tool %s", tool_words[i]);
      choose(static_cast<Tool>(i));
    }
  }
  ImGui::Separator();
  if (choices_.tool == Tool::brush)
    draw_brush();
  else if (choices_.tool == Tool::probe)
    ImGui::Text("pressed in by %.4g  [ ]", choices_.depth);
  else if (choices_.tool == Tool::drag || choices_.tool == Tool::create)
    ImGui::Text("t  what is blocked %s", choices_.slides ? "slides" : "stops");
  const auto button = [this](const char* label, const char* key) {
    if (ImGui::Button(label))
      on_key(*key_named(key));
  };
  button("undo  u", "u");
  ImGui::SameLine();
  button("redo  U", "shift+u");
  ImGui::SameLine();
  button("save  s", "s");
  button("all keys  h", "h");
  ImGui::SameLine();
  button("edges  w", "w");
  ImGui::SameLine();
  button("see all  f", "f");
  ImGui::Separator();
  ImGui::TextWrapped("%s%s%s", path_.c_str(), is_unsaved() ? "  (not saved)" : "",
                     status_.log_has_failed ? "  (its log cannot be written)" : "");
  ImGui::Text("%zu triangles", s.faces);
  if (!last_refusal_.empty()) {
    ImGui::PushStyleColor(ImGuiCol_Text, {1, 0.55f, 0.4f, 1});
    ImGui::TextWrapped("refused: %s", last_refusal_.c_str());
    ImGui::PopStyleColor();
  }
  if (record_ != nullptr)
    ImGui::TextColored({1, 0.3f, 0.3f, 1}, "recording");
  if (choices_.shows_figures)
    draw_figures();
  ImGui::End();
}

void Application::draw_brush() {
  Brush& brush = choices_.brush;
  for (int i = 0; i < brush_uses; ++i) {
    if (i % 2 != 0)
      ImGui::SameLine(panel_width / 2.f - 4);
    if (ImGui::RadioButton(brush_names[i], int(brush.use) == i)) {
      note("brush %s %.17g %.17g", brush_words[i], brush.radius, brush.strength);
      choose(static_cast<Brush_use>(i));
    }
  }
  const double whole = view_.camera().unscaled(1.0);
  float size = float(brush.radius / whole), strength = float(brush.strength);
  ImGui::SetNextItemWidth(110);
  bool changes = ImGui::SliderFloat("size  [ ]", &size, 0.01f, 1, "%.2f", ImGuiSliderFlags_Logarithmic);
  ImGui::SetNextItemWidth(110);
  changes = ImGui::SliderFloat("strength  , .", &strength, -1, 1, "%.2f") || changes;
  if (changes) {
    brush.radius = double(size) * whole, brush.strength = double(strength);
    note("brush %s %.17g %.17g", brush_words[int(brush.use)], brush.radius, brush.strength);
  }
  ImGui::AlignTextToFramePadding();
  ImGui::TextUnformatted("symmetry");
  for (const char* const key : {"shift+x", "shift+y", "shift+z"}) {
    const int axis = key[6] - 'x';
    bool is_on = brush.symmetry[std::size_t(axis)];
    ImGui::SameLine();
    if (ImGui::Checkbox(key + 6, &is_on))
      on_key(*key_named(key));
  }
  ImGui::AlignTextToFramePadding();
  ImGui::TextUnformatted("new triangles");
  ImGui::SameLine();
  if (ImGui::Button("all  D"))
    on_key(*key_named("shift+d"));
  if (ImGui::Checkbox("where the brush goes ctrl+d", &brush.remeshes))
    brush.remeshes = !brush.remeshes, on_key(*key_named("ctrl+d"));
  ImGui::Separator();
}

/// What the loop and the hand do, for who wants to know.
void Application::draw_figures() {
  const Status& s = status_;
  ImGui::Separator();
  ImGui::Text("%zu vertices; undo %zu, redo %zu", s.vertices, s.undo_steps, s.redo_steps);
  if (s.hold == Status::Hold::vertex || s.hold == Status::Hold::probe) {
    if (s.hold == Status::Hold::vertex)
      ImGui::Text("vertex %zu: %s", s.vertex, s.end);
    else
      ImGui::Text("probe: %s", s.end);
    ImGui::Text("at %.4g %.4g %.4g", s.proxy[0], s.proxy[1], s.proxy[2]);
    ImGui::Text("target %.4g %.4g %.4g", s.target[0], s.target[1], s.target[2]);
    ImGui::TextColored(color_of(mark_colors::force * 1.4f), "force %.3f N", vector(s.force).norm());
    for (int i = 0; i < s.contacts; ++i) {
      const Contact_view& c = s.contact[std::size_t(i)];
      std::string names;
      for (int j = 0; j < c.still; ++j)
        names += ' ' + std::to_string(c.ids[std::size_t(j)]);
      ImGui::TextColored({1, 0.45f, 0.8f, 1}, "%s:%s", c.kind, names.c_str());
    }
  } else if (s.pointed.size > 0) {
    std::string names;
    for (int i = 0; i < s.pointed.size; ++i)
      names += ' ' + std::to_string(s.pointed.ids[std::size_t(i)]);
    ImGui::Text("at %s%s", s.pointed.feature, names.c_str());
  }
  ImGui::TextUnformatted("ms: median, 99 %, longest");
  ImGui::Text("loop %.3f  %.3f  %.2f", ms(s.work.p50), ms(s.work.p99), ms(s.work.largest));
  ImGui::Text("late %.3f  %.3f  %.2f", ms(s.lateness.p50), ms(s.lateness.p99), ms(s.lateness.largest));
  ImGui::Text("frame %.1f  %.1f", ms(frames_.percentile(0.5)), ms(frames_.percentile(0.99)));
  ImGui::Text("%llu ticks, %llu too long", static_cast<unsigned long long>(s.ticks),
              static_cast<unsigned long long>(s.missed_by_work));
  ImGui::TextWrapped("log %s", log_.empty() ? "none" : log_.c_str());
}

/// Until the first press of a button.
void Application::draw_hints() {
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  if (!choices_.shows_hints || size.x < 3 * panel_width)
    return;
  ImGui::SetNextWindowPos({(size.x + panel_width) / 2, size.y - 8}, ImGuiCond_Always, {0.5f, 1});
  ImGui::Begin("hints", nullptr, fixed | ImGuiWindowFlags_NoInputs);
  ImGui::TextUnformatted("Left button on the mesh: sculpt.  Shift: smooth.  Ctrl: carve.\n"
                         "Left button beside it, or right button: turn.  Wheel: zoom.\n"
                         "Ctrl + wheel: size of the brush.  Shift + wheel: strength.");
  ImGui::End();
}

void Application::draw_help() {
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos({size.x - 8, 8}, ImGuiCond_Always, {1, 0});
  ImGui::Begin("help", nullptr, fixed);
  std::vector<std::array<const char*, 2>> rows;
  for (const Mouse_use& use : mouse_uses())
    rows.push_back({use.how, use.what});
  for (const Key& key : keys())
    rows.push_back({key.name, key.what});
  if (ImGui::BeginTable("keys", 4, ImGuiTableFlags_SizingFixedFit)) {
    const std::size_t half = (rows.size() + 1) / 2;
    for (std::size_t i = 0; i < half; ++i)
      for (const std::size_t k : {i, i + half})
        for (const char* const text : rows[std::min(k, rows.size() - 1)]) {
          ImGui::TableNextColumn();
          if (k < rows.size())
            ImGui::TextUnformatted(text);
        }
    ImGui::EndTable();
  }
  ImGui::End();
}

void Application::draw_question() {
  using Question = Choices::Question;
  if (choices_.question == Question::none)
    return;
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos({size.x / 2, size.y / 2}, ImGuiCond_Always, {0.5f, 0.5f});
  ImGui::Begin("question", nullptr, fixed & ~ImGuiWindowFlags_NoNav);
  if (choices_.question == Question::leave_unsaved) {
    ImGui::Text("There is work that is not saved.");
    if (ImGui::Button("Save and quit")) {
      choices_.question = Question::none;
      note("key escape"), note_file("save", options_.out);
      save(options_.out, true);
    }
    ImGui::SameLine();
    if (ImGui::Button("Quit without saving"))
      note("close"), discards_ = true, leave_window();
    ImGui::SameLine();
    if (ImGui::Button("Go on"))
      note("key escape"), choices_.question = Question::none;
    ImGui::Text("It would be saved to %s", options_.out.c_str());
  } else {
    const bool saves = choices_.question == Question::name_to_save;
    ImGui::TextUnformatted(saves ? "Save the mesh as" : "Open the mesh");
    if (ImGui::IsWindowAppearing())
      ImGui::SetKeyboardFocusHere();
    ImGui::SetNextItemWidth(420);
    const bool entered =
        ImGui::InputText("##name", choices_.name.data(), choices_.name.size(), ImGuiInputTextFlags_EnterReturnsTrue);
    const bool agreed = ImGui::Button(saves ? "Save" : "Open") || entered;
    ImGui::SameLine();
    const bool cancelled = ImGui::Button("Cancel");
    if (agreed || cancelled)
      choices_.question = Question::none;
    if (agreed && saves)
      note_file("save", choices_.name.data()), save(choices_.name.data());
    else if (agreed)
      open(choices_.name.data());
  }
  ImGui::End();
}

} // namespace haptic_sculpt::window_program
