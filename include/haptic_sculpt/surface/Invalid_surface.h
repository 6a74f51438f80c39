// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/Error.h>
#include <haptic_sculpt/surface/Validity_report.h>
#include <haptic_sculpt/surface/Write_error.h>

#include <string>
#include <utility>

namespace haptic_sculpt {

/// A mesh was refused because it is not a valid surface. Holds every offending element; `what()` names the first ones.
class Invalid_surface : public Error {
public:
  /// \param subject what is refused, e.g. the name of a file
  Invalid_surface(const std::string& subject, Validity_report report)
      : Error(subject + " is not a valid surface:\n" + report.message() +
              (report.is_repairable() ? "Or call repair() of haptic_sculpt/surface/repair.h, which tries all that.\n"
                                      : "")),
        report_(std::move(report)) {}

  /// Every offending element; lives as long as the exception.
  const Validity_report& report() const {
    return report_;
  }

private:
  Validity_report report_;
};

/// A file could not be read as a mesh: missing, empty, cut short, or not what its format asks for.
class Read_error : public Error {
public:
  using Error::Error; ///< takes the message that `what()` gives
};

} // namespace haptic_sculpt
