// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A force feedback device of Linux as the servo sees it, and what passes between the servo and the
// thread that has it.
#pragma once

#include <Eigen/Core>
#include <chrono>
#include <cstdint>
#include <string>

#include "reckon/haptics/devices/coefficient_device.hpp"
#include "reckon/haptics/evdev/condition_effect.hpp"
#include "reckon/haptics/exchange/triple_buffer.hpp"

namespace reckon::haptics {

/// What is not in the device's own data, and which device it is.
struct EvdevSettings {
  /// From when the handle was where a reading has it to the instant at which the device shows the
  /// model that follows from it.
  static constexpr std::chrono::milliseconds kChain{8};

  std::string event;  ///< path of its event device, or a part of its name; empty: the first
  int axes = 2;       ///< 1: ABS_X; 2: ABS_Y too
  EffectScale scale;
  double max_force = 1e9;      ///< [N] > 0; more than full_force is no more
  double max_stiffness = 0.0;  ///< [N/m] > 0, that it shows without shaking
  double max_speed = 2.0;      ///< [m/s] > 0, of the handle
  std::chrono::nanoseconds chain = kChain;
};

/// What a servo relies on. @throws std::invalid_argument for a number that is missing, with its key
/// in [[device]]
[[nodiscard]] DeviceLimits evdev_limits(const EvdevSettings& settings);

/// A model as the servo stated it.
struct StatedModel {
  SpringModel model;
  std::chrono::nanoseconds at{0};
  bool is_stated = false;
};

/// The device as its thread saw it.
struct EvdevReading {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< [m], frame D
  std::uint32_t buttons = 0;
  bool is_there = false;
  std::chrono::nanoseconds at{0};
  std::chrono::nanoseconds placed_at{0};  ///< when the handle was there
  ShownModel shown;
};

/// Neither side waits for the other.
struct EvdevExchange {
  TripleBuffer<StatedModel> model;
  TripleBuffer<EvdevReading> reading;
};

/// Reads and writes are atomics and copies: no lock, no allocation, no system call. Another thread
/// (EvdevLoop) has the device. A reading is good while that thread runs, and the device is there: a
/// handle that rests sends nothing.
class EvdevDevice final : public CoefficientDevice {
 public:
  /// @param exchange outlives it  @param limits see evdev_limits()
  EvdevDevice(EvdevExchange& exchange, const DeviceLimits& limits)
      : exchange_(exchange), limits_(limits) {}

  [[nodiscard]] DeviceLimits limits() const noexcept override { return limits_; }
  [[nodiscard]] DeviceSample read(std::chrono::nanoseconds now) noexcept override;
  void state(const SpringModel& wanted, std::chrono::nanoseconds now) noexcept override;
  /// Nothing once the device's thread has been silent for longer than an effect lasts: the device
  /// has ended them.
  [[nodiscard]] ShownModel shown() const noexcept override;

 private:
  EvdevExchange& exchange_;
  DeviceLimits limits_;
  std::chrono::nanoseconds read_at_{0};    // last
  std::chrono::nanoseconds placed_at_{0};  // of the last good reading
};

}  // namespace reckon::haptics
