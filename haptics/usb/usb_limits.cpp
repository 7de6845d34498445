// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/usb/usb_limits.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>

namespace reckon::haptics {
namespace {

using std::chrono::nanoseconds;

}  // namespace

DeviceLimits usb_limits(const UsbFacts& facts, const UsbSettings& settings) {
  const auto check = [&](bool good, const char* what, double value) {
    if (good) return;
    throw std::invalid_argument(std::string(facts.name) + ": " + what + ", got " +
                                std::to_string(value));
  };
  check(settings.max_force > 0, "largest force must be above 0 N", settings.max_force);
  check(settings.damping >= 0, "damping must be 0 or more N s/m", settings.damping);
  check(settings.spent_damping >= 0, "damping that the driver uses must be 0 or more N s/m",
        settings.spent_damping);
  check(settings.joint_damping >= 0, "damping of its joints must be 0 or more N m s/rad",
        settings.joint_damping);
  check(!(settings.joint_damping > 0) || facts.lever > 0,
        "its joints are unknown: state the damping of the handle", settings.joint_damping);
  check(settings.spent_joint_damping >= 0,
        "damping that the driver uses must be 0 or more N m s/rad", settings.spent_joint_damping);
  check(settings.max_stiffness >= 0, "largest stiffness must be 0 or more N/m",
        settings.max_stiffness);
  check(settings.max_speed > 0, "largest speed must be above 0 m/s", settings.max_speed);
  check(settings.resolution >= 0, "resolution must be 0 or more m", settings.resolution);
  check(settings.period > nanoseconds(0), "the servo's period must be above 0 ns",
        static_cast<double>(settings.period.count()));
  check(settings.chain > nanoseconds(0), "delay must be above 0 ns",
        static_cast<double>(settings.chain.count()));
  DeviceLimits limits;
  limits.max_force = std::min(settings.max_force, facts.most_force);
  limits.damping = std::max(0.0, facts.sure_share * settings.damping - settings.spent_damping);
  if (settings.joint_damping > 0) {
    const double sure = facts.sure_share * settings.joint_damping - settings.spent_joint_damping;
    limits.damping = std::max(0.0, sure) / (facts.lever * facts.lever);
    limits.lever = facts.lever;
  }
  limits.max_stiffness = settings.max_stiffness;
  limits.max_speed = settings.max_speed;
  limits.workspace_min = Eigen::Vector3d::Constant(-facts.reach);
  limits.workspace_max = Eigen::Vector3d::Constant(facts.reach);
  limits.resolution = settings.resolution > 0 ? settings.resolution : facts.resolution;
  limits.delay_samples =
      static_cast<int>((settings.chain + settings.period - nanoseconds(1)) / settings.period);
  return limits;
}

}  // namespace reckon::haptics
