// SPDX-License-Identifier: GPL-3.0-or-later
#include "Log_file.h"

#include <haptic_sculpt/surface/Invalid_surface.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace haptic_sculpt::sculpt_program {
namespace {

std::string hexadecimal(double x) {
  char text[40];
  std::snprintf(text, sizeof text, "%a", x);
  return text;
}

std::string line_of(const Command& command) {
  std::string line = name_of(command.kind);
  for (std::size_t index : command.indices)
    line += ' ' + std::to_string(index);
  for (const auto& point : command.points)
    for (double x : point)
      line += ' ' + hexadecimal(x);
  if (command.kind == Command::Kind::clearance || command.kind == Command::Kind::delta)
    line += ' ' + hexadecimal(command.length);
  if (!command.word.empty())
    line += ' ' + command.word;
  return line + '\n';
}

} // namespace

Log_file::Log_file(const std::string& path, const std::string& mesh_hash, const std::vector<Command>& settings) : path_(path) {
  std::string text;
  if (std::filesystem::exists(path)) {
    std::ifstream old(path, std::ios::binary);
    std::ostringstream all;
    all << old.rdbuf();
    if (!old)
      throw Write_error("cannot read the log '" + path + "'");
    text = all.str();
    const std::size_t end = text.find_last_of('\n');
    const std::size_t kept = end == std::string::npos ? 0 : end + 1;
    if (kept != text.size()) {
      text.resize(kept);
      std::error_code error;
      std::filesystem::resize_file(path, kept, error);
      if (error)
        throw Write_error("cannot cut the unfinished last line off the log '" + path + "': " + error.message());
    }
  }
  std::istringstream lines(text);
  commands_ = read_script(lines, path);
  if (!commands_.empty() && (commands_[0].kind != Command::Kind::mesh || commands_[0].word != mesh_hash))
    throw Foreign_log("the log '" + path + "' does not begin with the hash of this mesh, " + mesh_hash +
                      ": give the mesh it was begun with, or another log");
  file_.reset(std::fopen(path.c_str(), "ab"));
  if (!file_)
    throw Write_error("cannot open the log '" + path + "': " + std::strerror(errno));
  if (commands_.empty()) {
    Command hash;
    hash.kind = Command::Kind::mesh;
    hash.word = mesh_hash;
    append(hash);
  }
  for (const Command& setting : settings)
    append(setting);
}

void Log_file::append(const Command& command) {
  const std::string line = line_of(command);
  if (std::fwrite(line.data(), 1, line.size(), file_.get()) != line.size() || std::fflush(file_.get()) != 0)
    throw Write_error("cannot append to the log '" + path_ + "': " + std::strerror(errno));
}

} // namespace haptic_sculpt::sculpt_program
