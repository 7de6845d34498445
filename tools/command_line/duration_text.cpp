// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/command_line/duration_text.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "reckon/peer/notation/units.hpp"

namespace reckon::tools {
namespace {

struct Unit {
  std::string_view name;
  double nanoseconds;
};

constexpr std::array kUnits{Unit{"s", 1e9}, Unit{"ms", 1e6}, Unit{"us", 1e3}, Unit{"ns", 1.0}};

std::string two_units(std::int64_t large, std::string_view large_unit, std::int64_t small,
                      std::string_view small_unit) {
  if (small == 0) return fmt::format("{} {}", large, large_unit);
  return fmt::format("{} {} {} {}", large, large_unit, small, small_unit);
}

}  // namespace

std::optional<std::chrono::nanoseconds> parse_duration(std::string_view text) {
  const peer::Quantity quantity = peer::parse_quantity(text, "s");
  if (!quantity.good() || std::signbit(quantity.value)) return std::nullopt;
  // A number without a unit could mean seconds or milliseconds; only zero is unambiguous.
  if (quantity.value != 0 && text.find_first_of("smhnu") == text.npos) return std::nullopt;
  const std::chrono::nanoseconds duration = peer::to_nanoseconds(quantity.value);
  if (duration == std::chrono::nanoseconds::max()) return std::nullopt;
  return duration;
}

std::string duration_text(std::chrono::nanoseconds duration) {
  const std::int64_t seconds = duration.count() / 1'000'000'000;
  if (seconds >= 3600) return two_units(seconds / 3600, "h", seconds / 60 % 60, "min");
  if (seconds >= 60) return two_units(seconds / 60, "min", seconds % 60, "s");
  const auto count = static_cast<double>(duration.count());
  for (const Unit& unit : kUnits) {
    if (std::abs(count) >= unit.nanoseconds)
      return fmt::format("{:.4g} {}", count / unit.nanoseconds, unit.name);
  }
  return "0 s";
}

}  // namespace reckon::tools
