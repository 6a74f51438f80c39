// SPDX-License-Identifier: GPL-3.0-or-later

/// \file
/// Whatever stands in the files that `haptic_loop` reads, devices, hands, paths and recordings: it is refused with a
/// message, or gives what can be used. The first byte says which file.

#include "haptic_loop/Recording.h"

#include <fuzz/Damage.h>
#include <fuzz/Fuzz_target.h>
#include <fuzz/require.h>
#include <fuzz/temporary_folder.h>

#include <array>

namespace {

using namespace haptic_sculpt;
using namespace haptic_sculpt::loop_program;
using fuzz::require;

constexpr std::array<const char*, 4> names{"device", "hand", "path", "recording"};
std::array<std::size_t, 4> accepted{}, refused{};

void read(std::size_t which, const std::string& path) {
  switch (which) {
  case 0: {
    const auto device = read_device(path);
    Device_parameters<double>{device}; // throws where it is none
    require(json_of(device).dump().find("null") == std::string::npos, "all of a device is finite");
    return;
  }
  case 1:
    return read_hand(path).check();
  case 2: {
    const Hand_path read = read_path(path);
    for (std::size_t k = 0; k < read.rows().size(); ++k) {
      const auto& row = read.rows()[k];
      require(row.position.allFinite() && std::isfinite(row.time), "all of a path is finite");
      require(k == 0 || read.rows()[k - 1].time < row.time, "the times of a path grow");
      require(read.at(row.time).position == row.position, "a path leads through its rows");
    }
    return;
  }
  default: {
    const Recording read = Recording::read(path);
    require(!bad_setting(read.settings), "a recording's settings can be used");
    require(json_of(settings_of(json_of(read.settings))) == json_of(read.settings), "settings come back as they are");
  }
  }
}

std::vector<std::string> good_files() {
  Settings settings;
  settings.device = default_device();
  const std::string device = json_of(settings.device).dump();
  std::string recording = recording_head(std::string(64, 'a'), settings);
  for (const char* line : {"0x1p-1 0x1p-2 0x1p-3 0x0p+0 -0x1p-4 0x1p-5 1 0x1p-10\n", "1 1.1 0.9 0 0 0 0 0.001\n"})
    recording += line;
  return {'\0' + device,
          '\0' + std::string(R"({"form":"general","params":)") + device + "}",
          '\1' + std::string(R"({"mass": [0, 0.2], "stiffness": [2000, 300], "damping": [2, 3]})"),
          '\1' + std::string(R"({"name": "finger"})"),
          '\2' + std::string("t,x,y,z,button\n0,0.01,0.02,0.03,0\n0.5,0.01,-0.02,0.03,1\r\n1e0,1e-3,2,3,2\n"),
          '\3' + recording};
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0)
    return 0;
  const std::size_t which = data[0] % names.size();
  const auto path = fuzz::temporary_file("in", data + 1, size - 1);
  try {
    read(which, path.string());
    ++accepted[which];
  } catch (const Error& error) {
    require(error.what()[0] != '\0' && std::string(error.what()).size() < 100000, "a refusal says why, shortly");
    ++refused[which];
  }
  return 0;
}

std::string fuzz_input(std::mt19937_64& random) {
  static const std::vector<std::string> seeds = good_files();
  return fuzz::Damage(random, seeds)();
}

std::string fuzz_summary() {
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i)
    text += (i ? ", " : "") + std::string(names[i]) + "s: " + std::to_string(refused[i]) + " refused, " +
            std::to_string(accepted[i]) + " accepted";
  return text;
}
