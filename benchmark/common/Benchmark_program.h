// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Promises.h"
#include "Shard.h"

#include "../../examples/common/json_words.h"
#include "../../examples/common/numbers.h"
#include "../../examples/common/output_targets.h"
#include "../../examples/common/parse_arguments.h"
#include "../../examples/common/process_state.h"

#include <haptic_sculpt/surface/io/replace_file.h>

#include <nlohmann/json.hpp>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <new>
#include <stdexcept>
#include <string>
#include <system_error>
#include <utility>

#include <unistd.h>

namespace haptic_sculpt::benchmark {

/// Exit codes that all programs share; those of promises are a program's own, and others.
enum Common_exit { all_kept = 0, failed = 1, usage = 2, cannot_write = 5 };

/// What was given cannot be used.
struct Wrong_use : Error {
  using Error::Error;
};

/// Reads what was given. \throw Wrong_use where that throws
template <class Read>
auto read_given(const Read& read) {
  try {
    return read();
  } catch (const Error& error) {
    throw Wrong_use(error.what());
  }
}

/// As CLI::PositiveNumber, which says of a number that it is not in a range of 300 digits.
inline const CLI::Validator positive_number(
    [](const std::string& text) -> std::string {
      const double number = examples::number_of(text).value_or(0);
      return number > 0 && std::isfinite(number) ? "" : "'" + text + "' is not a finite number > 0";
    },
    "POSITIVE");

/// That files can be put into a folder, which may have to be made. \throw Write_error
inline void check_folder(const std::string& folder) {
  std::error_code none;
  std::filesystem::path there = std::filesystem::absolute(folder, none);
  while (!std::filesystem::exists(there, none) && there != there.parent_path())
    there = there.parent_path();
  if (!std::filesystem::is_directory(there, none) || ::access(there.c_str(), W_OK | X_OK) != 0)
    throw Write_error("cannot write into '" + folder + "': '" + there.string() + "' is no folder that can be written");
}

/// What every program has: `--json`, `--shard`, a report with the promises at its end, one meaning of exit codes.
class Benchmark_program {
public:
  using Json = nlohmann::ordered_json;

  Shard shard;

  /// \param unit what a shard is a share of, for `--help`: "population"
  Benchmark_program(std::string name, CLI::App& app, const std::string& unit) : name_(std::move(name)), app_(app) {
    app.add_option("--json", file_, "Where the report goes");
    app.footer(
        "Exit: 0 all kept, 1 out of memory or a fault of the program, 2 usage, 5 the report, a case of --dump or "
        "standard output cannot be written; others name a promise that broke.");
    shard.add_option(app, unit);
  }

  /// Reads the options, does the work, and writes the report where `--json` says. That it can be written there is
  /// looked at before the work.
  /// \param work makes the report of what it gets, the promises, to which it adds its own
  /// \return the exit code: that of the promises; `usage` where an option is wrong, or what was given cannot be used;
  /// `cannot_write`, also where standard output takes nothing; `failed` where the work throws anything else
  template <class Work>
  int run(int argc, char** argv, const Work& work) {
    examples::put_process_in_order(name_.c_str());
    examples::end_at_once_by_signals();
    const int code = exit_code_of(argc, argv, work);
    if (!std::cout.flush() || std::fflush(stdout) != 0 || std::ferror(stdout) != 0) {
      say("not all could be written to standard output");
      return code == all_kept ? cannot_write : code;
    }
    return code;
  }

  /// What there is until now, in the course of long work. Where that cannot be written the work goes on: the end tries
  /// again.
  void write_so_far(const Json& report) const {
    try {
      write(report);
    } catch (const Write_error& error) {
      say(error.what());
    }
  }

private:
  std::string name_, file_;
  CLI::App& app_;

  /// \throw Write_error
  void write(const Json& report) const {
    if (!file_.empty())
      replace_file(file_, examples::text_of(report, 1) + '\n');
  }

  template <class Work>
  int exit_code_of(int argc, char** argv, const Work& work) {
    try {
      examples::parse_arguments(app_, argc, argv);
      refuse_what_is_not_finite();
      refuse_report_over_input();
      check_file();
      Promises promises;
      Json report = work(promises);
      report["shard"] = shard.text();
      report["promises"] = promises.json();
      report["exit"] = promises.exit();
      if (promises.exit() != all_kept)
        say(promises.first_broken() + (promises.exit() == cannot_write ? "" : "; please report it with this command"));
      write(report);
      return promises.exit();
    } catch (const CLI::ParseError& error) {
      return app_.exit(error) == 0 ? all_kept : usage;
    } catch (const Write_error& error) {
      return say(error.what()), cannot_write;
    } catch (const Wrong_use& error) {
      return say(error.what()), usage;
    } catch (const std::bad_alloc&) {
      return say("the memory does not suffice for this"), failed;
    } catch (const std::length_error&) { // of more than any memory
      return say("the memory does not suffice for this"), failed;
    } catch (const std::exception& error) {
      return say(error.what()), failed;
    }
  }
  /// \throw Wrong_use
  void refuse_report_over_input() const {
    if (mesh_file_format(file_)) // maybe of a folder that is read
      throw Wrong_use("'" + file_ + "' (--json) has the name of a mesh; give --json another name");
    std::error_code none;
    for (const CLI::Option* option : app_.get_options())
      for (const std::string& value : option->results())
        if (option->get_name() != "--json" && std::filesystem::equivalent(file_, value, none))
          throw Wrong_use("'" + file_ + "' (--json) and '" + value + "' (" + option->get_name() +
                          ") are one file; give --json another name");
  }
  /// A range of CLI11 lets nan pass, which is neither below nor above.
  void refuse_what_is_not_finite() const {
    for (const CLI::Option* option : app_.get_options())
      for (const std::string& value : option->results())
        if (option->get_type_name().compare(0, 5, "FLOAT") == 0 && !std::isfinite(std::strtod(value.c_str(), nullptr)))
          throw CLI::ValidationError(option->get_name(), "a finite number is expected, not " + value);
  }
  /// \throw Wrong_use, Write_error
  void check_file() const {
    if (const char* const stream = file_.empty() ? nullptr : examples::standard_stream_at(file_); stream != nullptr)
      throw Wrong_use("'" + file_ + "' (--json) is the file of standard " + stream + "; give --json another name");
    if (const std::string why = file_.empty() ? "" : why_not_replaceable(follow_links(file_)); !why.empty())
      throw Write_error("cannot write '" + file_ + "': " + why);
  }
  void say(const std::string& what) const {
    std::cout.flush();
    std::cerr << name_ << ": " << what << '\n';
  }
};

} // namespace haptic_sculpt::benchmark
