// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "reckon/bench/studies/sweep/values.hpp"
#include "reckon/bench/studies/zwidth/report.hpp"
#include "reckon/haptics/devices/simulated_device.hpp"
#include "reckon/pdu/seconds.hpp"
#include "reckon/peer/scene/belongings.hpp"
#include "reckon/peer/scene/units.hpp"
#include "reckon/tools/command_line/command_line.hpp"
#include "reckon/tools/command_line/command_text.hpp"
#include "reckon/tools/command_line/output_file.hpp"
#include "reckon/tools/command_line/status_line.hpp"
#include "reckon/tools/command_line/verb_rows.hpp"

namespace reckon::bench {
namespace {

constexpr std::string_view kSummary =
    "Says which stiffness and damping of a wall a device can show, sampled and with its delay: the "
    "border of passivity by theory, and measured, sample by sample with held forces.\n\n"
    "SCENE is a scene file, whose [[device]] tables say damping, rate, delay and largest stiffness "
    "(the mass stands in none: --mass); flags go before what it says. Without one: 0.1 kg, "
    "1 N s/m, 1 kHz, no delay.";
constexpr std::string_view kExamples =
    "reckon zwidth\n"
    "reckon zwidth --damping 2 --rate 4kHz --delay 1ms --report zwidth.html\n"
    "reckon zwidth two_hands.toml --device 2 --walls 0..0.5/11\n"
    "reckon zwidth --delay 20ms --json | jq .passive";

constexpr std::size_t kDampings = 21;

struct ZWidthWords {
  std::string scene, mass, damping, rate, walls, csv, svg, report;
  std::optional<std::uint64_t> device;
  std::optional<std::chrono::nanoseconds> delay;
  bool json = false;
};

double one_value(const std::string& text, const ValueRule& rule, std::string_view flag) {
  const std::vector<double> values = read_values(text, rule, flag);
  if (values.size() == 1) return values.front();
  throw tools::UsageError(fmt::format("{}: '{}' is more than one value; give one", flag, text));
}

/// All devices of the scene, peer by peer.
std::vector<peer::DeviceConfig> devices_of_all(const peer::SceneFile& scene) {
  std::vector<peer::DeviceConfig> all;
  for (std::uint32_t number = 1; number <= peer::peers_of(scene); ++number)
    for (peer::DeviceConfig& device : peer::devices_of(scene, number)) {
      device.peer = number;
      all.push_back(device);
    }
  return all;
}

/// What the scene says of the device, and its name.
struct SceneDeviceChoice {
  ZWidthDevice device;
  std::string name;
};

SceneDeviceChoice device_in_scene(const ZWidthWords& words) {
  const peer::SceneFile scene = [&] {
    try {
      return peer::load_scene_file(words.scene);
    } catch (const peer::SceneFileError& error) {
      throw tools::UsageError(error.what());
    }
  }();
  const std::vector<peer::DeviceConfig> all = devices_of_all(scene);
  if (all.empty())
    throw tools::UsageError(
        fmt::format("{}: no peer of it has a device; leave SCENE out and say what "
                    "yours is by flags",
                    words.scene));
  const std::uint64_t number = words.device.value_or(1);
  if (number < 1 || number > all.size())
    throw tools::UsageError(fmt::format("--device: {} is not from 1 to {}, which {} has", number,
                                        all.size(), words.scene));
  const peer::DeviceConfig& chosen = all[number - 1];
  ZWidthDevice device;
  device.damping = chosen.damping;
  device.period = pdu::to_seconds(chosen.period);
  device.delay_samples = chosen.delay_samples;
  device.max_stiffness = chosen.max_stiffness;
  std::string name =
      fmt::format("device {} of {} in {} (peer {})", number, all.size(), words.scene, chosen.peer);
  return {device, chosen.marking.empty() ? name : name + " " + chosen.marking};
}

void apply_flags(const ZWidthWords& words, ZWidthDevice& device) {
  if (!words.mass.empty()) device.mass = one_value(words.mass, {"kg", 1e-3, 100, false}, "--mass");
  if (!words.damping.empty())
    device.damping = one_value(words.damping, {"N s/m", 0, 1000, true}, "--damping");
  const double old_delay = device.period * device.delay_samples;
  if (!words.rate.empty())
    device.period = 1 / one_value(words.rate, {"Hz", 100, 10'000, false}, "--rate");
  const double delay = words.delay ? pdu::to_seconds(*words.delay) : old_delay;
  const double samples = std::ceil(delay / device.period - 1e-9);
  if (!(samples <= haptics::SimulatedDevice::kMostDelay))
    throw tools::UsageError(fmt::format("--delay: {} are {:.0f} samples at {}; {} are the most",
                                        peer::format_quantity(delay, "s"), samples,
                                        peer::format_quantity(1 / device.period, "Hz"),
                                        haptics::SimulatedDevice::kMostDelay));
  device.delay_samples = static_cast<int>(samples);
  if (!(device.damping > 0))
    throw tools::UsageError(
        fmt::format("{}: a device without damping shows no wall; give it some by "
                    "--damping",
                    words.scene));
}

std::vector<double> dampings_of(const ZWidthWords& words, const ZWidthDevice& device) {
  const std::string walls =
      words.walls.empty() ? fmt::format("0..{}/{}", device.damping, kDampings) : words.walls;
  return read_values(walls, {"N s/m", 0, 1000, false}, "--walls");
}

/// Rows, or none where the user ended it.
std::vector<ZWidthRow> measured(const ZWidthDevice& device, const std::vector<double>& dampings,
                                const tools::Console& console) {
  const auto now = [] { return std::chrono::steady_clock::now().time_since_epoch(); };
  tools::StatusLine line(console.err, now());
  auto rows = run_zwidth(device, dampings, [&](std::size_t done, std::size_t all) {
    if (line.due(now())) line.show(fmt::format("{} of {} dampings", done, all), now());
    return !console.stopped();
  });
  line.clear();
  return rows;
}

int run_zwidth_verb(tools::Arguments arguments, const tools::Console& console) {
  ZWidthWords words;
  tools::CommandLine line("zwidth", kSummary, kExamples);
  line.word("SCENE", words.scene, false, "scene file whose device is looked at");
  line.option("--device", words.device, "which device of SCENE, from 1, peer by peer (1)");
  line.option("--mass", words.mass, "of the handle and what moves with it (100g)");
  line.option("--damping", words.damping, "of the device itself (1 N s/m)");
  line.option("--rate", words.rate, "of the servo (1kHz)");
  line.option("--delay", words.delay,
              "until a force is at the handle; whole periods, rounded up (0s)");
  line.option("--walls", words.walls,
              "dampings of the wall, as 0..0.5/11 or 0,0.2,0.4 N s/m (21, up to the device's)");
  line.option("--csv", words.csv, "write all figures to this file");
  line.option("--svg", words.svg, "write the picture to this file");
  line.option("--report", words.report, "write one HTML page with picture and table");
  line.flag("--json", words.json, "one JSON object for each damping");
  if (const auto status = line.parse(arguments, console)) return *status;

  if (words.device && words.scene.empty())
    throw tools::UsageError("--device names one of a SCENE; name the scene too");
  ZWidthReport report;
  report.command = tools::command_text("zwidth", arguments);
  if (!words.scene.empty()) {
    const SceneDeviceChoice choice = device_in_scene(words);
    report.device = choice.device;
    report.subject = choice.name;
  }
  apply_flags(words, report.device);
  const std::vector<double> dampings = dampings_of(words, report.device);
  for (const std::string& path : {words.csv, words.svg, words.report}) tools::check_writable(path);
  report.rows = measured(report.device, dampings, console);
  if (report.rows.empty()) {
    fmt::print(console.err, "stopped before the end: no table\n");
    return tools::exit_status(tools::ExitCode::good);
  }
  fmt::print(console.out, "{}", words.json ? zwidth_json(report) : zwidth_text(report));
  tools::write_output(words.csv, zwidth_csv(report), console);
  tools::write_output(words.svg, zwidth_svg(report), console);
  tools::write_output(words.report, zwidth_page(report), console);
  return tools::exit_status(tools::ExitCode::good);
}

}  // namespace

namespace verb {

tools::Verb zwidth() { return tools::verb_of(tools::verb_row("zwidth"), run_zwidth_verb); }

}  // namespace verb

}  // namespace reckon::bench
