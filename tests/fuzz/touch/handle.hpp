// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// What a hand of a scenario holds: a simulated device, or the model of a real one with its line and
// the thread that has it.
#pragma once

#include <Eigen/Core>
#include <chrono>
#include <functional>

#include "reckon/haptics/devices/simulated_device.hpp"

namespace reckon::fuzz {

class Handle {
 public:
  virtual ~Handle() = default;
  Handle() = default;
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;

  [[nodiscard]] virtual haptics::HapticDevice& device() = 0;
  /// What its forces took from the hand [J], of its own books.
  [[nodiscard]] virtual double port_work() const = 0;
  /// And what its damping took [J].
  [[nodiscard]] virtual double work() const = 0;
  /// Most that work() was since the instant of which the servo's meter tells [J]; none where that
  /// is too long ago.
  [[nodiscard]] virtual double work_known() const { return work(); }
  /// Most that whole steps of its forces may have put into the books of the servo [J].
  [[nodiscard]] virtual double rounding() const { return 0; }
  /// Whether the next reading fails, at a cost that is estimated.
  [[nodiscard]] virtual bool fails() const { return false; }
  /// Of its own [N].
  [[nodiscard]] virtual Eigen::Vector3d force() const = 0;
  /// For how long the servo stands still from now on, beside its period.
  [[nodiscard]] virtual std::chrono::nanoseconds silence() { return {}; }
  /// Whether it tells that it shows nothing now.
  [[nodiscard]] virtual bool tells_why() const { return false; }
  /// Whether the hand kept within what is stated of the device.
  [[nodiscard]] virtual bool keeps_limits() const { return true; }
};

/// Holds its force through a reading that fails, as hardware does.
class SimulatedHandle final : public Handle, private haptics::SimulatedDevice {
 public:
  using SimulatedDevice::enable;
  using SimulatedDevice::SimulatedDevice;
  /// So many of the readings to come.
  void fail(int readings) { failures_ = readings; }

  [[nodiscard]] haptics::HapticDevice& device() override { return *this; }
  [[nodiscard]] double port_work() const override { return SimulatedDevice::port_work(); }
  [[nodiscard]] double work() const override { return port_work() + damping_loss(); }
  [[nodiscard]] bool fails() const override { return failures_ > 0; }
  [[nodiscard]] Eigen::Vector3d force() const override { return SimulatedDevice::force(); }

 private:
  [[nodiscard]] haptics::DeviceSample read(std::chrono::nanoseconds now) noexcept override;

  int failures_ = 0;
};

}  // namespace reckon::fuzz
