// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// How octets become frames on a serial line: COBS, which leaves no zero within a frame, a zero
// after each, and a CRC of 16 bits at its end. docs/devices.md has it for those who write a board.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace reckon::haptics {

/// Most octets that a frame carries, without its CRC.
inline constexpr std::size_t kSerialMost = 64;
/// Most octets of a frame on the line: two of CRC, one of COBS, a zero before and one after.
inline constexpr std::size_t kSerialLongest = kSerialMost + 5;

/// CRC-16/IBM-3740 ("CCITT-FALSE"): polynomial 0x1021, begins with 0xFFFF, high bit first.
[[nodiscard]] std::uint16_t serial_crc(std::span<const std::uint8_t> octets) noexcept;

/// A frame as it goes over the line.
struct SerialFrame {
  std::array<std::uint8_t, kSerialLongest> octets{};
  std::size_t length = 0;

  [[nodiscard]] std::span<const std::uint8_t> span() const noexcept {
    return std::span(octets).first(length);
  }
};

/// @param carried 1 to kSerialMost octets @return a frame that ends what came before it with a zero
/// of its own
[[nodiscard]] SerialFrame serial_frame(std::span<const std::uint8_t> carried) noexcept;

/// The frame after an octet that spoils what came before: of a frame that lost its last zero alone
/// the first zero of this one would make a whole one, however much later it comes.
/// @param frame of kSerialLongest - 1 octets at most
[[nodiscard]] SerialFrame spoiling(const SerialFrame& frame) noexcept;

/// Puts frames together from octets in any pieces. After octets that are lost or changed the next
/// zero begins anew: one damaged octet costs two frames at most. No allocation; one thread.
class SerialFrameParser {
 public:
  /// @return what the frame that this octet ends carries, valid until the next call; empty: none
  /// ended
  [[nodiscard]] std::span<const std::uint8_t> take(std::uint8_t octet) noexcept;
  /// Frames that were too long, or whose octets or CRC were wrong, since the start.
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
