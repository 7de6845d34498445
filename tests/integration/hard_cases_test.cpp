// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The hard cases of dead reckoning as a peer's table of remote entities meets them. The rest of the
// list is in tests/deadreckon/hard_cases_test.cpp.
#include <gtest/gtest.h>

#include <array>
#include <limits>

#include "reckon/pdu/timestamp.hpp"
#include "reckon/peer/loops/aoim_setup.hpp"
#include "reckon/peer/world/remote_entities.hpp"
#include "reckon/tests/support/in_process.hpp"

namespace reckon::peer {
namespace {

using std::chrono::hours;
using std::chrono::milliseconds;
using std::chrono::nanoseconds;
using std::chrono::seconds;

constexpr pdu::EntityId kEntity{7, 8, 9};

// The table of a peer, and a sender of relative time whose clock is a test's own.
class HardCases : public testing::Test {
 protected:
  HardCases() {
    const std::array<aoim::Focus, 1> everywhere{{{{0, 0, 0}, 0.0, 1e6}}};
    static_cast<void>(aoim_.set_foci(everywhere, nanoseconds(0)));
  }

  // A state that moves at 10 m/s along the geocentric x, from the scene's origin at sender time 0.
  pdu::EntityState state(nanoseconds sender) const {
    pdu::EntityState pdu;
    pdu.header.timestamp = pdu::to_dis_timestamp(sender, false);
    pdu.entity_id = kEntity;
    pdu.entity_type.kind = pdu::EntityKind::platform;
    pdu.entity_type.domain = pdu::EntityDomain::air;  // heartbeat 5 s, time-out 12 s
    const Eigen::Vector3d& origin = frame_.origin();
    pdu.location = {origin.x() + 10 * std::chrono::duration<double>(sender).count(), origin.y(),
                    origin.z()};
    pdu.linear_velocity = {10, 0, 0};
    pdu.dead_reckoning.algorithm = pdu::DeadReckoningAlgorithm::fpw;
    return pdu;
  }
  void hear(const pdu::EntityState& pdu, nanoseconds now) {
    Inbound update;
    update.entity = pdu.entity_id;
    update.has_state = true;
    update.state = pdu;
    remote_.take(update, {now, hours(1) + now, now, 0, {}}, {});
  }
  void hear(nanoseconds sender, nanoseconds now) { hear(state(sender), now); }

  const RemoteEntity& row() {
    const RemoteEntity* found = remote_.find(kEntity);
    EXPECT_NE(found, nullptr);
    static const RemoteEntity none;
    return found != nullptr ? *found : none;
  }
  std::uint64_t count(std::string_view name) const { return counters_.find(name)->value(); }

  const SceneFile scene_ = test::scene_of(test::kTwoHandsOnAWall);
  const deadreckon::LocalFrame frame_{0.82, 0.145, 430};
  Counters counters_;
  aoim::AreaOfInterestManager aoim_{
      aoim_config(scene_),
      presence(scene_, frame_, GroupPool::ipv4_default(), {{1, 2}, "LISTENER", 11, 12, true})};
  RemoteEntities remote_{frame_, aoim_, {0.01, {}, {}}, counters_};
};

TEST_F(HardCases, AnHourOfSilenceIsExtrapolatedToTheTimeOutAndHeld) {
  hear(seconds(1), seconds(100));
  const Eigen::Vector3d start = row().predicted(row().state_time).position;
  const Eigen::Vector3d end = row().predicted(row().state_time + seconds(12)).position;
  EXPECT_NEAR((end - start).norm(), 120, 1e-6);
  for (const nanoseconds silence : {nanoseconds(seconds(13)), nanoseconds(hours(1))}) {
    EXPECT_EQ(row().predicted(row().state_time + silence).position, end);
    EXPECT_EQ(row().shown(row().state_time + silence).position, end);
    EXPECT_TRUE(row().shown(row().state_time + silence).velocity.isZero(0));
  }
  remote_.expire(seconds(100) + hours(1));
  EXPECT_TRUE(remote_.rows().empty());
}

TEST_F(HardCases, DoublesAndLateUpdatesChangeNothingAndAreCounted) {
  hear(seconds(1), seconds(100));
  hear(seconds(2), seconds(101));
  const deadreckon::Pose before = row().shown(seconds(101));
  hear(seconds(2), milliseconds(101'010));
  hear(milliseconds(1'500), milliseconds(101'020));
  hear(seconds(1), milliseconds(101'030));
  EXPECT_EQ(count("stale_in"), 3u);
  EXPECT_EQ(count("updates_in"), 2u);
  EXPECT_EQ(row().shown(seconds(101)).position, before.position);
  EXPECT_EQ(row().shown(seconds(101)).velocity, before.velocity);
}

TEST_F(HardCases, TheOrderOfUpdatesHoldsAcrossTheHour) {
  hear(hours(1) - milliseconds(50), seconds(100));
  const nanoseconds first = row().state_time;
  hear(hours(1) + milliseconds(50), milliseconds(100'100));
  EXPECT_LE(std::abs((row().state_time - first - milliseconds(100)).count()), 2'000);
  hear(hours(1) - milliseconds(20), milliseconds(100'110));  // overtaken
  EXPECT_EQ(count("updates_in"), 2u);
  EXPECT_EQ(count("stale_in"), 1u);
  // One that moves as told is shown where it is, before and after.
  EXPECT_LE(row().jump_m, 1e-4);
}

TEST_F(HardCases, AnUpdateThatIsNotANumberLeavesTheRowAsItWas) {
  hear(seconds(1), seconds(100));
  const deadreckon::Pose before = row().shown(seconds(102));
  for (const float bad :
       {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
    pdu::EntityState broken = state(seconds(2));
    broken.linear_velocity.y = bad;
    hear(broken, seconds(101));
    broken = state(seconds(2));
    broken.location.z = static_cast<double>(bad);
    hear(broken, seconds(101));
    broken = state(seconds(2));
    broken.orientation.theta = bad;
    hear(broken, seconds(101));
  }
  EXPECT_EQ(count("values_refused"), 6u);
  EXPECT_EQ(count("updates_in"), 1u);
  EXPECT_EQ(row().shown(seconds(102)).position, before.position);
}

TEST_F(HardCases, AFifthOfAHertzWithOneLossInARowIsKeptAndShownWithoutAStep) {
  nanoseconds now = seconds(100);
  hear(now, now);
  for (int i = 1; i < 100; ++i) {
    now += seconds(5);
    remote_.expire(now);
    ASSERT_EQ(remote_.rows().size(), 1u) << i;
    if (i % 3 == 0) continue;  // lost
    const deadreckon::Pose before = row().shown(now);
    pdu::EntityState update = state(now);
    update.location.y += i % 2;  // a metre off, every other time
    hear(update, now);
    ASSERT_LE((row().shown(now).position - before.position).norm(), 1e-8) << i;
    ASSERT_TRUE(deadreckon::is_finite(row().shown(now + milliseconds(50))));
  }
  EXPECT_EQ(count("timed_out"), 0u);
  remote_.expire(row().last_heard + milliseconds(12'001));  // two in a row
  EXPECT_EQ(count("timed_out"), 1u);
}

}  // namespace
}  // namespace reckon::peer
