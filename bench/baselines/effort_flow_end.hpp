// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The naive junction, thesis (4.12): flow goes one way, effort comes back, both as they are. The
// flow travels as its integral, so that a sample that is lost costs no motion.
#pragma once

#include "reckon/bench/baselines/coupling_end.hpp"

namespace reckon::bench {

/// Sends where it is, shows the effort that it last heard of.
class FlowEnd final : public CouplingEnd {
 public:
  double step(const OwnMotion& own, std::span<const CouplingSample> arrived) noexcept override;
  [[nodiscard]] CouplingSample sample() noexcept override;

 private:
  OwnMotion own_;
  double effort_ = 0.0;
};

/// Renders the environment, or the spring before its own hand, against where the other was, and
/// sends the force.
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
