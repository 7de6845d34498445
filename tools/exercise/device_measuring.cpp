// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/exercise/device_measuring.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <stdexcept>

#include "reckon/pdu/seconds.hpp"

namespace reckon::tools {
namespace {

using haptics::MeasurementProblem;

constexpr std::chrono::milliseconds kPeriod{1};

std::string point_text(const Eigen::Vector3d& place) {
  return fmt::format("\"{:.4g} {:.4g} {:.4g} mm\"", 1e3 * place.x(), 1e3 * place.y(),
                     1e3 * place.z());
}

}  // namespace

haptics::SimulatedDeviceConfig free_device_of(const peer::DeviceDescriptor& device) {
  const double period = pdu::to_seconds(kPeriod);
  haptics::SimulatedDeviceConfig config;
  config.mass = device.mass;
  config.damping = device.damping;
  config.friction = device.friction;
  config.hand_stiffness = config.hand_damping = 0.0;
  config.max_force = device.max_force;
  config.max_speed = device.max_speed;
  config.max_stiffness = device.max_stiffness;
  config.delay_samples = static_cast<int>(std::ceil(pdu::to_seconds(device.delay) / period - 1e-6));
  config.resolution = device.resolution;
  if (device.axes != 6) return config;
  config.turn.emplace();
  config.turn->inertia = device.inertia;
  config.turn->damping = device.turn_damping;
  config.turn->max_torque = device.max_torque;
  config.turn->resolution = device.turn_resolution;
  return config;
}

std::string_view sentence_of(MeasurementProblem problem) noexcept {
  switch (problem) {
    case MeasurementProblem::readings:
      return "its readings fail: plug it in, and home it";
    case MeasurementProblem::switch_off:
      return "the operator's switch was released: hold only the switch";
    case MeasurementProblem::restless:
      return "it moves without a force: place the handle where its weight does not move it, and "
             "release it";
    case MeasurementProblem::speed:
      return "it moved faster than 0.6 m/s: release the handle; if you have, it is too light to "
             "measure safely";
    case MeasurementProblem::place:
      return "it moved farther than 40 mm: release the handle; if you have, its friction is too "
             "low to measure safely";
    case MeasurementProblem::active:
      return "it accelerates after the push: release the handle; if you have, it gains energy by "
             "itself and cannot be used";
    case MeasurementProblem::stuck:
      return "the greatest safe push does not move it by 5 mm: release the handle; if you have, it "
             "has too much dry friction";
    case MeasurementProblem::late:
      return "its forces are more than 50 ms late, which allows no walls";
    case MeasurementProblem::unlike:
      return "it does not move like a mass with friction: release the handle, or detach its spring";
    case MeasurementProblem::busy:
      return "this host was too busy for a valid result: end other programs, and allow real-time "
             "priority (see `reckon doctor`)";
    case MeasurementProblem::none:
      break;
  }
  return {};
}

haptics::MeasuredDevice measure_simulated(const peer::DeviceDescriptor& device) {
  constexpr std::chrono::minutes kLongest{10};
  if (device.axes != 3) throw std::runtime_error("only devices of three axes can be measured");
  haptics::SimulatedDevice simulated(free_device_of(device));
  haptics::DeviceMeasurement run(simulated.limits(), kPeriod);
  for (std::chrono::nanoseconds now{0}; !run.is_done() && now < kLongest; now += kPeriod) {
    simulated.write(run.step(simulated.read(now), now), now);
    if (run.needs_judging()) run.judge();
  }
  if (run.problem() != MeasurementProblem::none)
    throw std::runtime_error(std::string(sentence_of(run.problem())));
  if (!run.result()) throw std::runtime_error("the measurement did not finish within 10 minutes");
  return *run.result();
}

std::string descriptor_text(std::string_view name, const peer::DeviceDescriptor& known,
                            const haptics::MeasuredDevice& found,
                            const std::vector<std::string>& remarks) {
  // Two standard deviations are subtracted from the measured damping.
  const double sure = std::max(0.0, found.damping - 2 * found.damping_error);
  std::string text;
  for (const std::string& remark : remarks) text += fmt::format("# {}\n", remark);
  text += fmt::format("name = \"{}\"\n", name);
  std::string ids;
  for (const peer::UsbId& id : known.usb)
    ids += fmt::format("{}\"{:04x}:{:04x}\"", ids.empty() ? "" : ", ", id.vendor, id.product);
  if (!ids.empty()) text += fmt::format("usb = [{}]\n", ids);
  text += fmt::format("axes = {}\nmax_force = \"{:.6g} N\"\n", known.axes, known.max_force);
  text += fmt::format(
      "damping = \"{:.3g} N s/m\"  # measured {:.3g} +- {:.1g}, twice of which is subtracted\n",
      sure, found.damping, found.damping_error);
  text += fmt::format("friction = \"{:.3g} N\"  # measured\n", found.friction);
  text += fmt::format("delay = \"{:.1f} ms\"  # measured {:.3g}\n", 1e3 * found.delay,
                      1e3 * found.delay);
  // If several encoders determine a position, its steps along an axis are not multiples of one
  // step.
  const bool has_steps = found.resolution > 0 || known.resolution <= 0;
  text += fmt::format("resolution = \"{:.3g} um\"  # {}; noise at rest {:.2g} um\n",
                      1e6 * (has_steps ? found.resolution : known.resolution),
                      has_steps ? "measured" : "known to its driver", 1e6 * found.noise);
  text += fmt::format("mass = \"{:.3g} kg\"  # measured\n", found.mass);
  text += fmt::format("max_stiffness = \"{:.6g} N/m\"\nmax_speed = \"{:.6g} m/s\"\n",
                      known.max_stiffness, known.max_speed);
  return text + fmt::format("work_space = {{ from = {}, to = {} }}\n",
                            point_text(known.work_space.from), point_text(known.work_space.to));
}

}  // namespace reckon::tools
