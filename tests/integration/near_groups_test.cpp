// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Whole peers whose scene sends finer updates to near peers in groups of their own ([[aoim.tier]]
// own_group). No peer is shown an error above the limit of its tier, whoever moves, jumps or loses
// a datagram.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <numbers>
#include <string>
#include <vector>

#include "reckon/tests/integration/melee.hpp"
#include "reckon/tests/support/soak.hpp"

namespace reckon::test::near_groups_test {
namespace {

using namespace std::chrono_literals;
using Eigen::Vector3d;
using std::chrono::nanoseconds;

TEST(NearGroups, ReduceACrowdsTrafficWithinTheTierLimits) {
  const auto span = tries(3s, 8s);
  const auto each = 64 * static_cast<double>(span.count());
  std::uint64_t datagrams[2], octets[2], updates[2];
  for (const bool near : {false, true}) {
    Melee place(Melee::scene(near), crowd(64, 400.0, 1));
    place.run(4s);
    place.begin();
    place.run(span);
    datagrams[near] = place.datagrams();
    octets[near] = place.octets();
    updates[near] = place.updates();
    const Looks& seen = place.seen();
    std::printf(
        "[ residual ] %s: %.1f datagrams/s and %.0f octets/s heard, %.2f updates/s sent by each; "
        "%zu looks, %zu missing, %zu beyond their row, at most %.2f of it; %.2f m in the nearest\n",
        near ? "near groups" : "one stream", static_cast<double>(datagrams[near]) / each,
        static_cast<double>(octets[near]) / each, static_cast<double>(updates[near]) / each,
        seen.all, seen.missing, seen.beyond, seen.worst, seen.near_worst);
    EXPECT_EQ(seen.beyond, 0u);
    EXPECT_EQ(seen.missing, 0u);
    EXPECT_EQ(place.heard("datagrams_lost"), 0u);
  }
  EXPECT_LT(1.2 * static_cast<double>(datagrams[1]), static_cast<double>(datagrams[0]));
}

TEST(NearGroups, SceneWithoutThemSendsUnchangedOctets) {
  peer::SceneFile plain = Melee::scene(false);
  for (peer::TierConfig& tier : plain.aoim.tiers) tier.channel.coarser = 1.0;
  plain.hash = peer::scene_hash(plain);
  Melee coarse(Melee::scene(false), crowd(6, 150.0, 2)), fine(plain, crowd(6, 150.0, 2));
  EXPECT_EQ(Melee::scene(false).hash, plain.hash);
  for (Melee* place : {&coarse, &fine}) place->run(10s);
  EXPECT_EQ(coarse.heard("octets_out"), fine.heard("octets_out"));
  EXPECT_EQ(coarse.heard("updates_near"), 0u);
}

// Loss affects several streams as much as one, and no more.
TEST(NearGroups, SufferNoMoreFromLossThanOneStream) {
  constexpr double kLoss = 0.05;
  std::size_t all[2] = {}, beyond[2] = {}, near_beyond[2] = {}, missing[2] = {};
  for (const bool near : {false, true}) {
    for (unsigned seed = 1; seed <= tries(4U, 10U); ++seed) {
      Melee place(Melee::scene(near), crowd(12, 150.0, seed), seed, kLoss, 30ms);
      place.run(4s);
      place.begin();
      place.run(8s);
      all[near] += place.seen().all;
      beyond[near] += place.seen().beyond;
      near_beyond[near] += place.seen().near_beyond;
      missing[near] += place.seen().missing;
    }
    std::printf(
        "[ residual ] 5 %% loss, 30 ms of jitter, %s: %zu of %zu looks beyond, %zu of them in the "
        "nearest row, %zu missing\n",
        near ? "near groups" : "one stream", beyond[near], all[near], near_beyond[near],
        missing[near]);
  }
  EXPECT_EQ(missing[1], 0u);
  EXPECT_LE(static_cast<double>(near_beyond[1]), 1.5 * static_cast<double>(near_beyond[0]));
  // One stream shows distant entities better than their tier requires, so that it can afford some
  // losses.
  EXPECT_LE(static_cast<double>(beyond[1]), kLoss * static_cast<double>(all[1]));
}

// 100 m/s towards a weaving entity and past it: the nearest tier holds from its first check on.
TEST(NearGroups, AreJoinedAheadByAFastReceiver) {
  Melee place(Melee::scene(true), {weave(1.0, 2.0), stand({0, 20, 0}), [](double t) {
                                     return Vector3d(-1500.0 + 100.0 * t, 10.0, 0.0);
                                   }});
  place.run(12s);
  place.begin();
  place.run(6s);
  const Looks& seen = place.seen();
  std::printf("[ residual ] at 100 m/s: %zu looks, %zu beyond, at most %.2f of the row\n", seen.all,
              seen.beyond, seen.worst);
  EXPECT_EQ(seen.beyond, 0u);
  EXPECT_EQ(seen.missing, 0u);
}

// A third of a second after a jump a peer has all states that the near peers have.
TEST(NearGroups, IntroduceAReceiverThatJumped) {
  Melee place(Melee::scene(true),
              {sidestep(0.6, 0.5), stand({20, 20, 0}), stand({150, 0, 0}), stand({-140, 30, 0})});
  place.run(6s);
  for (int leap = 0; leap < 20; ++leap) {
    place.set_path(2, stand(leap % 2 == 0 ? Vector3d(40, 0, 0) : Vector3d(150, 0, 0)));
    place.run(340ms);
    place.begin();
    place.run(1560ms);
    EXPECT_EQ(place.seen().beyond, 0u) << leap << ": " << place.seen().worst;
    EXPECT_EQ(place.seen().missing, 0u) << leap;
  }
}

// A peer that moves away while another stays has received states that its outer tier lacks. It
// falls back to the state that its tier receives; else it stays wrong until the next update.
TEST(NearGroups, LeaveNoStateWithoutUpdates) {
  double worst = 0.0;
  for (int turn = 0; turn < 40; turn += tries(3, 1)) {
    Melee place(Melee::scene(true), {bump(0.6, 1.0), stand({10, 20, 0}), stand({10, -20, 0})});
    place.run(10s + turn * 75ms);
    const double left = place.time();
    // Away by 120 m in 6 s, smoothly.
    place.set_path(2, [left](double t) {
      const double share = std::min((t - left) / 6.0, 1.0);
      return Vector3d(10.0, -20.0 - 60.0 * (1.0 - std::cos(std::numbers::pi * share)), 0.0);
    });
    place.begin();
    place.run(9s);
    worst = std::max(worst, place.seen().worst);
    EXPECT_EQ(place.seen().beyond, 0u) << turn << ": " << place.seen().worst;
  }
  std::printf("[ residual ] gone away: at most %.2f of the row\n", worst);
}

// No peer is near any more: the states sent only to near peers are sent to all once.
TEST(NearGroups, AreSilentWhereNobodyIsNear) {
  Melee place(Melee::scene(true), {weave(1.0, 2.0), stand({0, 190, 0})});
  place.run(5s);
  const std::uint64_t before = place.count(0, "updates_near");
  place.run(5s);
  EXPECT_EQ(place.count(0, "updates_near"), before);
  place.set_path(1, stand({10, 20, 0}));
  place.run(5s);
  EXPECT_GT(place.count(0, "updates_near"), before + 4);
}

// A receiver leaves near groups that exceed its budget; another receiver there keeps them.
TEST(NearGroups, AreLeftByAReceiverWithoutTheBudget) {
  peer::SceneFile poor = Melee::scene(true), rich = Melee::scene(true);
  poor.aoim.awareness.budget = 2000.0;
  std::uint64_t octets[2];
  for (const bool is_poor : {false, true}) {
    Melee place(is_poor ? poor : rich, crowd(12, 60.0, 3));
    place.run(6s);
    place.begin();
    place.run(8s);
    octets[is_poor] = place.octets();
  }
  std::printf("[ residual ] budget of 2 kB/s: %.0f octets/s heard, %.0f without\n",
              static_cast<double>(octets[1]) / 12 / 8, static_cast<double>(octets[0]) / 12 / 8);
  EXPECT_LT(1.2 * static_cast<double>(octets[1]), static_cast<double>(octets[0]));
}

// If the nearest tier covers the whole radius, no traffic is saved, and no peer is shown a greater
// error.
TEST(NearGroups, EqualOneStreamWhereTheTierCoversAll) {
  peer::SceneFile wide = Melee::scene(true);
  wide.aoim.tiers.front().channel.farthest = 250.0;
  wide.aoim.tiers[1].channel.farthest = 300.0;
  wide.hash = peer::scene_hash(wide);
  Melee place(wide, crowd(10, 150.0, 4));
  place.run(4s);
  place.begin();
  place.run(6s);
  EXPECT_EQ(place.seen().missing, 0u);
  EXPECT_LT(place.seen().near_worst, Melee::kThreshold + Melee::kSlack);
  EXPECT_EQ(place.seen().beyond, 0u);
}

// Parts are sent to the tiers whose bodies include them, and to peers that enter one of these.
TEST(NearGroups, CarryPartsToTiersThatIncludeThem) {
  Melee place(Melee::scene(true),
              {stand({0, 0, 0}), stand({20, 0, 0}), stand({0, 80, 0}), stand({0, -185, 0})});
  place.run(6s);
  const std::uint64_t before = place.count(3, "updates_in");
  const auto swing = [&](nanoseconds span) {
    for (const double end = place.time() + pdu::to_seconds(span); place.time() < end;) {
      place.turn(0, std::sin(2.0 * place.time()), 2.0 * std::cos(2.0 * place.time()));
      place.run(Melee::kStep);
    }
  };
  swing(6s);
  const double truth = std::sin(2.0 * place.time());
  EXPECT_NEAR(place.shown_azimuth(1, 0), truth, 0.15);
  EXPECT_NEAR(place.shown_azimuth(2, 0), truth, 0.15);
  EXPECT_GT(place.count(0, "updates_near"), 5u);
  EXPECT_LE(place.count(3, "updates_in") - before, 6u) << "heartbeats alone";
  place.set_path(3, stand({0, -15, 0}));
  swing(1s);
  EXPECT_NEAR(place.shown_azimuth(3, 0), std::sin(2.0 * place.time()), 0.15);
}

TEST(NearGroups, CarryStatesOfTheCompactForm) {
  peer::SceneFile scene = Melee::scene(true);
  scene.network.compression = pdu::CompressedForm::compact;
  scene.hash = peer::scene_hash(scene);
  Melee place(scene, crowd(16, 150.0, 5));
  place.run(4s);
  place.begin();
  place.run(6s);
  EXPECT_EQ(place.seen().beyond, 0u) << place.seen().worst;
  EXPECT_EQ(place.seen().missing, 0u);
  EXPECT_GT(place.heard("updates_near"), 100u);
}

}  // namespace
}  // namespace reckon::test::near_groups_test
