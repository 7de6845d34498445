// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Hard cases of dead reckoning in a peer's table of remote entities. The others are in
// tests/deadreckon/hard_cases_test.cpp.
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

// The table of a peer, and a sender of relative time whose clock the test sets.
struct Listener {
  Listener() {
    const std::array<aoim::Focus, 1> everywhere{{{{0, 0, 0}, 0.0, 1e6}}};
    static_cast<void>(manager.listen(aoim::kCellTier, everywhere, nanoseconds(0)));
  }

  // A state that moves at 10 m/s along the geocentric x axis, from the scene's origin at sender
  // time 0.
  pdu::EntityState state(nanoseconds sender) const {
    pdu::EntityState pdu;
    pdu.header.timestamp = pdu::to_dis_timestamp(sender, false);
    pdu.entity_id = kEntity;
    pdu.entity_type.kind = pdu::EntityKind::platform;
    pdu.entity_type.domain = pdu::EntityDomain::air;  // heartbeat 5 s, time-out 12 s
    const Eigen::Vector3d& origin = frame.origin();
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
    remote.take(update, {now, hours(1) + now, now, 0, {}}, {});
  }
  void hear(nanoseconds sender, nanoseconds now) { hear(state(sender), now); }

  const RemoteEntity& row() {
    const RemoteEntity* found = remote.find(kEntity);
    EXPECT_NE(found, nullptr);
    static const RemoteEntity none;
    return found != nullptr ? *found : none;
  }
  std::uint64_t count(std::string_view name) const { return counters.find(name)->value(); }

  const SceneFile scene = test::scene_of(test::kTwoHandsOnAWall);
  const deadreckon::LocalFrame frame{0.82, 0.145, 430};
  Counters counters;
  aoim::AreaOfInterestManager manager{
      aoim_config(scene),
      presence(scene, frame, GroupPool::ipv4_default(), {{1, 2}, "LISTENER", 11, 12, true})};
  RemoteEntities remote{frame, manager, {0.01, {}, {}}, counters};
};

class HardCases : public testing::Test, protected Listener {};

TEST_F(HardCases, ExtrapolationStopsAtTheTimeOut) {
  hear(seconds(1), seconds(100));
  const Eigen::Vector3d start = row().predicted(row().state_time).position;
  const Eigen::Vector3d end = row().predicted(row().state_time + seconds(12)).position;
  EXPECT_NEAR((end - start).norm(), 120, 1e-6);
  for (const nanoseconds silence : {nanoseconds(seconds(13)), nanoseconds(hours(1))}) {
    EXPECT_EQ(row().predicted(row().state_time + silence).position, end);
    EXPECT_EQ(row().shown(row().state_time + silence).position, end);
    EXPECT_TRUE(row().shown(row().state_time + silence).velocity.isZero(0));
  }
  remote.expire(seconds(100) + hours(1));
  EXPECT_TRUE(remote.rows().empty());
}

