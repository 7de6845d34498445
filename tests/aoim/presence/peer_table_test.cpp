// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/aoim/presence/peer_table.hpp"

#include <gtest/gtest.h>

#include <random>

#include "reckon/aoim/presence/former_lives.hpp"
#include "reckon/tests/aoim/support/segment.hpp"

namespace reckon::aoim {
namespace {

using namespace test;

Peer peer_of(std::uint16_t number, std::uint32_t epoch) {
  Peer peer;
  peer.announced = presence_of(number, epoch);
  return peer;
}

TEST(PeerTable, FindsPeersByIdAndEpochThroughRestarts) {
  PeerTable table(64);
  std::mt19937 random(7);
  std::uint32_t epoch = 100;
  std::vector<std::uint32_t> lives(64, 0);  // by number; 0: absent
  for (int turn = 0; turn < 5000; ++turn) {
    const auto number = static_cast<std::uint16_t>(1 + random() % 63);
    const PeerId id = presence_of(number, 1).simulation;
    const std::uint32_t former = lives[number];
    const std::size_t index = table.find(id);
    ASSERT_EQ(index < table.size(), former != 0) << "turn " << turn;
    if (former == 0) {
      table.append(peer_of(number, lives[number] = ++epoch));
      continue;
    }
    ASSERT_EQ(table.epoch(index), former);
    ASSERT_EQ(table.find_epoch(former), index);
    if (random() % 2 == 0) {
      table.replace(index, peer_of(number, lives[number] = ++epoch));
    } else {
      table.erase(index);
      lives[number] = 0;
    }
    ASSERT_EQ(table.find_epoch(former), table.size());
  }
  for (const Peer& peer : table.rows()) EXPECT_NE(peer.announced.epoch, 0U);
}

FormerLife life_of(std::uint32_t epoch, int seconds_heard, bool returns) {
  FormerLife life;
  life.epoch = epoch;
  life.last_heard = seconds(seconds_heard);
  pdu::Presence announced = presence_of(1, epoch);
  if (returns) announced.chain_link[0] = 1;
  life.tip = LifeTip(announced, life.last_heard);
  return life;
}

TEST(FormerLives, KeepsLongKnownPeersThatMayReturn) {
  FormerLives lives;
  lives.add(life_of(1, 1000, true));
  lives.add(life_of(2, 2, true));
  for (std::uint32_t epoch = 3; epoch < 200; ++epoch) lives.add(life_of(epoch, 500, false));
  EXPECT_TRUE(lives.contains(1));
  EXPECT_TRUE(lives.contains(2));
  EXPECT_FALSE(lives.contains(3));
  EXPECT_TRUE(lives.contains(199));
  for (std::uint32_t epoch = 200; epoch < 263; ++epoch) lives.add(life_of(epoch, 5, true));
  EXPECT_TRUE(lives.contains(1));
  EXPECT_FALSE(lives.contains(2));
}

TEST(FormerLives, RemembersAnEpochOnceUntilItIsTaken) {
  FormerLives lives;
  lives.add(life_of(1, 10, true));
  lives.add(life_of(1, 20, true));
  ASSERT_NE(lives.find(1), nullptr);
  EXPECT_EQ(lives.find(1)->last_heard, seconds(20));
  EXPECT_TRUE(lives.take(1).has_value());
  EXPECT_EQ(lives.find(1), nullptr);
  EXPECT_FALSE(lives.take(1).has_value());
}

}  // namespace
}  // namespace reckon::aoim
