// SPDX-License-Identifier: GPL-3.0-or-later
#include "Report.h"

#include <haptic_sculpt/version.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <ostream>
#include <string_view>

namespace haptic_sculpt::sculpt_program {
namespace {

using Json = nlohmann::ordered_json;

const char* name_of(Edit_record::Status status) {
  constexpr const char* names[] = {"reached", "blocked", "refused"};
  return names[static_cast<int>(status)];
}

Json json_of(const Edit_record& edit) {
  Json contacts = Json::array();
  for (const auto& contact : edit.contacts)
    contacts.push_back({{"kind", contact.kind}, {"ids", contact.ids}, {"normal", contact.normal}});
  const Json script_line = edit.is_logged ? (edit.script_line != 0 ? Json(edit.script_line) : Json()) : Json(edit.line);
  return {{"source", edit.is_logged ? "log" : "script"},
          {"line", edit.line},
          {"script_line", script_line},
          {"op", edit.op},
          {"status", name_of(edit.status)},
          {"reason", edit.reason ? Json(edit.reason) : Json()},
          {"detail", edit.detail.empty() ? Json() : Json(edit.detail)},
          {"elements", edit.elements},
          {"many", edit.many ? Json{{"asked", (*edit.many)[0]}, {"done", (*edit.many)[1]}} : Json()},
          {"position", edit.motion ? Json(edit.motion->stop) : Json()},
          {"legs", edit.legs},
          {"stop_error", edit.stop_error},
          {"stop_error_along_path", edit.stop_error_along_path},
          {"kkt_residual", edit.kkt_residual},
          {"within_clearance", edit.is_within_clearance},
          {"contacts", std::move(contacts)}};
}

/// The smallest value that at least this share of the values does not exceed; 0 of none.
double percentile(const std::vector<double>& sorted, double share) {
  if (sorted.empty())
    return 0;
  const auto rank = static_cast<std::size_t>(std::ceil(share * static_cast<double>(sorted.size())));
  return sorted[std::clamp<std::size_t>(rank, 1, sorted.size()) - 1];
}

/// E.g. 1,390.
std::string with_commas(std::size_t n) {
  std::string text = std::to_string(n);
  for (std::size_t i = text.size(); i > 3; i -= 3)
    text.insert(i - 3, ",");
  return text;
}

/// What blocked or refused an edit.
std::string cause_of(const Edit_record& edit) {
  std::string text =
      edit.reason && (edit.status == Edit_record::Status::refused || edit.contacts.empty()) ? edit.reason : "";
  const auto name = [&text](const auto& ids) {
    constexpr std::size_t most = 6;
    for (std::size_t i = 0; i < ids.size() && i < most; ++i)
      text += ' ' + std::to_string(ids[i]);
    if (ids.size() > most)
      text += " ...";
  };
  if (edit.status == Edit_record::Status::refused)
    name(edit.elements);
  if (!edit.detail.empty())
    text += (text.empty() ? "" : ": ") + edit.detail;
  constexpr std::size_t most_contacts = 8;
  for (std::size_t i = 0; i < edit.contacts.size(); ++i) {
    const auto& contact = edit.contacts[i];
    if (i == most_contacts)
      return text + " and " + with_commas(edit.contacts.size() - i) + " more";
    text += (text.empty() ? "" : ", ") + std::string(contact.kind);
    name(contact.ids);
  }
  return text;
}

} // namespace

double distance(const Edit_record::Coordinates& p, const Edit_record::Coordinates& q) {
  // By halves: the difference of two doubles may overflow, and std::hypot of infinities is not a number in some
  // libraries. But the least of them has no half.
  double part = 1;
  for (const Edit_record::Coordinates& place : {p, q})
    for (const double x : place)
      part = std::fabs(x) > 1 ? 2 : part;
  return part * std::hypot(p[0] / part - q[0] / part, p[1] / part - q[1] / part, p[2] / part - q[2] / part);
}

std::string report_of(const Run_result& result, const std::vector<std::string>& notes,
                      const std::vector<Near_vertex>& nearest) {
  std::vector<double> times = result.nanoseconds;
  std::sort(times.begin(), times.end());
  const Json totals = {
      {"asked", result.asked()}, {"reached", result.reached}, {"blocked", result.blocked}, {"refused", result.refused}};
  const Json time = {{"p50", percentile(times, 0.5)},
                     {"p99", percentile(times, 0.99)},
                     {"p999", percentile(times, 0.999)},
                     {"max", percentile(times, 1)}};
  const Json filter = {{"permanent", result.filter.permanent},
                       {"integer_64", result.filter.integer_64},
                       {"integer_128", result.filter.integer_128},
                       {"integer_256", result.filter.integer_256},
                       {"big_integer", result.filter.big_integer}};
  // Put together edit by edit: a tree of a million edits would take gigabytes.
  std::string text =
      "{\n\"version\": " + Json(HAPTIC_SCULPT_VERSION).dump() + ",\n\"totals\": " + totals.dump() + ",\n\"edits\": [";
  for (std::size_t i = 0; i < result.edits.size(); ++i)
    text += (i == 0 ? "\n" : ",\n") + json_of(result.edits[i]).dump();
  // A note may name a file whose name is no UTF-8.
  const std::string told = Json(notes).dump(-1, ' ', false, Json::error_handler_t::replace);
  Json found = Json::array();
  for (const Near_vertex& v : nearest)
    found.push_back({{"vertex", v.number}, {"position", v.position}, {"distance", v.distance}});
  const std::string near = nearest.empty() ? "" : ",\n\"nearest\": " + found.dump();
  return text + "\n]" + near + ",\n\"notes\": " + told + ",\n\"time_ns\": " + time.dump() +
         ",\n\"filter\": " + filter.dump() + "\n}\n";
}

void print_table(std::ostream& out, const Run_result& result, const Mesh& mesh) {
  out << mesh.number_of_vertices() << " vertices, " << mesh.number_of_faces() << " triangles\n"
      << "edits asked " << result.asked() << ", reached " << result.reached << ", blocked " << result.blocked
      << ", refused " << result.refused << '\n';
  if (result.within_clearance != 0)
    out << "of those blocked " << result.within_clearance
        << " arrived within a clearance: nearer than that nothing may come\n";
  constexpr std::size_t most = 40;
  std::size_t told = 0;
  for (const Edit_record& edit : result.edits) {
    if (edit.status == Edit_record::Status::reached)
      continue;
    if (told == most) {
      out << "  and " << with_commas(result.blocked + result.refused - most) << " more (see the report)\n";
      break;
    }
    if (told++ == 0)
      out << "      line  edit         vertex  outcome  left to go  by (the vertices of what stands still)\n";
    out << std::setw(10) << (edit.is_logged ? "log " : "") + std::to_string(edit.line) << "  " << std::left
        << std::setw(11) << edit.op << std::right << std::setw(8)
        << (edit.op == std::string_view("drag") ? std::to_string(edit.elements[0]) : "-") << "  ";
    if (edit.is_within_clearance)
      out << "arrived within a clearance";
    else if (edit.motion)
      out << name_of(edit.status) << std::setw(12) << std::setprecision(4)
          << distance(edit.motion->stop, edit.motion->target);
    else
      out << name_of(edit.status) << std::setw(12) << '-';
    out << "  " << cause_of(edit) << '\n';
  }
}

void print_nearest(std::ostream& out, const Edit_record::Coordinates& to, const std::vector<Near_vertex>& nearest) {
  out << std::setprecision(9) << "vertices nearest to " << to[0] << ' ' << to[1] << ' ' << to[2] << ":\n";
  for (const Near_vertex& v : nearest)
    out << std::setw(10) << v.number << "  at " << v.position[0] << ' ' << v.position[1] << ' ' << v.position[2]
        << ", distance " << v.distance << '\n';
}

} // namespace haptic_sculpt::sculpt_program
