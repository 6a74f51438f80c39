// SPDX-License-Identifier: GPL-3.0-or-later
// The mechanism as a calculator: one JSON request a line in, one JSON answer a line out. doc/use/device.md has the
// keys.
#include "common/json_words.h"
#include "common/run_program.h"
#include "device_json.h"
#include "json_line.h"
#include <haptic_sculpt/device.h>
#include <haptic_sculpt/device/forward_by_all_modes.h>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <boost/multiprecision/eigen.hpp>
#include <cstring>
#include <iostream>
#include <new>
#include <optional>

namespace {

using namespace haptic_sculpt;
using nlohmann::json;

/// Past this condition number the position's rounding, magnified by the condition and then again by the Jacobian's own
/// sensitivity, costs more digits than a caller of a calculator expects; the answer is then found again in quadruple
/// precision.
constexpr double condition_for_quadruple = 50;

using Quadruple = boost::multiprecision::number<boost::multiprecision::cpp_bin_float_quad::backend_type,
                                                boost::multiprecision::et_off>;

template <class S> double rounded(const S& value) { return static_cast<double>(value); }

template <class M> json to_json(const M& matrix) {
  json rows = json::array();
  for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
    if (matrix.cols() == 1) {
      rows.push_back(rounded(matrix(i, 0)));
      continue;
    }
    json row = json::array();
    for (Eigen::Index k = 0; k < matrix.cols(); ++k)
      row.push_back(rounded(matrix(i, k)));
    rows.push_back(row);
  }
  return rows;
}

template <class S>
Device_vector<S> widen(const Eigen::Vector3d& v) {
  return Device_vector<S>(S(v[0]), S(v[1]), S(v[2]));
}

template <class T> void demand(const Outcome<T>& outcome, const std::string& what) {
  if (outcome)
    return;
  std::string message = what + ": " + name_of(outcome.status());
  if (outcome.shortfall() > typename T::Scalar(0))
    message += ", short by " + json(rounded(outcome.shortfall())).dump();
  throw No_answer(name_of(outcome.status()), message);
}

struct Request {
  Device_description<double> description;
  Eigen::Vector3d theta = Eigen::Vector3d::Zero(), rate = Eigen::Vector3d::Zero(),
                  acceleration = Eigen::Vector3d::Zero();
  int mode = 1;
  std::optional<Eigen::Vector3d> phi_seed;
  std::optional<Eigen::VectorXd> wrench;
  bool with_dynamics = false;
};

template <class S>
Outcome<Device_pose<S>> forward_pose(const Device_parameters<S>& parameters, const Request& request) {
  const Device_vector<S> theta = widen<S>(request.theta);
  if (parameters.form() == Device_form::ditetrahedral)
    return ditetrahedral_forward(parameters, theta, request.mode);
  if (request.phi_seed)
    return forward_by_all_modes(parameters, theta, widen<S>(*request.phi_seed));
  return forward_by_all_modes(parameters, theta);
}

template <class S>
json terms_to_json(const Dynamics_terms<S>& terms, const Device_vector<S>& rate, const Device_vector<S>& acceleration) {
  return {{"M", to_json(terms.mass)},
          {"C", to_json(terms.coriolis)},
          {"gravity", to_json(terms.gravity)},
          {"tau", to_json(terms.torque(rate, acceleration))}};
}

