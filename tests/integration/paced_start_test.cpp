// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// An owner of very many entities starts, and introduces them to newcomers: no receiver takes it for
// a flood.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "reckon/tests/support/in_process.hpp"

namespace reckon::test {
namespace {

// Entities at rest of the first peer, around the hands.
peer::SceneFile scene_with(std::size_t entities) {
  peer::SceneFile scene = scene_of(kTwoHandsOnAWall);
  scene.aoim.radius = 1000.0;
  for (std::size_t i = 0; i < entities; ++i) {
    peer::EntityConfig& entity = scene.entities.emplace_back();
    entity.marking = "E" + std::to_string(i);
    entity.position = {0.1 * static_cast<double>(i % 200), 0.1 * static_cast<double>(i / 200), 1.0};
  }
  scene.hash = peer::scene_hash(scene);
  return scene;
}

TEST(ManyEntities, AreCompleteSoonAfterTheirOwnersStart) {
  const peer::SceneFile scene = scene_with(20'000);
  InProcess world(2, 1, 8192);
  world.start(1, scene);
  world.run(1000);
  world.start(0, scene);
  const auto whole = [&] { return world.view(1).entities > 20'000; };
  EXPECT_LE(world.run_until(whole, 3000), 3000u);
  EXPECT_EQ(world.count(1, "muted_in"), 0u);
}

TEST(ManyEntities, AreCompleteSoonForANewcomer) {
  const peer::SceneFile scene = scene_with(40'000);
  InProcess world(2, 1, 8192);
  world.start(0, scene);
  world.run(6000);
  world.start(1, scene);
  const auto whole = [&] { return world.view(1).entities > 40'000; };
  EXPECT_LE(world.run_until(whole, 6000), 6000u);
  EXPECT_EQ(world.count(1, "muted_in"), 0u);
}

// The datagrams of all passes in any 100 ms stay below the limit that a receiver under pressure
// sets for one sender.
TEST(ManyEntities, AreSentBelowTheQuotaOfAReader) {
  const peer::SceneFile scene = scene_with(20'000);
  InProcess world(2, 1, 8192);
  world.start(0, scene);
  world.run(20);
  std::vector<std::uint64_t> sent;
  for (int i = 0; i < 3000; ++i) {
    world.run(1);
    sent.push_back(world.count(0, "datagrams_out"));
    if (sent.size() <= 100) continue;
    ASSERT_LT(sent.back() - sent[sent.size() - 101], peer::SenderBudget::kMostPressed);
  }
  EXPECT_GT(sent.back(), 2000u);
}

}  // namespace
}  // namespace reckon::test
