// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/bench/studies/zwidth/measured_border.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <vector>

#include "reckon/bench/analysis/device_damping.hpp"
#include "reckon/bench/analysis/hybrid_motion.hpp"

namespace reckon::bench {
namespace {

/// Share of the exchanged energy that is rounding.
constexpr double kRounding = 1e-12;

struct Wall {
  double stiffness, damping;  // [N/m], [N s/m]
};

/// Force of the wall on a handle at x [m], from two samples [N].
double force_of(const Wall& wall, double x, double before, double period) {
  return -wall.stiffness * x - wall.damping * (x - before) / period;
}

// --- a hand that moves the handle as it likes ---

/// Handle positions of a swinging hand: a whole number of periods in a cycle of samples.
class SwingingHand {
 public:
  explicit SwingingHand(const ZWidthDevice& device)
      : device_(device),
        samples_(std::max<std::size_t>(2000, 20 * (2 * delay() + 1))),
        circle_(samples_) {
    for (std::size_t i = 0; i < samples_; ++i)
      circle_[i] =
          std::cos(2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(samples_));
  }

  /// Most periods in a cycle: half the sampling rate.
  [[nodiscard]] std::size_t fastest() const { return samples_ / 2; }

  /// Energy that the hand loses in a cycle with this number of periods [J], as a share of the
  /// energy exchanged; below 0 it gains.
  [[nodiscard]] double lost(const Wall& wall, std::size_t periods) const {
    const double T = device_.period;
    double net = 0, moved = 0;
    // As a ring: the force of a sample acts d samples later, in this cycle or the next.
    std::size_t at = 0;
    std::size_t force_at = (samples_ - (delay() * periods) % samples_) % samples_;
    double x = circle_[at], felt = circle_[force_at];
    double felt_before = circle_[(force_at + samples_ - periods) % samples_];
    for (std::size_t k = 0; k < samples_; ++k) {
      at += periods;
      if (at >= samples_) at -= samples_;
      force_at += periods;
      if (force_at >= samples_) force_at -= samples_;
      const double dx = circle_[at] - x;
      const double work = -force_of(wall, felt, felt_before, T) * dx;
      const double loss = device_.damping * dx * dx / T;
      net += work + loss;
      moved += std::abs(work) + loss;
      x = circle_[at];
      felt_before = felt;
      felt = circle_[force_at];
    }
    return net / moved;
  }

 private:
  [[nodiscard]] std::size_t delay() const {
    return static_cast<std::size_t>(device_.delay_samples);
  }

  const ZWidthDevice& device_;
  std::size_t samples_;
  std::vector<double> circle_;
};

/// Greatest stiffness of a wall that dissipates energy at these frequencies.
double border_at(const SwingingHand& hand, double wall_damping, double most,
                 const std::vector<std::size_t>& periods) {
  double low = 0, high = most;
  while (high - low > 0.1 * kBorderPrecision * high) {
    const Wall wall{0.5 * (low + high), wall_damping};
    const bool passes = std::ranges::all_of(
        periods, [&](std::size_t p) { return hand.lost(wall, p) >= -kRounding; });
    (passes ? low : high) = wall.stiffness;
    if (high < 1e-9 * most) return 0;
  }
  return low;
}

// --- a handle that nobody holds ---

/// Motion of the handle in one period under a held force, computed by `advanced`.
struct HeldStep {
  double v_of_v, v_of_f, x_of_v, x_of_f;

  explicit HeldStep(const ZWidthDevice& device) {
    const MassDamper body{device.mass, device.damping};
    const auto coasted = advanced(body, {0, 1}, 0, device.period);
    const auto pushed = advanced(body, {0, 0}, 1, device.period);
    v_of_v = coasted.velocity;
    x_of_v = coasted.position;
    v_of_f = pushed.velocity;
    x_of_f = pushed.position;
  }
};

constexpr std::size_t kSwingSamples = 40'000;
constexpr double kGone = 1e-18, kGrown = 1e6;  // of the initial energy

/// Whether swings grow: compares the greatest energy in the last quarter with that in the second.
bool grows(const ZWidthDevice& device, const HeldStep& step, const Wall& wall) {
  const auto delay = static_cast<std::size_t>(device.delay_samples);
  std::vector<double> under_way(delay + 1);
  double x = 0, v = 1, before = 0, early = 0, late = 0;
  const double first = 0.5 * device.mass;
  for (std::size_t k = 0; k < kSwingSamples; ++k) {
    under_way[k % (delay + 1)] = force_of(wall, x, before, device.period);
    const double force = under_way[(k + 1) % (delay + 1)];
    before = x;
    x += step.x_of_v * v + step.x_of_f * force;
    v = step.v_of_v * v + step.v_of_f * force;
    const double energy = 0.5 * device.mass * v * v + 0.5 * wall.stiffness * x * x;
    if (energy > kGrown * first) return true;
    const std::size_t quarter = 4 * k / kSwingSamples;
    if (quarter == 1) early = std::max(early, energy);
    if (quarter == 3) late = std::max(late, energy);
    if (quarter == 2 && early < kGone * first) return false;
  }
  return late > early;
}

}  // namespace

double energy_border(const ZWidthDevice& device, double wall_damping,
                     const std::function<bool()>& go_on) {
  const SwingingHand hand(device);
  const double most = 3 * (device.damping + std::abs(wall_damping)) / device.period;
  // Finds the border for a few frequencies, adds each frequency that gains energy at it, and
  // repeats until none does.
  std::vector<std::size_t> periods{1, hand.fastest() / 2, hand.fastest()};
  for (;;) {
    const double border = border_at(hand, wall_damping, most, periods);
    const Wall wall{border, wall_damping};
    std::size_t worst = 0;
    double least = -kRounding;
    for (std::size_t p = 1; p <= hand.fastest(); ++p) {
      if (p % 256 == 0 && go_on && !go_on()) return border;
      const double lost = hand.lost(wall, p);
      if (lost < least) {
        least = lost;
        worst = p;
      }
    }
    if (worst == 0 || border == 0) return border;
    periods.push_back(worst);
  }
}

double stability_border(const ZWidthDevice& device, double wall_damping) {
  constexpr double kScan = 1.1;
  const HeldStep step(device);
  const double typical = device.damping / spring_damping(1, device.period, device.delay_samples);
  double low = 0, high = 1e-3 * typical;
  while (!grows(device, step, {high, wall_damping})) {
    low = high;
    high *= kScan;
    if (high > 1e3 * typical) return std::numeric_limits<double>::infinity();
  }
  if (low == 0) return 0;
  while (high - low > kBorderPrecision * high) {
    const double middle = 0.5 * (low + high);
    (grows(device, step, {middle, wall_damping}) ? high : low) = middle;
  }
  return high;
}

}  // namespace reckon::bench
