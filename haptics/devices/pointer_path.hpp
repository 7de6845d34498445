// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Turns the sparse samples of a pointer into a smooth path for a hand.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace reckon::haptics {

/// The wanted point moves to the newest sample at no more than the path's speed V. The path is that
/// point after a critically damped filter of third order, p = u / (1 + s/w)^3. Its step response
/// never overshoots, so, for any samples at any times:
///  - the path stays within the box, because it is a weighted mean of points in it;
///  - |p'| <= V, |p''| <= 2 V w (2/e^2), |p'''| <= 0.62 V w^2; p, p', p'' and p''' are continuous;
///  - it lags 3/w behind a steady motion.
/// The steps are exact: the motion does not depend on their length. Allocates nothing.
class PointerPath {
 public:
  /// w [1/s]. A higher value lags less and passes more of the samples' steps: the speed of a steady
  /// motion sampled at 60 Hz ripples by at most 1.6 %.
  static constexpr double kBandwidth = 75.0;
  /// Lag of the path behind a steadily moving pointer [s].
  static constexpr double kLag = 3.0 / kBandwidth;

  /// @param box [m], not empty; `start` is moved into it. @param max_speed [m/s] > 0
  /// @throws std::invalid_argument otherwise.
  PointerPath(const Eigen::AlignedBox3d& box, const Eigen::Vector3d& start, double max_speed);

  /// Sets the target, clamped to the box. @param point [m], finite
  void lead_to(const Eigen::Vector3d& point) noexcept;
  /// Brings the path to rest at the present wanted point.
  void rest() noexcept { goal_ = wanted_; }
  /// @param h [s] >= 0
  void advance(double h) noexcept;

  [[nodiscard]] const Eigen::Vector3d& position() const noexcept { return position_; }
  [[nodiscard]] const Eigen::Vector3d& velocity() const noexcept { return velocity_; }
  [[nodiscard]] const Eigen::Vector3d& acceleration() const noexcept { return acceleration_; }
  [[nodiscard]] const Eigen::AlignedBox3d& box() const noexcept { return box_; }

  // Limits for any samples.
  [[nodiscard]] double max_speed() const noexcept { return max_speed_; }  ///< [m/s]
  [[nodiscard]] double max_acceleration() const noexcept;                 ///< [m/s^2]
  [[nodiscard]] double max_jerk() const noexcept;                         ///< [m/s^3]

 private:
  void advance_filter(const Eigen::Vector3d& speed, double h) noexcept;

  Eigen::AlignedBox3d box_;
  double max_speed_;
  Eigen::Vector3d goal_;    // the newest sample
  Eigen::Vector3d wanted_;  // u, which moves to goal_
  Eigen::Vector3d position_;
  Eigen::Vector3d velocity_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d acceleration_ = Eigen::Vector3d::Zero();
};

}  // namespace reckon::haptics
