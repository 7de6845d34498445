// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A hand that jumps between two places at random times, so that the force changes from one servo
// step to the next; or a hand that does not move.
#pragma once

#include <Eigen/Core>
#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <random>

#include "reckon/haptics/devices/haptic_device.hpp"

namespace reckon::bench {

/// The device; no force moves it. During its first kComes it is four times as far from the origin,
/// because hands that appear inside each other feel nothing. One thread.
class SteppedHand final : public haptics::HapticDevice {
 public:
  static constexpr std::chrono::nanoseconds kComes = std::chrono::seconds(1);

  /// Stays at `place` [m], frame D.
  explicit SteppedHand(const Eigen::Vector3d& place) : places_{place, place} {}
  /// Jumps between the places [m], after 40 to 80 ms each time.
  SteppedHand(const Eigen::Vector3d& first, const Eigen::Vector3d& second, std::uint64_t seed)
      : places_{first, second}, random_(seed) {}

  [[nodiscard]] haptics::DeviceLimits limits() const noexcept override {
    haptics::DeviceLimits limits;
    limits.max_force = 10.0;
    limits.damping = 1.0;
    limits.max_speed = 1e3;  // a jump is not a fault here
    return limits;
  }

  [[nodiscard]] haptics::DeviceSample read(std::chrono::nanoseconds now) noexcept override {
    if (now >= next_) {
      at_ = 1 - at_;
      next_ = now + std::chrono::microseconds(pause_(random_));
    }
    haptics::DeviceSample sample;
    if (begun_ < std::chrono::nanoseconds(0)) begun_ = now;
    sample.position = (now - begun_ < kComes ? 4.0 : 1.0) * places_[at_];
    sample.has_velocity = sample.ok = true;
    return sample;
  }
  void write(const Eigen::Vector3d&, std::chrono::nanoseconds) noexcept override {}

 private:
  std::array<Eigen::Vector3d, 2> places_;
  std::mt19937_64 random_;
  std::uniform_int_distribution<int> pause_{40'000, 80'000};  // [us]
  std::chrono::nanoseconds next_{0}, begun_{-1};
  std::size_t at_ = 0;
};

}  // namespace reckon::bench
