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

const char* const tool_names[] = {"drag a vertex", "touch with a probe", "create a vertex", "remove a vertex", "brush"};
const char* const tool_words[] = {"drag", "probe", "create", "remove", "brush"}; // of scripts
const char* const brush_names[] = {"grab", "inflate", "smooth", "flatten", "pinch"};

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
  ImGui::SetNextWindowPos({8, 8});
  ImGui::Begin("state", nullptr, fixed);
  ImGui::Text("%s%s", path_.c_str(), is_unsaved() ? "  (not saved)" : "");
  ImGui::Text("%zu vertices, %zu faces; undo %zu, redo %zu", s.vertices, s.faces, s.undo_steps, s.redo_steps);
  ImGui::Separator();
  for (int i = 0; i < 5; ++i) {
    const std::string label = std::to_string(i + 1) + "  " + tool_names[i];
    if (ImGui::RadioButton(label.c_str(), int(choices_.tool) == i)) {
      note("tool %s", tool_words[i]);
      choose(static_cast<Tool>(i));
    }
  }
  if (choices_.tool == Tool::brush) {
    int kind = int(choices_.brush.kind);
    float strength = float(choices_.brush.strength);
    ImGui::SetNextItemWidth(110);
    bool changes = ImGui::Combo("b", &kind, brush_names, 5);
    ImGui::SetNextItemWidth(110);
    changes = ImGui::SliderFloat("strength  , .", &strength, -1, 1, "%.1f") || changes;
    if (changes) {
      choices_.brush.kind = static_cast<Brush_kind>(kind), choices_.brush.strength = double(strength);
      note("brush %s %.17g %.17g", brush_names[kind], choices_.brush.radius, choices_.brush.strength);
    }
    ImGui::Text("radius %.4g  [ ]", choices_.brush.radius);
  } else if (choices_.tool == Tool::probe) {
    ImGui::Text("pressed in by %.4g  [ ]", choices_.depth);
  }
  ImGui::Text("t  what is blocked %s", choices_.response == 0 ? "slides" : "stops");
  ImGui::Text("h  all keys");
  ImGui::Separator();
  if (s.hold == Status::Hold::vertex || s.hold == Status::Hold::probe) {
    if (s.hold == Status::Hold::vertex)
      ImGui::Text("vertex %zu: %s", s.vertex, s.end);
    else
      ImGui::Text("probe: %s", s.end);
    ImGui::Text("at      %.6g %.6g %.6g", s.proxy[0], s.proxy[1], s.proxy[2]);
    ImGui::Text("target  %.6g %.6g %.6g", s.target[0], s.target[1], s.target[2]);
    ImGui::TextColored(color_of(mark_colors::force * 1.4f), "force   %.3f N", vector(s.force).norm());
    for (int i = 0; i < s.contacts; ++i) {
      const Contact_view& c = s.contact[std::size_t(i)];
      std::string names;
      for (int j = 0; j < c.still; ++j)
        names += ' ' + std::to_string(c.ids[std::size_t(j)]);
      ImGui::TextColored({1, 0.45f, 0.8f, 1}, "%s:%s", c.kind, names.c_str());
    }
  } else if (s.hold == Status::Hold::brush) {
    ImGui::Text("brush: %zu vertices to go", s.brush_left);
  } else if (s.pointed.size > 0) {
    std::string names;
    for (int i = 0; i < s.pointed.size; ++i)
      names += ' ' + std::to_string(s.pointed.ids[std::size_t(i)]);
    ImGui::Text("points at %s%s", s.pointed.feature, names.c_str());
  } else {
    ImGui::TextUnformatted("points at nothing");
  }
  if (!last_refusal_.empty())
    ImGui::TextColored({1, 0.55f, 0.4f, 1}, "refused: %s", last_refusal_.c_str());
  ImGui::Separator();
  ImGui::Text("loop   p50 %.3f  p99 %.3f  max %.2f ms", ms(s.work.p50), ms(s.work.p99), ms(s.work.largest));
  ImGui::Text("late   p50 %.3f  p99 %.3f  max %.2f ms", ms(s.lateness.p50), ms(s.lateness.p99), ms(s.lateness.largest));
  ImGui::Text("ticks %llu, missed %llu by work, %llu woken late", static_cast<unsigned long long>(s.ticks),
              static_cast<unsigned long long>(s.missed_by_work), static_cast<unsigned long long>(s.woken_late));
  ImGui::Text("frame  p50 %.1f  p99 %.1f ms", ms(frames_.percentile(0.5)), ms(frames_.percentile(0.99)));
  ImGui::Text("log    %s", log_.empty() ? "none" : log_.c_str());
  if (record_ != nullptr)
    ImGui::TextColored({1, 0.3f, 0.3f, 1}, "recording");
  ImGui::End();
}

void Application::draw_help() {
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos({size.x - 8, 8}, ImGuiCond_Always, {1, 0});
  ImGui::Begin("help", nullptr, fixed);
  const auto row = [](const char* how, const char* what) {
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::TextUnformatted(how);
    ImGui::TableNextColumn();
    ImGui::TextUnformatted(what);
  };
  if (ImGui::BeginTable("keys", 2, ImGuiTableFlags_SizingFixedFit)) {
    for (const Mouse_use& use : mouse_uses())
      row(use.how, use.what);
    row("", "");
    for (const Key& key : keys())
      row(key.name, key.what);
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
      save(options_.out, true);
    }
    ImGui::SameLine();
    if (ImGui::Button("Quit without saving"))
      discards_ = is_done_ = true;
    ImGui::SameLine();
    if (ImGui::Button("Go on"))
      choices_.question = Question::none;
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
    if (agreed) {
      note("%s %s", saves ? "save" : "open", choices_.name.data());
      saves ? save(choices_.name.data()) : open(choices_.name.data());
    }
  }
  ImGui::End();
}

} // namespace haptic_sculpt::window_program
