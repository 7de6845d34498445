// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/aoim/interest/channel_table.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>
#include <vector>

namespace reckon::aoim {
namespace {

constexpr double kForever = std::numeric_limits<double>::infinity();

double sum(const ChannelTable& table, const std::vector<ChannelClient>& clients, double stretch) {
  double octets = 0;
  for (const ChannelClient& client : clients) octets += table.rate(client, stretch);
  return octets;
}

TEST(ChannelTable, GivesContactAKilohertzAndDistanceOneHertz) {
  ChannelTable table;
  EXPECT_EQ(table.channel(table.row(0.5)).active_hz, 1000.0);
  EXPECT_EQ(table.channel(table.row(0.5)).body, Body::full);
  EXPECT_EQ(table.channel(table.row(50.0)).body, Body::full);
  EXPECT_EQ(table.channel(table.row(50.1)).body, Body::approximate);
  EXPECT_EQ(table.channel(table.row(1e9)).body, Body::rigid);
  EXPECT_EQ(table.channel(table.row(std::nan(""))).active_hz, 1.0);
  EXPECT_LT(table.rate({20.0, false}), 0.01 * table.rate({20.0, true}));
}

TEST(ChannelTable, FitsABudgetByTheLeastStretch) {
  ChannelTable table;
  std::mt19937_64 random(4);
  std::uniform_real_distribution<double> where(0.0, 300.0), share(0.02, 0.99);
  for (int scene = 0; scene < 200; ++scene) {
    std::vector<ChannelClient> clients(1 + random() % 60);
    for (ChannelClient& client : clients) client = {where(random), random() % 4 != 0};
    const double all = sum(table, clients, 1.0), budget = all * share(random);
    const ChannelBudget fitted = table.fit(clients, budget);
    EXPECT_EQ(fitted.met, fitted.octets_per_second <= budget);
    EXPECT_DOUBLE_EQ(fitted.octets_per_second, sum(table, clients, fitted.stretch));
    if (!fitted.met) {
      EXPECT_DOUBLE_EQ(fitted.octets_per_second, sum(table, clients, 1e12));
      continue;
    }
    // No smaller stretch fits: tried at each distance where a client changes its row.
    for (const ChannelClient& client : clients) {
      for (std::size_t row = 0; row < table.size(); ++row) {
        const double stretch = table.channel(row).farthest / client.distance * (1.0 + 1e-12);
        if (stretch < 1.0 || stretch > fitted.stretch * (1.0 - 1e-11)) continue;
        EXPECT_GT(sum(table, clients, stretch), budget);
      }
    }
  }
}

TEST(ChannelTable, LeavesChannelsWithinTheBudgetUnchanged) {
  ChannelTable table;
  const std::vector<ChannelClient> clients(10, ChannelClient{30.0, true});
  const double all = sum(table, clients, 1.0);
  EXPECT_EQ(table.fit(clients, all).stretch, 1.0);
  EXPECT_TRUE(table.fit(clients, all).met);
  EXPECT_GT(table.fit(clients, 0.999 * all).stretch, 50.0 / 30.0);
  EXPECT_TRUE(table.fit({}, 0.0).met);
}

TEST(ChannelTable, NeverTakesAwayContact) {
  ChannelTable table;
  const std::vector<ChannelClient> clients{{0.5, true}, {20.0, true}};
  const ChannelBudget fitted = table.fit(clients, 0.0);
  EXPECT_FALSE(fitted.met);
  EXPECT_EQ(table.row(0.5, fitted.stretch), 0u);
  EXPECT_DOUBLE_EQ(fitted.octets_per_second, 232'000.0 + 144.0);
}

TEST(ChannelTable, BeyondTheLastRowThereIsNothing) {
  const std::vector<Channel> rows{{100.0, Body::rigid, 5.0, 0.0, 144.0, false}};
  ChannelTable table(rows);
  EXPECT_EQ(table.row(100.5), table.size());
  EXPECT_EQ(table.rate({100.5, true}), 0.0);
  const ChannelBudget fitted =
      table.fit(std::vector<ChannelClient>{{50.0, true}, {20.0, true}}, 800.0);
  EXPECT_TRUE(fitted.met);
  EXPECT_EQ(fitted.octets_per_second, 720.0);
}

TEST(ChannelTable, RefusesTablesThatMakeNoSense) {
  const auto refused = [](std::vector<Channel> rows) {
    EXPECT_THROW(ChannelTable{rows}, std::invalid_argument);
  };
  refused({});
  refused({{-1.0, Body::full, 1.0, 1.0, 100.0, false}});
  refused({{1.0, Body::full, 1.0, 1.0, 0.0, false}});
  refused({{1.0, Body::full, kForever, 1.0, 100.0, false}});
  refused({{2.0, Body::full, 2.0, 1.0, 100.0, false}, {2.0, Body::full, 1.0, 1.0, 100.0, false}});
  refused({{1.0, Body::full, 2.0, 1.0, 100.0, false}, {2.0, Body::full, 1.0, 1.0, 100.0, true}});
  refused({{1.0, Body::full, 2.0, 1.0, 100.0, false}, {2.0, Body::full, 3.0, 1.0, 100.0, false}});
}

}  // namespace
}  // namespace reckon::aoim
