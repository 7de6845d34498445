// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// What goes over a Polhem's line: reports of HID, one to a transfer, words of 16 bits with the low
// octet first. There are two forms: of 14 octets both ways, and an older one of 8.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

namespace reckon::haptics {

/// Octets of a report, both ways.
enum class PolhemForm : std::uint8_t { eight = 8, fourteen = 14 };

/// From the device.
struct PolhemReport {
  std::array<std::int16_t, 3> arm{};     ///< counts of the base, the upper and the fore link
  std::array<std::int16_t, 3> gimbal{};  ///< counts, from the fore link outwards; 0 in eight octets
  /// Of 14 octets: 1 after the calibration button was pressed, until the counts are set. Of 8: a
  /// number that grows.
  std::uint16_t info = 0;
  bool button = false;  ///< at the handle

  friend bool operator==(const PolhemReport&, const PolhemReport&) = default;
};

/// To the device.
struct PolhemCommand {
  std::array<std::int16_t, 3> currents{};  ///< [mA]
  /// Instead: no current, and the counts become these, in the order of the report's words. Of 14
  /// octets only.
  std::optional<std::array<std::int16_t, 6>> counts = {};

  friend bool operator==(const PolhemCommand&, const PolhemCommand&) = default;
};

/// @return nothing for a transfer of any other length. A button is told on top of the outermost
/// count: 10,000 more.
[[nodiscard]] std::optional<PolhemReport> polhem_report(
    PolhemForm form, std::span<const std::uint8_t> transfer) noexcept;

/// A command of 14 octets, of which a device of eight is told the first eight.
[[nodiscard]] std::array<std::uint8_t, 14> octets_of(const PolhemCommand& command) noexcept;

}  // namespace reckon::haptics
