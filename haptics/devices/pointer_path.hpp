// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Turns the sparse samples of a pointer into a smooth path for a hand.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

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
  PointerPath(const Eigen::AlignedBox3d& box, const Eigen::Vector3d& start, double max_speed)
      : box_(box), max_speed_(max_speed) {
    if (box.isEmpty() || !box.sizes().allFinite() || !start.allFinite()) {
      throw std::invalid_argument(
          "pointer path: box and start must be finite, and the box not empty");
    }
    if (!(max_speed > 0) || !std::isfinite(max_speed)) {
      throw std::invalid_argument("pointer path: speed must be above 0 m/s, got " +
                                  std::to_string(max_speed));
    }
    goal_ = wanted_ = position_ = inside(box_, start);
  }

  /// Sets the target, clamped to the box. @param point [m], finite
  void lead_to(const Eigen::Vector3d& point) noexcept { goal_ = inside(box_, point); }
  /// Brings the path to rest at the present wanted point.
  void rest() noexcept { goal_ = wanted_; }
  /// @param h [s] >= 0
  void advance(double h) noexcept {
    const Eigen::Vector3d way = goal_ - wanted_;
    const double needs = way.norm() / max_speed_;  // [s]
    if (needs > 0) {
      const double moving = std::min(h, needs);
      const Eigen::Vector3d speed = way / needs;
      advance_filter(speed, moving);
      if (moving < needs) {
        wanted_ += moving * speed;
      } else {
        wanted_ = goal_;
      }
      h -= moving;
    }
    advance_filter(Eigen::Vector3d::Zero(), h);
  }

  [[nodiscard]] const Eigen::Vector3d& position() const noexcept { return position_; }
  [[nodiscard]] const Eigen::Vector3d& velocity() const noexcept { return velocity_; }
  [[nodiscard]] const Eigen::Vector3d& acceleration() const noexcept { return acceleration_; }
  [[nodiscard]] const Eigen::AlignedBox3d& box() const noexcept { return box_; }

  // Limits for any samples.
  [[nodiscard]] double max_speed() const noexcept { return max_speed_; }  ///< [m/s]
  /// [m/s^2]
  [[nodiscard]] double max_acceleration() const noexcept {
    return 2.0 * kPeak * kBandwidth * max_speed_;
  }
  /// [m/s^3]
  [[nodiscard]] double max_jerk() const noexcept {
    return kSlopeWay * kBandwidth * kBandwidth * max_speed_;
  }

 private:
  // The filter's impulse response is h(t) = w^3 t^2/2 e^(-wt). With x = wt:
  static constexpr double kPeak = 0.27067056647322537;  // largest h / w: 2/e^2, at x = 2
  // Total variation of h' / w^2: h' is 0.23058 at x = 2 - sqrt 2 and -0.07944 at 2 + sqrt 2.
  static constexpr double kSlopeWay = 0.6200250;
  static Eigen::Vector3d inside(const Eigen::AlignedBox3d& box, const Eigen::Vector3d& point) {
    return point.cwiseMax(box.min()).cwiseMin(box.max());
  }

  void advance_filter(const Eigen::Vector3d& speed, double h) noexcept {
    // Exact for a wanted point u + speed t: the path is u + speed (t - 3/w) plus the solution of (1
    // + s/w)^3 e = 0, which is (c0 + c1 t + c2 t^2) e^(-wt).
    if (!(h > 0)) return;
    constexpr double w = kBandwidth;
    const Eigen::Vector3d c0 = position_ - wanted_ + kLag * speed;
    const Eigen::Vector3d de = velocity_ - speed;
    const Eigen::Vector3d c1 = de + w * c0;
    const Eigen::Vector3d c2 = 0.5 * (acceleration_ + 2.0 * w * de + w * w * c0);

    const double fade = std::exp(-w * h);
    const Eigen::Vector3d e = c0 + h * (c1 + h * c2);
    const Eigen::Vector3d e1 = c1 + 2.0 * h * c2;
    position_ = wanted_ + (h - kLag) * speed + fade * e;
    velocity_ = speed + fade * (e1 - w * e);
    acceleration_ = fade * (2.0 * c2 - 2.0 * w * e1 + w * w * e);
  }

  Eigen::AlignedBox3d box_;
  double max_speed_;
  Eigen::Vector3d goal_;    // the newest sample
  Eigen::Vector3d wanted_;  // u, which moves to goal_
  Eigen::Vector3d position_;
  Eigen::Vector3d velocity_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d acceleration_ = Eigen::Vector3d::Zero();
};

}  // namespace reckon::haptics
