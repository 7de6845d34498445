// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/world/near_bodies.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <deque>
#include <random>
#include <vector>

namespace reckon::peer {
namespace {

TEST(NearBodies, AreLargerAsProbesWhereTheyMayTouch) {
  RemoteEntity row;
  row.model.radius = 0.01;
  row.type.kind = pdu::EntityKind::life_form;
  NearBody body;
  body.row = &row;
  body.centre = {1, 2, 3};
  std::array bodies{body, body, body, body};
  bodies[0].depth = 0.001;    // touches
  bodies[1].depth = -0.0004;  // almost touches
  bodies[2].depth = -0.0006;
  bodies[3].depth = -1;
  std::array<deadreckon::ProbeState, haptics::kMaxRemoteHands> probes;
  ASSERT_EQ(to_probes(bodies, 0.0005, probes), 4u);
  EXPECT_EQ(probes[0].radius, 0.01);
  EXPECT_EQ(probes[1].radius, 0.0105);
  EXPECT_EQ(probes[2].radius, 0.01);
  EXPECT_EQ(probes[3].radius, 0.01);
  EXPECT_EQ(probes[1].position, body.centre);
}

TEST(NearBodies, AreNoProbesWhereNobodyHoldsThem) {
  RemoteEntity hand, peg;
  hand.type.kind = pdu::EntityKind::life_form;
  peg.type.kind = pdu::EntityKind::cultural_feature;
  std::array<NearBody, 2> bodies;
  bodies[0].row = &peg;
  bodies[1].row = &hand;
  bodies[1].centre = {1, 2, 3};
  std::array<deadreckon::ProbeState, haptics::kMaxRemoteHands> probes;
  ASSERT_EQ(to_probes(bodies, 0.0005, probes), 1u);
  EXPECT_EQ(probes[0].position, bodies[1].centre);
}

// Bodies of other peers, each given once in each pass.
class Places {
 public:
  // A sphere that a hand feels, unless `k1` is too small.
  std::size_t body(const Party& party, double depth, double k1 = 300.0) {
    RemoteEntity& row = rows_.emplace_back();
    row.id = {7, 7, static_cast<std::uint16_t>(rows_.size())};
    row.model.kind = pdu::ForceModelKind::sphere;
    row.model.k1 = k1;
    row.party = party;
    depths_.push_back(depth);
    return rows_.size() - 1;
  }
  void look() {
    std::vector<std::size_t> order(rows_.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
    std::shuffle(order.begin(), order.end(), random_);
    near.clear();
    for (const std::size_t i : order) {
      deadreckon::Contact touch;
      touch.depth = depths_[i];
      near.add(rows_[i], touch, Eigen::Vector3d::Zero());
    }
    near.choose();
  }
  [[nodiscard]] bool has(std::size_t body) const {
    return std::ranges::any_of(
        near.bodies(), [&](const NearBody& found) { return found.id == rows_[body].id; });
  }
  void set_depth(std::size_t body, double depth) { depths_[body] = depth; }
  [[nodiscard]] std::size_t of_host(std::uint16_t host) const {
    return static_cast<std::size_t>(std::ranges::count_if(
        near.bodies(), [&](const NearBody& found) { return found.row->party.host == host; }));
  }
  NearBodies near;

 private:
  std::deque<RemoteEntity> rows_;
  std::vector<double> depths_;
  std::minstd_rand random_{1};
};

constexpr Party kBob{1, 1, false};

// Host 0 is never used here, nor is the local host.
Party guest_of(std::uint16_t host, std::uint16_t sender = 9) { return {host, sender, true}; }
Party peer_of(std::uint16_t host, std::uint16_t sender = 9) { return {host, sender, false}; }

TEST(NearBodies, KeepAllInDepthOrderIfRoom) {
  Places places;
  for (std::size_t i = 0; i < NearBodies::kMost; ++i)
    static_cast<void>(places.body(kBob, -0.2 + 0.001 * static_cast<double>(i)));
  places.look();
  EXPECT_EQ(places.near.bodies().size(), NearBodies::kMost);
  EXPECT_EQ(places.near.left_out(), 0u);
  EXPECT_EQ(places.near.crowding(), nullptr);
  EXPECT_TRUE(std::ranges::is_sorted(
      places.near.bodies(), [](const NearBody& a, const NearBody& b) { return a.depth > b.depth; }));
}

TEST(NearBodies, KeepAHandAmongTenThousandGuests) {
  for (const double depth : {0.004, -0.02, -0.2}) {
    Places places;
    const std::size_t bob = places.body(kBob, depth);
    for (std::size_t i = 0; i < 10'000; ++i)
      static_cast<void>(places.body(guest_of(2, static_cast<std::uint16_t>(i % 50)), 0.9));
    places.look();
    EXPECT_TRUE(places.has(bob)) << depth;
    EXPECT_EQ(places.near.left_out(), 10'001 - NearBodies::kMost);
    ASSERT_NE(places.near.crowding(), nullptr);
    EXPECT_EQ(places.near.crowding()->party.host, 2);
  }
}

TEST(NearBodies, KeepANewHandAmongTouchingStrangers) {
  for (const bool guest : {false, true}) {
    Places places;
    for (std::size_t i = 0; i < 100; ++i) static_cast<void>(places.body({2, 9, guest}, 0.9));
    places.look();
    const std::size_t bob = places.body(kBob, -0.2);
    places.look();
    EXPECT_TRUE(places.has(bob));
    places.set_depth(bob, 0.001);
    places.look();
    EXPECT_TRUE(places.has(bob));
  }
}

TEST(NearBodies, KeepTouchingBodiesAgainstAnyNewHosts) {
  for (const bool guest : {false, true}) {
    Places places;
    const std::size_t bob = places.body(kBob, 0.001), his_other = places.body(kBob, 0.001);
    places.look();
    for (std::uint16_t host = 2; host < 200; ++host)
      static_cast<void>(places.body({host, 9, guest}, 0.9));
    places.look();
    EXPECT_TRUE(places.has(bob) && places.has(his_other));
  }
}

TEST(NearBodies, PreferPeersToGuestsOfAnyHosts) {
  Places places;
  for (std::uint16_t host = 2; host < 200; ++host)
    static_cast<void>(places.body(guest_of(host), 0.9));
  places.look();
  const std::size_t bob = places.body(kBob, -0.01);
  places.look();
  EXPECT_TRUE(places.has(bob));
}

TEST(NearBodies, ShareAHostsPlacesAmongItsSenders) {
  Places places;
  const std::size_t bob = places.body(kBob, 0.001);
  for (std::size_t i = 0; i < 100; ++i) static_cast<void>(places.body(peer_of(1, 2), 0.9));
  for (std::size_t i = 0; i < 100; ++i) static_cast<void>(places.body(guest_of(1, 3), 0.9));
  for (std::uint16_t host = 2; host < 8; ++host) {
    for (int i = 0; i < 5; ++i) static_cast<void>(places.body(peer_of(host), 0.5));
  }
  places.look();
  EXPECT_TRUE(places.has(bob));
}

TEST(NearBodies, GiveEachHostItsShareFirst) {
  Places places;
  for (std::uint16_t host = 1; host <= 5; ++host) {
    for (int i = 0; i < 3 * host; ++i) static_cast<void>(places.body(peer_of(host), 0.1 * host));
  }
  places.look();
  EXPECT_EQ(places.near.bodies().size(), NearBodies::kMost);
  EXPECT_EQ(places.of_host(1), 3u);
  for (std::uint16_t host = 2; host <= 5; ++host)
    EXPECT_GE(places.of_host(host), NearBodies::kSure) << host;
}

TEST(NearBodies, PutForcelessBodiesLast) {
  Places places;
  for (std::uint16_t host = 2; host < 100; ++host) {
    for (const double k1 : {0.0, 1e-30, 1e-3}) static_cast<void>(places.body(peer_of(host), 0.9, k1));
  }
  places.look();
  std::vector<std::size_t> soft;
  for (std::size_t i = 0; i < NearBodies::kMost; ++i)
    soft.push_back(places.body(guest_of(2), -0.2, 1.0));
  places.look();
  for (const std::size_t body : soft) EXPECT_TRUE(places.has(body));
}

}  // namespace
}  // namespace reckon::peer
