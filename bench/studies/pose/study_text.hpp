// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Compact numbers for tables and pages of studies.
#pragma once

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <string_view>

#include "reckon/pdu/seconds.hpp"
#include "reckon/peer/network/impairment.hpp"

namespace reckon::bench {

/// Three digits, without an exponent if that is short: "0", "0.0312", "12.3", "41200".
[[nodiscard]] inline std::string number_text(double value) {
  if (value == 0) return "0";
  const double size = std::abs(value);
  if (!(size >= 1e-4 && size < 1e6)) return fmt::format("{:.2g}", value);
  const int decimals = std::max(0, 2 - static_cast<int>(std::floor(std::log10(size))));
  std::string text = fmt::format("{:.{}f}", value, decimals);
  if (text.find('.') != std::string::npos) text.erase(text.find_last_not_of('0') + 1);
  if (text.ends_with('.')) text.pop_back();
  return text;
}

/// The number shown by three digits, for comparing values as in tables. NaN counts as 0.
[[nodiscard]] inline double in_three_digits(double value) {
  if (!(std::abs(value) > 0)) return 0;
  if (std::isinf(value)) return value;
  const double digits = std::pow(10, 2 - std::floor(std::log10(std::abs(value))));
  return std::round(value * digits) / digits;
}

/// Three digits and a suitable unit: "0.33 mm", "5.2 m", "1.2 km".
[[nodiscard]] inline std::string length_text(double metres) {
  struct Unit {
    std::string_view name;
    double metres;
  };
  constexpr std::array kUnits{Unit{"km", 1e3}, Unit{"m", 1}, Unit{"mm", 1e-3}, Unit{"um", 1e-6},
                              Unit{"nm", 1e-9}};
  if (metres == 0) return "0 m";
  for (const Unit& unit : kUnits) {
    // A value that would be rounded up to 1000 belongs to the next unit.
    if (std::abs(metres) >= 0.9995 * unit.metres)
      return fmt::format("{} {}", number_text(metres / unit.metres), unit.name);
  }
  return "< 1 nm";
}

[[nodiscard]] inline double degrees(double radians) { return radians * 180 / std::numbers::pi; }

/// "delay 80 ms +-40 %, 10 % lost"
[[nodiscard]] inline std::string network_text(const peer::ImpairmentLaw& law) {
  std::string text = fmt::format("delay {} ms", number_text(1e3 * pdu::to_seconds(law.delay)));
  if (law.jitter.count() > 0)
    text += fmt::format(" +-{} %", number_text(100 * peer::jitter_share(law)));
  if (law.loss > 0) text += fmt::format(", {} % lost", number_text(100 * law.loss));
  return text;
}

}  // namespace reckon::bench
