// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Parses a HID report descriptor: the bit position, size and range of each field of each report.
// Pure: no calls of the system. Device Class Definition for HID 1.11, 5.2 to 6.2.2.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace reckon::haptics {

enum class HidKind : std::uint8_t { input, output, feature };

/// A usage with its page.
constexpr std::uint32_t hid_usage(std::uint32_t page, std::uint32_t number) noexcept {
  return page << 16 | number;
}

/// One number of a report. Padding (constant) has no field.
struct HidField {
  HidKind kind = HidKind::input;
  std::uint8_t report = 0;           ///< report ID; 0: the device's reports have no IDs
  std::uint32_t usage = 0;           ///< with its page; 0 for an array
  std::size_t collection = 0;        ///< innermost collection: index in HidReports::collections
  std::int64_t least = 0, most = 0;  ///< logical; least <= most
  std::uint32_t bit = 0;   ///< its first bit; a report begins with its ID, which takes 8 bits
  std::uint32_t bits = 0;  ///< 1 to 32
  /// An array's possible usages: a range of HidReports::choices. The field's value - least is the
  /// index in that range. Empty: not an array.
  std::size_t first_choice = 0, choices = 0;
  bool is_seconds = false;  ///< its unit is seconds
  int exponent = 0;         ///< power of ten by which the unit is multiplied
};

struct HidCollection {
  std::uint32_t usage = 0;
  std::size_t parent = 0;  ///< its own index: no parent
};

/// A parsed descriptor.
struct HidReports {
  static constexpr std::size_t kMostOctets = 4096;        ///< of a descriptor; the limit of Linux
  static constexpr std::size_t kMostFields = 4096;        ///< of the device
  static constexpr std::uint32_t kMostBits = 8 * 4096;    ///< of a report
  static constexpr std::size_t kMostUsages = 1024;        ///< in front of one main item
  static constexpr std::size_t kMostChoices = 64 * 1024;  ///< of the device

  std::vector<HidField> fields;  ///< in the order of the descriptor
  std::vector<HidCollection> collections;
  std::vector<std::uint32_t> choices;
  /// Size of each report in bits, with its ID: by HidKind, then report ID.
  std::array<std::array<std::uint32_t, 256>, 3> bits{};

  /// Whether a collection or one around it has this usage.
  [[nodiscard]] bool is_within(std::size_t collection, std::uint32_t usage) const noexcept;
  /// Octets of a report with its ID; 0: no such report.
  [[nodiscard]] std::size_t size(HidKind kind, std::uint8_t report) const noexcept;
};

/// @return std::nullopt: the descriptor is malformed or exceeds a limit of HidReports
[[nodiscard]] std::optional<HidReports> hid_reports(std::span<const std::uint8_t> descriptor);

/// The value of a field. A report begins with its ID. std::nullopt: the report is too short.
[[nodiscard]] std::optional<std::int64_t> number_in(std::span<const std::uint8_t> report,
                                                    const HidField& field) noexcept;
/// Writes a field. `number` must fit into its bits. A report that is too short stays as it is.
void put_number(std::span<std::uint8_t> report, const HidField& field,
                std::int64_t number) noexcept;

}  // namespace reckon::haptics
