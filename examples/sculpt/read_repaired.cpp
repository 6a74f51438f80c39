// SPDX-License-Identifier: GPL-3.0-or-later
#include "read_repaired.h"
#include "refusal.h"
#include "repair_json.h"

#include "../common/write_file.h"

#include <haptic_sculpt/surface/repair.h>

#include <utility>

namespace haptic_sculpt::sculpt_program {

Mesh read_repaired(const Arguments& arguments, std::vector<std::string>& left_out, std::string& told) {
  Face_soup soup = read_face_soup(arguments.mesh);
  Repair_parameters parameters;
  parameters.delta(arguments.delta.value_or(0));
  if (arguments.repair.gap)
    parameters.gap(*arguments.repair.gap);
  if (arguments.repair.largest_hole)
    parameters.largest_hole(*arguments.repair.largest_hole);
  const Repair_report report = repair(soup, parameters);
  if (!arguments.repair.report.empty())
    examples::write_file(arguments.repair.report, json_of(report));
  told = report.message(Validity_report::Reader::user);
  if (!report.is_repaired()) {
    write_refusal(arguments, report.attempt, report.left);
    throw Read_error("cannot repair '" + arguments.mesh + "':\n" + told +
                     "doc/use/repair.md says what is refused, and what to do then");
  }
  left_out = std::move(soup.left_out);
  return make_surface<Mesh>(soup, parameters.delta_length);
}

} // namespace haptic_sculpt::sculpt_program
