// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Haptic dead reckoning as printed: a received model is evaluated at the hand, and each update is
// applied on arrival, without any limit.
#pragma once

#include "reckon/bench/baselines/coupling_end.hpp"

namespace reckon::bench {

/// The other's surface, extrapolated by its speed if `extrapolates`; thesis 4.1 and 4.5.
class LocalModelEnd : public CouplingEnd {
 public:
  LocalModelEnd(const CouplingEndConfig& config, double share, bool extrapolates) noexcept;

  double step(const OwnMotion& own, std::span<const CouplingSample> arrived) noexcept override;
  [[nodiscard]] CouplingSample sample() noexcept override;

 private:
  double direction_;  // +1 for the first hand, -1 for the second
  double period_;
  double share_;
  double stiffness_;  // stiffness sent to the other end [N/m]
  bool extrapolates_;
  OwnMotion own_;
  CouplingSample model_;  // stiffness 0: nothing received yet
};

/// The same with a passivity observer and controller in series: a damper that is switched on after
/// the port has given more energy than it took. It dissipates afterwards, so that the port is below
/// 0 first.
class PassivityControllerEnd final : public LocalModelEnd {
 public:
  explicit PassivityControllerEnd(const CouplingEndConfig& config) noexcept;

  double step(const OwnMotion& own, std::span<const CouplingSample> arrived) noexcept override;

 private:
  double period_;
  double most_damping_;    // [N s/m], a greater one would reverse the handle within a sample
  double observed_ = 0.0;  // [J], taken from the hand
  double last_position_ = 0.0, held_ = 0.0;
  bool started_ = false;
};

/// A server that sends the tangent at the last position that it received from the hand.
class TangentServer final : public CouplingEnd {
 public:
  explicit TangentServer(const CouplingEndConfig& config) noexcept;

  double step(const OwnMotion& own, std::span<const CouplingSample> arrived) noexcept override;
  [[nodiscard]] CouplingSample sample() noexcept override;

 private:
  Environment environment_;
  double period_;
  double seen_ = kCouplingStart;
  std::uint32_t number_ = 0;
};

}  // namespace reckon::bench