template <class S> json forward_answer(const Request& request, Device_pose<double>* reached) {
  const Device_parameters<S> parameters(device_description_as<S>(request.description));
  const Outcome<Device_pose<S>> pose = forward_pose(parameters, request);
  demand(pose, "no pose at these joint angles");
  const Outcome<Conditioning<S>> condition = conditioning(parameters, *pose);
  demand(condition, "the pose is singular");
  const Device_vector<S> rate = widen<S>(request.rate), acceleration = widen<S>(request.acceleration);
  const Outcome<Device_motion<S>> motion = device_motion(parameters, *pose, rate);
  demand(motion, "no Jacobian at this pose");
  const bool general = parameters.form() == Device_form::general;
  json answer = {{"ok", true},
                 {"p", to_json(pose->position)},
                 {"Q", to_json(pose->orientation)},
                 {"joints", to_json(Device_matrix<S>(pose->joints.transpose()))},
                 {"condA", rounded(condition->constraint_condition)}};
  Eigen::Matrix<S, 6, 3> both;
  both << motion->jacobian.linear, motion->jacobian.angular;
  answer["J"] = general ? to_json(both) : to_json(motion->jacobian.linear);
  if (request.wrench) {
    Device_vector<S> moment = Device_vector<S>::Zero();
    if (general && request.wrench->size() == 6)
      moment = widen<S>(request.wrench->tail<3>());
    answer["tau_wrench"] = to_json(motion->jacobian.torque(widen<S>(request.wrench->head<3>()), moment));
  }
  if (request.with_dynamics) {
    answer["v"] = to_json(motion->velocity.linear);
    answer["a"] = to_json(motion->acceleration(acceleration).linear);
    answer["spatial"] = terms_to_json(spatial_dynamics(parameters, *motion), rate, acceleration);
    const Outcome<Dynamics_terms<S>> planar = planar_dynamics(parameters, *motion);
    demand(planar, "the planar model has no link angle here");
    answer["paper"] = terms_to_json(*planar, rate, acceleration);
  }
  if constexpr (std::is_same<S, double>::value)
    *reached = *pose;
  return answer;
}

/// A number that is not finite has no place in an answer (and none in JSON).
bool is_finite_answer(const json& value) {
  if (value.is_number_float())
    return std::isfinite(value.get<double>());
  for (const json& part : value)
    if ((part.is_structured() || part.is_number_float()) && !is_finite_answer(part))
      return false;
  return true;
}

json answer_forward(Request request) {
  Device_pose<double> pose;
  json answer = forward_answer<double>(request, &pose);
  if (answer["condA"].get<double>() > condition_for_quadruple) {
    // The mode is settled: quadruple precision only adds digits to it.
    if (request.description.form == Device_form::general)
      request.phi_seed = pose.phi();
    answer = forward_answer<Quadruple>(request, nullptr);
  }
  return answer;
}

json answer_inverse(const Device_parameters<double>& parameters, const json& request) {
  const Eigen::Vector3d point = json_vector_3(request, "p");
  if (parameters.form() == Device_form::ditetrahedral) {
    const Outcome<Ditetrahedral_inverse<double>> inverse = ditetrahedral_inverse(parameters, point);
    if (inverse.status() == Device_status::unreachable) {
      std::string legs;
      for (int leg = 0; leg < 3; ++leg)
        if (!inverse->leg_reaches[leg])
          legs += (legs.empty() ? "" : ", ") + std::to_string(leg);
      throw No_answer("unreachable", "legs that do not reach the point: " + legs +
                                         "; the worst |cosine| exceeds 1 by " + json(inverse.shortfall()).dump());
    }
    demand(inverse, "no joint angles for this point");
    json pairs = json::array();
    for (int leg = 0; leg < 3; ++leg)
      pairs.push_back({inverse->minus[leg], inverse->plus[leg]});
    return {{"ok", true}, {"ik_theta_minus_plus", pairs}};
  }
  const bool seeded = request.contains("theta") && !request["theta"].is_null();
  const Eigen::Vector3d seed = seeded ? json_vector_3(request, "theta") : Eigen::Vector3d(Eigen::Vector3d::Constant(1));
  const Outcome<Device_pose<double>> start = forward_by_all_modes(parameters, seed);
  Outcome<Device_pose<double>> pose(Device_status::unreachable, 0);
  if (start)
    pose = general_inverse(parameters, point, *start);
  if (!pose && pose.status() == Device_status::unreachable) {
    // The straight way is blocked, or the seed itself has no pose: take the known solution nearest to the seed.
    double nearest = std::numeric_limits<double>::infinity();
    for (const Device_pose<double>& other : general_inverse_all(parameters, point)) {
      const double distance = (other.theta - seed).cwiseAbs().maxCoeff();
      if (distance < nearest)
        nearest = distance, pose = Outcome<Device_pose<double>>(other);
    }
  }
  demand(pose, "no joint angles bring the platform there (shortfall in m along the way from the seed)");
  return {{"ok", true}, {"theta", to_json(pose->theta)}};
}

