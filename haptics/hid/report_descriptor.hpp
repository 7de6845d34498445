// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// What the report descriptor of a device of the class HID says: where each number of each report
// stands. Pure. Device Class Definition for HID 1.11, 5.2 to 6.2.2.
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

/// One number of a report. What is there to fill it up is none.
struct HidField {
  HidKind kind = HidKind::input;
  std::uint8_t report = 0;           ///< its number; 0: the device's reports have none
  std::uint32_t usage = 0;           ///< what it is; of an array 0
  std::size_t collection = 0;        ///< the innermost that it is in, of HidReports::collections
  std::int64_t least = 0, most = 0;  ///< logical; least <= most
  std::uint32_t bit = 0;             ///< its first, in a report that begins with its number
  std::uint32_t bits = 0;            ///< 1 to 32
  /// Of an array, what it may say: its number is least + the place in this part of
  /// HidReports::choices. Empty: it is no array.
  std::size_t first_choice = 0, choices = 0;
  bool is_seconds = false;  ///< has the unit of time
  int exponent = 0;         ///< of ten, of its unit
};

struct HidCollection {
  std::uint32_t usage = 0;
  std::size_t parent = 0;  ///< its own place: it has none
};

/// A descriptor that was read.
struct HidReports {
  static constexpr std::size_t kMostOctets = 4096;        ///< of a descriptor, as Linux takes
  static constexpr std::size_t kMostFields = 4096;        ///< in all
  static constexpr std::uint32_t kMostBits = 8 * 4096;    ///< of a report
  static constexpr std::size_t kMostUsages = 1024;        ///< before one item
  static constexpr std::size_t kMostChoices = 64 * 1024;  ///< in all

  std::vector<HidField> fields;  ///< in their order
  std::vector<HidCollection> collections;
  std::vector<std::uint32_t> choices;
  /// Bits of each report, with its number.
  std::array<std::array<std::uint32_t, 256>, 3> bits{};

  /// Whether a collection is of a usage or within one that is.
  [[nodiscard]] bool is_within(std::size_t collection, std::uint32_t usage) const noexcept;
  /// Octets of a report with its number; 0: there is none.
  [[nodiscard]] std::size_t size(HidKind kind, std::uint8_t report) const noexcept;
};

/// @return nothing for a descriptor that breaks the rules or a bound of HidReports
[[nodiscard]] std::optional<HidReports> hid_reports(std::span<const std::uint8_t> descriptor);

/// A number in a report that begins with its own; nothing: the report ends before.
[[nodiscard]] std::optional<std::int64_t> number_in(std::span<const std::uint8_t> report,
                                                    const HidField& field) noexcept;
/// Writes one, which lies within what its bits hold; of a report that ends before nothing.
void put_number(std::span<std::uint8_t> report, const HidField& field,
                std::int64_t number) noexcept;

}  // namespace reckon::haptics
