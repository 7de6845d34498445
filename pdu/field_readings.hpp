// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Readings: the value of a field in a form for people, printed beside its name and number.
// Examples: a position in degrees, a timestamp in minutes and seconds, the code of an IFF mode. A
// further reading is one overload here.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "reckon/pdu/codec/text_sink.hpp"
#include "reckon/pdu/pdu_types.hpp"

namespace reckon::pdu {

/// One part of a reading: a number with a unit, or a short text.
struct FieldReading {
  std::string_view key;       ///< "latitude"
  std::string_view unit;      ///< "deg"; empty for a text
  std::array<char, 32> text;  ///< the first `size` octets
  std::size_t size = 0;

  [[nodiscard]] std::string_view view() const noexcept { return {text.data(), size}; }
};

/// The parts of one field's reading. No heap.
class FieldReadings {
 public:
  /// Adds a finite number with `decimals` decimals, 0 .. 7.
  void number(std::string_view key, std::string_view unit, double value, int decimals) noexcept;
  void text(std::string_view key, std::string_view value) noexcept;
  void clear() noexcept { size_ = 0; }
  [[nodiscard]] std::span<const FieldReading> parts() const noexcept {
    return std::span(parts_).first(size_);
  }

 private:
  FieldReading& add(std::string_view key) noexcept;
  std::array<FieldReading, 4> parts_;
  std::size_t size_ = 0;
};

/// Readings of a record from its own value; most records have none.
void read_value(const WorldCoordinates& value, FieldReadings& out) noexcept;
void read_value(const EulerAngles& value, FieldReadings& out) noexcept;
void read_value(const ClockTime& value, FieldReadings& out) noexcept;

/// Readings of a field that depend on the other fields of its record.
void read_field(const PduHeader& record, std::string_view field, FieldReadings& out) noexcept;
void read_field(const EntityState& record, std::string_view field, FieldReadings& out) noexcept;
void read_field(const EntityStateUpdate& record, std::string_view field,
                FieldReadings& out) noexcept;
void read_field(const AggregateState& record, std::string_view field, FieldReadings& out) noexcept;
void read_field(const Iff& record, std::string_view field, FieldReadings& out) noexcept;

/// "41:15.999999": minutes and seconds past the hour of a DIS timestamp.
void put_past_the_hour(TextSink& sink, std::uint32_t timestamp);

/// The octets as text if all are printable ASCII, tabs or line ends, without trailing NULs; else
/// empty.
[[nodiscard]] std::string_view text_in(std::span<const std::byte> octets) noexcept;

}  // namespace reckon::pdu
