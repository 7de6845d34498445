// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Large exercises against closed forms, brute force, and each mechanism against the one before it.
#include "reckon/bench/studies/scale/world.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <map>
#include <set>

#include "reckon/pdu/codec/codec.hpp"
#include "reckon/pdu/entity/entity_state.hpp"
#include "reckon/tools/command_line/console.hpp"

namespace reckon::bench {
namespace {

using ::testing::HasSubstr;

ScaleSetting small_setting() {
  ScaleSetting setting;
  setting.peers = 12;
  setting.crowd.entities = 240;
  setting.crowd.movement = "vehicles";
  setting.seconds = 4;
  setting.rate = 20;
  setting.converges = false;  // so that what is shown is what was predicted
  return setting;
}

std::size_t mechanism_named(std::string_view name) {
  for (std::size_t i = 0; i < kMechanisms.size(); ++i)
    if (kMechanisms[i].name == name) return i;
  ADD_FAILURE() << name;
  return 0;
}

ScaleCounts counts_with(const ScaleSetting& setting, std::string_view mechanism) {
  return run_world(setting, design_of(mechanism_named(mechanism)));
}

TEST(Crowd, KeepsItsDensityAndItsSpeed) {
  Crowd crowd({"vehicles", 400, 100, 7});
  EXPECT_NEAR(crowd.side(), 2000, 1e-9);
  std::vector<aoim::Position> before;
  for (std::size_t i = 0; i < crowd.size(); ++i) before.push_back(crowd.position(i));
  double moved = 0;
  for (int tick = 1; tick <= 600; ++tick) {
    crowd.advance(0.1 * tick);
    for (std::size_t i = 0; i < crowd.size(); ++i) {
      const aoim::Position& at = crowd.position(i);
      ASSERT_TRUE(std::abs(at.x) <= 1000 && std::abs(at.y) <= 1000) << i;
      ASSERT_LE(distance(at, before[i]), 0.1 * 14 + 1e-9) << i;
      moved += distance(at, before[i]);
      before[i] = at;
    }
  }
  EXPECT_GT(moved / 400 / 60, 4);  // [m/s], on average
}

// What is told of the motion is the rate of what is seen.
TEST(Crowd, TellsTheRatesOfItsMotion) {
  constexpr double kStep = 1e-4;
  for (const Gait& gait : kGaits) {
    Crowd crowd({gait.name, 60, 100, 3});
    int compared = 0;
    for (double time = 1; time < 9; time += 0.5) {
      crowd.advance(time);
      std::vector<deadreckon::MotionSample> before;
      for (std::size_t i = 0; i < crowd.size(); ++i) before.push_back(crowd.motion(i));
      crowd.advance(time + kStep);
      for (std::size_t i = 0; i < crowd.size(); ++i) {
        const deadreckon::MotionSample after = crowd.motion(i);
        // A leg began, or an edge threw it back.
        if ((after.velocity - before[i].velocity).norm() > 40 * kStep) continue;
        ++compared;
        const Eigen::Vector3d seen = (after.position - before[i].position) / kStep;
        EXPECT_LT((seen - before[i].velocity).norm(), 1e-2) << gait.name << i;
        const Eigen::Vector3d rate = (after.velocity - before[i].velocity) / kStep;
        const bool stopped = before[i].velocity.norm() < 0.01;
        EXPECT_TRUE(stopped || (rate - before[i].acceleration).norm() < 0.05) << gait.name << i;
        // The nose is ahead, body z down.
        EXPECT_LT(
            (before[i].orientation * Eigen::Vector3d::UnitZ() + Eigen::Vector3d::UnitZ()).norm(),
            1e-9);
      }
    }
    EXPECT_GT(compared, 600) << gait.name;
  }
}

TEST(Crowd, RefusesMovementsThatItDoesNotKnow) {
  try {
    Crowd crowd({"swimmers", 10, 100, 1});
    FAIL();
  } catch (const tools::UsageError& error) {
    EXPECT_THAT(error.what(), HasSubstr("swimmers"));
    EXPECT_THAT(error.what(), HasSubstr("walkers"));
  }
}

// 240 entities x 20 ticks, each alone in a datagram of 144 + 24 + 28 octets; and an announcement a
// second from each peer.
TEST(ScaleWorld, SendsEverythingEveryTickToAll) {
  const ScaleSetting setting = small_setting();
  const ScaleCounts counts = counts_with(setting, "every tick");
  EXPECT_EQ(counts.updates, 240U * 20 * 4);
  EXPECT_EQ(counts.heard_updates, counts.updates * 11);
  EXPECT_EQ(counts.datagrams - counts.control, counts.updates);
  EXPECT_EQ(counts.heard_datagrams, counts.datagrams * 11);
  EXPECT_LE(counts.octets, counts.datagrams * 300);
  EXPECT_GE(counts.octets, counts.updates * (144 + 24 + 28));
  // Prediction over no time at all, but for the wire's floats.
  EXPECT_LT(counts.pose.max, 1e-3);
  // Foci are a tick or two old.
  EXPECT_LT(counts.unseen * 1000, counts.looks);
  EXPECT_EQ(counts.lost, 0U);
}

TEST(ScaleWorld, HoldsTheThresholdWithoutNetwork) {
  const ScaleSetting setting = small_setting();
  const ScaleCounts every = counts_with(setting, "every tick");
  const ScaleCounts reckoned = counts_with(setting, "+ dead reckoning");
  EXPECT_LT(reckoned.updates * 10, every.updates);
  EXPECT_GT(reckoned.updates, 0U);
  EXPECT_LE(reckoned.pose.max, setting.thresholds.position * 1.04);  // 3 % of a bucket
  EXPECT_GT(reckoned.pose.p99, 0.2 * setting.thresholds.position);
}

TEST(ScaleWorld, BundlesTheSameUpdatesIntoFewerDatagrams) {
  const ScaleSetting setting = small_setting();
  const ScaleCounts alone = counts_with(setting, "+ dead reckoning");
  const ScaleCounts bundled = counts_with(setting, "+ bundling");
  EXPECT_EQ(bundled.updates, alone.updates);
  EXPECT_LT(bundled.datagrams, alone.datagrams);
  EXPECT_LT(bundled.octets, alone.octets);
  // What waits for company comes a tick later.
  EXPECT_LE(bundled.pose.p99, 1.2 * setting.thresholds.position);
}

TEST(ScaleWorld, AreasSpareWhatIsFarAndKeepWhatIsNear) {
  ScaleSetting setting = small_setting();
  setting.peers = 40;
  setting.crowd.entities = 4000;
  const ScaleCounts all = counts_with(setting, "+ bundling");
  const ScaleCounts areas = counts_with(setting, "+ areas of interest");
  EXPECT_LT(4 * areas.heard_updates, all.heard_updates);
  EXPECT_LT(static_cast<double>(areas.missed), 0.01 * static_cast<double>(areas.wanted));
  EXPECT_GT(areas.joins, 0U);
  EXPECT_GT(areas.groups, 20U);
  EXPECT_LE(areas.groups, setting.grid.pool);
  // Sent more: introductions and borders.
  EXPECT_GE(areas.updates, all.updates);
}

// Each update sent, each peer, each of its entities: who of the others is within the radius? All of
// these take it, and of the others only who has it shown and keeps it a tenth longer, about foci
// that cover several of its own.
TEST(ScaleWorld, CountsTheWantedBetweenWhatBruteForceDoes) {
  ScaleSetting setting = small_setting();
  setting.seconds = 2;
  setting.radius = 60;
  Crowd crowd(setting.crowd);
  std::uint64_t within = 0, kept = 0;
  double at = -1;
  const auto owner = [&](std::size_t entity) {
    std::size_t peer = 0;
    while ((peer + 1) * 240 / 12 <= entity) ++peer;
    return peer;
  };
  const ScaleTap tap = [&](double time, std::uint32_t sender, aoim::GroupIndex,
                           std::span<const std::byte> datagram) {
    if (time < kWarmUp) return;
    if (time != at) crowd.advance(at = time);
    pdu::EntityState pdu;
    if (pdu::decode(datagram, pdu) != pdu::DecodeError::none) return;
    const std::size_t entity = sender * 240 / 12 + pdu.entity_id.entity - 1;
    const auto takers = [&](double radius) {
      std::set<std::size_t> peers;
      for (std::size_t other = 0; other < crowd.size(); ++other)
        if (distance(crowd.position(other), crowd.position(entity)) <= radius)
          peers.insert(owner(other));
      peers.erase(sender);
      return peers.size();
    };
    within += takers(0.98 * setting.radius);  // foci are a tenth of a second old
    kept += takers(1.3 * setting.radius);
  };
  const ScaleCounts counts = run_world(setting, design_of(0), {}, tap);
  EXPECT_EQ(counts.witnesses, 12U);
  EXPECT_GE(counts.wanted, within);
  EXPECT_LE(counts.wanted, kept);
  EXPECT_GT(within, 1000U);
}

// Who stands is taken within the radius alone, of a focus that covers one entity.
TEST(ScaleWorld, CountsTheWantedOfWhatStandsAsBruteForceDoes) {
  ScaleSetting setting = small_setting();
  setting.seconds = 1;
  setting.radius = 60;
  setting.peers = setting.crowd.entities = 60;
  setting.crowd.movement = "rest";
  Crowd crowd(setting.crowd);
  crowd.advance(kWarmUp);
  std::uint64_t pairs = 0;
  for (std::size_t entity = 0; entity < crowd.size(); ++entity) {
    for (std::size_t other = 0; other < crowd.size(); ++other)
      pairs += entity != other && distance(crowd.position(other), crowd.position(entity)) <= 60;
  }
  const ScaleCounts counts = run_world(setting, design_of(0));
  EXPECT_EQ(counts.wanted, pairs * counts.updates / crowd.size());
  EXPECT_EQ(counts.updates % crowd.size(), 0U);
  EXPECT_GT(pairs, 100U);
}

TEST(ScaleWorld, LosesTheShareThatTheNetworkLoses) {
  ScaleSetting setting = small_setting();
  setting.network.loss = 0.2;
  setting.network.delay = std::chrono::milliseconds(80);
  const ScaleCounts counts = counts_with(setting, "every tick");
  const double share = static_cast<double>(counts.lost) / static_cast<double>(counts.wanted);
  EXPECT_NEAR(share, 0.2, 5 * std::sqrt(0.16 / static_cast<double>(counts.wanted)));
  // Updates are late and carry their time: what is off is what changed since.
  EXPECT_GT(counts.pose.p99, 1e-3);
  EXPECT_LT(counts.pose.p99, 0.5);
}

TEST(ScaleWorld, IsTheSameEveryTime) {
  ScaleSetting setting = small_setting();
  setting.network.loss = 0.1;
  const ScaleCounts a = counts_with(setting, "+ areas of interest");
  const ScaleCounts b = counts_with(setting, "+ areas of interest");
  EXPECT_EQ(a.updates, b.updates);
  EXPECT_EQ(a.heard_octets, b.heard_octets);
  EXPECT_EQ(a.wanted, b.wanted);
  EXPECT_EQ(a.pose.p99, b.pose.p99);
  setting.crowd.seed = 2;
  EXPECT_NE(counts_with(setting, "+ areas of interest").heard_octets, a.heard_octets);
}

TEST(ScaleWorld, RefusesWhatPeersCannotNumber) {
  ScaleSetting setting = small_setting();
  setting.peers = 300;
  EXPECT_THROW(static_cast<void>(run_world(setting, design_of(0))), tools::UsageError);
  setting.peers = 2;
  setting.crowd.entities = 200'000;
  EXPECT_THROW(static_cast<void>(run_world(setting, design_of(0))), tools::UsageError);
}

// A second after the first, then after two more, then after four: at 3 s and 7 s of what is
// counted.
TEST(ScaleWorld, SaysWhatStandsAgainAfterTwiceTheSilence) {
  ScaleSetting setting = small_setting();
  setting.crowd.movement = "rest";
  setting.seconds = 12;
  setting.fresh = true;
  EXPECT_EQ(counts_with(setting, "+ dead reckoning").updates, 2 * setting.crowd.entities);
}

}  // namespace
}  // namespace reckon::bench
