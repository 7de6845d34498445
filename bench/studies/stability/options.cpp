// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/bench/studies/stability/options.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <functional>
#include <memory>
#include <sstream>
#include <utility>

#include "reckon/bench/studies/sweep/values.hpp"
#include "reckon/pdu/seconds.hpp"
#include "reckon/peer/notation/units.hpp"
#include "reckon/peer/scene/belongings.hpp"
#include "reckon/peer/tracks/hand_trace_file.hpp"

namespace reckon::bench {
namespace {

constexpr double kRecordedExtent = 0.02;  // [m]
constexpr double kRecordedMiddle = 0.004;
constexpr double kRecordedWay = 0.5;  // [s], from kCouplingStart to the start of the recording

CouplingMode read_mode(std::string_view name) {
  if (const auto mode = coupling_mode(name)) return *mode;
  std::vector<std::string_view> names;
  for (const CouplingMode mode : kCouplingModes) names.push_back(name_of(mode));
  refuse_name("--coupling", name, names, ", all");
}

/// In the order of the list, each once.
std::vector<CouplingMode> read_modes(const std::vector<std::string>& words) {
  std::vector<CouplingMode> asked;
  for (const std::string& word : words)
    for (const std::string_view name : parts_between_commas(word)) {
      if (name == "all")
        asked.insert(asked.end(), kCouplingModes.begin(), kCouplingModes.end());
      else
        asked.push_back(read_mode(name));
    }
  if (words.empty()) return {kCouplingModes.begin(), kCouplingModes.end()};
  std::vector<CouplingMode> modes;
  for (const CouplingMode mode : kCouplingModes)
    if (std::ranges::count(asked, mode) > 0) modes.push_back(mode);
  return modes;
}

peer::SceneFile read_scene(const std::string& path) {
  try {
    return peer::load_scene_file(path);
  } catch (const peer::SceneFileError& error) {
    throw tools::UsageError(error.what());
  }
}

/// The first device of the scene's first peer that has one.
peer::DeviceConfig first_device(const peer::SceneFile& scene, const std::string& path) {
  for (std::uint32_t number = 1; number <= peer::peers_of(scene); ++number) {
    const auto devices = peer::devices_of(scene, number);
    if (!devices.empty()) return devices.front();
  }
  throw tools::UsageError(fmt::format("{}: no peer has a device, so no hand can touch", path));
}

/// Settings of the scene that the study ignores.
std::vector<std::string> left_out(const peer::SceneFile& scene, const peer::DeviceConfig& device) {
  std::vector<std::string> notes;
  const peer::ImpairmentLaw& law = scene.impairment.law;
  const auto note = [&](bool there, std::string_view what) {
    if (there) notes.push_back(fmt::format("{} of the scene is not part of this study", what));
  };
  note(device.delay_samples > 0, "[[device]] delay");
  note(device.resolution > 0, "[[device]] resolution");
  note(device.max_stiffness > 0, "[[device]] max_stiffness");
  note(scene.hand.k3 > 0, "[hand] k3 (environment=hardening has its own)");
  note(law.burst_loss > 0, "[impairment] burst_loss");
  note(law.duplicate > 0, "[impairment] duplicate");
  note(!law.outages.empty(), "[[impairment.outage]]");
  return notes;
}

void apply_scene(const std::string& path, StabilityOptions& options) {
  const peer::SceneFile scene = read_scene(path);
  const peer::DeviceConfig device = first_device(scene, path);
  StabilitySetting& base = options.plan.base;
  base.run.device.damping = device.damping;
  base.run.device.period = pdu::to_seconds(device.period);
  base.stiffness = scene.hand.k1;
  const peer::ImpairmentLaw& law = scene.impairment.law;
  base.run.network.delay = law.delay;
  base.run.network.jitter = law.jitter;
  base.run.network.loss = law.loss;
  base.run.network.reorder = law.reorder;
  base.run.network.reorder_delay = law.reorder_delay;
  options.plan.seed = scene.impairment.seed;
  options.notes = left_out(scene, device);
}

double read_peak(const std::string& text) {
  const auto values = read_values(text, {"N", 0, 1e6, true}, "--peak");
  if (values.size() == 1) return values.front();
  throw tools::UsageError(fmt::format("--peak: '{}' is more than one force; write one", text));
}

double read_length(std::chrono::nanoseconds length) {
  const double seconds = pdu::to_seconds(length);
  if (seconds >= 3 && seconds <= 3600) return seconds;
  throw tools::UsageError(
      "--for: write 3s to 1h: hands touch after 1s, and the last third is evaluated");
}

/// Position and speed along one axis of a recording.
struct RecordedAxis {
  int axis;
  double sign, middle, scale;