TEST_F(HardCases, DuplicateAndLateUpdatesAreOnlyCounted) {
  hear(seconds(1), seconds(100));
  hear(seconds(2), seconds(101));
  const deadreckon::Pose before = row().shown(seconds(101));
  hear(seconds(2), milliseconds(101'010));
  hear(milliseconds(1'500), milliseconds(101'020));
  hear(seconds(1), milliseconds(101'030));
  EXPECT_EQ(count("repeats_in"), 1u);
  EXPECT_EQ(count("stale_in"), 2u);
  EXPECT_EQ(count("updates_in"), 2u);
  EXPECT_EQ(row().shown(seconds(101)).position, before.position);
  EXPECT_EQ(row().shown(seconds(101)).velocity, before.velocity);
}

// A tool that repeats its last packet as a heartbeat. Its clock has not leapt.
TEST_F(HardCases, RepeatKeepsTheEntityAndIsNoLeap) {
  for (const bool absolute : {false, true}) {
    for (const auto gap : {milliseconds(100), milliseconds(250), milliseconds(1000),
                           milliseconds(5000), milliseconds(11'000)}) {
      SCOPED_TRACE(testing::Message() << absolute << ' ' << gap.count() << " ms");
      Listener listener;
      nanoseconds now = seconds(100);
      pdu::EntityState once = listener.state(seconds(1));
      once.linear_velocity = {};
      once.header.timestamp =
          pdu::to_dis_timestamp(absolute ? hours(1) + now : nanoseconds(seconds(1)), absolute);
      listener.hear(once, now);
      const nanoseconds time = listener.row().state_time;
      const deadreckon::Pose pose = listener.row().shown(now);
      for (int i = 0; i < 400; ++i) {
        now += gap;
        listener.remote.expire(now);
        ASSERT_EQ(listener.remote.rows().size(), 1u) << i;
        listener.hear(once, now);
        ASSERT_EQ(listener.row().shown(now).position, pose.position) << i;
      }
      EXPECT_EQ(listener.row().state_time, time);
      EXPECT_EQ(listener.count("repeats_in"), 400u);
      EXPECT_EQ(listener.count("updates_in"), 1u);
      EXPECT_EQ(listener.count("sender_leaps"), 0u);
      EXPECT_EQ(listener.count("stale_in"), 0u);
      // It continues after up to 73 minutes.
      now += milliseconds(100);
      const nanoseconds sent = seconds(1) + now - seconds(100);
      pdu::EntityState next = listener.state(sent);
      next.header.timestamp = pdu::to_dis_timestamp(absolute ? hours(1) + now : sent, absolute);
      listener.hear(next, now);
      EXPECT_EQ(listener.count("updates_in"), 2u);
    }
  }
}

// Two entities of one sender; each update of one is sent three times. Both are shown alike.
TEST_F(HardCases, RepeatsBetweenHonestUpdatesChangeNothing) {
  Listener plain, repeated;
  nanoseconds leap{0};
  for (int i = 0; i < 600; ++i) {
    if (i == 300) leap = seconds(-20);  // the sender's clock is set back
    const nanoseconds sent = seconds(30) + i * milliseconds(100);
    pdu::EntityState state = plain.state(sent);
    state.header.timestamp = pdu::to_dis_timestamp(sent + leap, false);
    for (int copy = 0; copy < 3; ++copy) {
      const nanoseconds now = seconds(100) + sent + copy * milliseconds(30);
      if (copy == 0) plain.hear(state, now);
      repeated.hear(state, now);
      ASSERT_EQ(plain.row().shown(now).position, repeated.row().shown(now).position) << i;
      ASSERT_EQ(plain.row().state_time, repeated.row().state_time) << i;
    }
  }
  EXPECT_EQ(plain.count("sender_leaps"), 1u);
  EXPECT_EQ(repeated.count("sender_leaps"), 1u);
  EXPECT_EQ(repeated.count("updates_in"), plain.count("updates_in"));
  EXPECT_GE(repeated.count("repeats_in"), 2 * 595u);
}

// An old state does not become a leap by repetition.
TEST_F(HardCases, CopiesOfAnOldUpdateAreNoLeap) {
  for (const auto gap :
       {milliseconds(10), milliseconds(100), milliseconds(300), milliseconds(2000)}) {
    Listener listener;
    for (int i = 0; i <= 20; ++i) {
      listener.hear(listener.state(seconds(1) + i * milliseconds(100)),
                    seconds(100) + i * milliseconds(100));
    }
    const double x = listener.row().state->position.norm();
    for (int i = 1; i < 200 && gap * i < seconds(11); ++i) {
      listener.hear(listener.state(seconds(1)), seconds(102) + i * gap);
    }
    EXPECT_EQ(listener.row().state->position.norm(), x);
    EXPECT_EQ(listener.count("sender_leaps"), 0u) << gap.count();
  }
}

// A sender without a clock: each packet has the same timestamp. Arrival times are used.
TEST_F(HardCases, StoppedClockIsNoLeap) {
  Listener listener;
  for (int i = 0; i < 300; ++i) {
    pdu::EntityState state = listener.state(i * milliseconds(100));
    state.header.timestamp = 0;
    const nanoseconds now = seconds(100) + i * milliseconds(100);
    listener.hear(state, now);
    ASSERT_LE(listener.row().jump_m, 1e-6) << i;
    ASSERT_EQ(listener.row().state_time, now) << i;
  }
  EXPECT_EQ(listener.count("updates_in"), 300u);
  EXPECT_EQ(listener.count("sender_leaps"), 0u);
}

TEST_F(HardCases, TheOrderOfUpdatesHoldsAcrossTheHour) {
  hear(hours(1) - milliseconds(50), seconds(100));
  const nanoseconds first = row().state_time;
  hear(hours(1) + milliseconds(50), milliseconds(100'100));
  EXPECT_LE(std::abs((row().state_time - first - milliseconds(100)).count()), 2'000);
  hear(hours(1) - milliseconds(20), milliseconds(100'110));  // overtaken
  EXPECT_EQ(count("updates_in"), 2u);
  EXPECT_EQ(count("stale_in"), 1u);
  // An entity that moves as predicted is shown at its true position, before and after.
  EXPECT_LE(row().jump_m, 1e-4);
}

TEST_F(HardCases, NonFiniteUpdatesDoNotChangeTheRow) {
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

TEST_F(HardCases, SlowLossyUpdatesAreShownWithoutAStep) {
  nanoseconds now = seconds(100);
  hear(now, now);
  for (int i = 1; i < 100; ++i) {
    now += seconds(5);
    remote.expire(now);
    ASSERT_EQ(remote.rows().size(), 1u) << i;
    if (i % 3 == 0) continue;  // lost
    const deadreckon::Pose before = row().shown(now);
    pdu::EntityState update = state(now);
    update.location.y += i % 2;  // a metre of error, every other time
    hear(update, now);
    ASSERT_LE((row().shown(now).position - before.position).norm(), 1e-8) << i;
    ASSERT_TRUE(deadreckon::is_finite(row().shown(now + milliseconds(50))));
  }
  EXPECT_EQ(count("timed_out"), 0u);
  remote.expire(row().last_heard + milliseconds(12'001));  // two in a row
  EXPECT_EQ(count("timed_out"), 1u);
}

}  // namespace
}  // namespace reckon::peer
