// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// An admittance device as one that takes forces: the measured force of the hand and the force of
// the scene move a virtual mass, and the device goes where the mass is.
#pragma once

#include <Eigen/Core>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <optional>

#include "reckon/haptics/devices/motion_device.hpp"

namespace reckon::haptics {

/// What the hand feels while nothing else is there, and how exact the device's motion must be.
struct VirtualHandleConfig {
  double mass = 2.0;       ///< [kg] > 0
  double damping = 2.0;    ///< [N s/m] > 0; all of it counts as sure, for it is computed
  double max_force = 0.0;  ///< [N], of the scene; 0: what the sensor measures
  double loan = 10e-3;     ///< [J] >= 0, that the device's motion may owe the mass's
  /// After a write the scene's force ends by itself, > 0 and at most HapticDevice::kWatchdog.
  std::chrono::nanoseconds hold = HapticDevice::kWatchdog;
};

/// Between two reads the mass goes as m v' = f - b v + F with the mean f of the hand's two forces
/// and the scene's held force F, in closed form: so b |dx|^2 / dt is less than what its damping
/// takes, as the servo's port counts it, at any rate.
///
/// Energy at the real handle is f dx of the device's own, measured motion, and its motors may do
/// work that no mass has: they lag, overshoot, swing with a stiff grip. So the hand's work on the
/// mass is kept within its work on the device and the loan. Where it would go beyond, the mass goes
/// a shorter way and is as much slower, in which it loses energy (the port's account stays what it
/// is: it is concave in that share), becomes twice as heavy at the same momentum, and the debt is
/// written off; from then on it becomes lighter by half in two seconds, at the same speed. So a
/// device that is too slow for the grip feels heavy and does not swing, and gives the hand at most
/// a loan more than it got each time. At kMostHeavy times its mass it is only slowed.
class VirtualHandle final : public HapticDevice {
 public:
  static constexpr double kMostHeavy = 64.0;
  /// @param device outlives it
  /// @throws std::invalid_argument for values out of range.
  VirtualHandle(MotionDevice& device, const VirtualHandleConfig& config);

  /// Of an impedance device: the mass is exact, at once, and has a damping that is sure.
  [[nodiscard]] DeviceLimits limits() const noexcept override;
  /// Moves the mass from the last read to `now`. At most kWatchdog after it; a later read finds it
  /// at rest where the device is.
  [[nodiscard]] DeviceSample read(std::chrono::nanoseconds now) noexcept override;
  void write(const Eigen::Vector3d& force, std::chrono::nanoseconds now) noexcept override;

  /// Of the hand, as last measured [N].
  [[nodiscard]] const Eigen::Vector3d& hand_force() const noexcept { return hand_; }
  /// How often the mass became heavier because the device could not follow. Any thread.
  [[nodiscard]] std::uint64_t heavier() const noexcept {
    return heavier_.load(std::memory_order_relaxed);
  }
  /// Of the mass now [kg].
  [[nodiscard]] double mass() const noexcept { return mass_; }
  /// Energy that the device owed and was written off so far [J]. Beside it the hand may have got
  /// the loan, and what the device did against it while the mass stood.
  [[nodiscard]] double written_off() const noexcept { return written_off_; }

 private:
  void stand(const MotionSample& sample, bool is_good) noexcept;
  void move(const Eigen::Vector3d& hand, double dt) noexcept;

  MotionDevice& device_;
  MotionLimits limits_;
  VirtualHandleConfig config_;
  Eigen::Vector3d position_ = Eigen::Vector3d::Zero();  // of the mass
  Eigen::Vector3d velocity_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d force_ = Eigen::Vector3d::Zero();  // of the scene, held
  Eigen::Vector3d hand_ = Eigen::Vector3d::Zero();   // as last measured
  Eigen::Vector3d device_at_ = Eigen::Vector3d::Zero();
  double owed_ = 0.0;  // [J], the hand's work on the mass less that on the device
  double written_off_ = 0.0;
  double mass_;
  std::atomic<std::uint64_t> heavier_{0};
  std::chrono::nanoseconds read_at_{0}, written_at_{0};
  std::optional<Eigen::Vector3d> released_;  // where the scene's force ended, until it is told
  bool was_good_ = false;                    // the last reading
  bool moves_ = false;                       // and the operator's switch was held
};

}  // namespace reckon::haptics
