// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Arguments.h"
#include "Report.h"
#include "Run_result.h"
#include "comparison.h"
#include "picture.h"

#include "../common/Result_writer.h"
#include "../common/write_file.h"

namespace haptic_sculpt::sculpt_program {

/// Writes what was asked for; the report last, with what there is to say of the others.
inline void write_all(examples::Result_writer& writer, const Mesh& mesh, const Run_result& result,
                      const Arguments& arguments, const std::vector<Near_vertex>& nearest,
                      const drawing::Scene& before, const std::optional<Mesh>& without_guard) {
  writer.write(arguments.out, [&](const std::string& path) {
    Write_options options;
    options.vertex_order = result.vertex_order;
    return examples::write_mesh(path, mesh, options);
  });
  writer.write(arguments.picture,
          [&](const std::string& path) { return write_picture_of(mesh, result, before, path, arguments.shown); });
  writer.write(arguments.comparison,
          [&](const std::string& path) { return write_comparison(*without_guard, mesh, path, arguments.shown.view); });
  writer.write(arguments.report, [&](const std::string& path) {
    return examples::write_file(path, report_of(result, writer.notes(), nearest));
  });
}

} // namespace haptic_sculpt::sculpt_program
