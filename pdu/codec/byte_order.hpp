// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Big-endian loads and stores of single values; one load and one byte swap each.
#pragma once

#include <bit>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstring>

namespace reckon::pdu {

template <std::size_t size>
struct UnsignedOf;
template <>
struct UnsignedOf<1> {
  using Type = std::uint8_t;
};
template <>
struct UnsignedOf<2> {
  using Type = std::uint16_t;
};
template <>
struct UnsignedOf<4> {
  using Type = std::uint32_t;
};
template <>
struct UnsignedOf<8> {
  using Type = std::uint64_t;
};

/// Converts a value between host order and wire order.
template <std::unsigned_integral T>
[[nodiscard]] constexpr T swap_to_big_endian(T value) noexcept {
  if constexpr (std::endian::native == std::endian::big || sizeof(T) == 1) return value;
  if constexpr (sizeof(T) == 2) return __builtin_bswap16(value);
  if constexpr (sizeof(T) == 4) return __builtin_bswap32(value);
  if constexpr (sizeof(T) == 8) return __builtin_bswap64(value);
}

/// Reads sizeof(T) octets at `from`, which need not be aligned.
template <typename T>
[[nodiscard, gnu::always_inline]] inline T load_big_endian(const std::byte* from) noexcept {
  typename UnsignedOf<sizeof(T)>::Type bits;
  std::memcpy(&bits, from, sizeof bits);
  return std::bit_cast<T>(swap_to_big_endian(bits));
}

/// Writes sizeof(T) octets at `to`, which need not be aligned.
template <typename T>
[[gnu::always_inline]] inline void store_big_endian(std::byte* to, T value) noexcept {
  const auto bits = swap_to_big_endian(std::bit_cast<typename UnsignedOf<sizeof(T)>::Type>(value));
  std::memcpy(to, &bits, sizeof bits);
}

}  // namespace reckon::pdu
