// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "tools/inspect_format.hpp"

#include <fmt/compile.h>
#include <fmt/format.h>

#include <cmath>
#include <iterator>

#include "tools/json_text.hpp"

namespace reckon::tools {

void append_time(std::string& out, std::chrono::nanoseconds time) {
  constexpr std::int64_t kSecond = 1'000'000'000;
  const std::int64_t count = time.count();
  if (count < 0) out += '-';
  const auto magnitude =
      count < 0 ? 0 - static_cast<std::uint64_t>(count) : static_cast<std::uint64_t>(count);
  fmt::format_to(std::back_inserter(out), FMT_COMPILE("{}.{:09d}"), magnitude / kSecond,
                 magnitude % kSecond);
}

std::string id_text(pdu::EntityId id) {
  return fmt::format(FMT_COMPILE("{}:{}:{}"), id.site, id.application, id.entity);
}

void append_csv_cell(std::string& out, std::string_view cell) {
  if (cell.find_first_of(",\"\r\n") == std::string_view::npos) {
    out += cell;
    return;
  }
  out += '"';
  for (const char letter : cell) {
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
