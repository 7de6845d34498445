// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The acceleration of a hand from its last few velocities. The servo's own value is computed from
// 32 samples and lags some 10 ms. When a hand is thrown off an edge or over another hand, that is
// half a period of the swing. Part of the model loop.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstddef>

#include "reckon/pdu/seconds.hpp"

namespace reckon::peer {

/// Differences of velocities that come every 1 to 2 ms, and their noise. One thread; no allocation.
class VelocityTrend {
 public:
  /// @param velocity [m/s] at `time`; one that is not later than the last is ignored
  void note(std::chrono::nanoseconds time, const Eigen::Vector3d& velocity) noexcept {
    const double dt = pdu::to_seconds(time - back(0).time);
    if (!(dt > 0)) return;
    if (dt > kMemory) {
      kept_.fill({time, velocity});
      unevenness_ = 0.0;
    }
    newest_ = (newest_ + 1) % kKept;
    kept_[newest_] = {time, velocity};

    const Span last = span_to(0);
    acceleration_.setZero();
    jerk_.setZero();
    if (last.length > 0) {
      acceleration_ = difference(last, 0);
      const Span before = span_to(last.begin);
      if (before.length > 0) {
        const double apart = 0.5 * (last.length + before.length);
        jerk_ = (acceleration_ - difference(before, last.begin)) / apart;
      }
    }

    const Eigen::Vector3d third =
        back(0).value - 3.0 * back(1).value + 3.0 * back(2).value - back(3).value;
    const double uneven = third.squaredNorm();
    unevenness_ += dt / (kMemory + dt) * (uneven - unevenness_);
    doubt_ = last.length > 0 ? std::sqrt(std::max(unevenness_, uneven)) / last.length : 0.0;
  }

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
  // Interval of the difference [s]: a longer one lags more, a shorter one is noisier.
  static constexpr double kLongest = 0.0021;
  static constexpr double kShortest = 0.0009;
  static constexpr double kMemory = 0.1;  // [s], memory of the unevenness

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
  [[nodiscard]] Span span_to(std::size_t end) const noexcept {
    Span span;
    for (std::size_t i = end + 1; i < kKept; ++i) {
      const double length = pdu::to_seconds(back(end).time - back(i).time);
      if (length < kShortest || length > kLongest || length < span.length) continue;
      span = {i, length};
    }
    return span;
  }
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
