// SPDX-License-Identifier: GPL-3.0-or-later
#include "device_calculator/answer_request.h"

#include "device_json.h"
#include "json_line.h"
#include <haptic_sculpt/device.h>
#include <haptic_sculpt/device/forward_by_all_modes.h>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <boost/multiprecision/eigen.hpp>
#include <optional>

namespace haptic_sculpt {

using nlohmann::json;

namespace {

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
  demand(pose,
         "no joint angles within `angle_limits` bring the platform there (shortfall in m along the way from the seed)");
  return {{"ok", true}, {"theta", to_json(pose->theta)}};
}

json answer_modes(const Device_parameters<double>& parameters, const Eigen::Vector3d& theta) {
  if (parameters.form() == Device_form::ditetrahedral) {
    const auto pose = ditetrahedral_forward(parameters, theta, 1);
    if (pose.status() != Device_status::unreachable)
      demand(pose, "no apex at these joint angles");
    // A point has no link angles seen from a platform.
    return {{"ok", true}, {"n_modes", pose ? 2 : 0}, {"all_phi", json::array()}};
  }
  const Outcome<Assembly_modes<double>> modes = assembly_modes(parameters, theta);
  demand(modes, "the assembly modes are not isolated");
  json all = json::array();
  for (int k = 0; k < modes->count; ++k)
    all.push_back(to_json(modes->modes[static_cast<std::size_t>(k)].angles()));
  return {{"ok", true}, {"n_modes", modes->count}, {"all_phi", all}};
}

} // namespace

json examples::answer_request(const json& request) {
  if (!request.is_object())
    throw Bad_request("a request is an object");
  if (!request.contains("op") || !request["op"].is_string())
    throw Bad_request("`op` must be \"forward\", \"dynamics\", \"inverse\" or \"modes\"");
  if (!request.contains("params"))
    throw Bad_request("`params` must be given");
  const json& params = request["params"];
  const std::string op = request["op"];
  const bool has_form_within = params.is_object() && params.contains("form");
  const json form = request.contains("form") ? request["form"] : has_form_within ? params["form"] : json();
  if (has_form_within && params["form"] != form)
    throw Bad_request("`form` is given twice, in `params` and beside it, as something else: leave one out");
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
  if (request.contains("mode") && request["mode"] != "home" && !request["mode"].is_null()) {
    if (parameters.form() == Device_form::general)
      throw Bad_request("`mode` is of the form \"ditetra\"; `phi_seed` leads to another mode of the form \"general\"");
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

} // namespace haptic_sculpt
