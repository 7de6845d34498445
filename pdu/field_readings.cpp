// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/pdu/field_readings.hpp"

#include <algorithm>
#include <charconv>
#include <chrono>
#include <cmath>
#include <numbers>

#include "reckon/pdu/geodetic.hpp"
#include "reckon/pdu/timestamp.hpp"

namespace reckon::pdu {
namespace {

using std::chrono::microseconds;

constexpr double kDegrees = 180.0 / std::numbers::pi;
constexpr int kPlaceDecimals = 7;  // of a degree: 1 cm
// Half of the last digit, by the count of decimals.
constexpr std::array<double, 8> kHalves{0.5,    0.5e-1, 0.5e-2, 0.5e-3,
                                        0.5e-4, 0.5e-5, 0.5e-6, 0.5e-7};

/// `value` with at least `digits` digits.
void put_digits(TextSink& sink, std::uint64_t value, unsigned digits) {
  for (std::uint64_t power = 10; digits > 1; --digits, power *= 10)
    if (value < power) sink.text('0');
  sink.number(value);
}

/// Writes a time past the hour as "01:15.999999", in minutes and seconds.
void put_minutes(TextSink& sink, std::chrono::nanoseconds past_hour) {
  const auto micros =
      static_cast<std::uint64_t>(std::chrono::duration_cast<microseconds>(past_hour).count());
  put_digits(sink, micros / 60'000'000, 2);
  sink.text(':');
  put_digits(sink, micros / 1'000'000 % 60, 2);
  sink.text('.');
  put_digits(sink, micros % 1'000'000, 6);
}

/// Reads an orientation: heading, pitch and roll against the horizon if the location is a place on
/// earth, else the angles of the PDU in degrees.
void read_orientation(const EulerAngles& orientation, const WorldCoordinates& location,
                      FieldReadings& out) noexcept {
  const auto place = geodetic_from(location);
  if (!place.has_value()) return read_value(orientation, out);
  const auto attitude = attitude_from(orientation, *place);
  if (!attitude.has_value()) return;
  out.number("heading", "deg", attitude->heading_deg, 3);
  out.number("pitch", "deg", attitude->pitch_deg, 3);
  out.number("roll", "deg", attitude->roll_deg, 3);
}

// Whether the parameters of this system type are modes: Mark X, XII and ATCRBS, and their
// successors.
bool has_modes(std::uint16_t system_type) {
  constexpr std::array<std::uint16_t, 8> kTypes{1, 2, 6, 7, 8, 9, 10, 11};
  return std::ranges::find(kTypes, system_type) != kTypes.end();
}

constexpr unsigned kModeOn = 1U << 13;
constexpr unsigned kModeDamaged = 1U << 14;
constexpr unsigned kModeFailed = 1U << 15;

std::string_view state_of_mode(const Iff& pdu, unsigned number, unsigned parameter) {
  if (((pdu.system_status >> number) & 1U) != 0) return "not capable";
  if ((parameter & kModeFailed) != 0) return "malfunction";
  if ((parameter & kModeDamaged) != 0) return "damaged";
  return (parameter & kModeOn) != 0 ? "on" : "off";
}

/// Digits of a mode in the order of their code elements, three bits each, the lowest first.
void read_code(std::string_view key, unsigned parameter, std::size_t digits, FieldReadings& out) {
  std::array<char, 4> code{};
  for (std::size_t i = 0; i < digits; ++i)
    code[i] = static_cast<char>('0' + ((parameter >> (3 * i)) & 7U));
  out.text(key, std::string_view(code.data(), digits));
}

/// Mode C: hundreds of feet in bits 1 to 11, their sign in bit 0; all ones in bits 1 to 11: no
/// altitude.
void read_altitude(unsigned parameter, FieldReadings& out) {
  const unsigned hundreds = (parameter >> 1) & 0x7FFU;
  if (hundreds == 0x7FFU) return out.text("mode_c", "no altitude");
  const double feet = 100.0 * hundreds * ((parameter & 1U) != 0 ? -1.0 : 1.0);
  out.number("altitude", "ft", feet, 0);
}

}  // namespace

FieldReading& FieldReadings::add(std::string_view key) noexcept {
  FieldReading& part = parts_[std::min(size_, parts_.size() - 1)];
  size_ = std::min(size_ + 1, parts_.size());
  part.key = key;
  part.unit = {};
  part.size = 0;
  return part;
}

void FieldReadings::number(std::string_view key, std::string_view unit, double value,
                           int decimals) noexcept {
  FieldReading& part = add(key);
  part.unit = unit;
  const double half = kHalves[static_cast<std::size_t>(decimals)];
  if (std::abs(value) < half) value = 0.0;  // never "-0.000"
  char* begin = part.text.data();
  // A number too long for the text is written with an exponent.
  auto end =
      std::to_chars(begin, begin + part.text.size(), value, std::chars_format::fixed, decimals);
  if (end.ec != std::errc{})
    end = std::to_chars(begin, begin + part.text.size(), value, std::chars_format::scientific, 6);
  part.size = static_cast<std::size_t>(end.ptr - begin);
}

void FieldReadings::text(std::string_view key, std::string_view value) noexcept {
  FieldReading& part = add(key);
  part.size = std::min(value.size(), part.text.size());
  std::copy_n(value.begin(), part.size, part.text.begin());
}

void read_value(const WorldCoordinates& value, FieldReadings& out) noexcept {
  const auto place = geodetic_from(value);
  if (!place.has_value()) return;
  out.number("latitude", "deg", place->latitude_deg, kPlaceDecimals);
  out.number("longitude", "deg", place->longitude_deg, kPlaceDecimals);
  out.number("height", "m", place->height, 3);
}

void read_value(const EulerAngles& value, FieldReadings& out) noexcept {
  if (!std::isfinite(value.psi + value.theta + value.phi)) return;
  out.number("psi", "deg", value.psi * kDegrees, 3);
  out.number("theta", "deg", value.theta * kDegrees, 3);
  out.number("phi", "deg", value.phi * kDegrees, 3);
}

void read_value(const ClockTime& value, FieldReadings& out) noexcept {
  using namespace std::chrono;
  std::array<char, 40> buffer{};
  TextSink sink(buffer);
  // Hours of a relative clock count from any origin, so that small ones are no date; nor are hours
  // beyond the year 9999.
  constexpr int kHoursOfADate = 24 * sys_days{year{10000} / January / 1}.time_since_epoch().count();
  if (value.hour >= 24 * 365 && value.hour < kHoursOfADate) {
    const year_month_day date{sys_days{days{value.hour / 24}}};
    sink.number(static_cast<int>(date.year()));
    sink.text('-');
    put_digits(sink, static_cast<unsigned>(date.month()), 2);
    sink.text('-');
    put_digits(sink, static_cast<unsigned>(date.day()), 2);
    sink.text('T');
    put_digits(sink, static_cast<std::uint64_t>(value.hour % 24), 2);
    sink.text(':');
  } else {
    sink.number(value.hour);
    sink.text(':');
  }
  put_minutes(sink, past_the_hour(value.time_past_hour));
  out.text("time", sink.view());
}

void put_past_the_hour(TextSink& sink, std::uint32_t timestamp) {
  put_minutes(sink, past_the_hour(timestamp));
}

void read_field(const PduHeader& record, std::string_view field, FieldReadings& out) noexcept {
  if (field != "timestamp") return;
  std::array<char, 32> buffer{};
  TextSink sink(buffer);
  put_past_the_hour(sink, record.timestamp);
  out.text("past_the_hour", sink.view());
  out.text("clock", is_absolute(record.timestamp) ? "absolute" : "relative");
}

void read_field(const EntityState& record, std::string_view field, FieldReadings& out) noexcept {
  if (field == "entity_orientation") read_orientation(record.orientation, record.location, out);
}

void read_field(const EntityStateUpdate& record, std::string_view field,
                FieldReadings& out) noexcept {
  if (field == "entity_orientation")
    read_orientation(record.entity_orientation, record.entity_location, out);
}

void read_field(const AggregateState& record, std::string_view field, FieldReadings& out) noexcept {
  if (field == "orientation") read_orientation(record.orientation, record.center_of_mass, out);
}

void read_field(const Iff& record, std::string_view field, FieldReadings& out) noexcept {
  constexpr std::string_view kParameter = "parameter_";
  if (!field.starts_with(kParameter) || !has_modes(record.system_type)) return;
  switch (field.back()) {
    case '1':
      read_code("mode_1", record.parameter_1, 2, out);
      return out.text("state", state_of_mode(record, 1, record.parameter_1));
    case '2':
      read_code("mode_2", record.parameter_2, 4, out);
      return out.text("state", state_of_mode(record, 2, record.parameter_2));
    case '3':
      read_code("mode_3a", record.parameter_3, 4, out);
      return out.text("state", state_of_mode(record, 3, record.parameter_3));
    case '4':
      out.number("mode_4", "", record.parameter_4 & 0xFFFU, 0);
      return out.text("state", state_of_mode(record, 4, record.parameter_4));
    case '5':
      read_altitude(record.parameter_5, out);
      return out.text("mode_c_state", state_of_mode(record, 5, record.parameter_5));
    default:
      return;
  }
}

std::string_view text_in(std::span<const std::byte> octets) noexcept {
  std::string_view text(reinterpret_cast<const char*>(octets.data()), octets.size());
  while (text.ends_with('\0')) text.remove_suffix(1);
  const bool is_text = std::ranges::all_of(text, [](char letter) {
    return (letter >= ' ' && letter <= '~') || letter == '\t' || letter == '\n' || letter == '\r';
  });
  return is_text ? text : std::string_view();
}

}  // namespace reckon::pdu
