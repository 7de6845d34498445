// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Whole peers with leaders of cells: one per cell, named by all; replaced within two seconds after
// a death, at once after a leave announcement, and one again after a partition. Only the leader
// introduces a newcomer.
#include <gtest/gtest.h>

#include <cstdio>
#include <map>
#include <string>
#include <vector>

#include "reckon/pdu/reckon/cell_roles.hpp"
#include "reckon/pdu/reckon/cell_snapshot.hpp"
#include "reckon/pdu/reckon/group_map.hpp"
#include "reckon/tests/integration/field_of_peers.hpp"

namespace reckon::test::leaders_test {
namespace {

constexpr std::size_t kWitness = 0;
constexpr double kSpeed = 10.0;  // [m/s]

std::size_t link_of(const std::string& name) { return std::stoul(name.substr(2)) - 1; }

class LeadersOfPeers : public testing::TestWithParam<std::size_t> {};

TEST_P(LeadersOfPeers, AreOneForTheSceneAndCell) {
  Field field(GetParam());
  for (std::size_t link = 0; link < GetParam(); ++link) field.start(link);
  EXPECT_LE(field.until_agreed(4000), 2500U);
  const auto first = field.agreed();
  ASSERT_TRUE(first);
  EXPECT_EQ(first->scene, "1:1") << "who came first";
  EXPECT_EQ(first->cell, "1:1");
  field.world_.run(1000);
  for (std::size_t link = 0; link < GetParam(); ++link) {
    SCOPED_TRACE(link);
    const peer::LeadersView& view = field.world_.view(link).leaders;
    EXPECT_EQ(view.cells, 1U);
    EXPECT_EQ(view.led, link == 0 ? 1U : 0U);
    EXPECT_EQ(view.leaderless, 0U);
    EXPECT_GE(view.map_version, 1U);
    EXPECT_EQ(view.map_version, field.world_.view(0).leaders.map_version);
    EXPECT_TRUE(view.on);
    EXPECT_GE(view.map_cells, 1U);
    EXPECT_EQ(view.map_cells, field.world_.view(0).leaders.map_cells);
    EXPECT_EQ(field.world_.count(link, "cells_led"), view.led);
    EXPECT_EQ(field.world_.count(link, "group_map_version"), view.map_version);
    const std::string who = link == 0 ? "this peer, 1:1," : "peer 1:1";
    const auto told = field.world_.notices(link);
    EXPECT_EQ(std::count(told.begin(), told.end(), "the scene is led by " + who + " now"), 1);
    EXPECT_EQ(std::count(told.begin(), told.end(), "cell 0,0 is led by " + who + " now"), 1);
  }
}

TEST_P(LeadersOfPeers, AreReplacedWithinTwoSecondsOfADeath) {
  Field field(GetParam());
  for (std::size_t link = 0; link < GetParam(); ++link) field.start(link);
  field.world_.run(5000);
  // Killed at any time between two heartbeats; two in a row if there are enough peers.
  for (std::size_t deaths = 0; deaths + 1 < std::min<std::size_t>(GetParam(), 3); ++deaths) {
    const auto before = field.agreed();
    ASSERT_TRUE(before);
    field.kill(link_of(before->scene));
    const std::size_t took = field.until_agreed(4000, before->scene);
    std::printf("%zu peers, leader %s killed: another one named by all after %.2f s\n", GetParam(),
                before->scene.c_str(), 1e-3 * static_cast<double>(took));
    EXPECT_LT(took, 2000U);
    field.world_.run(4137);
  }
}

TEST_P(LeadersOfPeers, HandOverWithTheirGoodbye) {
  Field field(GetParam());
  for (std::size_t link = 0; link < GetParam(); ++link) field.start(link);
  field.world_.run(5000);
  const auto before = field.agreed();
  ASSERT_TRUE(before);
  field.stop(link_of(before->scene));
  const std::size_t took = field.until_agreed(4000, before->scene);
  std::printf("%zu peers, leader left: another one named by all after %zu ms\n", GetParam(), took);
  EXPECT_LE(took, 200U) << "with its picture each 50 ms";
}

INSTANTIATE_TEST_SUITE_P(Of, LeadersOfPeers, testing::Values(2, 4, 8));

TEST(Leaders, OfBothSidesUniteAfterAPartition) {
  Field field(6);
  peer::ImpairmentLaw cut;
  cut.outages = {{seconds(5), seconds(8)}};
  for (std::size_t one = 0; one < 3; ++one) {
    for (std::size_t other = 3; other < 6; ++other) {
      field.world_.network().impair(one, other, cut);
      field.world_.network().impair(other, one, cut);
    }
  }
  for (std::size_t link = 0; link < 6; ++link) field.start(link);
  field.world_.run(4900);
  ASSERT_TRUE(field.agreed());
  field.world_.run(7000);
  for (std::size_t link = 0; link < 6; ++link) {
    EXPECT_EQ(field.leader(link).cell, link < 3 ? "1:1" : "1:4") << "of peer " << link + 1;
  }
  field.world_.run(1100);  // it is connected again since 13 s
  const std::size_t took = field.until_agreed(4000);
  std::printf("two leaders after a partition: one again %zu ms after it healed\n", took);
  EXPECT_LT(took, 2000U);
  EXPECT_EQ(field.agreed()->cell, "1:1") << "who came first";
}

TEST(Leaders, ChangeWhenOneMovesToAnotherCell) {
  Field field(2);
  field.start(0);
  field.start(1);
  field.world_.run(3000);
  ASSERT_EQ(field.leader(1).cell, "1:1");
  // The first peer moves on by two cells; the second one leads the cell in which it stays.
  for (int i = 0; i < 30; ++i) {
    peer::EntityTruth truth = field.truth(Eigen::Vector3d(kSpeed * i, 0, 0));
    truth.velocity.x() = kSpeed;
    static_cast<void>(field.world_.peer(0).model().move(1, truth));
    field.world_.run(1000);
  }
  EXPECT_EQ(field.leader(1).cell, "1:2");
  EXPECT_EQ(field.leader(1).scene, "1:1");
  EXPECT_EQ(field.leader(0).cell, "1:1");
}

// The datagrams that each sender sent in a time, by its link.
struct Said {
  std::size_t datagrams = 0, octets = 0, states = 0, snapshots = 0, snapshot_octets = 0;
};

std::map<std::size_t, Said> said_since(InProcess& world, nanoseconds since) {
  std::map<std::size_t, Said> said;
  for (const Heard& heard : world.heard()) {
    if (heard.time <= since) continue;
    Said& one = said[heard.sender.octets[3] - 1U];
    const std::size_t size = heard.octets.size() + 28;  // with IP and UDP headers
    ++one.datagrams;
    one.octets += size;
    bool tells = false;
    for (const pdu::BundledPdu& pdu : pdu::BundleReader(heard.octets)) {
      one.states += pdu.header.pdu_type == pdu::PduType::entity_state ? 1 : 0;
      tells = tells || pdu.header.pdu_type == pdu::PduType::cell_snapshot;
    }
    if (!tells) continue;
    ++one.snapshots;
    one.snapshot_octets += size;
  }
  return said;
}

TEST(LateJoiner, OnlyTheLeaderIntroducesACellOfThousand) {
  constexpr std::size_t kOwners = 4, kEach = 250;
  Field field(kOwners + 1);
  for (std::size_t link = 0; link < kOwners; ++link) field.start(link, kEach);
  field.world_.run(11'000);  // states at rest are repeated after 9 s, then after 17 s
  for (std::size_t link = 0; link < kOwners; ++link) {
    ASSERT_EQ(field.world_.view(link).entities, (kOwners - 1) * kEach);
  }
  field.world_.heard().clear();
  const nanoseconds quiet = field.world_.clock().now();
  field.world_.run(2000);
  auto before = said_since(field.world_, quiet);

  const nanoseconds came = field.world_.clock().now();
  field.start(kOwners, 0);
  // It owns nothing and watches the origin, from 50 m away.
  peer::EntityDescription eye;
  eye.type = {pdu::EntityKind::platform, pdu::EntityDomain::land, 225, 1, 0, 0, 0};
  field.world_.peer(kOwners).model().add(1, eye, field.truth(Eigen::Vector3d(0, 1, 0)));
  const std::size_t took = field.world_.run_until(
      [&] { return field.world_.peer(kOwners).model().remote().rows().size() == kOwners * kEach; },
      3000);
  field.world_.run(2000 - took);
  const auto after = said_since(field.world_, came);

  std::size_t snapshot_octets = 0;
  for (const auto& [link, said] : after) {
    std::printf(
        "peer %zu: %zu datagrams, %zu octets in 2 s (before: %zu, %zu); of these %zu parts "
        "of snapshots; %zu Entity States\n",
        link + 1, said.datagrams, said.octets, before[link].datagrams, before[link].octets,
        said.snapshots, said.states);
    snapshot_octets += said.snapshot_octets;
    if (link != kWitness) {
      EXPECT_EQ(said.snapshots, 0U);
    }
    if (link >= kOwners) continue;
    EXPECT_EQ(before[link].states, 0U) << "a quiet time to compare with";
    EXPECT_EQ(said.states, 0U) << "introduced by peer " << link + 1;
    // Presence is answered to a newcomer with and without leaders.
    EXPECT_LE(said.datagrams - said.snapshots, before[link].datagrams + 3);
    EXPECT_LE(said.octets - said.snapshot_octets, before[link].octets + 600);
  }
  const double share = static_cast<double>(snapshot_octets) / (kOwners * kEach * 144.0);
  std::printf("1,000 entities shown %.3f s after the newcomer's start, for %.3f of their octets\n",
              1e-3 * static_cast<double>(took), share);
  EXPECT_LT(took, 1000U);
  EXPECT_LE(share, 1.2);
  EXPECT_EQ(field.world_.count(kOwners, "states_relayed_in"), kOwners * kEach);
  EXPECT_GT(field.world_.count(kWitness, "snapshot_parts_out"), 100U);
}

TEST(LateJoiner, FeelsAtOnceEntitiesOfSilentOwners) {
  Field field(3);
  field.start(0);
  field.start(1, 1, true);
  field.world_.run(4000);
  field.start(2, 1);
  field.world_.run(900);
  EXPECT_EQ(field.world_.count(2, "states_relayed_in"), 2U);
  const auto& remote = field.world_.peer(2).model().remote();
  const peer::RemoteEntity* post = remote.find({1, 2, 1});
  ASSERT_NE(post, nullptr);
  EXPECT_TRUE(post->haptic);
  EXPECT_EQ(post->model.k1, 500.0);
}

// The last update is old, but its motion model is still right: a newcomer shows the entity in
// place, and takes the next updates as if it had received all.
TEST(LateJoiner, ShowsMovingEntitiesInPlace) {
  for (const bool absolute : {true, false}) {
    SCOPED_TRACE(absolute);
    Field field(3);
    if (!absolute) field.world_.set_host_clock(1, seconds(400));
    field.start(0);
    field.start(1);
    const nanoseconds begun = field.world_.clock().now();
    const auto drive = [&](std::size_t ms, double speed) {
      for (std::size_t i = 0; i < ms; i += 10) {
        const double since =
            1e-9 * static_cast<double>((field.world_.clock().now() - begun).count());
        peer::EntityTruth truth = field.truth(Eigen::Vector3d(speed * since, 0, 0));
        truth.velocity.x() = speed;
        static_cast<void>(field.world_.peer(1).model().move(1, truth));
        field.world_.run(10);
      }
    };
    drive(6000, 1.0);
    field.start(2);
    drive(900, 1.0);
    const auto& remote = field.world_.peer(2).model().remote();
    const peer::RemoteEntity* car = remote.find({1, 2, 1});
    ASSERT_NE(car, nullptr);
    const nanoseconds now = field.world_.clock().now();
    const double there = kMiddle.x() + 6.9;
    EXPECT_NEAR(car->shown(now).position.x(), there, 0.1);
    EXPECT_EQ(field.world_.count(2, "states_relayed_in"), 2U);
    EXPECT_EQ(field.world_.count(2, "stale_in"), 0U);
    drive(3000, 1.5);  // it jumps and continues faster
    EXPECT_NEAR(remote.find({1, 2, 1})->shown(field.world_.clock().now()).position.x(),
                kMiddle.x() + 1.5 * 9.9, 0.2);
    EXPECT_EQ(field.world_.count(2, "stale_in"), 0U);
  }
}

TEST(Leaders, AreSilentInAScenesWithoutLeaders) {
  const std::string none = with(kField, "leaders = true\n", "");
  EXPECT_NE(scene_of(kField).hash, scene_of(none).hash) << "peers of the one do not join the other";
  EXPECT_EQ(scene_of(none).hash, scene_of(with(kField, "leaders = true", "leaders = false")).hash);
  Field field(3, none);
  for (std::size_t link = 0; link < 3; ++link) field.start(link);
  field.world_.run(5000);
  EXPECT_TRUE(field.world_.heard_pdus<pdu::CellRoles>().empty());
  EXPECT_TRUE(field.world_.heard_pdus<pdu::GroupMap>().empty());
  EXPECT_TRUE(field.world_.heard_pdus<pdu::CellSnapshot>().empty());
  EXPECT_FALSE(field.world_.view(0).leaders.on);
  EXPECT_EQ(field.world_.peer(0).counters().find("cells_led"), nullptr);
}

TEST(Leaders, AreRefusedWhereTheyCannotBeHad) {
  const auto problem = [](std::string_view extra) {
    try {
      static_cast<void>(scene_of(std::string(kField) + std::string(extra)));
    } catch (const peer::SceneFileError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_NE(problem("[network]\ninterop = true\n").find("'interop'"), std::string::npos);
  EXPECT_NE(problem("[network]\ncompression = \"compact\"\n").find("'compression'"),
            std::string::npos);
}

}  // namespace
}  // namespace reckon::test::leaders_test
