// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Remote turrets and guns as a peer shows them, from the octets of a datagram on.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "reckon/peer/world/peer_view.hpp"
#include "reckon/tests/integration/parts_receiver.hpp"
#include "reckon/tests/support/in_process.hpp"

namespace reckon::peer::test {
namespace {

using deadreckon::PartMetric;
using std::chrono::nanoseconds;

// --- updates without parts

TEST(RemoteParts, RemainWhenARigidUpdateOmitsThem) {
  for (const bool in_part : {false, true}) {
    PartsReceiver receiver({0.8, 0.1, 400}, in_part);
    receiver.hear(turret(0.5, 0.0), 0.0, 0.1);
    receiver.hear({}, 1.0, 1.1);
    EXPECT_EQ(receiver.parts(1.2).size(), in_part ? 1u : 0u);
    receiver.hear(turret(0.7, 0.0), 2.0, 2.1);
    EXPECT_NEAR(receiver.part(kTurret, 9.0).value, 0.7, 1e-6);
  }
}

// --- motion

// The float32 on the wire errs by 2e-7 rad, the timestamp by 1.7 us times the rate.
TEST(RemoteParts, ShowASteadilyTurningTurretWithoutDelay) {
  PartsReceiver receiver;
  const auto truth = [](double t) { return 2.8 + 0.5 * t; };
  double worst = 0;
  for (int update = 0; update < 60; ++update) {
    const double sent = 0.5 * update, now = sent + 0.15;
    receiver.hear(turret(truth(sent), 0.5), sent, now);
    for (double t = now; t < now + 0.5; t += 0.01) {
      const ShownPart shown = receiver.part(kTurret, t);
      worst = std::max(worst, off(shown.value, truth(t)));
      ASSERT_LE(std::abs(shown.value), kPi + 1e-12);
      ASSERT_NEAR(shown.rate, 0.5, 1e-4);
    }
  }
  std::printf("turret at 0.5 rad/s, 2 Hz, 150 ms late: at most %.2g rad off\n", worst);
  EXPECT_LE(worst, 2e-6);
}

// 1.28 rad/s^2 for 0.65 s gives 0.27 rad at an update, and 0.83 rad/s; no more during convergence.
TEST(RemoteParts, TurnWithoutAStepAtUpdates) {
  PartsReceiver receiver;
  const auto truth = [](double t) { return 3 + 2 * std::sin(0.8 * t); };
  const auto rate = [](double t) { return 1.6 * std::cos(0.8 * t); };
  double worst = 0;
  for (int update = 0; update < 60; ++update) {
    const double sent = 0.5 * update, now = sent + 0.15;
    const ShownPart before = receiver.part(kTurret, now);
    receiver.hear(turret(truth(sent), rate(sent)), sent, now);
    const ShownPart after = receiver.part(kTurret, now);
    if (update > 0) {
      ASSERT_LE(off(after.value, before.value), 1e-12) << update;
      ASSERT_NEAR(after.rate, before.rate, 1e-12) << update;
    }
    for (double t = now; t < now + 0.5; t += 0.01)
      worst = std::max(worst, off(receiver.part(kTurret, t).value, truth(t)));
  }
  EXPECT_LE(worst, 0.3);
  EXPECT_EQ(receiver.count("snaps"), 0U);
}

TEST(RemoteParts, RestWhileFrozenAndChangeWithoutConvergence) {
  PartsReceiver receiver;
  receiver.hear(turret(1, 0.5), 1, 1);
  receiver.state().appearance = pdu::kAppearanceFrozen;
  receiver.hear(turret(2, 0.5), 2, 2);
  for (const double t : {2.0, 2.01, 2.05, 9.0}) {
    EXPECT_NEAR(receiver.part(kTurret, t).value, 2, 1e-6) << t;
    EXPECT_EQ(receiver.part(kTurret, t).rate, 0) << t;
  }
  // Updates during the freeze converge.
  receiver.hear(turret(2.1, 0.5), 3, 3);
  EXPECT_NEAR(receiver.part(kTurret, 3).value, 2, 1e-6);
  EXPECT_NEAR(receiver.part(kTurret, 4).value, 2.1, 1e-6);

  receiver.state().appearance = 0;
  receiver.hear(turret(1.5, 0.5), 5, 5);
  EXPECT_NEAR(receiver.part(kTurret, 5).value, 1.5, 1e-5);
  EXPECT_NEAR(receiver.part(kTurret, 6).value, 2, 1e-5);
}

TEST(RemoteParts, AreShownAtOnceWhereTheEntityIs) {
  PartsReceiver receiver;
  receiver.hear(turret(1, 0), 1, 1);
  receiver.shift = 500;
  receiver.hear(turret(2, 0), 2, 2);
  EXPECT_EQ(receiver.count("snaps"), 1U);
  EXPECT_NEAR(receiver.part(kTurret, 2).value, 2, 1e-6);
}

TEST(RemoteParts, StopAfterTheEntitysCurrentTimeOut) {
  PartsReceiver receiver;
  receiver.state().linear_velocity = {0, 0, 0};  // at rest: 144 s
  receiver.hear(turret(0, 0.01), 1, 1);
  EXPECT_NEAR(receiver.part(kTurret, 101).value, 1, 1e-5);
  const ShownPart before = receiver.part(kTurret, 102);

  receiver.state().linear_velocity = {10, 0, 0};  // 12 s
  receiver.shift = -10 * 101;
  receiver.hear(turret(1.01, 0.01), 102, 102);
  EXPECT_EQ(receiver.count("snaps"), 0U);
  EXPECT_NEAR(receiver.part(kTurret, 102).value, before.value, 1e-9);
  EXPECT_NEAR(receiver.part(kTurret, 110).value, 1.09, 1e-5);
  for (const double t : {114.1, 200.0, 1e6}) {
    EXPECT_NEAR(receiver.part(kTurret, t).value, 1.13, 1e-5) << t;
    EXPECT_EQ(receiver.part(kTurret, t).rate, 0) << t;
  }
}

// --- appearing and disappearing

TEST(RemoteParts, AppearAndDisappearWithTheirUpdates) {
  PartsReceiver receiver;
  receiver.hear({}, 1, 1);
  EXPECT_TRUE(receiver.parts(1).empty());
  receiver.hear(octets_of({{kTurret, 11, 0.5F}, {kGun, 13, 0.1F, 1}, {kGun, 14, 0.2F, 1}}), 2, 2);
  EXPECT_EQ(receiver.parts(2).size(), 2U);
  EXPECT_EQ(receiver.part(kTurret, 2).value, 0.5);
  EXPECT_EQ(receiver.part(kGun, 2).attached_to, 1);
  EXPECT_EQ(receiver.part(kGun, 2).metric, PartMetric::elevation);
  EXPECT_NEAR(receiver.part(kGun, 3).value, 0.3, 1e-5);
  EXPECT_EQ(view_of(*receiver.row(), {}, pdu::from_seconds(2)).parts, 2);

  receiver.hear(turret(0.5, 0), 3, 3);
  EXPECT_EQ(receiver.parts(3).size(), 1U);
  receiver.hear({}, 4, 4);
  EXPECT_TRUE(receiver.parts(4).empty());
  EXPECT_EQ(receiver.remote().with_parts(), 0U);
  EXPECT_EQ(view_of(*receiver.row(), {}, pdu::from_seconds(4)).parts, 0);
  EXPECT_TRUE(receiver.parts(4, {3, 3, 3}).empty()) << "nobody knows it";
}

TEST(RemoteParts, GiveTheirPlaceBackHoweverTheEntityGoes) {
  PartsReceiver receiver;
  receiver.hear(turret(1, 0), 1, 1);
  receiver.state().appearance = pdu::kAppearanceDeactivated;
  receiver.hear(turret(1, 0), 2, 2);
  EXPECT_EQ(receiver.remote().with_parts(), 0U);

  receiver.state().appearance = 0;
  receiver.hear(turret(1, 0), 3, 3);
  EXPECT_EQ(receiver.remote().with_parts(), 1U);
  receiver.remote().expire(pdu::from_seconds(60));
  EXPECT_EQ(receiver.remote().with_parts(), 0U);

  receiver.hear(turret(1, 0), 61, 61);
  receiver.remote().drop_peer({7, 8}, Gone::left, {});
  EXPECT_EQ(receiver.remote().with_parts(), 0U);
  EXPECT_TRUE(receiver.parts(61).empty());
}

// The table moves rows when one is removed.
TEST(RemoteParts, StayWithTheirEntityWhenOthersGo) {
  PartsReceiver receiver;
  for (std::uint16_t id = 1; id <= 20; ++id) receiver.hear(turret(0.1 * id, 0), 1, 1, id);
  receiver.state().appearance = pdu::kAppearanceDeactivated;
  for (std::uint16_t id = 1; id <= 20; id = static_cast<std::uint16_t>(id + 2))
    receiver.hear({}, 2, 2, id);
  EXPECT_EQ(receiver.remote().with_parts(), 10U);
  for (std::uint16_t id = 2; id <= 20; id = static_cast<std::uint16_t>(id + 2)) {
    ASSERT_EQ(receiver.parts(2, {7, 8, id}).size(), 1U) << id;
    EXPECT_NEAR(receiver.parts(2, {7, 8, id})[0].value, 0.1 * id, 1e-6) << id;
  }
}

// --- a whole peer

// Datagrams of peers without trailers are accepted, too.
TEST(RemoteParts, ARunningPeerShowsThoseOfEntityStates) {
  const SceneFile scene = reckon::test::scene_of(reckon::test::kTwoHandsOnAWall);
  reckon::test::InProcess world(1);
  const peer::Peer& peer = world.start(0, scene);
  world.run(100);
  pdu::EntityState state;
  state.header.exercise_id = scene.network.exercise;
  state.header.timestamp = pdu::to_dis_timestamp(world.clock().utc_now(), true);
  state.entity_id = {7, 8, 9};
  const deadreckon::LocalFrame frame(scene.origin.latitude, scene.origin.longitude,
                                     scene.origin.height);
  state.location = {frame.origin().x(), frame.origin().y(), frame.origin().z()};
  const auto records = turret(1, 0.5);
  state.variable_parameters = records;
  const nanoseconds sent = world.clock().now();
  world.say(state, scene);
  world.run(1000);
  const ShownParts parts = peer.model().remote().parts({7, 8, 9}, sent + std::chrono::seconds(1));
  ASSERT_EQ(parts.size(), 1U);
  EXPECT_NEAR(parts[0].value, 1.5, 1e-5);
  ASSERT_EQ(world.view(0).count, 1U);
  EXPECT_EQ(world.view(0).rows[0].parts, 1);
}

}  // namespace
}  // namespace reckon::peer::test
