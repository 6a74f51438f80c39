// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef HAPTIC_SCULPT_EXAMPLES_WRITE_RESULTS_H
#define HAPTIC_SCULPT_EXAMPLES_WRITE_RESULTS_H

#include "Arguments.h"
#include "Report.h"
#include "Run_result.h"
#include "comparison.h"
#include "picture.h"

#include <haptic_sculpt/surface/io/replace_file.h>
#include <haptic_sculpt/surface/write_surface.h>

#include <iostream>

namespace haptic_sculpt::sculpt_program {

/// Writes what was asked for. A file that cannot be written does not keep the others from being written: the work is
/// done. The report comes last, with what there is to say of the others.
inline bool write_all(const Mesh& mesh, const Run_result& result, const Arguments& arguments,
                      std::vector<std::string>& notes, const std::vector<Near_vertex>& nearest,
                      const drawing::Scene& before, const std::optional<Mesh>& without_guard) {
  bool all_written = true;
  const auto note = [&](const std::string& text) {
    std::cerr << "sculpt: " << text << '\n';
    notes.push_back(text);
  };
  const auto attempt = [&](const std::string& path, const auto& write) {
    if (path.empty())
      return;
    try {
      if (const std::string lost = write(path); !lost.empty())
        note(lost);
      return;
    } catch (const Write_error& error) {
      note(error.what());
    } catch (const drawing::Picture_error& error) {
      note(error.what());
    }
    all_written = false;
  };
  attempt(arguments.out, [&](const std::string& path) {
    Write_options options;
    options.vertex_order = result.vertex_order;
    return write_surface(path, mesh, options);
  });
  attempt(arguments.picture,
          [&](const std::string& path) { return write_picture_of(mesh, result, before, path, arguments.shown); });
  attempt(arguments.comparison,
          [&](const std::string& path) { return write_comparison(*without_guard, mesh, path, arguments.shown.view); });
  attempt(arguments.report,
          [&](const std::string& path) { return replace_file(path, report_of(result, notes, nearest)); });
  return all_written;
}

} // namespace haptic_sculpt::sculpt_program

#endif
