// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A simulated admittance device as the servo uses it.
#pragma once

#include <chrono>
#include <cstdint>
#include <string>
#include <utility>

#include "reckon/haptics/devices/simulated_motion.hpp"
#include "reckon/haptics/devices/virtual_handle.hpp"

namespace reckon::tools {

/// The device, the operator's hand and the virtual mass.
class AdmittanceHand final : public haptics::HapticDevice {
 public:
  /// @throws std::invalid_argument for values out of range.
  AdmittanceHand(const haptics::SimulatedMotionConfig& motion, haptics::HandScript script,
                 const haptics::VirtualHandleConfig& handle)
      : motion_(motion, std::move(script)), handle_(motion_, handle), own_mass_(handle.mass) {}

  [[nodiscard]] haptics::DeviceLimits limits() const noexcept override { return handle_.limits(); }
  [[nodiscard]] haptics::DeviceSample read(std::chrono::nanoseconds now) noexcept override {
    return handle_.read(now);
  }
  void write(const Eigen::Vector3d& force, std::chrono::nanoseconds now) noexcept override {
    handle_.write(force, now);
  }

  /// A sentence when the device could not follow its hand for the first time, and again each time
  /// the count has doubled since the last report; else empty. May be called by any one thread.
  [[nodiscard]] std::string take_notice();

 private:
  haptics::SimulatedMotion motion_;
  haptics::VirtualHandle handle_;
  double own_mass_;
  std::uint64_t told_ = 0;
};

}  // namespace reckon::tools
