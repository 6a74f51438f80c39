// SPDX-License-Identifier: GPL-3.0-or-later
// Prints the workspace, force and inertia figures of a design, and writes its samples for plot_device_workspace.py to
// draw.
#include "common/contents_of.h"
#include "common/json_words.h"
#include "common/output_targets.h"
#include "common/parse_arguments.h"
#include "common/run_program.h"
#include "device_json.h"
#include "json_line.h"
#include <haptic_sculpt/device.h>
#include <haptic_sculpt/device/forward_by_all_modes.h>
#include <haptic_sculpt/surface/io/replace_file.h>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iomanip>
#include <sstream>

namespace {

using namespace haptic_sculpt;

struct Range {
  std::vector<double> values;
  /// \throw Error where no number holds what comes of the device
  void add(double figure) {
    if (!std::isfinite(figure))
      throw Error("its forces, or its apparent masses, are beyond the range of numbers; give `torque_limit` (N m) and "
                  "masses (kg) of a device that can be built");
    values.push_back(figure);
  }
  void print(const char* what, const char* unit) {
    if (values.empty()) {
      std::printf("  %-44s none\n", what);
      return;
    }
    std::sort(values.begin(), values.end());
    std::printf("  %-44s %9.4g .. %9.4g, median %9.4g %s\n", what, values.front(), values.back(),
                values[values.size() / 2], unit);
  }
};

Device_vector<double> eigenvalues(const Device_matrix<double>& m) {
  return Eigen::SelfAdjointEigenSolver<Device_matrix<double>>(m).eigenvalues();
}

/// Of a motor that turns ten times as fast as its joint: 6.3 g cm^2, times the square of that; kg m^2.
constexpr double inertia_of_geared_motors = 6.3e-5;
/// In a pose where a joint moves the platform by less than this share of its link for a radian, in some direction, the
/// apparent mass says how near a singular pose is, and nothing of the device.
constexpr double least_way_per_radian = 0.01;

void figures(Device_description<double> description, const char* name, int per_joint, std::ostream* samples_file) {
  const Device_parameters<double> parameters(description);
  description.rotor_inertia += inertia_of_geared_motors;
  const Device_parameters<double> geared(description);
  const auto samples =
      sample_workspace(parameters, per_joint, Workspace_limits<double>(),
                       [](const auto& p, const auto& theta) { return forward_by_all_modes(p, theta); });
  Device_vector<double> low = Device_vector<double>::Constant(INFINITY), high = -low;
  Range condition, force, light, heavy, model_difference, tilt;
  int inside = 0, left_out = 0;
  for (const auto& sample : samples) {
    if (!sample.verdict.inside())
      continue;
    ++inside;
    low = low.cwiseMin(sample.pose.position), high = high.cwiseMax(sample.pose.position);
    condition.add(sample.condition);
    force.add(sample.force);
    tilt.add(std::acos(std::min(1.0, sample.pose.orientation(2, 2))));
    const auto motion = device_motion(parameters, sample.pose, Device_vector<double>(Device_vector<double>::Zero()));
    const auto planar = planar_dynamics(parameters, *motion);
    const Device_matrix<double> mass = spatial_dynamics(parameters, *motion).mass, position = motion->jacobian.linear;
    if (!planar ||
        translation_conditioning(motion->jacobian).least < least_way_per_radian * parameters.primary_length()) {
      ++left_out;
      continue;
    }
    const Device_vector<double> felt = eigenvalues(apparent_mass(mass, position));
    light.add(felt[2] / felt[0]);
    const Device_vector<double> felt_geared =
        eigenvalues(apparent_mass(spatial_dynamics(geared, *motion).mass, position));
    heavy.add(felt_geared[2] / felt_geared[0]);
    model_difference.add((planar->mass - mass).norm() / mass.norm());
    if (samples_file)
      *samples_file << sample.pose.position.transpose() << ' ' << sample.condition << ' ' << sample.force << ' '
                    << felt.transpose() << ' ' << felt_geared.transpose() << '\n';
  }
  std::printf("%s: %zu regular poses of %d, %d inside all limits\n", name, samples.size(),
              per_joint * per_joint * per_joint, inside);
  if (inside)
    std::printf("  extent (mm)  x %.1f .. %.1f  y %.1f .. %.1f  z %.1f .. %.1f\n", 1e3 * low[0], 1e3 * high[0],
                1e3 * low[1], 1e3 * high[1], 1e3 * low[2], 1e3 * high[2]);
  condition.print("condition of the velocity equations", "");
  tilt.print("tilt", "rad");
  force.print("isotropic force at the torque limit", "N");
  light.print("apparent mass, largest over smallest axis", "");
  heavy.print("the same with geared motors (630 g cm^2 a joint)", "");
  model_difference.print("planar model's mass matrix off by", "of its norm");
  if (left_out != 0)
    std::printf("  %-44s %d\n", "poses near singular ones, not in the last three", left_out);
}

/// \throw Write_error where that is known before the work
void check_target(const std::string& path) {
  if (const std::string why = why_not_replaceable(follow_links(path)); !why.empty())
    throw Write_error("cannot write '" + path + "': " + why);
}

/// Of the designs D1, D2, D3 in both forms; samples of the first.
void figures_of_designs(std::ostream& samples) {
  for (Device_form form : {Device_form::general, Device_form::ditetrahedral})
    for (Named_design design : {Named_design::D1, Named_design::D2, Named_design::D3}) {
      const std::string name = std::string("D") + std::to_string(static_cast<int>(design) + 1) +
                               (form == Device_form::general ? " general" : " di-tetrahedral");
      const bool is_first = form == Device_form::general && design == Named_design::D1;
      figures(named_design<double>(design, form), name.c_str(), 21, is_first ? &samples : nullptr);
    }
}

void figures_of_file(const std::string& path, std::ostream& samples) {
  const nlohmann::json device = parse_bounded(examples::contents_of<Error>(path, "the device", 1));
  figures(device_from_json(device), path.c_str(), 21, &samples);
}

int print_figures(int argument_count, char** arguments) {
  CLI::App app(
      "Prints workspace, force and inertia of the designs D1, D2, D3 in both forms, or of a device.\n"
      "Exit: 0 done, 1 a fault of the program, 2 usage, 3 the device is refused, 5 something cannot be written.");
  std::string file, device;
  app.add_option("SAMPLES.txt", file, "Where the samples of the first one go, for examples/plot_device_workspace.py")
      ->check([](const std::string& name) -> std::string {
        std::error_code none;
        std::string word;
        if (std::filesystem::is_regular_file(name, none))
          std::ifstream(name) >> std::setw(8) >> word;                 // no more of it is needed
        const bool has_mark = word.compare(0, 3, "\xef\xbb\xbf") == 0; // of the order of bytes
        const bool is_device =
            std::filesystem::path(name).extension() == ".json" || word.compare(has_mark ? 3 : 0, 1, "{") == 0;
        return is_device ? "'" + name + "' would be replaced by samples; a device comes second" : "";
      });
  app.add_option("DEVICE.json", device, "With the keys of doc/use/device.md");
  try {
    examples::parse_arguments(app, argument_count, arguments);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? examples::done : examples::usage;
  }
  std::error_code is_missing;
  if (std::filesystem::equivalent(file, device, is_missing))
    throw examples::Usage_error("the samples would replace the device: both are '" + device + "'");
  if (const char* const stream = file.empty() ? nullptr : examples::standard_stream_at(file); stream != nullptr)
    throw examples::Usage_error("'" + file + "' is the file of standard " + stream + "; give the samples another name");
  if (!file.empty())
    check_target(file);
  std::ostringstream samples;
  samples.exceptions(std::ios::badbit); // what memory does not suffice for comes out, and no part is written
  device.empty() ? figures_of_designs(samples) : figures_of_file(device, samples);
  if (!file.empty())
    replace_file(file, samples.str());
  if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0)
    throw Write_error("the figures cannot be written");
  return examples::done;
}

} // namespace

int main(int argument_count, char** arguments) {
  return examples::run_program(
      "device_workspace", [&] { return print_figures(argument_count, arguments); },
      [](const std::exception& error) {
        if (dynamic_cast<const examples::Usage_error*>(&error) != nullptr)
          return examples::usage;
        if (dynamic_cast<const Write_error*>(&error) != nullptr)
          return examples::cannot_write;
        const bool is_of_device = dynamic_cast<const Error*>(&error) != nullptr ||
                                  dynamic_cast<const nlohmann::json::exception*>(&error) != nullptr;
        return is_of_device ? examples::mesh_refused : examples::failed;
      },
      [](const std::exception& error) {
        const auto* const of_json = dynamic_cast<const nlohmann::json::exception*>(&error);
        return of_json == nullptr ? error.what() : "the device cannot be read: " + examples::in_words(*of_json);
      });
}
