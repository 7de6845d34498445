// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Presents an admittance device as an impedance device: the measured force of the hand and the
// force of the scene move a virtual mass, and the device follows the mass.
#pragma once

#include <Eigen/Core>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <optional>

#include "reckon/haptics/devices/motion_device.hpp"

namespace reckon::haptics {

/// Dynamics of the free handle, and tolerance of the device's motion.
struct VirtualHandleConfig {
  double mass = 2.0;       ///< [kg] > 0
  double damping = 2.0;    ///< [N s/m] > 0; all of it counts as guaranteed, because it is computed
  double max_force = 0.0;  ///< [N], of the scene; 0: the sensor's limit
  double loan = 10e-3;  ///< [J] >= 0, greatest excess of the hand's work on the mass over its work
                        ///< on the device
  /// Time after a write until the scene's force ends, > 0 and at most HapticDevice::kWatchdog.
  std::chrono::nanoseconds hold = HapticDevice::kWatchdog;
};

/// Between two reads the mass follows m v' = f - b v + F in closed form, with the mean f of the
/// hand's two forces and the scene's held force F. So b |dx|^2 / dt, which the servo's port books,
/// is at most the loss in its damping, at any rate.
///
/// The energy at the real handle is f dx of the device's measured motion. Its motors may add work
/// that no mass has: they lag, overshoot, or oscillate with a stiff grip. So the hand's work on the
/// mass is kept within its work on the device plus the loan. Beyond that, the mass moves a shorter
/// distance and slows down in proportion, which loses energy (the port's account stays valid: it is
/// concave in that share). It also becomes twice as heavy at the same momentum, and the debt is
/// written off. Then its mass halves every two seconds at the same speed. So a device that is too
/// slow for the grip feels heavy and does not oscillate, and each time gives the hand at most one
/// loan more than it received. At kMostHeavy times its mass, the mass is only slowed.
class VirtualHandle final : public HapticDevice {
 public:
  static constexpr double kMostHeavy = 64.0;
  /// @param device outlives it
  /// @throws std::invalid_argument for values out of range.
  VirtualHandle(MotionDevice& device, const VirtualHandleConfig& config);

  /// Limits of an exact impedance device without delay and with guaranteed damping.
  [[nodiscard]] DeviceLimits limits() const noexcept override;
  /// Moves the mass from the last read to `now`. A read more than kWatchdog after the last one puts
  /// it at rest at the device's position.
  [[nodiscard]] DeviceSample read(std::chrono::nanoseconds now) noexcept override;
  void write(const Eigen::Vector3d& force, std::chrono::nanoseconds now) noexcept override;

  /// Last measured force of the hand [N].
  [[nodiscard]] const Eigen::Vector3d& hand_force() const noexcept { return hand_; }
  /// Number of times the mass was doubled because the device could not follow. Any thread.
  [[nodiscard]] std::uint64_t heavier() const noexcept {
    return heavier_.load(std::memory_order_relaxed);
  }
  /// Present virtual mass [kg].
  [[nodiscard]] double mass() const noexcept { return mass_; }
  /// Written-off debt of the device so far [J]. The hand may have received in addition the loan,
  /// and the work of the device while the mass was at rest.
  [[nodiscard]] double written_off() const noexcept { return written_off_; }

 private:
  void stand(const MotionSample& sample, bool is_good) noexcept;
  void move(const Eigen::Vector3d& hand, double dt) noexcept;

  MotionDevice& device_;
  MotionLimits limits_;
  VirtualHandleConfig config_;
  Eigen::Vector3d position_ = Eigen::Vector3d::Zero();  // position of the mass
  Eigen::Vector3d velocity_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d force_ = Eigen::Vector3d::Zero();  // held force of the scene
  Eigen::Vector3d hand_ = Eigen::Vector3d::Zero();   // last measured force of the hand
  Eigen::Vector3d device_at_ = Eigen::Vector3d::Zero();
  double owed_ = 0.0;  // [J], the hand's work on the mass minus its work on the device
  double written_off_ = 0.0;
  double mass_;
  std::atomic<std::uint64_t> heavier_{0};
  std::chrono::nanoseconds read_at_{0}, written_at_{0};
  std::optional<Eigen::Vector3d> released_;  // where the scene's force ended, until reported
  bool was_good_ = false;                    // the last reading was valid
  bool moves_ = false;  // the last reading was valid and the operator's switch held
};

}  // namespace reckon::haptics
