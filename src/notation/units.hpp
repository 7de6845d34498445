// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Quantities with units in scene files and command lines: "5 ms", "0.5 m", "800 N/m".
#pragma once

#include <chrono>
#include <string>
#include <string_view>

namespace reckon::peer {

/// A quantity in SI, or the reason why the text is invalid.
struct Quantity {
  double value = 0.0;
  std::string error;  ///< empty if valid; else one sentence with the accepted units
  [[nodiscard]] bool good() const noexcept { return error.empty(); }
};

/// Reads "NUMBER UNIT" as SI. `si_unit` is the expected unit ("m", "rad", "s", "N/m", "" for a
/// plain number) and must be in the table of units.cpp; a number without a unit is in SI. A
/// percentage is accepted for a plain number. Finite results only. Any blanks between the two are
/// allowed.
[[nodiscard]] Quantity parse_quantity(std::string_view text, std::string_view si_unit);

/// `value` [SI] with a readable unit: 0.005 "s" gives "5 ms".
[[nodiscard]] std::string format_quantity(double value, std::string_view si_unit);

/// The spellings that parse_quantity accepts for `si_unit`, such as "m, mm, cm, km".
[[nodiscard]] std::string units_for(std::string_view si_unit);

/// Seconds in the clock's unit, rounded to the nearest; saturates at about 292 years.
[[nodiscard]] std::chrono::nanoseconds to_nanoseconds(double seconds) noexcept;

}  // namespace reckon::peer
