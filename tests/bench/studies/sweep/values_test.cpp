// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/bench/studies/sweep/values.hpp"

#include <gmock/gmock.h>

#include "reckon/tools/command_line/console.hpp"

namespace reckon::bench {
namespace {

using ::testing::DoubleEq;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr ValueRule kTime{"s", 0, 2, false};
constexpr ValueRule kShare{"", 0, 1, false};

std::string refusal(std::string_view text, const ValueRule& rule = kTime) {
  try {
    static_cast<void>(read_values(text, rule, "--sweep delay"));
  } catch (const tools::UsageError& error) {
    return error.what();
  }
  return "taken";
}

TEST(AxisValues, RangeHasBothEndsAndTheGivenCount) {
  EXPECT_THAT(read_values("0..200ms/5", kTime, ""),
              ElementsAre(0, DoubleEq(0.05), DoubleEq(0.1), DoubleEq(0.15), 0.2));
  EXPECT_THAT(read_values("1 .. 0.5 / 2", kShare, ""), ElementsAre(1, 0.5));
  EXPECT_EQ(read_values("0..1s", kTime, "").size(), kRangeValues);
}

TEST(AxisValues, NumberTakesTheNextUnit) {
  EXPECT_THAT(read_values("10, 20, 50ms, 1s", kTime, ""), ElementsAre(0.01, 0.02, 0.05, 1));
  EXPECT_THAT(read_values("10..20ms/2,1", kTime, ""), ElementsAre(0.01, 0.02, 1));
  EXPECT_THAT(read_values("0.25, 1", kTime, ""), ElementsAre(0.25, 1)) << "SI without any";
}

TEST(AxisValues, UnitsWithASlashAreNoCount) {
  const ValueRule stiffness{"N/m", 0, 1e5, false};
  EXPECT_THAT(read_values("100..300N/m/3", stiffness, ""), ElementsAre(100, 200, 300));
  EXPECT_EQ(read_values("100..300 N/m", stiffness, "").size(), kRangeValues);
}

TEST(AxisValues, SharesAreAcceptedAsPercent) {
  EXPECT_THAT(read_values("0..50%/3", kShare, ""), ElementsAre(0, 0.25, 0.5));
}

TEST(AxisValues, ListsMayHoldRanges) {
  EXPECT_THAT(read_values("0,0.1..0.3/3,0.9", kShare, ""),
              ElementsAre(0, 0.1, DoubleEq(0.2), 0.3, 0.9));
}

TEST(AxisValues, RefusesWithPlaceAndRemedy) {
  EXPECT_THAT(refusal(""), HasSubstr("--sweep delay: '' has no value; write A..B/N or A,B,C"));
  EXPECT_THAT(refusal("0..,1"), HasSubstr("has no value"));
  EXPECT_THAT(refusal("fast"), HasSubstr("does not start with a number"));
  EXPECT_THAT(refusal("5 mm"), HasSubstr("unit 'mm' does not fit here: write one of"));
  EXPECT_THAT(refusal("0..3s"), HasSubstr("'3s' is not from 0 s to 2 s"));
  EXPECT_THAT(refusal("-1..1s"), HasSubstr("is not from 0 s to 2 s"));
  EXPECT_THAT(refusal("0..1s/1"), HasSubstr("'1' is not a count from 2 to 1000"));
  EXPECT_THAT(refusal("0..1s/99999"), HasSubstr("is not a count"));
  EXPECT_THAT(refusal("0,50ms,0.05"), HasSubstr("'50 ms' is given twice"));
  EXPECT_THAT(refusal("0", {"", 0, 1, true}), HasSubstr("is not above 0 to 1"));
}

}  // namespace
}  // namespace reckon::bench