  [[nodiscard]] double position(const haptics::HandTarget& target) const {
    return kRecordedMiddle + sign * scale * (target.position[axis] - middle);
  }
  [[nodiscard]] double velocity(const haptics::HandTarget& target) const {
    return sign * scale * target.velocity[axis];
  }
};

/// Whether any cell is random.
bool draws(const StabilityPlan& plan) {
  for (std::size_t cell = 0; cell < plan.cells(); ++cell) {
    const peer::ImpairmentLaw law = plan.setting(cell).run.network;
    if (law.loss > 0 || law.reorder > 0 || law.jitter.count() > 0) return true;
  }
  return false;
}

/// Name and hash of the content, so that no study continues with another recording of the same
/// name.
std::string identity_of(const std::string& file) {
  std::ifstream in(file, std::ios::binary);
  std::stringstream content;
  content << in.rdbuf();
  return fmt::format("{} ({:016x})", file, std::hash<std::string>{}(content.str()));
}

}  // namespace

OperatorModel recorded_operator(const std::string& file) {
  const auto trace = [&] {
    try {
      return std::make_shared<const haptics::HandTrace>(peer::read_hand_trace(file));
    } catch (const std::exception& error) {
      throw tools::UsageError(fmt::format("--hand: {}", error.what()));
    }
  }();
  const Eigen::AlignedBox3d bounds = trace->bounds();
  int axis = 0;
  const double extent = bounds.sizes().maxCoeff(&axis);
  if (!(extent > 0))
    throw tools::UsageError(fmt::format("--hand: {}: the hand does not move", file));
  const RecordedAxis along{axis, axis == 2 ? -1.0 : 1.0, bounds.center()[axis],
                           std::min(1.0, kRecordedExtent / extent)};
  OperatorModel hand = operator_model(OperatorKind::tracking);
  hand.script = [trace, along](double time) {
    const double played = time - kCouplingWait - kRecordedWay;
    const haptics::HandTarget there = trace->at(std::max(0.0, played));
    haptics::HandTarget target;
    target.position.x() = kCouplingStart;
    if (time < kCouplingWait) return target;
    if (played >= 0) {
      target.position.x() = along.position(there);
      target.velocity.x() = along.velocity(there);
      return target;
    }
    const double u = 1 + played / kRecordedWay;
    const double way = along.position(there) - kCouplingStart;
    target.position.x() += way * u * u * u * (10 + u * (6 * u - 15));
    target.velocity.x() = way * 30 * u * u * (1 - u) * (1 - u) / kRecordedWay;
    return target;
  };
  return hand;
}

std::vector<Flag> StabilityWords::flags() {
  std::vector<std::string_view> names, known;
  for (const StabilityParameter& parameter : stability_parameters())
    names.push_back(parameter.name);
  for (const CouplingMode mode : kCouplingModes) known.push_back(name_of(mode));
  return {{"--sweep", &sweeps,
           fmt::format("stability: NAME=A..B/N or NAME=A,B,C, once per axis; other values are as "
                       "in FILE; names: {}",
                       fmt::join(names, ", "))},
          {"--coupling", &modes,
           fmt::format("stability: modes separated by commas, or all (the default): {}",
                       fmt::join(known, ", "))},
          {"--no-gate", &no_gate,
           "stability: the mode reckon without its energy port; all results are marked"},
          {"--hand", &hand, "stability: recorded trace that the hand follows"},
          {"--peak", &peak, "stability: force above which peaks are counted (10 N)"}};
}

StabilityOptions read_stability_options(const StabilityWords& words) {
  StabilityOptions options;
  StabilityPlan& plan = options.plan;
  if (words.files.size() > 1)
    throw tools::UsageError("bench stability reads one FILE, the scene: remove the others");
  const bool has_scene = !words.files.empty();
  if (has_scene) apply_scene(words.files.front(), options);
  if (!words.modes.empty() || plan.modes.empty()) plan.modes = read_modes(words.modes);
  for (const std::string& sweep : words.sweeps) plan.axes.push_back(read_stability_axis(sweep));
  if (words.sweeps.empty() && !has_scene && words.hand.empty()) plan.axes = default_axes();
  if (words.seed) plan.seed = *words.seed;
  if (words.length) plan.base.run.duration = read_length(*words.length);
  plan.peak = read_peak(words.peak);
  plan.gate = !words.no_gate;
  if (!plan.gate && std::ranges::count(plan.modes, CouplingMode::reckon) == 0)
    throw tools::UsageError(
        "--no-gate needs the mode reckon: add it to --coupling, or remove --no-gate");
  if (!words.hand.empty()) {
    plan.base.recorded = recorded_operator(words.hand);
    plan.base.operator_number = kRecordedOperator;
    plan.trace_file = identity_of(words.hand);
  }
  for (const StabilityAxis& axis : plan.axes)
    if (!words.hand.empty() && axis.parameter->name == "operator" &&
        std::ranges::count(axis.values, static_cast<double>(kRecordedOperator)) == 0)
      throw tools::UsageError(
          "--hand: the swept operators lack trace; add it, as in operator=push,trace");
  check(plan);
  if (words.seed && !draws(plan))
    throw tools::UsageError(
        "--seed: this run has no randomness; sweep loss, reorder or jitter_share, or remove "
        "--seed");
  return options;
}

}  // namespace reckon::bench
