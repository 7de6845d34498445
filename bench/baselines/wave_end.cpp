// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/bench/baselines/wave_end.hpp"

#include <cmath>

namespace reckon::bench {

double WaveMean::take() noexcept {
  const double mean = count_ > 0 ? sum_ / count_ : 0.0;
  *this = WaveMean{};
  return mean;
}

WaveHandEnd::WaveHandEnd(const CouplingEndConfig& config) noexcept
    : root_(std::sqrt(config.impedance)), period_(config.period) {}

double WaveHandEnd::step(const OwnMotion& own, std::span<const CouplingSample> arrived) noexcept {
  const double speed = own.number > 0 ? (own.position - last_position_) / period_ : 0.0;
  if (own.number > 0) leaving_.add(wave_ + root_ * speed);
  last_position_ = own.position;
  number_ = own.number;
  for (const CouplingSample& sample : arrived) wave_ = sample.effort;
  return -root_ * (root_ * speed + 2 * wave_);
}

CouplingSample WaveHandEnd::sample() noexcept {
  CouplingSample out;
  out.number = number_;
  out.effort = leaving_.take();
  return out;
}

WaveWorldEnd::WaveWorldEnd(const CouplingEndConfig& config) noexcept
    : environment_(config.environment),
      root_(std::sqrt(config.impedance)),
      period_(config.period) {}

// Change of stored energy over the distance: this force makes the energy balance of the step exact.
double WaveWorldEnd::mean_force(double from, double to) const noexcept {
  const double way = to - from;
  if (std::abs(way) < 1e-9) return law_.force(0.5 * (from + to));
  return (law_.energy(to) - law_.energy(from)) / way;
}

// Solves Z w + F(w) = 2 sqrt(Z) v for the speed w of the point, by bisection; F grows with w.
double WaveWorldEnd::speed(double depth) const noexcept {
  const double impedance = root_ * root_;
  double high = 2 * wave_ / root_;
  const double most = mean_force(depth, depth + high * period_);
  if (!(most > 0)) return high;
  double low = high - most / impedance;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    const double force = mean_force(depth, depth + middle * period_);
    (impedance * middle + force > 2 * root_ * wave_ ? high : low) = middle;
  }
  return 0.5 * (low + high);
}

double WaveWorldEnd::step(const OwnMotion& own, std::span<const CouplingSample> arrived) noexcept {
  const ContactLaw law = environment_.at(own.number * period_);
  const double depth = point_ - own.position;
  if (own.number > 0) world_work_ += law.energy(depth) - law_.energy(depth);
  law_ = law;
  number_ = own.number;
  for (const CouplingSample& sample : arrived) wave_ = sample.effort;
  const double w = speed(depth);
  point_ += w * period_;
  leaving_.add(wave_ - root_ * w);
  return law_.force(point_ - own.position);
}

CouplingSample WaveWorldEnd::sample() noexcept {
  CouplingSample out;
  out.number = number_;
  out.effort = leaving_.take();
  return out;
}

}  // namespace reckon::bench
