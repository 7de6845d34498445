// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A Novint Falcon as the servo sees it.
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>

#include "reckon/haptics/devices/haptic_device.hpp"
#include "reckon/haptics/falcon/falcon_exchange.hpp"

namespace reckon::haptics {

/// What is not in the device's own data.
struct FalconSettings {
  /// Of an exchange: a command waits for the next USB frame (1 ms), and the chip keeps the report
  /// until its latency timer of 1 ms.
  static constexpr std::chrono::milliseconds kExchange{2};
  static constexpr double kMostForce = 8.9;  ///< [N], by its maker
  /// Share of the stated damping that is left for the servo. The rest answers for torques that stay
  /// as they are while the handle turns the arms.
  static constexpr double kSureShare = 0.9;

  /// [N s/m], taken as sure where nobody has measured it: a low guess, for none is published.
  static constexpr double kAssumedDamping = 0.3;
  /// Of the chain where nobody has measured it: three exchanges.
  static constexpr std::chrono::nanoseconds kChain = 3 * kExchange;

  double max_force = kMostForce;  ///< [N], > 0; more than kMostForce is no more
  double damping = 0.0;           ///< [N s/m], >= 0, that one is sure of
  double max_stiffness = 0.0;     ///< [N/m], 0 = as much as damping, period and delay allow
  double max_speed = 2.0;         ///< [m/s]
  std::chrono::nanoseconds period{1'000'000};  ///< of the servo
  /// Of the whole chain, > 0, rounded up to periods. Where it is too short readings fail, more
  /// often the shorter it is, and no energy is made.
  std::chrono::nanoseconds chain = kChain;
};

/// What a servo relies on. @throws std::invalid_argument for settings out of their range
[[nodiscard]] DeviceLimits falcon_limits(const FalconSettings& settings);

/// Reads and writes are atomics and copies: no lock, no allocation, no system call. Another thread
/// (FalconLoop) has the device.
///
/// Its delay is fixed, though the device is not in step with the servo. A force waits for one
/// exchange at most, is held for one, and the report that ends it comes after a third. Each report
/// tells which writes it stands between. A read shows the last report before which only forces were
/// held that are `delay` writes old, so that the ledger books each way of the handle under the very
/// force that was held. Where that report has not come, or the device is gone, the reading fails.
class FalconDevice final : public HapticDevice {
 public:
  /// @param exchange outlives it. @throws std::invalid_argument for settings out of their range
  FalconDevice(FalconExchange& exchange, const FalconSettings& settings);

  [[nodiscard]] DeviceLimits limits() const noexcept override { return limits_; }
  [[nodiscard]] DeviceSample read(std::chrono::nanoseconds now) noexcept override;
  void write(const Eigen::Vector3d& force, std::chrono::nanoseconds now) noexcept override;

 private:
  void take_readings() noexcept;

  FalconExchange& exchange_;
  DeviceLimits limits_;
  std::int64_t written_ = 0;
  // Those not shown yet, a ring.
  std::array<FalconReading, 2 * FalconExchange::kReadings> waiting_{};
  std::size_t first_ = 0, count_ = 0;
  FalconReading shown_;
  std::uint32_t run_ = 0;
  bool has_shown_ = false;  // a reading of this run
  bool dropped_ = false;    // the force was, and the servo does not know
};

}  // namespace reckon::haptics
