// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Log_text.h"
#include "run_program.h"

#include <haptic_sculpt/surface/Invalid_surface.h>
#include <haptic_sculpt/surface/Write_error.h>
#include <haptic_sculpt/surface/coordinate_range.h>

#include <exception>
#include <new>
#include <string>

namespace haptic_sculpt::examples {

/// What people hear of an exception: of a surface that is not valid, advice for those who do not program.
inline std::string message_of(const std::exception& error) {
  const auto* const refused = dynamic_cast<const Invalid_surface*>(&error);
  if (refused == nullptr)
    return error.what();
  const std::string said = refused->what();
  std::string text = said.substr(0, said.find(refused->report().message())) + // a name may have line ends
                     refused->report().message(8, Validity_report::Reader::user);
  if (!refused->report().non_triangular_faces.empty())
    text += "`sculpt MESH --triangulate -o OUT` divides polygons into triangles, where nothing else is wrong.\n";
  if (refused->report().is_repairable())
    text += "`sculpt MESH --repair -o OUT` repairs what can be repaired.";
  else
    text += "doc/use/validity.md says what a surface has to be.";
  while (!text.empty() && text.back() == '\n')
    text.pop_back();
  return text;
}

template <class Exception>
bool is_a(const std::exception& error) {
  return dynamic_cast<const Exception*>(&error) != nullptr;
}

/// The exit code of what a program that sculpts meshes throws. A program looks for its own exceptions first.
inline int exit_code_of(const std::exception& error) {
  if (is_a<Foreign_log>(error))
    return foreign_log;
  if (is_a<Read_error>(error) || is_a<Invalid_surface>(error) || is_a<Out_of_range>(error))
    return mesh_refused;
  if (is_a<Script_error>(error))
    return script_error;
  if (is_a<Write_error>(error))
    return cannot_write;
  return is_a<Error>(error) ? usage : failed; // options, and parameters that do not serve
}

/// Of what was kept to be reported later, as far as it is a std::exception.
inline int exit_code_of(const std::exception_ptr& failure) {
  try {
    std::rethrow_exception(failure);
  } catch (const std::exception& error) {
    return exit_code_of(error);
  }
}
inline std::string message_of(const std::exception_ptr& failure) {
  try {
    std::rethrow_exception(failure);
  } catch (const std::bad_alloc&) {
    return "the memory does not suffice for this";
  } catch (const std::exception& error) {
    return message_of(error);
  }
}

/// run_program() of a program that sculpts meshes. \param code_of exit_code_of(), or the program's own, which asks that
template <class Body, class Code_of>
int run_mesh_program(const char* name, const Body& body, const Code_of& code_of) {
  return run_program(name, body, code_of, [](const std::exception& error) { return message_of(error); });
}

} // namespace haptic_sculpt::examples
