// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Encodes and decodes the packets of a Polhem: HID reports, one per transfer, of 16-bit
// little-endian words. There are two forms: 14 octets both ways, and an older one of 8.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>

namespace reckon::haptics {

/// Octets of a report, both ways.
enum class PolhemForm : std::uint8_t { eight = 8, fourteen = 14 };

/// From the device.
struct PolhemReport {
  std::array<std::int16_t, 3> arm{};     ///< counts of the base, the upper and the fore link
  std::array<std::int16_t, 3> gimbal{};  ///< counts, from the fore link outwards; 0 in form `eight`
  /// Form `fourteen`: 1 after the calibration button was pressed, until the counts are set. Form
  /// `eight`: an increasing number.
  std::uint16_t info = 0;
  bool button = false;  ///< at the handle

  friend bool operator==(const PolhemReport&, const PolhemReport&) = default;
};

/// To the device.
struct PolhemCommand {
  std::array<std::int16_t, 3> currents{};  ///< [mA]
  /// If set, the currents are zero, and the device sets its counts to these: arm, then gimbal. Only
  /// in form `fourteen`.
  std::optional<std::array<std::int16_t, 6>> counts = {};

  friend bool operator==(const PolhemCommand&, const PolhemCommand&) = default;
};

/// @return std::nullopt for a transfer of another length. A pressed button adds 10,000 to the count
/// of the outermost gimbal axis.
[[nodiscard]] std::optional<PolhemReport> polhem_report(
    PolhemForm form, std::span<const std::uint8_t> transfer) noexcept;

/// A command of 14 octets. A device of form `eight` is sent the first eight.
[[nodiscard]] std::array<std::uint8_t, 14> octets_of(const PolhemCommand& command) noexcept;

}  // namespace reckon::haptics
