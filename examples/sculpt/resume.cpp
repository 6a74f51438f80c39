// SPDX-License-Identifier: GPL-3.0-or-later
#include "resume.h"

#include "../common/numbers.h"

#include <algorithm>
#include <iterator>

namespace haptic_sculpt::sculpt_program {
namespace {

using examples::decimal;

void compare(const Arguments& arguments, const Settings& log, const std::string& when) {
  const auto refuse = [&](const std::string& name, const std::string& asked, const std::string& logged) {
    throw Usage_error("--" + name + ' ' + asked + " contradicts the log '" + arguments.log + "', which " + when + " '" +
                      name + ' ' + logged + "'. Leave the option out; to change over, put the line '" + name + ' ' +
                      asked + "' into the script, where it shall hold from");
  };
  if (!arguments.response.empty() && arguments.response != log.response)
    refuse("response", arguments.response, log.response);
  if (arguments.clearance && arguments.clearance != log.clearance)
    refuse("clearance", decimal(*arguments.clearance), log.clearance ? decimal(*log.clearance) : "default");
  if (arguments.delta && *arguments.delta != log.delta)
    refuse("delta", decimal(*arguments.delta), decimal(log.delta));
}

} // namespace

Rest rest_of(const std::vector<Command>& script, const std::string& script_hash, const Log_contents& log,
             const Arguments& arguments) {
  Rest rest;
  const auto last = std::find_if(log.passes.rbegin(), log.passes.rend(),
                                 [&](const auto& pass) { return pass.script == script_hash; });
  if (last == log.passes.rend() || (last->is_done && arguments.append)) {
    rest.commands = script;
    return rest;
  }
  if (last->is_done)
    throw Usage_error(
        "'" + arguments.script + "' has been carried out to its end already, as the log '" + arguments.log +
        "' says. Leave --script out to replay the log alone; give --append to make the same edits once more");
  rest.after = last->last_line;
  rest.is_new_pass = rest.after == 0;
  rest.is_announced = last == log.passes.rbegin();
  if (!rest.is_new_pass)
    rest.commands = last->settings.changes_from(log.last_settings());
  for (Command& setting : rest.commands)
    setting.line = rest.after, setting.is_restored = true;
  std::copy_if(script.begin(), script.end(), std::back_inserter(rest.commands),
               [&](const Command& c) { return c.line > rest.after; });
  return rest;
}

bool ends_within_move(const std::vector<Command>& script, const std::string& script_hash, const Log_contents& log) {
  if (!log.last_line || log.passes.back().script != script_hash || log.passes.back().is_done)
    return false;
  // Of a `stroke` in the script the log looks the same.
  const bool is_move = std::any_of(script.begin(), script.end(), [&](const Command& c) {
    return c.kind == Command::Kind::move && c.line == log.passes.back().last_line;
  });
  const std::size_t first = log.last_line->begin.commands; // that it logged; of a line that did nothing there is none
  return is_move && first < log.commands.size() && log.commands[first].edit.kind == Edit_kind::stroke &&
         log.commands.back().edit.kind != Edit_kind::end;
}

Settings settings_of(const Arguments& arguments) {
  Settings settings;
  if (!arguments.response.empty())
    settings.response = arguments.response;
  settings.clearance = arguments.clearance;
  settings.delta = arguments.delta.value_or(settings.delta);
  return settings;
}

void check_options(const Arguments& arguments, const Log_contents& log, bool is_new_pass) {
  compare(arguments, log.first_settings(), "was begun with");
  if (is_new_pass)
    compare(arguments, log.last_settings(), "ends with");
}

} // namespace haptic_sculpt::sculpt_program
