// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Two environments driven by the own speed minus the other's, thesis (4.1), Figs 4.1 and 4.2.
#pragma once

#include "reckon/bench/baselines/coupling_end.hpp"

namespace reckon::bench {

/// Speeds are sent as means since the last sample and are held until the next one: a lost sample
/// loses motion, and the two environments drift apart.
class VelocityExchangeEnd final : public CouplingEnd {
 public:
  explicit VelocityExchangeEnd(const CouplingEndConfig& config) noexcept;

  double step(const OwnMotion& own, std::span<const CouplingSample> arrived) noexcept override;
  [[nodiscard]] CouplingSample sample() noexcept override;
  [[nodiscard]] double world_work() const noexcept override { return world_work_; }

 private:
  Environment environment_;
  ContactLaw law_;
  double direction_;  // +1 for the first hand, -1 for the second
  double period_;
  double depth_ = kCouplingStart;  // [m], integral of the difference of speeds
  double other_speed_ = 0.0, world_work_ = 0.0;
  double last_position_ = 0.0, sent_position_ = 0.0;
  std::uint32_t number_ = 0, sent_ = 0;
};

/// The surface of a server, which also has a speed.
class SurfaceSpeedServer final : public CouplingEnd {
 public:
  explicit SurfaceSpeedServer(const CouplingEndConfig& config) noexcept;

  double step(const OwnMotion& own, std::span<const CouplingSample> arrived) noexcept override;
  [[nodiscard]] CouplingSample sample() noexcept override;

 private:
  Environment environment_;
  double period_;
  double sent_surface_ = 0.0;
  std::uint32_t number_ = 0, sent_ = 0;
};

}  // namespace reckon::bench
