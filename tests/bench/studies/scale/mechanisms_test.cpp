// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Exercises of whole simulated peers against closed forms and brute force, and each mechanism
// against the one before it.
#include "reckon/bench/studies/scale/mechanisms.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <cstdio>
#include <vector>

#include "reckon/bench/studies/scale/fit.hpp"
#include "reckon/tests/support/soak.hpp"
#include "reckon/tools/command_line/console.hpp"

namespace reckon::bench {
namespace {

ScaleSetting small_setting() {
  ScaleSetting setting;
  setting.peers = 12;
  setting.crowd.entities = 240;
  setting.crowd.movement = "vehicles";
  setting.seconds = 2;
  setting.rate = 20;
  return setting;
}

std::size_t mechanism_named(std::string_view name) {
  for (std::size_t i = 0; i < kMechanisms.size(); ++i)
    if (kMechanisms[i].name == name) return i;
  ADD_FAILURE() << name;
  return 0;
}

WholeRun run_with(ScaleSetting setting, std::string_view mechanism) {
  setting.design = design_of(mechanism_named(mechanism));
  return run_whole_peers(setting, Meeting::simulated);
}

// 240 entities x 20 ticks a second, each update in its own datagram of 144 + 24 + 28 octets, plus
// an announcement a second from each peer.
TEST(Mechanisms, EveryTickSendsEverythingToAll) {
  const ScaleSetting setting = small_setting();
  const WholeRun run = run_with(setting, "every tick");
  const WholeCounts& counts = run.counts;
  EXPECT_EQ(counts.updates, 240U * 20 * 2);
  EXPECT_NEAR(static_cast<double>(counts.heard_updates), 11.0 * static_cast<double>(counts.updates),
              0.002 * 11 * static_cast<double>(counts.updates));
  EXPECT_EQ(counts.datagrams - counts.updates, 12U * 2);
  EXPECT_EQ(counts.heard_datagrams, counts.datagrams * 11);
  EXPECT_EQ(static_cast<double>(counts.octets - counts.updates * (144 + 24 + 28)),
            12 * 2 * announcement_octets(12));
  EXPECT_LT(run.pose.p99, 0.01);
  EXPECT_LT(counts.unseen * 1000, counts.looks);
  EXPECT_EQ(counts.lost + counts.dropped, 0U);
}

TEST(Mechanisms, DeadReckoningHoldsTheThreshold) {
  ScaleSetting setting = small_setting();
  setting.converges = false;
  const WholeRun every = run_with(setting, "every tick");
  const WholeRun reckoned = run_with(setting, "+ dead reckoning");
  EXPECT_LT(reckoned.counts.updates * 10, every.counts.updates);
  EXPECT_GT(reckoned.counts.updates, 0U);
  // In a bend of 14 m/s and 0.3 rad/s the error of 1 m grows by 0.15 m until the update of the next
  // tick arrives. A bucket has 3 %.
  EXPECT_LE(reckoned.pose.max, (setting.thresholds.position + 0.15) * 1.04);
  EXPECT_GT(reckoned.pose.p99, 0.2 * setting.thresholds.position);
}

TEST(Mechanisms, BundlingSendsTheSameInFewerDatagrams) {
  ScaleSetting setting = small_setting();
  setting.converges = false;
  const WholeRun alone = run_with(setting, "+ dead reckoning");
  const WholeRun bundled = run_with(setting, "+ bundling");
  EXPECT_NEAR(static_cast<double>(bundled.counts.updates),
              static_cast<double>(alone.counts.updates),
              0.02 * static_cast<double>(alone.counts.updates));
  EXPECT_EQ(alone.counts.datagrams - alone.counts.updates, 12U * 2);
  EXPECT_LT(bundled.counts.datagrams, alone.counts.datagrams);
  EXPECT_LT(bundled.counts.octets, alone.counts.octets);
  EXPECT_LE(bundled.pose.p99, 1.2 * setting.thresholds.position);
}

TEST(Mechanisms, AreasSpareWhatIsFar) {
  ScaleSetting setting = small_setting();
  setting.peers = 16;
  setting.crowd.entities = 800;
  setting.radius = setting.grid.cell_size = 60;
  setting.rate = 10;
  const WholeRun all = run_with(setting, "+ bundling");
  const WholeRun areas = run_with(setting, "+ areas of interest");
  EXPECT_LT(4 * areas.counts.heard_updates, all.counts.heard_updates);
  EXPECT_LT(areas.counts.unseen * 100, areas.counts.looks);
  EXPECT_EQ(areas.counts.overdue, 0U);
  EXPECT_GT(areas.counts.joins, 0U);
  EXPECT_EQ(all.counts.groups, setting.peers);
  EXPECT_GT(areas.counts.groups, 4 * setting.peers);
  // Areas send more: introductions, and updates near cell borders.
  EXPECT_GE(areas.counts.updates, all.counts.updates);
}

/// Pairs of a peer and an entity of another within `radius` [m].
std::uint64_t pairs_within(const ScaleSetting& setting, const Crowd& crowd, double radius) {
  std::uint64_t pairs = 0;
  for (std::size_t peer = 0; peer < setting.peers; ++peer) {
    const OwnedRange own = owned_by(setting, peer);
    for (std::uint32_t e = 0; e < crowd.size(); ++e) {
      if (e >= own.first && e < own.end) continue;
      bool inside = false;
      for (std::uint32_t o = own.first; o < own.end && !inside; ++o)
        inside = distance(crowd.position(e), crowd.position(o)) <= radius;
      pairs += inside;
    }
  }
  return pairs;
}

// Brute force for each entity, tick and peer: is the entity within the radius of an own entity? If
// so, the peer uses the update. Farther updates are used only for shown entities, which are kept up
// to a tenth beyond the radius of foci that cover several own entities.
TEST(Mechanisms, WantedLieBetweenWhatBruteForceCounts) {
  ScaleSetting setting = small_setting();
  setting.radius = 60;
  Crowd crowd(setting.crowd);
  std::uint64_t within = 0, kept = 0;
  for (int tick = 0; tick < 5 * 20; ++tick) {
    crowd.advance(tick / 20.0);
    if (tick < 3 * 20) continue;
    within += pairs_within(setting, crowd, 0.98 * setting.radius);  // foci are some ticks old
    kept += pairs_within(setting, crowd, 1.3 * setting.radius);
  }
  const WholeRun run = run_with(setting, "every tick");
  EXPECT_GE(run.counts.wanted, within);
  EXPECT_LE(run.counts.wanted, kept);
  EXPECT_GT(within, 1000U);
}

// Updates of entities at rest are used only within the radius of a focus that covers one entity.
TEST(Mechanisms, RestingEntitiesAreWantedWithinTheRadius) {
  ScaleSetting setting = small_setting();
  setting.seconds = 1;
  setting.radius = 60;
  setting.peers = setting.crowd.entities = 30;
  setting.crowd.movement = "rest";
  const std::uint64_t pairs = pairs_within(setting, Crowd(setting.crowd), setting.radius);
  // A few are sent again between two ticks.
  EXPECT_NEAR(static_cast<double>(run_with(setting, "every tick").counts.wanted),
              static_cast<double>(pairs * 20), 0.02 * static_cast<double>(pairs * 20));
  EXPECT_GT(pairs, 50U);
}

TEST(Mechanisms, LoseTheShareThatTheNetworkLoses) {
  ScaleSetting setting = small_setting();
  setting.network.loss = 0.2;
  setting.network.delay = std::chrono::milliseconds(80);
  const WholeRun run = run_with(setting, "every tick");
  const auto sent = static_cast<double>(run.counts.lost + run.counts.heard_datagrams);
  EXPECT_NEAR(static_cast<double>(run.counts.lost) / sent, 0.2, 5 * std::sqrt(0.16 / sent) + 1e-3);
  // Updates are late and carry their time: the error is the change since then.
  EXPECT_GT(run.pose.p99, 1e-3);
  EXPECT_LT(run.pose.p99, 0.5);
}

TEST(Mechanisms, AreTheSameEveryTime) {
  ScaleSetting setting = small_setting();
  setting.network.loss = 0.1;
  const WholeRun a = run_with(setting, "+ compression");
  const WholeRun b = run_with(setting, "+ compression");
  for (const WholeSum& sum : kWholeSums) EXPECT_EQ(a.counts.*sum.of, b.counts.*sum.of) << sum.name;
  EXPECT_EQ(a.pose.p99, b.pose.p99);
  setting.crowd.seed = 2;
  EXPECT_NE(run_with(setting, "+ compression").counts.heard_octets, a.counts.heard_octets);
}

TEST(Mechanisms, RefuseWhatPeersCannotNumber) {
  ScaleSetting setting = small_setting();
  setting.peers = 300;
  EXPECT_THROW(static_cast<void>(run_with(setting, "every tick")), tools::UsageError);
  setting.peers = 2;
  setting.crowd.entities = 200'000;
  EXPECT_THROW(static_cast<void>(run_with(setting, "every tick")), tools::UsageError);
}

// A world that grows at constant density; each cell has its own group.
TEST(Mechanisms, AreasKeepWhatAPeerHearsFromGrowing) {
  ScaleSetting setting = small_setting();
  setting.radius = test::tries(40, 60);
  setting.grid.cell_size = test::tries(60, 175);
  setting.grid.pool = 1000;
  setting.rate = test::tries(5, 10);
  std::vector<std::size_t> sizes{12, 48};
  if (test::soaks()) sizes = {32, 64, 128, 256};
  std::vector<ScaleRow> rows;
  for (const std::size_t peers : sizes) {
    setting.peers = peers;
    setting.crowd.entities = test::tries<std::size_t>(20, 100) * peers;
    for (std::size_t mechanism = 1; mechanism < kMechanisms.size(); ++mechanism) {
      setting.design = design_of(mechanism);
      if (mechanism == mechanism_named("+ bundling") || mechanism + 1 == kMechanisms.size())
        rows.push_back({mechanism, run_whole_peers(setting, Meeting::simulated)});
    }
    EXPECT_TRUE(groups_suffice(setting));
  }
  const double with = power_of(ladder_of(rows, kMechanisms.size() - 1), "heard_updates_per_s");
  const double without =
      power_of(ladder_of(rows, mechanism_named("+ bundling")), "heard_updates_per_s");
  std::printf("updates heard grow by the power %.2f of the peers, %.2f without areas\n", with,
              without);
  EXPECT_LT(std::abs(with), test::tries(0.25, 0.15));
  EXPECT_NEAR(without, 1, 0.1);
}

}  // namespace
}  // namespace reckon::bench
