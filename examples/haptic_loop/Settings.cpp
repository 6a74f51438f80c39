// SPDX-License-Identifier: GPL-3.0-or-later
#include "Settings.h"

#include "../device_json.h"

#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>

namespace haptic_sculpt::loop_program {
namespace {

using nlohmann::json;

json json_file(const std::string& path) {
  try {
    return json::parse(contents_of(path));
  } catch (const json::exception& error) {
    throw Usage_error("'" + path + "' is no JSON: " + error.what());
  }
}

Device_description<double> device_of(const json& device) {
  if (!device.is_object())
    throw Bad_request("a device is an object");
  json params = device.contains("params") ? device["params"] : device;
  if (!params.is_object())
    throw Bad_request("`params` must be an object");
  for (const auto& [key, value] : device.items()) // those of the joints may stand beside `params`
    if (key != "params" && !params.contains(key))
      params[key] = value;
  for (const auto& [key, value] : params.items())
    if (!is_device_key(key))
      throw Bad_request("`" + key + "` means nothing to a device");
  const Device_form form = device_form_from_json(params.value("form", json("ditetra")));
  const Device_description<double> d = device_description_from_json(params, form, true);
  Device_parameters<double>{d}; // throws what is wrong with it
  return d;
}

} // namespace

std::string contents_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file)
    throw Usage_error("cannot open '" + path + "': " + std::strerror(errno));
  std::string text{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  if (file.bad())
    throw Usage_error("reading '" + path + "' failed");
  return text;
}

Device_description<double> default_device() {
  Device_description<double> d = named_design<double>(Named_design::D1, Device_form::ditetrahedral);
  d.viscous_friction = 0.005;
  d.coulomb_friction = 0.0005;
  d.encoder_step = 1.53e-4; // 40,960 counts a turn
  return d;
}

Device_description<double> read_device(const std::string& path) {
  try {
    return device_of(json_file(path));
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
  try {
    read.check();
  } catch (const Error& error) {
    fail(error.what());
  }
  return read;
}

Hand_path read_path(const std::string& path) {
  return Hand_path::parse(contents_of(path), path);
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
      !(fault.time >= 0))
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
          {"work", s.work},
          {"virtual_mass", s.virtual_mass},
          {"compensated_inertia", s.compensated_inertia},
          {"controller", s.controller ? json(*s.controller) : json()},
          {"map", s.map},
          {"device", json_of(s.device)}};
}

Settings settings_of(const json& j) {
  try {
    Settings s;
    s.rate = j.at("rate"), s.delay = j.at("delay"), s.stiffness = j.at("stiffness"), s.damping = j.at("damping");
    s.reach = j.at("reach"), s.work = j.at("work"), s.map = j.at("map").get<std::vector<double>>();
    s.virtual_mass = j.value("virtual_mass", 0.0); // older recordings have none
    s.compensated_inertia = j.value("compensated_inertia", 0.0);
    const json controller = j.value("controller", json(0.0));
    s.controller = controller.is_null() ? std::nullopt : std::optional<double>(controller.get<double>());
    s.device = device_of(j.at("device"));
    return s;
  } catch (const json::exception& error) {
    throw Foreign_recording(std::string("the recording's settings cannot be read: ") + error.what());
  } catch (const Error& error) {
    throw Foreign_recording(std::string("the recording's device cannot be used: ") + error.what());
  }
}

} // namespace haptic_sculpt::loop_program
