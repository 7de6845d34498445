// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The product's own servo as an end of a coupling study: nothing of it is copied here.
#pragma once

#include <cstdint>

#include "reckon/bench/baselines/coupling_end.hpp"
#include "reckon/haptics/devices/haptic_device.hpp"
#include "reckon/haptics/servo/servo_loop.hpp"

namespace reckon::bench {

/// The handle as the servo is told of it, moved by the study.
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

/// A ServoLoop against a server's tangent or against another hand. Without the gate the servo is
/// told of a device that damps without end: then the energy port answers for everything, while
/// stiffness and rates stay limited as the true device asks for.
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
