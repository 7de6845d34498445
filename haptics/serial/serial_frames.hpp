// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Frames of a serial line: payload and 16-bit CRC in COBS, which leaves no zero within a frame, and
// a zero after each frame. docs/devices.md describes the format for authors of firmware.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace reckon::haptics {

/// Largest payload of a frame in octets, without its CRC.
inline constexpr std::size_t kSerialMost = 64;
/// Largest frame on the line in octets: payload, two of CRC, one of COBS, a zero before and one
/// after.
inline constexpr std::size_t kSerialLongest = kSerialMost + 5;

/// CRC-16/IBM-3740 ("CCITT-FALSE"): polynomial 0x1021, initial value 0xFFFF, high bit first.
[[nodiscard]] std::uint16_t serial_crc(std::span<const std::uint8_t> octets) noexcept;

/// An encoded frame.
struct SerialFrame {
  std::array<std::uint8_t, kSerialLongest> octets{};
  std::size_t length = 0;

  [[nodiscard]] std::span<const std::uint8_t> span() const noexcept {
    return std::span(octets).first(length);
  }
};

/// @param carried 1 to kSerialMost octets @return a frame that starts with a zero, which ends any
/// octets before it
[[nodiscard]] SerialFrame serial_frame(std::span<const std::uint8_t> carried) noexcept;

/// Prefixes a frame with an octet that invalidates an unfinished frame before it. Without it, the
/// first zero of this frame would complete an older frame that lost only its last zero, however
/// old.
/// @param frame of kSerialLongest - 1 octets at most
[[nodiscard]] SerialFrame spoiling(const SerialFrame& frame) noexcept;

/// Decodes frames from a stream of octets. After lost or changed octets the next zero
/// resynchronizes: one damaged octet costs two frames at most. No allocation; one thread.
class SerialFrameParser {
 public:
  /// @return payload of the frame that this octet completes, valid until the next call; empty: none
  /// completed
  [[nodiscard]] std::span<const std::uint8_t> take(std::uint8_t octet) noexcept;
  /// Frames since the start that were too long, malformed or had a wrong CRC.
  [[nodiscard]] std::uint64_t damaged() const noexcept { return damaged_; }

 private:
  [[nodiscard]] std::span<const std::uint8_t> end() noexcept;
  [[nodiscard]] std::size_t unstuff() noexcept;

  std::array<std::uint8_t, kSerialMost + 3> stuffed_{};
  std::array<std::uint8_t, kSerialMost + 3> carried_{};
  std::size_t length_ = 0;
  bool overrun_ = false;
  std::uint64_t damaged_ = 0;
};

}  // namespace reckon::haptics