json answer_modes(const Device_parameters<double>& parameters, const Eigen::Vector3d& theta) {
  if (parameters.form() == Device_form::ditetrahedral) {
    demand(ditetrahedral_forward(parameters, theta, 1), "no apex at these joint angles");
    return {
        {"ok", true}, {"n_modes", 2}, {"all_phi", json::array()}}; // a point has no link angles seen from a platform
  }
  const Outcome<Assembly_modes<double>> modes = assembly_modes(parameters, theta);
  demand(modes, "the assembly modes are not isolated");
  json all = json::array();
  for (int k = 0; k < modes->count; ++k)
    all.push_back(to_json(modes->modes[static_cast<std::size_t>(k)].angles()));
  return {{"ok", true}, {"n_modes", modes->count}, {"all_phi", all}};
}

json answer(const json& request) {
  if (!request.is_object())
    throw Bad_request("a request is an object");
  if (!request.contains("op") || !request["op"].is_string())
    throw Bad_request("`op` must be \"forward\", \"dynamics\", \"inverse\" or \"modes\"");
  if (!request.contains("params"))
    throw Bad_request("`params` must be given");
  const json& params = request["params"];
  const std::string op = request["op"];
  const json form = request.contains("form")                        ? request["form"]
                    : params.is_object() && params.contains("form") ? params["form"]
                                                                    : json();
  Request r;
  r.with_dynamics = op == "dynamics";
  r.description = device_description_from_json(params, device_form_from_json(form), r.with_dynamics);
  if (params.contains("r") && r.description.platform_radius == 0)
    throw No_answer("invalid_parameters",
                    "platform_radius (r) must be positive; leave it out where there is no platform");
  const Device_parameters<double> parameters(r.description);
  if (op == "inverse")
    return answer_inverse(parameters, request);
  if (op != "forward" && op != "dynamics" && op != "modes")
    throw Bad_request("`op` must be \"forward\", \"dynamics\", \"inverse\" or \"modes\"");
  r.theta = json_vector_3(request, "theta");
  if (op == "modes")
    return answer_modes(parameters, r.theta);
  if (parameters.form() == Device_form::ditetrahedral && request.contains("mode") && request["mode"] != "home" &&
      !request["mode"].is_null()) {
    if (request["mode"] != 1 && request["mode"] != -1)
      throw Bad_request("`mode` must be 1 or -1");
    r.mode = request["mode"] == 1 ? 1 : -1;
  }
  if (request.contains("phi_seed") && !request["phi_seed"].is_null() && parameters.form() == Device_form::general)
    r.phi_seed = json_vector_3(request, "phi_seed");
  if (request.contains("wrench") && !request["wrench"].is_null())
    r.wrench = parameters.form() == Device_form::general ? json_vector(request, "wrench", 6, 3)
                                                         : json_vector(request, "wrench", 3, 6);
  if (r.with_dynamics) {
    r.rate = json_vector_3(request, "thetad");
    r.acceleration = json_vector_3(request, "thetadd");
  }
  return answer_forward(r);
}

/// The request's keys that mean nothing to any operation, those of `params` as `params.KEY`: a misspelt key must not go
/// unseen.
json unknown_keys(const json& request) {
  json unknown = json::array();
  if (!request.is_object())
    return unknown;
  for (const auto& [key, value] : request.items()) {
    if (!is_one_of(key, {"op", "form", "params", "theta", "thetad", "thetadd", "mode", "phi_seed", "wrench", "p"}))
      unknown.push_back(key);
    if (key == "params" && value.is_object())
      for (const auto& [name, ignored] : value.items())
        if (!is_device_key(name))
          unknown.push_back("params." + name);
  }
  return unknown;
}

/// A message quotes what it complains of, which may be a whole line.
constexpr std::size_t longest_message = 1000;

json failure(const char* code, const std::string& message) {
  return {{"ok", false},
          {"error", code},
          {"message", message.size() > longest_message ? message.substr(0, longest_message) + "..." : message}};
}

