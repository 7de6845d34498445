// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/inspect/output/format.hpp"

#include <fmt/compile.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <iterator>

#include "reckon/tools/terminal/foreign_text.hpp"
#include "reckon/tools/terminal/json_text.hpp"

namespace reckon::tools {
namespace {

/// `value` in decimal, with at least `digits` digits.
void append_digits(std::string& out, std::uint64_t value, std::size_t digits) {
  const fmt::format_int text(value);
  if (text.size() < digits) out.append(digits - text.size(), '0');
  out.append(text.data(), text.size());
}

/// |value| in thousandths, rounded to nearest, ties to even; for |value| < 2^52, whose last bit is
/// 2^-1 or less.
std::uint64_t thousandths_of(double value) {
  const auto bits = std::bit_cast<std::uint64_t>(value);
  const auto exponent = static_cast<int>((bits >> 52) & 0x7FF);
  const int shift = 1075 - exponent;  // |value| = significand / 2^shift
  if (shift > 63) return 0;           // below 2^-11, which is less than half of a thousandth
  const std::uint64_t significand = (bits & ((1ULL << 52) - 1)) | (1ULL << 52);
  const std::uint64_t product = significand * 1000;  // below 2^63
  const std::uint64_t whole = product >> shift;
  const std::uint64_t rest = product - (whole << shift);
  const std::uint64_t half = 1ULL << (shift - 1);
  return whole + ((rest > half || (rest == half && whole % 2 == 1)) ? 1 : 0);
}

/// Whether a spreadsheet would evaluate the cell as a formula: some accept full-width signs too.
bool is_formula(std::string_view cell) {
  constexpr std::array<std::string_view, 8> kSigns{"=",      "+",      "-",      "@",
                                                   "\uff1d", "\uff0b", "\uff0d", "\uff20"};
  const bool begins = std::any_of(kSigns.begin(), kSigns.end(),
                                  [&](std::string_view sign) { return cell.starts_with(sign); });
  if (!begins) return false;
  const char* end = cell.data() + cell.size();
  double number = 0.0;
  const auto read = std::from_chars(cell.data(), end, number);
  return read.ec != std::errc() || read.ptr != end;
}

}  // namespace

void append_number(std::string& out, std::uint64_t value) { append_digits(out, value, 1); }

void append_thousandths(std::string& out, double value) {
  constexpr double kExact = 0x1p52;
  if (!(std::abs(value) < kExact)) {
    fmt::format_to(std::back_inserter(out), FMT_COMPILE("{:.3f}"), value);
    return;
  }
  if (std::signbit(value)) out += '-';
  const std::uint64_t thousandths = thousandths_of(value);
  append_digits(out, thousandths / 1000, 1);
  out += '.';
  append_digits(out, thousandths % 1000, 3);
}

void append_time(std::string& out, std::chrono::nanoseconds time) {
  constexpr std::uint64_t kSecond = 1'000'000'000;
  const std::int64_t count = time.count();
  if (count < 0) out += '-';
  const auto magnitude =
      count < 0 ? 0 - static_cast<std::uint64_t>(count) : static_cast<std::uint64_t>(count);
  append_digits(out, magnitude / kSecond, 1);
  out += '.';
  append_digits(out, magnitude % kSecond, 9);
}

void append_id(std::string& out, pdu::EntityId id) {
  append_number(out, id.site);
  out += ':';
  append_number(out, id.application);
  out += ':';
  append_number(out, id.entity);
}

std::string id_text(pdu::EntityId id) {
  std::string text;
  append_id(text, id);
  return text;
}

void append_csv_cell(std::string& out, std::string_view cell) {
  const auto is_plain = [](char letter) {
    return letter >= 0x20 && letter < 0x7F && letter != ',' && letter != '"';
  };
  const bool formula = is_formula(cell);
  if (!formula && std::all_of(cell.begin(), cell.end(), is_plain)) {
    out += cell;
    return;
  }
  std::string clean = formula ? "'" : "";
  append_clean_text(clean, cell);
  if (clean.find_first_of(",\"") == std::string::npos) {
    out += clean;
    return;
  }
  out += '"';
  for (const char letter : clean) {
    if (letter == '"') out += '"';
    out += letter;
  }
  out += '"';
}

void append_json_member(std::string& out, std::string_view key, std::string_view value) {
  fmt::format_to(std::back_inserter(out), FMT_COMPILE(",\"{}\":"), key);
  append_json_string(out, value);
}

std::string json_number(double value, int digits) {
  return std::isfinite(value) ? fmt::format("{:.{}g}", value, digits) : "null";
}

}  // namespace reckon::tools
