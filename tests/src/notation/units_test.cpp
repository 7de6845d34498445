// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/notation/units.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <tuple>

namespace reckon::peer {
namespace {

using testing::HasSubstr;

TEST(Units, ReadEachSpellingAsSi) {
  const std::tuple<const char*, const char*, double> cases[] = {
      {"5 ms", "s", 0.005},
      {"0.5 m", "m", 0.5},
      {"3 deg", "rad", std::numbers::pi / 60},
      {"800 N/m", "N/m", 800},
      {"4 N s/m", "N s/m", 4},
      {"4 Ns/m", "N s/m", 4},
      {"2 MN/m3", "N/m3", 2e6},
      {"2 N/m^3", "N/m3", 2},
      {"7mm", "m", 0.007},
      {"  -12.5   cm ", "m", -0.125},
      {"+1e3 us", "s", 0.001},
      {"30 %", "", 0.3},
      {"1.5 KiB", "B", 1536},
      {"-9.81 m/s2", "m/s2", -9.81},
      {"2 h", "s", 7200},
      {"1 kHz", "Hz", 1000},
  };
  for (const auto& [text, unit, value] : cases) {
    const Quantity read = parse_quantity(text, unit);
    EXPECT_TRUE(read.good()) << text << ": " << read.error;
    EXPECT_DOUBLE_EQ(read.value, value) << text;
  }
}

TEST(Units, TakeANumberAloneAsSi) {
  EXPECT_EQ(parse_quantity("0.25", "m").value, 0.25);
  EXPECT_EQ(parse_quantity("1e-3", "s").value, 1e-3);
}

TEST(Units, MillimetresAreTheNearestDoubleToTheDecimal) {
  for (int mm = 1; mm < 1000; ++mm) {
    const double metres = std::stod("0." +
                                    std::string(mm < 10    ? "00"
                                                : mm < 100 ? "0"
                                                           : "") +
                                    std::to_string(mm));
    EXPECT_EQ(parse_quantity(std::to_string(mm) + " mm", "m").value, metres);
  }
}

TEST(Units, RefuseMisfitsAndNameFittingUnits) {
  EXPECT_THAT(parse_quantity("5 ms", "m").error, HasSubstr("m, mm, um, cm, km"));
  EXPECT_THAT(parse_quantity("5 N/m", "N s/m").error, HasSubstr("'N/m' does not fit here"));
  EXPECT_THAT(parse_quantity("5 m", "").error, HasSubstr("number without a unit"));
  EXPECT_THAT(parse_quantity("stiff", "N/m").error, HasSubstr("does not start with a number"));
  for (const char* text :
       {"", " ", "-", "+", "nan m", "inf m", "1e999 m", "0x10 m", "1 m m", "--1 m", "1,5 m", "m"}) {
    EXPECT_FALSE(parse_quantity(text, "m").good()) << text;
  }
}

TEST(Units, AreShownAsAPersonWouldWriteThem) {
  EXPECT_EQ(format_quantity(0.005, "s"), "5 ms");
  EXPECT_EQ(format_quantity(0.0005, "m"), "500 um");
  EXPECT_EQ(format_quantity(0.05, "m"), "50 mm");
  EXPECT_EQ(format_quantity(800, "N/m"), "800 N/m");
  EXPECT_EQ(format_quantity(20000, "N/m"), "20 kN/m");
  EXPECT_EQ(format_quantity(std::numbers::pi / 60, "rad"), "3 deg");
  EXPECT_EQ(format_quantity(2e6, "m"), "2000 km");
  EXPECT_EQ(format_quantity(1e-4, "N"), "0.1 mN");
  EXPECT_EQ(format_quantity(0, "m"), "0 m");
  EXPECT_EQ(format_quantity(0.4, ""), "0.4");
}

TEST(Units, ShownAndReadAgainAreTheSame) {
  for (const char* unit :
       {"m", "s", "rad", "N", "kg", "Hz", "J", "N/m", "N s/m", "N/m3", "m/s", ""}) {
    for (double value = 1e-7; value < 1e7; value *= 3.7) {
      const Quantity again = parse_quantity(format_quantity(-value, unit), unit);
      ASSERT_TRUE(again.good()) << again.error;
      EXPECT_NEAR(again.value, -value, value * 1e-8) << unit;  // nine digits are shown
    }
  }
}

TEST(Units, OfTimeBecomeNanosecondsRoundedAndSaturated) {
  using std::chrono::nanoseconds;
  EXPECT_EQ(to_nanoseconds(0.005), std::chrono::milliseconds(5));
  EXPECT_EQ(to_nanoseconds(1.4e-9), nanoseconds(1));
  EXPECT_EQ(to_nanoseconds(1e300), nanoseconds::max());
  EXPECT_EQ(to_nanoseconds(-1e300), nanoseconds::min());
  EXPECT_EQ(to_nanoseconds(std::numeric_limits<double>::quiet_NaN()), nanoseconds(0));
}

}  // namespace
}  // namespace reckon::peer
