// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/falcon/falcon_device.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "reckon/haptics/falcon/falcon_kinematics.hpp"

namespace reckon::haptics {
namespace {

using std::chrono::nanoseconds;

void check_setting(bool good, const char* what, double value) {
  if (good) return;
  throw std::invalid_argument(std::string("Falcon: ") + what + ", got " + std::to_string(value));
}

}  // namespace

DeviceLimits falcon_limits(const FalconSettings& settings) {
  check_setting(settings.max_force > 0, "largest force must be above 0 N", settings.max_force);
  check_setting(settings.damping >= 0, "damping must be 0 or more N s/m", settings.damping);
  check_setting(settings.max_stiffness >= 0, "largest stiffness must be 0 or more N/m",
                settings.max_stiffness);
  check_setting(settings.max_speed > 0, "largest speed must be above 0 m/s", settings.max_speed);
  check_setting(settings.period > nanoseconds(0), "the servo's period must be above 0 ns",
                static_cast<double>(settings.period.count()));
  check_setting(settings.chain > nanoseconds(0), "delay must be above 0 ns",
                static_cast<double>(settings.chain.count()));
  DeviceLimits limits;
  limits.max_force = std::min(settings.max_force, FalconSettings::kMostForce);
  limits.damping = FalconSettings::kSureShare * settings.damping;
  limits.max_stiffness = settings.max_stiffness;
  limits.max_speed = settings.max_speed;
  limits.workspace_min = Eigen::Vector3d::Constant(-FalconGeometry::kReach);
  limits.workspace_max = Eigen::Vector3d::Constant(FalconGeometry::kReach);
  limits.resolution = FalconGeometry::kResolution;
  limits.delay_samples =
      static_cast<int>((settings.chain + settings.period - nanoseconds(1)) / settings.period);
  return limits;
}

FalconDevice::FalconDevice(FalconExchange& exchange, const FalconSettings& settings)
    : exchange_(exchange), limits_(falcon_limits(settings)) {}

void FalconDevice::take_readings() noexcept {
  FalconReading reading;
  while (exchange_.readings.pop(reading)) {
    if (reading.run != run_) {
      dropped_ = dropped_ || has_shown_;
      run_ = reading.run;
      has_shown_ = false;
      count_ = 0;
    }
    if (count_ == waiting_.size()) return;
    waiting_[(first_ + count_++) % waiting_.size()] = reading;
  }
}

DeviceSample FalconDevice::read(nanoseconds) noexcept {
  take_readings();
  // Before the first write the device holds none, number 0.
  const std::int64_t due = std::max<std::int64_t>(0, written_ - limits_.delay_samples);
  while (count_ > 0 && waiting_[first_].before <= due) {
    shown_ = waiting_[first_];
    has_shown_ = true;
    first_ = (first_ + 1) % waiting_.size();
    --count_;
  }
  DeviceSample sample;
  sample.ok = has_shown_ && shown_.after > due;
  if (!sample.ok) return sample;
  sample.position = shown_.position;
  sample.buttons = shown_.buttons;
  sample.watchdog = dropped_;
  dropped_ = false;
  return sample;
}

void FalconDevice::write(const Eigen::Vector3d& force, nanoseconds now) noexcept {
  FalconForce& newest = exchange_.force.write_slot();
  newest.force = force.allFinite() ? force : Eigen::Vector3d(Eigen::Vector3d::Zero());
  newest.number = ++written_;
  newest.at = now;
  exchange_.force.publish();
}

}  // namespace reckon::haptics
