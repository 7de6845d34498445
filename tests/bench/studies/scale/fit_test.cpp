// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Estimates for exercises that are too large to run.
#include "reckon/bench/studies/scale/fit.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <sstream>

#include "reckon/bench/studies/scale/mechanisms.hpp"
#include "reckon/tests/support/soak.hpp"

namespace reckon::bench::fit_test {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;

TEST(ScaleFit, FitRecoversTheGeneratingLaw) {
  std::vector<SizedValue> edge, peers;
  for (const double n : {16.0, 32.0, 64.0, 128.0}) {
    edge.push_back({n, 5 - 3 / std::sqrt(n)});
    peers.push_back({n, 7 + 0.5 * n});
  }
  EXPECT_NEAR(fitted(edge, Growth::edge, 1000), 5 - 3 / std::sqrt(1000.0), 1e-9);
  EXPECT_NEAR(fitted(peers, Growth::peers, 1000), 507, 1e-9);
  EXPECT_NEAR(fit_error(edge, Growth::edge), 0, 1e-9);
  peers.back().value *= 1.25;
  EXPECT_NEAR(fit_error(peers, Growth::peers), -0.2, 1e-9);
  EXPECT_NEAR(fit_error(peers, Growth::peers, peers.back().value), -0.1, 1e-9);
}

// A list of 240 peers is sent in one part, a longer list in parts of 192.
TEST(ScaleFit, KnowsTheLengthOfAnnouncements) {
  EXPECT_EQ(announcement_octets(1), 260);
  EXPECT_EQ(announcement_octets(9), 356 + 4 * 8);
  EXPECT_EQ(announcement_octets(241), 356 + 4 * 240);
  EXPECT_EQ(announcement_octets(384), 356 + 4 * 192);
  EXPECT_LE(announcement_octets(1000), 356 + 4 * 192);
}

TEST(ScaleFit, SlopesArePowers) {
  const std::vector<double> x{1, 10, 100}, y{3, 3 * std::sqrt(10.0), 30};
  EXPECT_NEAR(log_slope(x, y), 0.5, 1e-12);
  EXPECT_EQ(log_slope(std::span(x).first(1), std::span(y).first(1)), 0);
  EXPECT_EQ(log_slope(std::vector<double>{80, 80}, std::vector<double>{20, 30}), 0);
}

/// All mechanisms at some sizes; each peer sends 20 datagrams a second besides its announcement.
std::vector<ScaleRow> rows_at(const std::vector<std::size_t>& sizes) {
  std::vector<ScaleRow> rows;
  for (const std::size_t peers : sizes)
    for (std::size_t mechanism = 0; mechanism < kMechanisms.size(); ++mechanism) {
      ScaleRow row;
      row.mechanism = mechanism;
      row.run.setting.peers = peers;
      row.run.setting.crowd.entities = 10 * peers;
      row.run.counts.seconds = 1;
      row.run.counts.datagrams = 21 * peers;
      row.run.counts.heard_datagrams =
          peers * (design_of(mechanism).areas ? 30 + peers - 1 : 21 * (peers - 1));
      row.run.pose.p99 = peers == 64 ? 2 : 1;
      rows.push_back(row);
    }
  return rows;
}

ScaleSetting setting_of(std::size_t peers) {
  ScaleSetting setting;
  setting.peers = peers;
  setting.crowd.entities = 10 * peers;
  setting.grid.cell_size = 1000;
  return setting;
}

TEST(ScaleFit, KeepsAnnouncementsApartAndStatesItsError) {
  const auto fitted = fitted_rows(rows_at({16, 32, 64}), setting_of(400));
  ASSERT_EQ(fitted.size(), kMechanisms.size());
  const json all = json::parse(fitted_json(std::span(fitted).last(1)));
  EXPECT_NEAR(all["sent_packets_per_s"], 21, 1e-9);
  EXPECT_NEAR(all["heard_packets_per_s"], 30 + 399, 1e-6);
  EXPECT_EQ(all["pose_error_p99_m"], nullptr);
  EXPECT_NEAR(all["pose_error_p99_m_error"], -0.5, 1e-9);
  const json first = json::parse(fitted_json(std::span(fitted).first(1)));
  EXPECT_NEAR(first["heard_packets_per_s"], 21 * 399, 1e-6);
  EXPECT_THAT(fitted_text(fitted), HasSubstr("400 peers with 4000 entities"));
  EXPECT_THAT(fitted_text(fitted), HasSubstr("?"));
}

TEST(ScaleFit, ClaimsNothingWhereCellsShareGroups) {
  ScaleSetting setting = setting_of(400);
  setting.grid.cell_size = 60;
  const auto fitted = fitted_rows(rows_at({16, 32, 64}), setting);
  for (const FittedRow& row : fitted)
    EXPECT_EQ(row.values[0].has_value(), !design_of(row.mechanism).areas) << row.mechanism;
  setting = setting_of(64 * 31);
  EXPECT_FALSE(fitted_rows(rows_at({16, 32, 64}), setting)[0].values[0]) << "too far beyond";
  EXPECT_TRUE(fitted_rows(rows_at({32, 64}), setting_of(400)).empty());
}

// Predicts the largest size from the smaller ones. Crowds are small unless soaking.
TEST(ScaleFit, PredictsAWholeRunFromSmallerOnes) {
  std::vector<std::size_t> sizes{8, 16, 32, 64};
  if (test::soaks()) sizes = {32, 64, 128, 256};
  ScaleSetting setting;
  setting.radius = 80;
  setting.grid.cell_size = test::tries(80, 175);
  setting.grid.pool = 1000;
  setting.rate = 10;
  setting.seconds = test::tries(2, 5);
  std::vector<ScaleRow> rows;
  for (const std::size_t peers : sizes) {
    setting.peers = peers;
    setting.crowd.entities = test::tries<std::size_t>(20, 100) * peers;
    rows.push_back({kMechanisms.size() - 1, run_whole_peers(setting, Meeting::simulated)});
  }
  const auto fitted = fitted_row(rows, kMechanisms.size() - 1, setting, groups_suffice(setting));
  ASSERT_TRUE(fitted);
  for (std::size_t i = 0; i < std::size(kFitted); ++i) {
    const double error = fitted->errors[i];
    std::printf("%s: %+.1f %%\n", std::string(kFitted[i]).c_str(), 100 * error);
    if (kFitted[i] != "cpu_share") {
      EXPECT_LT(std::abs(error), test::tries(0.25, 0.12)) << kFitted[i];
    }
  }
}

}  // namespace
}  // namespace reckon::bench::fit_test
