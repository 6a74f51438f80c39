// SPDX-License-Identifier: GPL-3.0-or-later

/// \file
/// Whatever line `device_calculator` reads, it answers by one object of finite numbers, or says why not.

#include <device_calculator/answer_line.h>
#include <fuzz/Damage.h>
#include <fuzz/Fuzz_target.h>
#include <fuzz/require.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>

namespace {

using haptic_sculpt::fuzz::require;
using nlohmann::json;

std::map<std::string, std::size_t> outcomes;

const std::vector<std::string>& good_requests() {
  static const std::vector<std::string> requests = [] {
    std::vector<std::string> all;
    const std::string plain = R"("form":"ditetra","params":{"R":0.03,"l1":0.07,"l2":0.1)",
                      general = R"("form":"general","params":{"R":0.06,"l1":0.1,"l2":0.12,"r":0.03)",
                      masses = R"(,"m1":0.1,"m2":0.05,"M":0.1,"Jm":1e-5,"g":9.81)";
    for (const std::string& form : {plain, general}) {
      all.push_back(R"( {"op":"forward",)" + form + R"(},"theta":[1,1.1,0.9],"wrench":[1,0.5,-2]})");
      all.push_back(R"( {"op":"dynamics",)" + form + masses +
                    R"(},"theta":[1,1.1,0.9],"thetad":[0.5,-1,2],"thetadd":[3,0.1,-7]})");
      all.push_back(R"( {"op":"inverse",)" + form + R"(},"p":[0.01,-0.005,0.12],"theta":[1,1,1]})");
      all.push_back(R"( {"op":"modes",)" + form + R"(},"theta":[1,1.1,0.9]})");
    }
    all.push_back(R"( {"op":"forward",)" + general + R"(},"theta":[1,1.1,0.9],"phi_seed":[0.2,0.1,0.3]})");
    all.push_back(R"( {"op":"forward",)" + plain + R"(},"theta":[1,1.1,0.9],"mode":-1,"more":[[{"a":null}]]})");
    return all;
  }();
  return requests;
}

bool is_finite(const json& value) {
  if (value.is_structured())
    return std::all_of(value.begin(), value.end(), is_finite);
  return !value.is_number_float() || std::isfinite(value.get<double>());
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0)
    return 0;
  std::istringstream in(std::string(reinterpret_cast<const char*>(data) + 1, size - 1));
  haptic_sculpt::Line_reader reader(in);
  while (reader.next()) {
    const json found = haptic_sculpt::examples::answer_line(reader);
    require(found.is_object() && found.contains("ok") && found["ok"].is_boolean(), "an answer says whether it is one");
    const std::string text = found.dump(-1, ' ', false, json::error_handler_t::replace);
    require(text.find('\n') == std::string::npos && json::accept(text), "an answer is one line of JSON");
    require(is_finite(found), "all its numbers are finite");
    if (!found["ok"].get<bool>())
      require(found["error"].is_string() && found["message"].is_string() &&
                  found["message"].get<std::string>().size() <= haptic_sculpt::examples::longest_message + 3,
              "no answer has a code and a short message");
    ++outcomes[found["ok"].get<bool>() ? "answered" : found["error"].get<std::string>()];
  }
  return 0;
}

std::string fuzz_input(std::mt19937_64& random) {
  return haptic_sculpt::fuzz::Damage(random, good_requests())();
}

std::string fuzz_summary() {
  std::string text;
  for (const auto& [name, count] : outcomes)
    text += (text.empty() ? "" : ", ") + name + " " + std::to_string(count);
  return text;
}
