// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Numbers of the inspector's output, compared octet for octet with fmt.
#include "reckon/tools/inspect/output/format.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <string>

namespace reckon::tools::format_test {
namespace {

std::string thousandths(double value) {
  std::string text;
  append_thousandths(text, value);
  return text;
}

TEST(InspectFormat, RoundsHalvesOfAThousandthToEven) {
  EXPECT_EQ(thousandths(0.0625), "0.062");
  EXPECT_EQ(thousandths(0.1875), "0.188");
  EXPECT_EQ(thousandths(-0.0625), "-0.062");
  EXPECT_EQ(thousandths(4443210.0625), "4443210.062");
  EXPECT_EQ(thousandths(std::nextafter(0.0625, 1)), "0.063");
  EXPECT_EQ(thousandths(std::nextafter(0.0625, 0)), "0.062");
  EXPECT_EQ(thousandths(0.0005), "0.001");  // the double is above the half
  EXPECT_EQ(thousandths(0.9996), "1.000");
}

TEST(InspectFormat, KeepsSignsOfZeroAndNonFiniteNumbers) {
  EXPECT_EQ(thousandths(0.0), "0.000");
  EXPECT_EQ(thousandths(-0.0), "-0.000");
  EXPECT_EQ(thousandths(-1e-9), "-0.000");
  EXPECT_EQ(thousandths(std::numeric_limits<double>::denorm_min()), "0.000");
  EXPECT_EQ(thousandths(std::numeric_limits<double>::infinity()), "inf");
  EXPECT_EQ(thousandths(-std::numeric_limits<double>::infinity()), "-inf");
  EXPECT_EQ(thousandths(std::numeric_limits<double>::quiet_NaN()), "nan");
}

TEST(InspectFormat, AgreesWithFmtAtItsRangesEdges) {
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

std::string csv_cell(std::string_view cell) {
  std::string text;
  append_csv_cell(text, cell);
  return text;
}

TEST(InspectCsvCell, QuotesByRfc4180) {
  EXPECT_EQ(csv_cell("TRUCK 1"), "TRUCK 1");
  EXPECT_EQ(csv_cell("a,b"), "\"a,b\"");
  EXPECT_EQ(csv_cell("a\"b"), "\"a\"\"b\"");
  EXPECT_EQ(csv_cell(""), "");
}

TEST(InspectCsvCell, HasNoCursorMovesOrLineBreaks) {
  EXPECT_EQ(csv_cell("\x1b[2J\x1b]0;x\x07"), ".[2J.]0;x.");
  EXPECT_EQ(csv_cell("a\nb\r\tc\x7f"), "a.b..c.");
  EXPECT_EQ(csv_cell("a\u009b2Jb"), "a.2Jb");  // C1, as UTF-8
  EXPECT_EQ(csv_cell("a\x9b"
                     "2Jb"),
            "a\ufffd2Jb");  // and bare
  EXPECT_EQ(csv_cell("\xff\xc3("), "\ufffd\ufffd(");
  EXPECT_EQ(csv_cell("A\u202eB\u2028C"), "A.B.C");
  EXPECT_EQ(csv_cell("caf\u00e9"), "caf\u00e9");
}

TEST(InspectCsvCell, IsNoFormula) {
  for (const char* formula :
       {"=1+2", "+SUM(A1)", "-cmd|' /C calc'!A0", "@SUM(1)", "-", "=", "\uff1d1+2", "-1.5x"}) {
    EXPECT_EQ(csv_cell(formula), std::string("'") + formula);
  }
  EXPECT_EQ(csv_cell("=1,2"), "\"'=1,2\"");
  EXPECT_EQ(csv_cell("\t=1+2"), ".=1+2");
  for (const char* number : {"-1.5", "-0", "-1e-9", "-inf", "3"})
    EXPECT_EQ(csv_cell(number), number);
}

}  // namespace
}  // namespace reckon::tools::format_test
