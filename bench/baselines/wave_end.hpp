// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A lossless transmission line between two ends, thesis (4.14), over any link for samples: WaveLine
// does the same in one object. Waves u = (F + Z V)/(2 sqrt Z) out, v = (F - Z V)/(2 sqrt Z) in,
// with u^2 - v^2 = F V [W].
//
// A wave is sent as its mean since the last sample and is held until the next one. The mean has no
// more energy than its parts, so with constant delay and a constant rate the line makes no energy.
// A wave that is held too long, because the next one is late or lost, adds energy.
#pragma once

#include "reckon/bench/baselines/coupling_end.hpp"

namespace reckon::bench {

/// Mean of the waves since the last sample that was sent.
class WaveMean {
 public:
  void add(double wave) noexcept {
    sum_ += wave;
    ++count_;
  }
  [[nodiscard]] double take() noexcept;

 private:
  double sum_ = 0.0;
  std::uint32_t count_ = 0;
};

/// At the hand: renders F = Z V + 2 sqrt(Z) v, held over the sample. The hold costs up to 2 Z V^2 T
/// a sample, which the device dissipates if Z <= b/2.
class WaveHandEnd final : public CouplingEnd {
 public:
  explicit WaveHandEnd(const CouplingEndConfig& config) noexcept;

  double step(const OwnMotion& own, std::span<const CouplingSample> arrived) noexcept override;
  [[nodiscard]] CouplingSample sample() noexcept override;

 private:
  double root_;  // sqrt Z
  double period_;
  double wave_ = 0.0;  // v, held
  double last_position_ = 0.0;
  std::uint32_t number_ = 0;
  WaveMean leaving_;
};

/// At the world, or in front of the second hand: the end of the line is a point that the wave moves
/// against the spring. Its motion is solved so that a step takes from the wave exactly what the
/// spring stores.
class WaveWorldEnd final : public CouplingEnd {
 public:
  explicit WaveWorldEnd(const CouplingEndConfig& config) noexcept;

  double step(const OwnMotion& own, std::span<const CouplingSample> arrived) noexcept override;
  [[nodiscard]] CouplingSample sample() noexcept override;
  [[nodiscard]] double world_work() const noexcept override { return world_work_; }

 private:
  [[nodiscard]] double mean_force(double from, double to) const noexcept;
  [[nodiscard]] double speed(double depth) const noexcept;

  Environment environment_;
  ContactLaw law_;
  double root_;  // sqrt Z
  double period_;
  double wave_ = 0.0;
  double point_ = kCouplingStart;  // [m]
  double world_work_ = 0.0;
  std::uint32_t number_ = 0;
  WaveMean leaving_;
};

}  // namespace reckon::bench
