// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef HAPTIC_SCULPT_EXAMPLES_LOG_FILE_H
#define HAPTIC_SCULPT_EXAMPLES_LOG_FILE_H

#include "Script.h"

#include <cstdio>
#include <memory>

namespace haptic_sculpt::sculpt_program {

/// A log or script that names another mesh.
struct Foreign_log : Error {
  using Error::Error;
};

/// An edit log: a script that begins with the mesh's hash, one line an edit, appended and flushed as the work goes on, so that a
/// killed process loses at most the edit under way. Numbers are hexadecimal: replay is exact to the bit.
class Log_file {
public:
  /// Opens a log, or begins one with the hash and the settings. An unterminated last line, which a killed process may leave, is
  /// cut off. \throw Script_error for a line that cannot be read; Foreign_log; Write_error
  Log_file(const std::string& path, const std::string& mesh_hash, const std::vector<Command>& settings);

  /// What the log held when it was opened.
  const std::vector<Command>& commands() const { return commands_; }

  /// \throw Write_error
  void append(const Command& command);

private:
  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  std::string path_;
  std::vector<Command> commands_;
  std::unique_ptr<std::FILE, Close> file_;
};

} // namespace haptic_sculpt::sculpt_program

#endif
