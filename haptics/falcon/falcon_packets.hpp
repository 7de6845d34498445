// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Encodes and decodes the packets of a Falcon: a command of 16 octets, answered by a report of 16
// octets. Both are '<', letters, '>'. A letter is 'A' plus a number: four bits of a motor or an
// encoder, the lowest first.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

namespace reckon::haptics {

inline constexpr std::size_t kFalconPacket = 16;  ///< octets of a command, and of a report
/// Octets of modem and line status that its FTDI chip puts before each packet: UsbPipes::header.
inline constexpr std::size_t kFalconHeader = 2;

/// To the device.
struct FalconCommand {
  std::array<std::int16_t, 3> motors{};
  std::uint8_t lights = 0;  ///< 2 green, 4 blue, 8 red
  bool homing = false;      ///< search for the reference positions of the arms

  friend bool operator==(const FalconCommand&, const FalconCommand&) = default;
};

/// From the device, one for each command.
struct FalconReport {
  std::array<std::int16_t, 3> counts{};  ///< of the encoders
  std::uint8_t buttons = 0;              ///< 1 plus, 2 forward, 4 centre, 8 minus
  std::uint8_t homed = 0;                ///< a bit for each arm; 7: the counts are angles

  friend bool operator==(const FalconReport&, const FalconReport&) = default;
};

[[nodiscard]] std::array<std::uint8_t, kFalconPacket> octets_of(
    const FalconCommand& command) noexcept;

/// Decodes reports from a stream of octets. A '<' always starts a new report, because no letter is
/// '<'. Malformed reports are dropped and counted. No allocation; one thread.
class FalconReportParser {
 public:
  /// @return the report that this octet completes
  [[nodiscard]] std::optional<FalconReport> take(std::uint8_t octet) noexcept;
  /// Discards a partly received report.
  void restart() noexcept { length_ = 0; }
  /// Reports begun and dropped since the start.
  [[nodiscard]] std::uint64_t malformed() const noexcept { return malformed_; }

 private:
  [[nodiscard]] FalconReport report() const noexcept;

  std::array<std::uint8_t, kFalconPacket> octets_{};
  std::size_t length_ = 0;
  std::uint64_t malformed_ = 0;
};

}  // namespace reckon::haptics