json answer_or_failure(const json& request) {
  try {
    json found = answer(request);
    return is_finite_answer(found)
               ? found
               : failure("not_finite", "the numbers are so large or small that the answer overflows");
  } catch (const No_answer& reason) {
    return failure(reason.code(), reason.what());
  } catch (const Bad_request& error) {
    return failure("bad_request", error.what());
  } catch (const Invalid_device_parameters& error) {
    return failure("invalid_parameters", error.what());
  }
}

json answer_line(const Line_reader& reader) {
  if (reader.is_too_long())
    return failure("line_too_long", "a line may have " + std::to_string(longest_line) + " bytes; this one was skipped");
  json request;
  try {
    request = parse_bounded(reader.line());
  } catch (const No_answer& error) {
    return failure(error.code(), error.what());
  } catch (const json::exception& error) {
    return failure("malformed_json", examples::in_words(error));
  }
  json found = answer_or_failure(request);
  json unknown = unknown_keys(request);
  if (!unknown.empty())
    found["unknown_keys"] = std::move(unknown);
  return found;
}

constexpr const char* help = R"(device_calculator: the three-leg mechanism as a calculator.

It reads JSON requests from its input, one a line, and prints one JSON answer a line. SI units and radians.

Example: the apex above three legs at 1, 1.1 and 0.9 rad.
  $ device_calculator <<'END'
  {"op":"forward","form":"ditetra","params":{"R":0.03,"l1":0.07,"l2":0.1},"theta":[1,1.1,0.9]}
  END
  {"J":[...],"Q":[...],"condA":...,"joints":[...],"ok":true,"p":[...]}

Requests: form, params and one op, with the keys it takes (those in brackets may be left out)
  form      "ditetra" or "general"
  params    R l1 l2 [r] [m1 m2 M] [I] [Jm] [g]; r for "general", masses for "dynamics"
  forward   theta [mode] [phi_seed] [wrench]    pose, Jacobian, condition
  dynamics  the same, thetad thetadd            also velocity, acceleration and both dynamic models
  inverse   p [theta]                           joint angles; theta is the seed in the general form
  modes     theta                               all assembly modes
doc/use/device.md says what each key means.

A request that cannot be answered gets {"ok":false,"error":CODE,"message":TEXT}, and the next line is read. Keys that
are not known are listed in the answer as "unknown_keys". A line may have 1048576 bytes, 1000 values and 32 levels of
nesting.

usage: device_calculator [--help] < REQUESTS > ANSWERS
Exit:  0 all lines answered (failures are answers), 1 a fault of the program, 2 wrong arguments or unreadable requests,
       5 the answers cannot be written
)";
static_assert(longest_line == 1048576 && most_values == 1000 && deepest_nesting == 32, "the help text says these");

int calculate(int argument_count, char** arguments) {
  for (int k = 1; k < argument_count; ++k)
    if (std::strcmp(arguments[k], "--help") == 0 || std::strcmp(arguments[k], "-h") == 0) {
      std::cout << help;
      return std::cout.flush() ? examples::done : examples::cannot_write;
    }
  if (argument_count > 1)
    throw examples::Usage_error("unknown argument `" + std::string(arguments[1]) +
                                "`. It reads JSON requests, one a line, from its input; see --help.");
  Line_reader reader(std::cin);
  while (reader.next()) {
    try {
      std::cout << answer_line(reader).dump(-1, ' ', false, json::error_handler_t::replace) << std::endl;
    } catch (const std::bad_alloc&) { // what this line took has been given back by now
      std::cout << R"({"error":"out_of_memory","message":"there is not enough memory to answer this line","ok":false})"
                << std::endl;
    }
    if (!std::cout)
      return examples::cannot_write;
  }
  if (std::cin.bad())
    throw examples::Usage_error("the requests cannot be read");
  return examples::done;
}

} // namespace

int main(int argument_count, char** arguments) {
  std::ios::sync_with_stdio(false); // first of all: it makes the streams anew
  return examples::run_program(
      "device_calculator", [&] { return calculate(argument_count, arguments); },
      [](const std::exception& error) {
        return dynamic_cast<const examples::Usage_error*>(&error) != nullptr ? examples::usage : examples::failed;
      },
      [](const std::exception& error) { return std::string(error.what()); });
}
