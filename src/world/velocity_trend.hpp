// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The acceleration of a hand from its last few velocities. The servo's own value is computed from
// 32 samples and lags some 10 ms. When a hand is thrown off an edge or over another hand, that is
// half a period of the swing. Part of the model loop.
#pragma once

#include <Eigen/Core>
#include <array>
#include <chrono>
#include <cstddef>

namespace reckon::peer {

/// Differences of velocities that come every 1 to 2 ms, and their noise. One thread; no allocation.
class VelocityTrend {
 public:
  /// @param velocity [m/s] at `time`; one that is not later than the last is ignored
  void note(std::chrono::nanoseconds time, const Eigen::Vector3d& velocity) noexcept;

  /// [m/s^2], of the last 1 to 2 ms; zero if velocities come less often.
  [[nodiscard]] const Eigen::Vector3d& acceleration() const noexcept { return acceleration_; }
  /// The same, extrapolated by `ahead` [s] with its change since the 2 ms before.
  [[nodiscard]] Eigen::Vector3d acceleration_in(double ahead) const noexcept {
    return acceleration_ + ahead * jerk_;
  }
  /// Its possible noise [m/s^2], >= 0, from the third differences of the velocities: over the last
  /// 0.1 s, or at this moment. The swings of a hand hardly appear in these differences; an
  /// encoder's steps and a blow do.
  [[nodiscard]] double doubt() const noexcept { return doubt_; }

 private:
  static constexpr std::size_t kKept = 6;
  struct Velocity {
    std::chrono::nanoseconds time{0};
    Eigen::Vector3d value = Eigen::Vector3d::Zero();  // [m/s]
  };
  [[nodiscard]] const Velocity& back(std::size_t count) const noexcept {
    return kept_[(newest_ + kKept - count) % kKept];
  }
  /// Begin of a difference that ends at `end`, counted back, and its length [s]; 0: none.
  struct Span {
    std::size_t begin = 0;
    double length = 0.0;
  };
  [[nodiscard]] Span span_to(std::size_t end) const noexcept;
  [[nodiscard]] Eigen::Vector3d difference(const Span& span, std::size_t end) const noexcept {
    return (back(end).value - back(span.begin).value) / span.length;
  }

  std::array<Velocity, kKept> kept_{};  // a ring
  std::size_t newest_ = 0;
  double unevenness_ = 0.0;  // [m^2/s^2], mean square of third differences
  Eigen::Vector3d acceleration_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d jerk_ = Eigen::Vector3d::Zero();  // [m/s^3]
  double doubt_ = 0.0;
};

}  // namespace reckon::peer
