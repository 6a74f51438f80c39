// SPDX-License-Identifier: GPL-3.0-or-later
#include "device_calculator/answer_line.h"

#include "common/json_words.h"
#include "device_calculator/answer_request.h"
#include "device_json.h"

namespace haptic_sculpt {

using nlohmann::json;

namespace {

/// A number that is not finite has no place in an answer (and none in JSON).
bool is_finite_answer(const json& value) {
  if (value.is_number_float())
    return std::isfinite(value.get<double>());
  for (const json& part : value)
    if ((part.is_structured() || part.is_number_float()) && !is_finite_answer(part))
      return false;
  return true;
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

json failure(const char* code, const std::string& message) {
  const std::size_t most = examples::longest_message;
  return {{"ok", false},
          {"error", code},
          {"message", message.size() > most ? message.substr(0, most) + "..." : message}};
}

json answer_or_failure(const json& request) {
  try {
    json found = examples::answer_request(request);
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

} // namespace

json examples::answer_line(const Line_reader& reader) {
  if (reader.is_too_long())
    return failure("line_too_long", "line " + std::to_string(reader.number()) + ": a line may have " +
                                        std::to_string(longest_line) + " bytes; this one was skipped");
  json request;
  try {
    request = parse_bounded(reader.line());
  } catch (const No_answer& error) {
    return failure(error.code(), "line " + std::to_string(reader.number()) + ": " + error.what());
  } catch (const json::exception& error) {
    std::string words = examples::in_words(error, reader.number());
    if (words.compare(0, 5, "line ") != 0) // where a number is too large, say
      words.insert(0, "line " + std::to_string(reader.number()) + ": ");
    return failure("malformed_json", words);
  }
  json found = answer_or_failure(request);
  json unknown = unknown_keys(request);
  if (!unknown.empty())
    found["unknown_keys"] = std::move(unknown);
  return found;
}

} // namespace haptic_sculpt
