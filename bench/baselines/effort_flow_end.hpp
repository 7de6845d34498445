// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The simple junction, thesis (4.12): flow is sent in one direction and effort in the other,
// unchanged. The flow is sent as its integral, so that a lost sample loses no motion.
#pragma once

#include "reckon/bench/baselines/coupling_end.hpp"

namespace reckon::bench {

/// Sends its position and renders the last effort that it received.
class FlowEnd final : public CouplingEnd {
 public:
  double step(const OwnMotion& own, std::span<const CouplingSample> arrived) noexcept override;
  [[nodiscard]] CouplingSample sample() noexcept override;

 private:
  OwnMotion own_;
  double effort_ = 0.0;
};

/// Renders the environment, or the spring in front of its own hand, against the last position of
/// the other, and sends the force.
class EffortEnd final : public CouplingEnd {
 public:
  explicit EffortEnd(const CouplingEndConfig& config) noexcept;

  double step(const OwnMotion& own, std::span<const CouplingSample> arrived) noexcept override;
  [[nodiscard]] CouplingSample sample() noexcept override;
  [[nodiscard]] double world_work() const noexcept override { return world_work_; }

 private:
  Environment environment_;
  ContactLaw law_;
  double gain_;
  double period_;
  double seen_ = kCouplingStart;
  double effort_ = 0.0, world_work_ = 0.0;
  std::uint32_t number_ = 0;
};

}  // namespace reckon::bench
