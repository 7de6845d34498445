// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/notation/units.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <numbers>

namespace reckon::peer {
namespace {

/// One spelling of one unit: value [SI] = number * multiply / divide. Two whole numbers, because 7
/// / 1000 is the double nearest to 0.007, while 7 * 0.001 may not be.
struct Unit {
  std::string_view si;
  std::string_view name;
  double multiply;
  double divide;
  bool shown;  ///< format_quantity may choose it
};

constexpr double kPi = std::numbers::pi;

constexpr std::array kUnits = std::to_array<Unit>({
    {"", "", 1, 1, true},
    {"", "%", 1, 100, false},
    {"m", "m", 1, 1, true},
    {"m", "mm", 1, 1000, true},
    {"m", "um", 1, 1e6, true},
    {"m", "cm", 1, 100, false},
    {"m", "km", 1000, 1, true},
    {"s", "s", 1, 1, true},
    {"s", "ms", 1, 1000, true},
    {"s", "us", 1, 1e6, true},
    {"s", "ns", 1, 1e9, true},
    {"s", "min", 60, 1, false},
    {"s", "h", 3600, 1, false},
    {"rad", "deg", kPi, 180, true},
    {"rad", "rad", 1, 1, false},
    {"rad", "mrad", 1, 1000, false},
    {"rad/s", "rad/s", 1, 1, true},
    {"rad/s", "deg/s", kPi, 180, false},
    {"N", "N", 1, 1, true},
    {"N", "mN", 1, 1000, true},
    {"N", "kN", 1000, 1, true},
    {"kg", "kg", 1, 1, true},
    {"kg", "g", 1, 1000, true},
    {"kg m2", "kg m2", 1, 1, true},
    {"kg m2", "kg m^2", 1, 1, false},
    {"kg m2", "g cm2", 1, 1e7, true},
    {"Hz", "Hz", 1, 1, true},
    {"Hz", "kHz", 1000, 1, true},
    {"J", "J", 1, 1, true},
    {"J", "mJ", 1, 1000, true},
    {"W", "W", 1, 1, true},
    {"W", "mW", 1, 1000, true},
    {"N/m", "N/m", 1, 1, true},
    {"N/m", "N/mm", 1000, 1, false},
    {"N/m", "kN/m", 1000, 1, true},
    {"N/s", "N/s", 1, 1, true},
    {"N/s", "kN/s", 1000, 1, true},
    {"N s/m", "N s/m", 1, 1, true},
    {"N s/m", "Ns/m", 1, 1, false},
    {"N s2/m2", "N s2/m2", 1, 1, true},
    {"N m", "N m", 1, 1, true},
    {"N m", "mN m", 1, 1000, true},
    {"N m", "Nm", 1, 1, false},
    {"N m/rad", "N m/rad", 1, 1, true},
    {"N m/rad", "Nm/rad", 1, 1, false},
    {"N m s/rad", "N m s/rad", 1, 1, true},
    {"N m s/rad", "Nm s/rad", 1, 1, false},
    {"1/s", "1/s", 1, 1, true},
    {"1/m2", "1/m2", 1, 1, true},
    {"1/m2", "1/cm2", 10000, 1, false},
    {"s/m", "s/m", 1, 1, true},
    {"N/m3", "N/m3", 1, 1, true},
    {"N/m3", "N/m^3", 1, 1, false},
    {"N/m3", "N/mm3", 1e9, 1, false},
    {"N/m3", "MN/m3", 1e6, 1, true},
    {"m/s", "m/s", 1, 1, true},
    {"m/s", "mm/s", 1, 1000, true},
    {"m/s2", "m/s2", 1, 1, true},
    {"m/s2", "m/s^2", 1, 1, false},
    {"1/m", "1/m", 1, 1, true},
    {"1/m", "1/mm", 1000, 1, false},
    {"B", "B", 1, 1, true},
    {"B", "kB", 1000, 1, false},
    {"B", "KiB", 1024, 1, false},
    {"B", "MiB", 1048576, 1, false},
    {"B", "GiB", 1073741824, 1, false},
});

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view kBlank = " \t";
  const auto begin = text.find_first_not_of(kBlank);
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(kBlank) - begin + 1);
}

const Unit* find_unit(std::string_view name, std::string_view si) {
  for (const Unit& unit : kUnits) {
    if (unit.si == si && unit.name == name) return &unit;
  }
  return nullptr;
}

std::string example(std::string_view si) { return si.empty() ? "0.5" : fmt::format("5 {}", si); }

/// Factor by which `magnitude` in `unit` is outside 1 .. 1000; 1 is best.
double clumsiness(const Unit& unit, double magnitude) {
  const double shown = magnitude * unit.divide / unit.multiply;
  if (shown < 0.9999999) return 1 / shown;
  return std::max(1.0, shown / 999.9999999);
}

}  // namespace

Quantity parse_quantity(std::string_view text, std::string_view si_unit) {
  text = trimmed(text);
  if (text.starts_with('+')) text.remove_prefix(1);
  double number = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || !std::isfinite(number)) {
    return {0.0,
            fmt::format("'{}' does not start with a number: write \"{}\"", text, example(si_unit))};
  }
  const auto name = trimmed(text.substr(static_cast<std::size_t>(end - text.data())));
  if (name.empty()) return {number, {}};
  const Unit* unit = find_unit(name, si_unit);
  if (unit == nullptr && si_unit.empty()) {
    return {0.0, fmt::format("unit '{}', but a number without a unit is needed", name)};
  }
  if (unit == nullptr) {
    return {0.0,
            fmt::format("unit '{}' does not fit here: write one of {}", name, units_for(si_unit))};
  }
  const double value = number * unit->multiply / unit->divide;
  if (!std::isfinite(value)) return {0.0, fmt::format("'{}' is too large", text)};
  return {value, {}};
}

std::string format_quantity(double value, std::string_view si_unit) {
  if (si_unit == "rad") return fmt::format("{:.9g} deg", value * 180.0 / kPi);
  const Unit* best = find_unit(si_unit, si_unit);
  for (const Unit& unit : kUnits) {
    if (unit.si != si_unit || !unit.shown || value == 0) continue;
    if (clumsiness(unit, std::abs(value)) < clumsiness(*best, std::abs(value))) best = &unit;
  }
  if (best == nullptr || best->name.empty()) return fmt::format("{:.9g}", value);
  return fmt::format("{:.9g} {}", value * best->divide / best->multiply, best->name);
}

std::string units_for(std::string_view si_unit) {
  std::string list;
  for (const Unit& unit : kUnits) {
    if (unit.si != si_unit || unit.name.empty()) continue;
    if (!list.empty()) list += ", ";
    list += unit.name;
  }
  return list;
}

std::chrono::nanoseconds to_nanoseconds(double seconds) noexcept {
  constexpr double kMost = 9.2e18;
  const double count = std::round(seconds * 1e9);
  if (std::isnan(count)) return std::chrono::nanoseconds(0);
  if (count >= kMost) return std::chrono::nanoseconds::max();
  if (count <= -kMost) return std::chrono::nanoseconds::min();
  return std::chrono::nanoseconds(static_cast<std::int64_t>(count));
}

}  // namespace reckon::peer
