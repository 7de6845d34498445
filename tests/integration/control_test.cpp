// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Control by others: stop, resume, a different scene, a conflicting number.
#include <gtest/gtest.h>

#include <algorithm>

#include "reckon/pdu/management/acknowledge.hpp"
#include "reckon/pdu/management/start_resume.hpp"
#include "reckon/pdu/management/stop_freeze.hpp"
#include "reckon/pdu/reckon/presence_pdu.hpp"
#include "reckon/pdu/timestamp.hpp"
#include "reckon/tests/support/in_process.hpp"

namespace reckon::test {
namespace {

constexpr pdu::EntityId kManager{9, 9, 0};

// Two peers that know each other, and a manager on the listener's link.
class Control : public testing::Test {
 protected:
  Control() : scene_(managed_by("9:9", scene_of(kTwoHandsOnAWall))), world_(2) {
    world_.listen(scene_);
    world_.start(0, scene_);
    world_.start(1, scene_);
    world_.run(300);
    EXPECT_EQ(world_.view(0).entities, 1u);
  }

  template <typename Message>
  void order(const pdu::EntityId& receiver, std::uint32_t request) {
    Message message;
    message.header.exercise_id = scene_.network.exercise;
    message.header.timestamp = pdu::to_dis_timestamp(world_.clock().utc_now(), true);
    message.originating_entity_id = kManager;
    message.receiving_entity_id = receiver;
    message.request_id = request;
    world_.heard().clear();
    world_.say(message, scene_);
    world_.run(100);
  }
  // The states of a peer received since the last order: with the frozen bit, and all.
  [[nodiscard]] std::pair<int, int> frozen_and_all(std::size_t link) {
    std::pair<int, int> count;
    for (const auto& state : world_.heard_pdus<pdu::EntityState>()) {
      if (state.entity_id != world_.peer(link).own_id()) continue;
      ++count.second;
      if ((state.appearance & pdu::kAppearanceFrozen) != 0) ++count.first;
    }
    return count;
  }
  void expect_answer(std::size_t link, pdu::AcknowledgeFlag flag, std::uint32_t request) {
    const auto answers = world_.heard_pdus<pdu::Acknowledge>();
    const auto own = world_.peer(link).own_id();
    const auto answer = std::find_if(answers.begin(), answers.end(), [&](const auto& heard) {
      return heard.originating_entity_id == own;
    });
    ASSERT_NE(answer, answers.end());
    EXPECT_EQ(answer->receiving_entity_id, kManager);
    EXPECT_EQ(answer->acknowledge_flag, flag);
    EXPECT_EQ(answer->request_id, request);
  }

  peer::SceneFile scene_;
  InProcess world_;
};

TEST_F(Control, StopFreezeSetsFrozenBitAndIsAcknowledged) {
  order<pdu::StopFreeze>(world_.peer(0).own_id(), 41);
  expect_answer(0, pdu::AcknowledgeFlag::stop_freeze, 41);
  const auto [frozen, all] = frozen_and_all(0);
  EXPECT_GE(frozen, 1);
  EXPECT_EQ(frozen, all);
  EXPECT_TRUE(world_.view(0).frozen);
  ASSERT_EQ(world_.view(1).count, 1u);
  EXPECT_TRUE(world_.view(1).rows[0].frozen);
}

TEST_F(Control, StartResumeClearsFrozenBitAndIsAcknowledged) {
  order<pdu::StopFreeze>(world_.peer(0).own_id(), 41);
  order<pdu::StartResume>(world_.peer(0).own_id(), 42);
  expect_answer(0, pdu::AcknowledgeFlag::start_resume, 42);
  const auto [frozen, all] = frozen_and_all(0);
  EXPECT_EQ(frozen, 0);
  EXPECT_GE(all, 1);
  EXPECT_FALSE(world_.view(0).frozen);
  EXPECT_FALSE(world_.view(1).rows[0].frozen);
}

TEST_F(Control, StopFreezeForAllReachesEveryone) {
  order<pdu::StopFreeze>({0xFFFF, 0xFFFF, 0xFFFF}, 43);
  for (std::size_t link : {0u, 1u}) {
    SCOPED_TRACE(link);
    expect_answer(link, pdu::AcknowledgeFlag::stop_freeze, 43);
    EXPECT_TRUE(world_.view(link).frozen);
  }
}

TEST_F(Control, StopFreezeForAnotherIsNotObeyed) {
  order<pdu::StopFreeze>(world_.peer(1).own_id(), 44);
  EXPECT_FALSE(world_.view(0).frozen);
  EXPECT_TRUE(world_.view(1).frozen);
  EXPECT_EQ(world_.heard_pdus<pdu::Acknowledge>().size(), 1u);
}

TEST(SceneMismatch, IsReportedOnceAndNotJoined) {
  const peer::SceneFile one = scene_of(kTwoHandsOnAWall);
  const peer::SceneFile other = scene_of(with(kTwoHandsOnAWall, "800 N/m", "700 N/m"));
  ASSERT_NE(one.hash, other.hash);
  InProcess world(2);
  world.start(0, one);
  world.start(1, other);
  world.run(10'000);
  for (std::size_t link : {0u, 1u}) {
    SCOPED_TRACE(link);
    const auto told = world.notices(link);
    EXPECT_EQ(told.size(), 1u);
    EXPECT_NE(told.at(0).find("another scene"), std::string::npos);
    EXPECT_EQ(world.view(link).entities, 0u);
    // A state that arrived before the announcement was dropped after it.
    EXPECT_LE(world.count(link, "updates_in"), 1u);
    EXPECT_EQ(world.view(link).servo().count, 0u);
  }
}

TEST(SceneMismatch, DoesNotKeepOthersApart) {
  const peer::SceneFile one = scene_of(kTwoHandsOnAWall);
  const peer::SceneFile other = scene_of(with(kTwoHandsOnAWall, "800 N/m", "700 N/m"));
  InProcess world(3);
  world.start(0, one);
  world.start(1, other);
  world.start(2, one);
  world.run(2000);
  EXPECT_EQ(world.view(0).entities, 1u);
  EXPECT_EQ(world.view(1).entities, 0u);
  EXPECT_EQ(world.view(2).entities, 1u);
}

TEST(IdentityConflict, EndsWithDifferentNumbersThatSeeEachOther) {
  const peer::SceneFile scene = scene_of(kTwoHandsOnAWall);
  for (std::uint32_t seed = 1; seed <= 5; ++seed) {
    SCOPED_TRACE(seed);
    InProcess world(3, seed);
    for (std::size_t link : {0u, 1u, 2u}) {
      world.start(link, scene, static_cast<std::uint32_t>(seed * 7 + link * 13), 1);
    }
    world.run(3000);
    std::vector<pdu::EntityId> ids;
    for (std::size_t link : {0u, 1u, 2u}) {
      ids.push_back(world.peer(link).own_id());
      EXPECT_EQ(world.view(link).entities, 2u) << link;
      EXPECT_EQ(world.view(link).peers, 2u) << link;
    }
    std::sort(ids.begin(), ids.end());
    EXPECT_EQ(std::adjacent_find(ids.begin(), ids.end()), ids.end());
  }
}

}  // namespace
}  // namespace reckon::test
