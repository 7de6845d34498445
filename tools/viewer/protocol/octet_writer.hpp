// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Writes numbers of pictures, little endian.
#pragma once

#include <Eigen/Core>
#include <bit>
#include <cstdint>

namespace reckon::tools {

/// Writes into memory of the caller, who ensures that there is room.
class OctetWriter {
 public:
  explicit OctetWriter(char* at) : at_(at) {}

  void u8(std::uint8_t value) { *at_++ = static_cast<char>(value); }
  void u16(std::uint16_t value) { put(value, 2); }
  void u32(std::uint32_t value) { put(value, 4); }
  void f32(float value) { u32(std::bit_cast<std::uint32_t>(value)); }
  void f64(double value) { put(std::bit_cast<std::uint64_t>(value), 8); }
  void vector(const Eigen::Vector3f& value) {
    for (const float part : value) f32(part);
  }
  void vector(const Eigen::Vector3d& value) {
    for (const double part : value) f64(part);
  }
  /// Seven bits in each octet, the lowest first; bit 7: another octet follows.
  void varint(std::uint64_t value) {
    for (; value >= 0x80; value >>= 7) u8(static_cast<std::uint8_t>(value | 0x80U));
    u8(static_cast<std::uint8_t>(value));
  }
  /// 0, -1, 1, -2 .. as 0, 1, 2, 3 ..
  void zigzag(std::int64_t value) {
    varint(static_cast<std::uint64_t>(value) << 1 ^ static_cast<std::uint64_t>(value >> 63));
  }
  [[nodiscard]] char* at() const noexcept { return at_; }

 private:
  void put(std::uint64_t value, int octets) {
    for (int i = 0; i < octets; ++i) *at_++ = static_cast<char>(value >> (8 * i) & 0xFFU);
  }
  char* at_;
};

}  // namespace reckon::tools
