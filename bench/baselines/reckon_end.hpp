// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The servo of the product as an end of a coupling study; it is not a copy.
#pragma once

#include <cstdint>

#include "reckon/bench/baselines/coupling_end.hpp"
#include "reckon/haptics/devices/haptic_device.hpp"
#include "reckon/haptics/servo/servo_loop.hpp"

namespace reckon::bench {

/// The handle as a device of the servo; the study moves it.
class StudyHandle final : public haptics::HapticDevice {
 public:
  explicit StudyHandle(const haptics::DeviceLimits& limits) noexcept : limits_(limits) {}

  void move(double position, double velocity) noexcept;
  [[nodiscard]] double force() const noexcept { return force_; }

  [[nodiscard]] haptics::DeviceLimits limits() const noexcept override { return limits_; }
  [[nodiscard]] haptics::DeviceSample read(std::chrono::nanoseconds now) noexcept override;
  void write(const Eigen::Vector3d& force, std::chrono::nanoseconds now) noexcept override;

 private:
  haptics::DeviceLimits limits_;
  haptics::DeviceSample sample_;
  double force_ = 0.0;
};

/// A ServoLoop against a server's tangent or against another hand. Without the gate the servo gets
/// a device with unlimited damping: then the energy port never limits the force, while stiffness
/// and rates stay limited as for the true device.
class ReckonEnd final : public CouplingEnd {
 public:
  explicit ReckonEnd(const CouplingEndConfig& config);

  double step(const OwnMotion& own, std::span<const CouplingSample> arrived) noexcept override;
  [[nodiscard]] CouplingSample sample() noexcept override;
  [[nodiscard]] double loan() const noexcept override { return loan_; }

 private:
  void take(const CouplingSample& sample) noexcept;
  [[nodiscard]] std::chrono::nanoseconds time_of(std::uint32_t number) const noexcept;

  CouplingEndConfig config_;
  StudyHandle handle_;
  haptics::ServoLoop servo_;
  haptics::ContactSet set_;
  std::uint32_t number_ = 0;
  double loan_ = 0.0;
};

}  // namespace reckon::bench
