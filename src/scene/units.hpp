// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Quantities with units, as scene files and command lines write them: "5 ms", "0.5 m", "800 N/m".
#pragma once

#include <chrono>
#include <string>
#include <string_view>

namespace reckon::peer {

/// A quantity in SI, or why the text is not one.
struct Quantity {
  double value = 0.0;
  std::string error;  ///< empty when good; else one sentence with the units that would do
  [[nodiscard]] bool good() const noexcept { return error.empty(); }
};

/// Reads "NUMBER UNIT" as SI. `si_unit` says what is wanted ("m", "rad", "s", "N/m", "" for a plain
/// number) and must be one of the table in units.cpp; a number without unit is taken as SI already.
/// A percentage is good where a plain number is. Finite results only. Blank between the two is
/// free.
[[nodiscard]] Quantity parse_quantity(std::string_view text, std::string_view si_unit);

/// `value` [SI] with the unit that a person would choose: 0.005 "s" gives "5 ms".
[[nodiscard]] std::string format_quantity(double value, std::string_view si_unit);

/// The spellings that parse_quantity takes for `si_unit`, such as "m, mm, cm, km".
[[nodiscard]] std::string units_for(std::string_view si_unit);

/// Seconds to the clock's unit, rounded to the nearest; saturates at about 292 years.
[[nodiscard]] std::chrono::nanoseconds to_nanoseconds(double seconds) noexcept;

}  // namespace reckon::peer
