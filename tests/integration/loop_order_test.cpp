// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The simulation loop of the thesis (Fig 5.5): sensors, actions, tasks, publish.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "reckon/pdu/management/comment.hpp"
#include "reckon/peer/loops/model_loop.hpp"
#include "reckon/tests/support/in_process.hpp"

namespace reckon::test {
namespace {

// A program that records its calls and the data available then.
class Program final : public peer::ModelGuest {
 public:
  std::vector<std::string> calls;
  nanoseconds hand{0};  // time of the hand's newest state, in the actions of the last pass

  void begin_pass(peer::ModelLoop& loop) noexcept override {
    calls.emplace_back("act");
    hand = loop.find_own(1)->truth().time;
  }
  void receive(const pdu::PduHeader&, std::span<const std::byte>,
               const peer::InteractionSender&) noexcept override {
    calls.emplace_back("hear");
  }
  void end_pass(peer::ModelLoop&) noexcept override { calls.emplace_back("publish"); }
};

class LoopOrder : public testing::Test {
 protected:
  LoopOrder() {
    world_.start(0, scene_).model().set_guest(&program_);
    world_.start(1, scene_);
    world_.run(2000);
    program_.calls.clear();
  }
  ~LoopOrder() override { world_.peer(0).model().set_guest(nullptr); }

  const peer::SceneFile scene_ = scene_of(kTwoHandsOnAWall);
  Program program_;
  InProcess world_{2};
};

TEST_F(LoopOrder, IsConstantInEachPassAndItsTrace) {
  peer::LoopRing ring(1000);
  world_.peer(0).trace_loop(&ring);
  world_.run(200);  // a pass each 2 ms
  world_.peer(0).trace_loop(nullptr);
  world_.run(2);
  peer::LoopStep before, step;
  std::size_t steps = 0;
  while (ring.pop(step)) {
    EXPECT_EQ(step.stage, static_cast<peer::LoopStage>(steps % 4)) << steps;
    EXPECT_GE(step.took, nanoseconds(0));
    if (steps % 4 == 0) {
      EXPECT_EQ(step.begin, nanoseconds(0));
      if (steps > 0) {
        EXPECT_EQ(step.pass, before.pass + 1);
        EXPECT_EQ(step.time, before.time + milliseconds(2));
      }
    } else {
      EXPECT_EQ(step.pass, before.pass);
      EXPECT_EQ(step.time, before.time);
      EXPECT_EQ(step.begin, before.begin + before.took) << "nothing runs between stages";
    }
    before = step;
    ++steps;
  }
  EXPECT_EQ(steps, 4U * 100);
}

TEST_F(LoopOrder, ProgramsActOnAllArrivals) {
  pdu::Comment comment;
  comment.header.exercise_id = scene_.network.exercise;
  comment.originating_entity_id = {4711, 1, 1};
  world_.say(comment, scene_);
  world_.run(4);
  ASSERT_GE(program_.calls.size(), 4U);
  EXPECT_THAT(program_.calls, testing::IsSupersetOf({"hear"}));
  const auto heard = std::ranges::find(program_.calls, "hear");
  EXPECT_EQ(*(heard + 1), "act") << "in the same pass";
  EXPECT_EQ(*(heard + 2), "publish");
}

// The servo steps before the model loop in each millisecond.
TEST_F(LoopOrder, ProgramsActOnWhereTheHandsAreNow) {
  for (int pass = 0; pass < 50; ++pass) {
    world_.run(2);
    ASSERT_EQ(program_.hand, world_.clock().now() - (world_.steps() % 2) * milliseconds(1));
  }
}

}  // namespace
}  // namespace reckon::test
