// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/exercise/loop_report.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

namespace reckon::tools {
namespace {

using namespace std::chrono_literals;

LoopReports one(std::chrono::nanoseconds longest, std::uint64_t passes) {
  LoopReports reports;
  reports.all[1].took = {20us, 40us, 80us, longest};
  reports.all[1].passes = passes;
  reports.all[1].overruns = longest > 1ms ? 1 : 0;
  return reports;
}

TEST(LoopReports, OfSeveralPeersHaveWorstTimesAndSums) {
  LoopReports both = one(90us, 100);
  both.add(one(3ms, 50));
  const auto json = nlohmann::json::parse(loops_json(both));
  EXPECT_EQ(json["model"]["passes"], 150);
  EXPECT_EQ(json["model"]["overruns"], 1);
  EXPECT_DOUBLE_EQ(json["model"]["us"]["max"], 3000.0);
  EXPECT_DOUBLE_EQ(json["model"]["us"]["p50"], 20.0);
  EXPECT_EQ(json["read"]["passes"], 0);
}

}  // namespace
}  // namespace reckon::tools
