// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// One whole peer among light ones: it hears what they say, and what the model counts.
#include "reckon/bench/studies/scale/measured_peer.hpp"

#include <gmock/gmock.h>

#include <set>

#include "reckon/bench/studies/scale/mechanisms.hpp"
#include "reckon/pdu/codec/codec.hpp"
#include "reckon/pdu/entity/entity_state.hpp"
#include "reckon/tools/command_line/console.hpp"

namespace reckon::bench::measured_peer_test {
namespace {

ScaleSetting small_setting() {
  ScaleSetting setting;
  setting.peers = 8;
  setting.crowd.entities = 400;
  setting.crowd.movement = "vehicles";
  setting.seconds = 4;
  setting.rate = 20;
  return setting;
}

// Everybody sends all to the base group, which a peer always hears: the count of the light peers,
// and of each datagram's updates, is that of the whole one.
TEST(MeasuredPeer, HearsEverythingThatGoesToAll) {
  ScaleSetting setting = small_setting();
  std::uint64_t sent = 0;
  static_cast<void>(run_world(setting, design_of(0), {},
                              [&](double time, std::uint32_t, aoim::GroupIndex,
                                  std::span<const std::byte>) { sent += time > kWarmUp; }));
  const MeasuredPeer run = run_measured_peer(setting, design_of(0));
  EXPECT_NEAR(run.seconds, setting.seconds, 0.1);
  EXPECT_NEAR(static_cast<double>(run.datagrams), static_cast<double>(sent),
              0.02 * static_cast<double>(sent));
  EXPECT_NEAR(static_cast<double>(run.updates), 400 * 20 * 4, 0.02 * 400 * 20 * 4);
  EXPECT_GT(run.cpu, 0);
}

// Who is within the radius of the origin is in its table; with areas it hears less.
TEST(MeasuredPeer, KnowsWhoIsNear) {
  ScaleSetting setting = small_setting();
  Crowd crowd(setting.crowd);
  const MeasuredPeer run = run_measured_peer(setting, design_of(kMechanisms.size() - 1));
  crowd.advance(kWarmUp + setting.seconds);
  std::size_t near = 0, nearby = 0;
  for (std::size_t i = 0; i < crowd.size(); ++i) {
    near += distance(crowd.position(i), {}) <= 0.97 * setting.radius;
    nearby += distance(crowd.position(i), {}) <= 1.15 * setting.radius;
  }
  EXPECT_GE(run.known, near);
  EXPECT_LE(run.known, nearby);
  EXPECT_GT(near, 20U);
  EXPECT_GT(run.groups, 3U);
  EXPECT_LT(run.groups, 30U);
}

TEST(MeasuredPeer, RefusesMoreLightPeersThanItKeepsInMind) {
  ScaleSetting setting = small_setting();
  setting.peers = 300;
  EXPECT_THROW(static_cast<void>(run_measured_peer(setting, design_of(0))), tools::UsageError);
}

}  // namespace
}  // namespace reckon::bench::measured_peer_test
