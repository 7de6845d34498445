// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/pdu/timestamp.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <random>
#include <string>

#include "reckon/tests/support/reference_data.hpp"

namespace reckon::pdu {
namespace {

using namespace std::chrono_literals;
using std::chrono::nanoseconds;

TEST(Timestamp, DiffersTheShortWayRoundTheHour) {
  RECKON_NEED_DATA("oracles/timestamps.json");
  const auto oracle =
      nlohmann::json::parse(std::ifstream(test::reference_data() / "oracles/timestamps.json"));
  double worst = 0.0;
  EXPECT_EQ(oracle["vectors"].size(), 12u);
  for (const auto& vector : oracle["vectors"]) {
    const std::uint32_t from = vector["field_from"];
    const std::uint32_t to = vector["field_to"];
    EXPECT_EQ(difference_units(to, from), vector["expected_units"].get<int>()) << vector["id"];
    const double seconds = std::stod(vector["expected_seconds"].get<std::string>());
    const double error =
        std::abs(std::chrono::duration<double>(difference(to, from)).count() - seconds);
    EXPECT_LE(error, 0.501e-9) << vector["id"];  // half a nanosecond, and rounding of the double
    worst = std::max(worst, error);
  }
  RecordProperty("worst_error_ns", std::to_string(worst * 1e9));
}

TEST(Timestamp, IgnoresTheLowBitInDifferences) {
  EXPECT_EQ(difference_units(101, 100), 0);
  EXPECT_TRUE(is_absolute(101));
  EXPECT_FALSE(is_absolute(100));
}

TEST(Timestamp, KeepsTheInstantToHalfAUnit) {
  std::mt19937_64 random(3);
  for (int i = 0; i < 100000; ++i) {
    const nanoseconds utc(static_cast<std::int64_t>(random() % 4'000'000'000'000'000'000ULL));
    const std::uint32_t timestamp = to_dis_timestamp(utc, true);
    EXPECT_TRUE(is_absolute(timestamp));
    EXPECT_LE(std::chrono::abs(nearest_instant(timestamp, utc) - utc), 839ns);  // 1.68 us / 2
  }
}

TEST(Timestamp, RestoresTheFieldFromItsTime) {
  std::mt19937_64 random(4);
  for (int i = 0; i < 100000; ++i) {
    const auto timestamp = static_cast<std::uint32_t>(random() % kTimestampUnitsPerHour) << 1;
    EXPECT_EQ(to_dis_timestamp(past_the_hour(timestamp), false), timestamp);
  }
}

TEST(Timestamp, RoundsTheLastHalfUnitToZero) {
  EXPECT_EQ(to_dis_timestamp(3600s - 1ns, false), 0U);
  EXPECT_EQ(to_dis_timestamp(3600s, false), 0U);
  EXPECT_EQ(to_dis_timestamp(-1ns, false), 0U);
  EXPECT_EQ(past_the_hour(0xFFFFFFFEU), 0ns);
}

TEST(Timestamp, FindsAnInstantAcrossTheHour) {
  const nanoseconds before_the_hour = 7 * 3600s - 5ms;
  const nanoseconds after_the_hour = 7 * 3600s + 5ms;
  const std::uint32_t timestamp = to_dis_timestamp(before_the_hour, true);
  EXPECT_LE(std::chrono::abs(nearest_instant(timestamp, after_the_hour) - before_the_hour), 839ns);
  const std::uint32_t later = to_dis_timestamp(after_the_hour, true);
  EXPECT_LE(std::chrono::abs(nearest_instant(later, before_the_hour) - after_the_hour), 839ns);
}

TEST(Timestamp, IsCorrectBeforeTheOriginOfTheClock) {
  EXPECT_LE(std::chrono::abs(nearest_instant(to_dis_timestamp(-90min, false), -90min) + 90min),
            839ns);
}

}  // namespace
}  // namespace reckon::pdu
