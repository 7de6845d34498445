// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Random draws of a seeded simulation: the same on every machine.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>

#include "reckon/pdu/random/split_mix.hpp"

namespace reckon::fuzz {

/// Draws at random, the same for the same seed.
class Dice {
 public:
  explicit Dice(std::uint64_t seed) : state_(seed) {}
  [[nodiscard]] std::uint64_t next() noexcept {
    return pdu::mixed_bits(state_ += pdu::kGoldenStep);
  }
  /// 0 .. below - 1
  [[nodiscard]] std::size_t below(std::size_t below) noexcept { return next() % below; }
  [[nodiscard]] double unit() noexcept { return pdu::unit_of(next()); }
  [[nodiscard]] bool chance(double probability) noexcept { return unit() < probability; }
  [[nodiscard]] std::chrono::nanoseconds between(std::chrono::nanoseconds low,
                                                 std::chrono::nanoseconds high) noexcept {
    const double span = static_cast<double>((high - low).count());
    return low + std::chrono::nanoseconds(static_cast<std::int64_t>(unit() * span));
  }

 private:
  std::uint64_t state_;
};

/// A hash of other numbers, evenly distributed.
[[nodiscard]] inline std::uint64_t mixed(std::uint64_t a, std::uint64_t b,
                                         std::uint64_t c = 0) noexcept {
  return Dice(a * pdu::kGoldenStep + b * 0xd1b54a32d192ed03ULL + c).next();
}

}  // namespace reckon::fuzz
