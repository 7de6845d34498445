// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// SplitMix64 (Steele, Lea and Flood, "Fast splittable pseudorandom number generators", 2014): the
// only source of bits for seeds, simulated damage and hashes of keys. Results do not depend on the
// order of calls or the machine. Not for secrets.
#pragma once

#include <cstdint>

namespace reckon::pdu {

/// 2^64 over the golden ratio, odd: the increment of SplitMix64 for each draw.
inline constexpr std::uint64_t kGoldenStep = 0x9E3779B97F4A7C15U;

/// The output function, a bijection with 0 -> 0: every bit of the input affects every bit of the
/// output. Some ns.
[[nodiscard]] constexpr std::uint64_t mixed_bits(std::uint64_t x) noexcept {
  x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9U;
  x = (x ^ (x >> 27)) * 0x94D049BB133111EBU;
  return x ^ (x >> 31);
}

/// Output of a generator in the state `x`; its next state is x + kGoldenStep.
[[nodiscard]] constexpr std::uint64_t split_mix(std::uint64_t x) noexcept {
  return mixed_bits(x + kGoldenStep);
}

/// Uniform in [0, 1), from the upper 53 bits.
[[nodiscard]] constexpr double unit_of(std::uint64_t bits) noexcept {
  return static_cast<double>(bits >> 11) * 0x1p-53;
}

}  // namespace reckon::pdu
