// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// What a pointer says a few times a second, as a smooth path that a hand can follow.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace reckon::haptics {

/// The wanted point moves to the newest sample at no more than the path's speed V, and the path is
/// that point behind a critically damped filter of third order, p = u / (1 + s/w)^3. Its answer to
/// a step never overshoots, so, for any samples at any times:
///  - the path stays within the box, for it is a weighted mean of points in it;
///  - |p'| <= V, |p''| <= 2 V w (2/e^2), |p'''| <= 0.62 V w^2; p, p', p'' and p''' are continuous;
///  - it lags 3/w behind what moves steadily.
/// The steps are exact: the same motion however finely it is advanced. Allocates nothing.
class PointerPath {
 public:
  /// w [1/s]. Higher lags less and lets more of the samples' steps through: the speed of a steady
  /// way that is sampled at 60 Hz ripples by 1.6 % at most.
  static constexpr double kBandwidth = 75.0;
  /// Of the path behind a pointer that moves steadily [s].
  static constexpr double kLag = 3.0 / kBandwidth;

  /// @param box [m], not empty; `start` is moved into it. @param max_speed [m/s] > 0
  /// @throws std::invalid_argument for others.
  PointerPath(const Eigen::AlignedBox3d& box, const Eigen::Vector3d& start, double max_speed);

  /// From now on it goes there, or as near as the box allows. @param point [m], finite
  void lead_to(const Eigen::Vector3d& point) noexcept;
  /// From now on it comes to rest where the wanted point is.
  void rest() noexcept { goal_ = wanted_; }
  /// @param h [s] >= 0
  void advance(double h) noexcept;

  [[nodiscard]] const Eigen::Vector3d& position() const noexcept { return position_; }
  [[nodiscard]] const Eigen::Vector3d& velocity() const noexcept { return velocity_; }
  [[nodiscard]] const Eigen::Vector3d& acceleration() const noexcept { return acceleration_; }
  [[nodiscard]] const Eigen::AlignedBox3d& box() const noexcept { return box_; }

  // What no samples exceed.
  [[nodiscard]] double max_speed() const noexcept { return max_speed_; }  ///< [m/s]
  [[nodiscard]] double max_acceleration() const noexcept;                 ///< [m/s^2]
  [[nodiscard]] double max_jerk() const noexcept;                         ///< [m/s^3]

 private:
  void advance_filter(const Eigen::Vector3d& speed, double h) noexcept;

  Eigen::AlignedBox3d box_;
  double max_speed_;
  Eigen::Vector3d goal_;    // the newest sample
  Eigen::Vector3d wanted_;  // u: on its way there
  Eigen::Vector3d position_;
  Eigen::Vector3d velocity_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d acceleration_ = Eigen::Vector3d::Zero();
};

}  // namespace reckon::haptics
