// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Sends the lowest bits of numbers: chooses how many, and restores the number from a prediction.
// Used by the residual form. Pure functions, inline so that values stay in registers. Any thread.
#pragma once

#include <array>
#include <bit>
#include <cstdint>

namespace reckon::deadreckon::residual {

/// Bits of each number of a field; a field's code is an index into this table.
inline constexpr std::array<unsigned, 16> kWidths = {0,  2,  4,  5,  6,  7,  8,  9,
                                                     10, 11, 12, 13, 14, 16, 18, 22};
/// The highest code.
inline constexpr unsigned kHighest = 15;

/// Narrowest code with at least this number of bits.
inline constexpr auto kCodeOf = [] {
  std::array<std::uint8_t, kWidths.back() + 1> code{};
  for (unsigned bits = 0; bits < code.size(); ++bits)
    while (kWidths[code[bits]] < bits) ++code[bits];
  return code;
}();

/// Array of of(0), of(1), of(2). Keeps the array in registers, which halves the time.
[[gnu::always_inline]] inline auto each_axis(auto of) noexcept {
  return std::array{of(0U), of(1U), of(2U)};
}

/// Narrowest code that covers numbers within `distance` of the prediction in both directions; above
/// kHighest if there is none.
[[nodiscard]] inline unsigned code_for(double distance) noexcept {
  const double wanted = 2.0 * distance + 2.0;  // count of numbers
  if (!(wanted <= static_cast<double>(1U << kWidths.back()))) return kHighest + 1;
  const auto below = static_cast<std::uint32_t>(wanted);
  const std::uint32_t is_whole = static_cast<double>(below) == wanted ? 1 : 0;
  return kCodeOf[static_cast<unsigned>(std::bit_width(below - is_whole))];
}

/// The same; 0 for the distance 0.
[[nodiscard]] inline unsigned code_for(std::int32_t distance) noexcept {
  if (distance >= 1 << (kWidths.back() - 1)) return kHighest + 1;
  const auto reached = static_cast<std::uint32_t>(distance);
  return kCodeOf[distance == 0 ? 0U : static_cast<unsigned>(std::bit_width(2 * reached + 1))];
}

template <typename Number>
[[nodiscard]] inline Number largest(Number a, Number b, Number c) noexcept {
  const Number larger = a < b ? b : a;
  return larger < c ? c : larger;
}

/// The number with these lowest bits that is nearest to `predicted`. A number farther than half the
/// range of `width` bits from it is restored wrongly.
template <typename Number>
[[gnu::always_inline]] inline Number restored(std::uint64_t bits, Number predicted,
                                              unsigned width) noexcept {
  const std::uint64_t span = std::uint64_t{1} << width, half = span >> 1;
  const auto from = static_cast<std::uint64_t>(predicted);
  return static_cast<Number>(from + (((bits - from) & (span - 1)) ^ half) - half);
}

template <typename Number>
[[gnu::always_inline]] inline std::array<Number, 3> restored(
    const std::array<std::uint64_t, 3>& bits, const std::array<Number, 3>& predicted,
    unsigned width) noexcept {
  return each_axis([&](auto i) { return restored(bits[i], predicted[i], width); });
}

template <typename Number>
[[gnu::always_inline]] inline std::array<std::uint64_t, 3> bits_of(
    const std::array<Number, 3>& numbers) noexcept {
  return each_axis([&](auto i) { return static_cast<std::uint64_t>(numbers[i]); });
}

}  // namespace reckon::deadreckon::residual
