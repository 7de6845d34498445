// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// What goes over a Falcon's line: a command of 16 octets, and a report of 16 octets in answer. Both
// are '<', letters, '>': a letter is 'A' and a number on top, four bits of a motor or an encoder
// in each, the lowest first.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

namespace reckon::haptics {

inline constexpr std::size_t kFalconPacket = 16;  ///< octets of a command, and of a report
/// Octets of modem and line status that its FTDI chip puts before each packet: UsbPipes::header.
inline constexpr std::size_t kFalconHeader = 2;

/// To the device.
struct FalconCommand {
  std::array<std::int16_t, 3> motors{};
  std::uint8_t lights = 0;  ///< 2 green, 4 blue, 8 red
  bool homing = false;      ///< look for the arms' reference places

  friend bool operator==(const FalconCommand&, const FalconCommand&) = default;
};

/// From the device, one for each command.
struct FalconReport {
  std::array<std::int16_t, 3> counts{};  ///< of the encoders
  std::uint8_t buttons = 0;              ///< 1 plus, 2 forward, 4 centre, 8 minus
  std::uint8_t homed = 0;                ///< a bit for each arm; 7: its counts are angles

  friend bool operator==(const FalconReport&, const FalconReport&) = default;
};

[[nodiscard]] std::array<std::uint8_t, kFalconPacket> octets_of(
    const FalconCommand& command) noexcept;

/// Puts reports together from octets in any pieces. A '<' begins anew, wherever it comes, for no
/// letter is one; what is no report is dropped and counted. No allocation; one thread.
class FalconReportParser {
 public:
  /// @return the report that this octet ends
  [[nodiscard]] std::optional<FalconReport> take(std::uint8_t octet) noexcept;
  /// What came so far of a report is forgotten.
  void restart() noexcept { length_ = 0; }
  /// Begun and dropped, since the start.
  [[nodiscard]] std::uint64_t malformed() const noexcept { return malformed_; }

 private:
  [[nodiscard]] FalconReport report() const noexcept;

  std::array<std::uint8_t, kFalconPacket> octets_{};
  std::size_t length_ = 0;
  std::uint64_t malformed_ = 0;
};

}  // namespace reckon::haptics
