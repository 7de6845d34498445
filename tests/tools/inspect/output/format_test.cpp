// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Numbers of the inspector's output against fmt, whose octets they must have.
#include "reckon/tools/inspect/output/format.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <string>

namespace reckon::tools {
namespace {

std::string thousandths(double value) {
  std::string text;
  append_thousandths(text, value);
  return text;
}

TEST(InspectFormat, RoundsHalvesOfAThousandthToTheEvenOne) {
  EXPECT_EQ(thousandths(0.0625), "0.062");
  EXPECT_EQ(thousandths(0.1875), "0.188");
  EXPECT_EQ(thousandths(-0.0625), "-0.062");
  EXPECT_EQ(thousandths(4443210.0625), "4443210.062");
  EXPECT_EQ(thousandths(std::nextafter(0.0625, 1)), "0.063");
  EXPECT_EQ(thousandths(std::nextafter(0.0625, 0)), "0.062");
  EXPECT_EQ(thousandths(0.0005), "0.001");  // the double lies above the half
  EXPECT_EQ(thousandths(0.9996), "1.000");
}

TEST(InspectFormat, KeepsTheSignOfZeroAndWhatIsNoNumber) {
  EXPECT_EQ(thousandths(0.0), "0.000");
  EXPECT_EQ(thousandths(-0.0), "-0.000");
  EXPECT_EQ(thousandths(-1e-9), "-0.000");
  EXPECT_EQ(thousandths(std::numeric_limits<double>::denorm_min()), "0.000");
  EXPECT_EQ(thousandths(std::numeric_limits<double>::infinity()), "inf");
  EXPECT_EQ(thousandths(-std::numeric_limits<double>::infinity()), "-inf");
  EXPECT_EQ(thousandths(std::numeric_limits<double>::quiet_NaN()), "nan");
}

TEST(InspectFormat, AgreesWithFmtAtTheEdgesOfItsRange) {
  for (int exponent = -70; exponent <= 70; ++exponent) {
    const double edge = std::ldexp(1.0, exponent);
    for (const double value : {std::nextafter(edge, 0.0), edge, std::nextafter(edge, 1e300)})
      EXPECT_EQ(thousandths(value), fmt::format("{:.3f}", value)) << exponent;
  }
  const double largest = std::numeric_limits<double>::max();
  EXPECT_EQ(thousandths(-largest), fmt::format("{:.3f}", -largest));
}

TEST(InspectFormat, AgreesWithFmtOnRandomOctetsAndCoordinates) {
  std::mt19937_64 random(20120701);
  std::uniform_real_distribution<double> coordinate(-6.4e6, 6.4e6);
  std::uniform_int_distribution<std::int64_t> sixteenths(-1'000'000'000, 1'000'000'000);
  for (int i = 0; i < 100'000; ++i) {
    for (const double value : {std::bit_cast<double>(random()), coordinate(random),
                               static_cast<double>(sixteenths(random)) / 16})
      ASSERT_EQ(thousandths(value), fmt::format("{:.3f}", value)) << i;
  }
}

TEST(InspectFormat, WritesTimesExactly) {
  const auto text = [](std::int64_t count) {
    std::string out;
    append_time(out, std::chrono::nanoseconds(count));
    return out;
  };
  EXPECT_EQ(text(0), "0.000000000");
  EXPECT_EQ(text(7), "0.000000007");
  EXPECT_EQ(text(-1'500'000'000), "-1.500000000");
  EXPECT_EQ(text(1'700'000'000'123'456'789), "1700000000.123456789");
  EXPECT_EQ(text(std::numeric_limits<std::int64_t>::min()), "-9223372036.854775808");
}

}  // namespace
}  // namespace reckon::tools
