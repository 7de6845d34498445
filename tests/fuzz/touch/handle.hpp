// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The device of a hand in a scenario: a simulated one, or the model of a real one with its line and
// thread.
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
  /// Energy that its forces took from the hand [J], by its own ledger.
  [[nodiscard]] virtual double port_work() const = 0;
  /// The same, with the energy taken by its damping [J].
  [[nodiscard]] virtual double work() const = 0;
  /// Greatest work() since the instant of the servo's meter [J]; none if that is too long ago.
  [[nodiscard]] virtual double work_known() const { return work(); }
  /// Greatest energy that whole force steps may have put into the servo's ledger [J].
  [[nodiscard]] virtual double rounding() const { return 0; }
  /// Whether the next reading fails; its energy is then estimated.
  [[nodiscard]] virtual bool fails() const { return false; }
  /// Its actual force [N].
  [[nodiscard]] virtual Eigen::Vector3d force() const = 0;
  /// How long the servo pauses from now on, besides its period.
  [[nodiscard]] virtual std::chrono::nanoseconds silence() { return {}; }
  /// Whether it reports that it shows no force now.
  [[nodiscard]] virtual bool tells_why() const { return false; }
  /// Whether the hand kept within the stated limits of the device.
  [[nodiscard]] virtual bool keeps_limits() const { return true; }
};

/// Holds its force through a failed reading, as hardware does.
class SimulatedHandle final : public Handle, private haptics::SimulatedDevice {
 public:
  using SimulatedDevice::enable;
  using SimulatedDevice::SimulatedDevice;
  /// Fails this many of the next readings.
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
