// SPDX-License-Identifier: GPL-3.0-or-later
#include "Settings.h"

#include "../common/contents_of.h"
#include "../common/json_words.h"
#include "../device_json.h"
#include "../json_line.h"

#include <haptic_sculpt/device/simulation/Torque_delay.h>

#include <algorithm>
#include <cmath>

namespace haptic_sculpt::loop_program {
namespace {

using nlohmann::json;

constexpr std::size_t most_work = 1000000000000000; // pairs; whole numbers of a double

json json_file(const std::string& path) {
  try {
    return parse_bounded(examples::contents_of<Usage_error>(path, "", 1));
  } catch (const json::exception& error) {
    throw Usage_error("'" + path + "' is no JSON: " + examples::in_words(error));
  } catch (const No_answer& error) {
    throw Usage_error("'" + path + "' cannot be read: " + error.what());
  }
}

/// \throw Bad_request
std::vector<double> json_numbers(const json& object, const char* key) {
  const json list = object.value(key, json());
  if (!list.is_array() || !std::all_of(list.begin(), list.end(), [](const json& x) { return x.is_number(); }))
    throw Bad_request(std::string("`") + key + "` must be given, as an array of numbers");
  return list.get<std::vector<double>>();
}

} // namespace

Device_description<double> default_device() {
  Device_description<double> d = named_design<double>(Named_design::D1, Device_form::ditetrahedral);
  d.viscous_friction = 0.005;
  d.coulomb_friction = 0.0005;
  d.encoder_step = 1.53e-4; // 40,960 counts a turn
  return d;
}

Device_description<double> read_device(const std::string& path) {
  try {
    return device_from_json(json_file(path));
  } catch (const Bad_request& error) {
    throw Usage_error("the device '" + path + "': " + error.what());
  } catch (const Invalid_device_parameters& error) {
    throw Usage_error("the device '" + path + "': " + error.what());
  }
}

Simulated_hand read_hand(const std::string& path) {
  const json hand = json_file(path);
  const auto fail = [&](const std::string& what) { throw Usage_error("the hand '" + path + "': " + what); };
  if (!hand.is_object())
    fail("a hand is an object");
  if (hand.contains("name")) {
    const auto named = hand["name"].is_string() ? Simulated_hand::named(hand["name"].get<std::string>()) : std::nullopt;
    if (!named)
      fail("`name` must be \"finger\", \"arm\" or \"measured_arm\"");
    if (hand.size() != 1)
      fail("a hand that has a `name` has nothing else");
    return *named;
  }
  Simulated_hand read;
  const auto list = [&](const char* key, double Simulated_hand::Stage::*member) {
    const auto found = hand.find(key);
    if (found == hand.end() || !found->is_array() || found->empty() || found->size() > Simulated_hand::most_stages)
      fail(std::string("`") + key + "` must be a list of 1 to " + std::to_string(Simulated_hand::most_stages) +
           " numbers, a stage each");
    if (read.stages != 0 && read.stages != static_cast<int>(found->size()))
      fail("`mass`, `stiffness` and `damping` must have one number a stage each");
    read.stages = static_cast<int>(found->size());
    for (std::size_t i = 0; i < found->size(); ++i) {
      if (!(*found)[i].is_number())
        fail(std::string("`") + key + "` must hold numbers");
      read.stage[i].*member = (*found)[i].get<double>();
    }
  };
  list("mass", &Simulated_hand::Stage::mass);
  list("stiffness", &Simulated_hand::Stage::stiffness);
  list("damping", &Simulated_hand::Stage::damping);
  for (const auto& [key, value] : hand.items())
    if (key != "mass" && key != "stiffness" && key != "damping")
      fail("`" + key + "` is none of `mass`, `stiffness` and `damping`");
  try {
    read.check();
  } catch (const Error& error) {
    fail(error.what());
  }
  return read;
}

Hand_path read_path(const std::string& path) {
  const std::string text = examples::contents_of<Hand_path_error>(path, "the path");
  return Hand_path::parse(examples::without_byte_order_mark(text), path);
}

Injected_fault fault_of(const std::string& text) {
  const std::size_t at = text.find('@');
  Injected_fault fault;
  for (const Loop_fault kind : {Loop_fault::not_finite, Loop_fault::jump, Loop_fault::stall, Loop_fault::singular,
                                Loop_fault::torque, Loop_fault::log})
    if (text.substr(0, at) == name_of(kind))
      fault.kind = kind;
  const char* const begin = at == std::string::npos ? text.data() : text.data() + at + 1;
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(begin, end, fault.time);
  if (at == std::string::npos || fault.kind == Loop_fault::none || error != std::errc() || stop != end ||
      !(fault.time >= 0 && std::isfinite(fault.time)))
    throw Usage_error(
        "--fault must be nan, jump, stall, singular, torque or log, `@` and seconds >= 0, such as nan@0.5; not '" +
        text + "'");
  return fault;
}

json json_of(const Device_description<double>& d) {
  return {{"form", d.form == Device_form::general ? "general" : "ditetra"},
          {"R", d.base_radius},
          {"l1", d.primary_length},
          {"l2", d.secondary_length},
          {"r", d.platform_radius},
          {"m1", d.primary_mass},
          {"m2", d.secondary_mass},
          {"M", d.platform_mass},
          {"I", {d.platform_inertia[0], d.platform_inertia[1], d.platform_inertia[2]}},
          {"Jm", d.rotor_inertia},
          {"g", d.gravity},
          {"torque_limit", d.torque_limit},
          {"angle_limits", {d.least_angle[0], d.greatest_angle[0]}},
          {"friction", d.viscous_friction},
          {"coulomb", d.coulomb_friction},
          {"encoder_step", d.encoder_step}};
}

json json_of(const Settings& s) {
  return {{"rate", s.rate},
          {"delay", s.delay},
          {"stiffness", s.stiffness},
          {"damping", s.damping},
          {"reach", s.reach},
          {"snap", {s.snap.length, s.snap.force}},
          {"work", s.work},
          {"virtual_mass", s.virtual_mass},
          {"controller", s.controller ? json(*s.controller) : json()},
          {"map", s.map},
          {"begin", s.begin ? json({s.begin->x(), s.begin->y(), s.begin->z()}) : json()},
          {"device", json_of(s.device)}};
}

Settings settings_of(const json& j) {
  const auto number = [&](const char* key) { return json_number(j, key); };
  const auto number_or_0 = [&](const char* key) { return j.contains(key) ? number(key) : 0; }; // older ones have none
  Settings s;
  try {
    s.rate = number("rate"), s.delay = number("delay"), s.stiffness = number("stiffness");
    s.damping = number("damping"), s.reach = number("reach"), s.map = json_numbers(j, "map");
    number("work");
    s.work = j["work"].is_number_unsigned() ? j["work"].get<std::size_t>() : 0; // 0 is refused below
    s.virtual_mass = number_or_0("virtual_mass");
    if (number_or_0("compensated_inertia") != 0)
      throw Foreign_recording("`compensated_inertia` is no setting any more; record anew without it");
    if (!j.value("snap", json()).is_null()) { // older recordings have none
      const Eigen::VectorXd snap = json_vector(j, "snap", 2, 2);
      s.snap = {snap[0], snap[1]};
    }
    if (!j.value("begin", json()).is_null())
      s.begin = json_vector_3(j, "begin");
    if (!j.value("controller", json(0)).is_null())
      s.controller = number_or_0("controller");
    if (const auto bad = bad_setting(s)) {
      std::string key = bad->option;
      std::replace(key.begin(), key.end(), '-', '_');
      throw Foreign_recording("`" + key + "` " + bad->demand);
    }
  } catch (const Error& error) {
    throw Foreign_recording(std::string("its settings cannot be used: ") + error.what());
  }
  try {
    s.device = device_from_json(j.value("device", json()));
  } catch (const Error& error) {
    throw Foreign_recording(std::string("its device cannot be used: ") + error.what());
  }
  return s;
}

std::optional<Bad_setting> bad_setting(const Settings& s) {
  const auto is_length = [](double x) { return x >= 0 && std::isfinite(x); };
  if (!(s.rate >= 100 && s.rate <= 100000))
    return Bad_setting{"rate", "must be from 100 to 100000 Hz"};
  if (!(s.delay >= 0 && s.delay <= Torque_delay<double>::most_ticks))
    return Bad_setting{"delay", "must be from 0 to 16 ticks"};
  if (!is_length(s.stiffness))
    return Bad_setting{"stiffness", "must be a finite number >= 0, N/m"};
  if (!(s.damping >= 0 && s.damping <= 1e5))
    return Bad_setting{"damping", "must be from 0 to 100000 N s/m"};
  if (!(s.virtual_mass >= 0 && s.virtual_mass <= 10))
    return Bad_setting{"virtual-mass", "must be from 0 to 10 kg"};
  if (!is_length(s.controller.value_or(0)))
    return Bad_setting{"controller", "must be a finite number >= 0, N s/m"};
  if (!(s.reach >= 1e-9 && s.reach <= 1))
    return Bad_setting{"reach", "must be from 1e-9 to 1 m"};
  if (!(s.snap.length == 0 || (s.snap.length >= Vertex_snap::least_length && s.snap.length <= 1)) ||
      !(s.snap.force >= 0 && s.snap.force <= 100))
    return Bad_setting{"snap", "must be 0, or a length from 0.00001 to 1 m and a force from 0 to 100 N"};
  if (s.work == 0 || s.work > most_work)
    return Bad_setting{"work", "must be a whole number of pairs, from 1 to 10^15"};
  if (!(s.map.empty() || s.map.size() == 4 || s.map.size() == 7))
    return Bad_setting{"map", "needs 4 numbers, SCALE X Y Z, or 7, with RX RY RZ"};
  if (!std::all_of(s.map.begin(), s.map.end(), [](double x) { return std::fabs(x) <= 1e300; }))
    return Bad_setting{"map", "must be numbers of at most 1e300"};
  if (!s.map.empty() && !(s.map[0] > 0))
    return Bad_setting{"map", "must begin with a scale > 0"};
  return std::nullopt;
}

} // namespace haptic_sculpt::loop_program
