// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The servo's view of a force feedback device of Linux, and the buffers that it shares with the
// device's thread.
#pragma once

#include <Eigen/Core>
#include <chrono>
#include <cstdint>
#include <string>

#include "reckon/haptics/devices/coefficient_device.hpp"
#include "reckon/haptics/evdev/condition_effect.hpp"
#include "reckon/haptics/exchange/triple_buffer.hpp"

namespace reckon::haptics {

/// Which device to use, and what the device does not report.
struct EvdevSettings {
  /// Default delay, from the instant of a position to the instant when the device renders the model
  /// that the servo made from it.
  static constexpr std::chrono::milliseconds kChain{8};

  std::string event;  ///< path of its event device, or a part of its name; empty: the first
  int axes = 2;       ///< 1: ABS_X; 2: ABS_Y too
  EffectScale scale;
  double max_force = 1e9;      ///< [N] > 0; limited to full_force
  double max_stiffness = 0.0;  ///< [N/m] > 0, the stiffest wall that it renders without oscillation
  double max_speed = 2.0;      ///< [m/s] > 0, of the handle
  std::chrono::nanoseconds chain = kChain;
};

/// The limits that a servo relies on. @throws std::invalid_argument: a number is missing; names its
/// key in [[device]]
[[nodiscard]] DeviceLimits evdev_limits(const EvdevSettings& settings);

/// A model and when the servo requested it.
struct StatedModel {
  SpringModel model;
  std::chrono::nanoseconds at{0};
  bool is_stated = false;
};

/// State of the device as its thread read it.
struct EvdevReading {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< [m], frame D
  std::uint32_t buttons = 0;
  bool is_there = false;
  std::chrono::nanoseconds at{0};
  std::chrono::nanoseconds placed_at{0};  ///< instant of the position
  ShownModel shown;
};

/// Neither side waits for the other.
struct EvdevExchange {
  TripleBuffer<StatedModel> model;
  TripleBuffer<EvdevReading> reading;
};

/// Reads and writes are atomics and copies: no lock, no allocation, no system call. The device
/// belongs to the thread of EvdevLoop. A reading is valid while that thread runs and the device is
/// attached: a handle at rest sends no events.
class EvdevDevice final : public CoefficientDevice {
 public:
  /// @param exchange outlives it  @param limits see evdev_limits()
  EvdevDevice(EvdevExchange& exchange, const DeviceLimits& limits)
      : exchange_(exchange), limits_(limits) {}

  [[nodiscard]] DeviceLimits limits() const noexcept override { return limits_; }
  [[nodiscard]] DeviceSample read(std::chrono::nanoseconds now) noexcept override;
  void state(const SpringModel& wanted, std::chrono::nanoseconds now) noexcept override;
  /// Empty once the device's thread has published nothing for longer than an effect last read()s:
  /// the device has ended its effects.
  [[nodiscard]] ShownModel shown() const noexcept override;

 private:
  EvdevExchange& exchange_;
  DeviceLimits limits_;
  std::chrono::nanoseconds read_at_{0};    // last
  std::chrono::nanoseconds placed_at_{0};  // of the last valid reading
};

}  // namespace reckon::haptics
