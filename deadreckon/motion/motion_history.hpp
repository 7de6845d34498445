// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The last three updates of one remote entity, for predictors that use more than the last one.
#pragma once

#include <array>
#include <cstddef>

#include "reckon/deadreckon/motion/kinematic_state.hpp"

namespace reckon::deadreckon {

/// The motion in one update. All in reference axes except the angular velocity. The rates are zero
/// for a sender that sends only positions.
struct MotionSample {
  double time = 0;                                     ///< Time of the state at the sender [s].
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< [m]
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();  ///< Unit, body to reference.
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();               ///< [m/s]
  Eigen::Vector3d acceleration = Eigen::Vector3d::Zero();           ///< [m/s^2]
  Eigen::Vector3d angular_velocity = Eigen::Vector3d::Zero();       ///< Body axes [rad/s].
};

/// Whether every number of `sample` is finite.
[[nodiscard]] bool is_finite(const MotionSample& sample) noexcept;

/// The state of an update as a sample: body-axis rates are converted to reference axes.
[[nodiscard]] MotionSample motion_sample(const KinematicState& state, double time) noexcept;

/// A motion as the state of an update with this model; rates that the model does not use are zero.
/// The inverse of motion_sample: body acceleration is the rate of the body components.
[[nodiscard]] KinematicState kinematic_state(const MotionSample& sample,
                                             pdu::DeadReckoningAlgorithm algorithm) noexcept;

/// Newest first. No allocation; not synchronised.
class MotionHistory {
 public:
  static constexpr std::size_t kLength = 3;

  /// Adds a sample that is newer than all others. A sample with the newest's time replaces it (a
  /// correction). False for an older sample or one that is not finite: a late packet must not
  /// reverse the history.
  bool add(const MotionSample& sample) noexcept;
  /// Discards all samples, as after a jump on purpose.
  void clear() noexcept { size_ = 0; }

  [[nodiscard]] std::size_t size() const noexcept { return size_; }
  /// 0 = the newest; valid for `age` < size().
  [[nodiscard]] const MotionSample& operator[](std::size_t age) const noexcept {
    return samples_[age];
  }

 private:
  std::array<MotionSample, kLength> samples_;
  std::size_t size_ = 0;
};

}  // namespace reckon::deadreckon
