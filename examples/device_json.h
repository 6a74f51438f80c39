// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/device/Device_parameters.h>
#include <nlohmann/json.hpp>
#include <algorithm>
#include <initializer_list>
#include <string>

/// \file
/// Device descriptions from JSON, for the programs: `{"form", "R", "l1", "l2", "r", "m1", "m2", "M", "I", "Jm", "g"}`
/// and, of the joints,
/// `{"torque_limit", "angle_limits", "friction", "coulomb", "encoder_step"}`; SI units and radians.

namespace haptic_sculpt {

/// A request that does not have the members or types it must have.
class Bad_request : public Error {
public:
  using Error::Error;
};

inline double json_number(const nlohmann::json& object, const char* key) {
  const auto found = object.find(key);
  if (found == object.end() || !found->is_number())
    throw Bad_request(std::string("`") + key + "` must be given, as a number");
  return found->get<double>();
}

inline Eigen::VectorXd json_vector(const nlohmann::json& object, const char* key, std::size_t size,
                                   std::size_t other_size) {
  const auto found = object.find(key);
  const std::string wanted = "`" + std::string(key) + "` must be given, as an array of " + std::to_string(size) +
                             (other_size == size ? "" : " or " + std::to_string(other_size)) + " numbers";
  if (found == object.end() || !found->is_array() || (found->size() != size && found->size() != other_size))
    throw Bad_request(wanted);
  Eigen::VectorXd values(found->size());
  for (std::size_t k = 0; k < found->size(); ++k) {
    if (!(*found)[k].is_number())
      throw Bad_request(wanted);
    values[static_cast<Eigen::Index>(k)] = (*found)[k].get<double>();
  }
  return values;
}

inline Eigen::Vector3d json_vector_3(const nlohmann::json& object, const char* key) {
  return json_vector(object, key, 3, 3);
}

inline bool is_one_of(const std::string& key, std::initializer_list<const char*> keys) {
  return std::find(keys.begin(), keys.end(), key) != keys.end();
}

/// Whether a member of `params` has a meaning.
inline bool is_device_key(const std::string& key) {
  return is_one_of(key, {"form", "R", "l1", "l2", "r", "m1", "m2", "M", "I", "Jm", "g", "torque_limit", "angle_limits",
                         "friction", "coulomb", "encoder_step"});
}

/// The description in `params`. Masses may be left out where only kinematics is asked (`with_masses` false), `r` in the
/// di-tetrahedral form; `I` left out is a disc's, `g` 9.81, the limits are those of the default design, all else is 0.
/// \throw Bad_request if a member is missing or has the wrong type
inline Device_description<double> device_description_from_json(const nlohmann::json& params, Device_form form,
                                                               bool with_masses) {
  if (!params.is_object())
    throw Bad_request("`params` must be an object");
  Device_description<double> d;
  auto optional = [&](const char* key, double otherwise) {
    return params.contains(key) ? json_number(params, key) : otherwise;
  };
  d.form = form;
  d.base_radius = json_number(params, "R");
  d.primary_length = json_number(params, "l1");
  d.secondary_length = json_number(params, "l2");
  d.platform_radius = form == Device_form::general ? json_number(params, "r") : optional("r", d.platform_radius);
  d.primary_mass = with_masses ? json_number(params, "m1") : optional("m1", 0);
  d.secondary_mass = with_masses ? json_number(params, "m2") : optional("m2", 0);
  d.platform_mass = with_masses ? json_number(params, "M") : optional("M", 0);
  d.gravity = optional("g", 9.81);
  d.rotor_inertia = optional("Jm", 0);
  d.torque_limit = optional("torque_limit", d.torque_limit);
  d.viscous_friction = optional("friction", 0);
  d.coulomb_friction = optional("coulomb", 0);
  d.encoder_step = optional("encoder_step", 0);
  if (params.contains("angle_limits")) {
    const Eigen::VectorXd limits = json_vector(params, "angle_limits", 2, 2);
    d.least_angle.setConstant(limits[0]);
    d.greatest_angle.setConstant(limits[1]);
  }
  if (params.contains("I"))
    d.platform_inertia = json_vector_3(params, "I");
  else
    d.platform_inertia = Device_description<double>::disc_inertia(d.platform_mass, d.platform_radius);
  return d;
}

/// `"ditetra"` or `"general"`. \throw Bad_request
inline Device_form device_form_from_json(const nlohmann::json& value) {
  if (value == "ditetra")
    return Device_form::ditetrahedral;
  if (value == "general")
    return Device_form::general;
  throw Bad_request("`form` must be \"ditetra\" or \"general\"");
}

/// The device of a file: its members, or those of its `params` with others beside them; none without a meaning.
/// Di-tetrahedral, if it says nothing else. \throw Bad_request, Invalid_device_parameters
inline Device_description<double> device_from_json(const nlohmann::json& device) {
  if (!device.is_object())
    throw Bad_request("a device is an object");
  nlohmann::json params = device.contains("params") ? device["params"] : device;
  if (!params.is_object())
    throw Bad_request("`params` must be an object");
  for (const auto& [key, value] : device.items())
    if (key != "params" && !params.contains(key))
      params[key] = value;
    else if (key != "params" && params[key] != value)
      throw Bad_request("`" + key + "` is given twice, in `params` and beside it, as something else: leave one out");
  for (const auto& [key, value] : params.items())
    if (!is_device_key(key))
      throw Bad_request("`" + key + "` means nothing to a device");
  const Device_description<double> d = device_description_from_json(
      params, device_form_from_json(params.value("form", nlohmann::json("ditetra"))), true);
  Device_parameters<double>{d}; // throws what is wrong with it
  if (d.primary_mass == 0 && d.secondary_mass == 0 && d.platform_mass == 0 && d.rotor_inertia == 0)
    throw Bad_request("`m1`, `m2`, `M` and `Jm` are all 0, and what has no mass has no motion: give one of them more");
  return d;
}

/// The description in another number type.
template <class S> Device_description<S> device_description_as(const Device_description<double>& d) {
  Device_description<S> e;
  e.form = d.form;
  e.base_radius = S(d.base_radius);
  e.primary_length = S(d.primary_length);
  e.secondary_length = S(d.secondary_length);
  e.platform_radius = S(d.platform_radius);
  e.primary_mass = S(d.primary_mass);
  e.secondary_mass = S(d.secondary_mass);
  e.platform_mass = S(d.platform_mass);
  e.rotor_inertia = S(d.rotor_inertia);
  e.gravity = S(d.gravity);
  e.torque_limit = S(d.torque_limit);
  e.viscous_friction = S(d.viscous_friction);
  e.coulomb_friction = S(d.coulomb_friction);
  e.encoder_step = S(d.encoder_step);
  for (int k = 0; k < 3; ++k) {
    e.platform_inertia[k] = S(d.platform_inertia[k]);
    e.least_angle[k] = S(d.least_angle[k]);
    e.greatest_angle[k] = S(d.greatest_angle[k]);
  }
  return e;
}

} // namespace haptic_sculpt
