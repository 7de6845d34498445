// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// What other peers see of owned bodies: at rest, at a knock, as they join, frozen, far away.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "reckon/tests/integration/owners_exercise.hpp"

namespace reckon::test {
namespace {

using testing::Contains;
using testing::HasSubstr;

constexpr double kThreshold = 0.0005;  // [m], of a scene without its own

haptics::BodyOrder placed(std::uint32_t body, const Eigen::Vector3d& position,
                          const Eigen::Vector3d& velocity = Eigen::Vector3d::Zero()) {
  haptics::BodyOrder order{haptics::BodyAct::place, body};
  order.state.position = position;
  order.state.velocity = velocity;
  return order;
}

double apart(OwnersExercise& exercise, std::size_t viewer, std::size_t owner, std::size_t body) {
  return (exercise.shown(viewer, body).position - exercise.body(owner, body).position).norm();
}

// Ten cubes slide, hit each other and change owner; then all rest.
TEST(OwnedBodies, RestWithinATenthOfAMillimetre) {
  OwnersExercise exercise(3, cubes_scene(10));
  exercise.network().impair(line_of(milliseconds(50), milliseconds(50), 0.3));
  exercise.start_all();
  exercise.run(4000);
  for (std::uint32_t body = 0; body < 10; body += 2) {
    const Eigen::Vector3d at(0.1 * body, 0, 0.02);
    ASSERT_TRUE(exercise.owners(0).order(placed(body, at, {1.0, 0.1, 0})));
    exercise.owners(body % 4 == 0 ? 1 : 2).acquire(body);
  }
  const auto moves = [&] {
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t body = 0; body < 10; ++body) {
        const haptics::BodyState& state = exercise.body(i, body);
        if (!state.carried && state.velocity.norm() > 1e-4) return true;
      }
    }
    return false;
  };
  exercise.run(500);
  ASSERT_LT(exercise.run_until([&] { return !moves(); }, 5000), 5000u);
  exercise.run(1000);
  for (std::size_t body = 0; body < 10; ++body) {
    ASSERT_EQ(exercise.simulating(body), 1u);
    std::size_t owner = 0;
    while (!exercise.simulates(owner, body)) ++owner;
    for (std::size_t i = 0; i < 3; ++i) EXPECT_LT(apart(exercise, i, owner, body), 1e-4) << body;
  }
}

// A cube slides against another, without friction: both are shown late by the delay, and no
// more.
TEST(OwnedBodies, AreShownRightAtAKnock) {
  for (const int delay : {0, 1, 20, 50}) {
    const std::string scene =
        with(cubes_scene(2), "plane = [0, 0, 1]", "plane = [0, 0, 1]\nbody_friction = 0.0");
    OwnersExercise exercise(2, scene);
    exercise.network().impair(line_of(milliseconds(delay), {}, 0.0));
    exercise.start_all();
    exercise.run(3000);
    ASSERT_TRUE(exercise.owners(0).order(placed(0, {-0.45, 0, 0.02}, {1.0, 0, 0})));
    exercise.run(400);
    double worst = 0.0, later = 0.0, knock = 0.0, last = exercise.body(0, 1).velocity.norm();
    int since = -1000;
    for (int t = 0; t < 400; ++t) {
      exercise.step();
      const double change = std::abs(exercise.body(0, 1).velocity.norm() - last);
      last = exercise.body(0, 1).velocity.norm();
      if (change > 0.1) knock = change, since = t;
      for (std::size_t body = 0; body < 2; ++body) {
        const double off = apart(exercise, 1, 0, body);
        worst = std::max(worst, off);
        if (since >= 0 && t > since + 100 + 2 * delay) later = std::max(later, off);
      }
    }
    ASSERT_GT(knock, 0.25) << "they met";
    EXPECT_LE(worst, 2.2 * kThreshold + knock * 1e-3 * (delay + 2)) << delay;
    EXPECT_LE(later, 2.2 * kThreshold) << delay;
  }
}

TEST(OwnedBodies, AreKnownToALateJoiner) {
  for (const std::uint8_t number : {std::uint8_t{0}, std::uint8_t{3}}) {
    OwnersExercise exercise(3, cubes_scene(3));
    exercise.network().impair(line_of(milliseconds(20), {}, 0.0));
    exercise.start(0, 1);
    exercise.start(1, 2);
    exercise.run(3000);
    ASSERT_TRUE(exercise.owners(0).order(placed(1, {0.2, 0.2, 0.02})));
    exercise.run(50);
    exercise.owners(1).acquire(1);
    exercise.run(2000);
    exercise.start(2, number);
    const auto knows = [&] {
      const bool names =
          exercise.owner(2, 0) == exercise.epoch(0) && exercise.owner(2, 1) == exercise.epoch(1);
      return names && apart(exercise, 2, 1, 1) < 1e-3 && apart(exercise, 2, 0, 2) < 1e-3;
    };
    EXPECT_LE(exercise.run_until(knows, 3000), 200u + 40u) << int{number};
    // It follows a change that it did not ask for.
    exercise.owners(1).divest(1);
    exercise.owners(0).acquire(1);
    exercise.run(3000);
    EXPECT_TRUE(exercise.simulates(0, 1));
    EXPECT_EQ(exercise.owner(2, 1), exercise.epoch(0));
    EXPECT_LT(apart(exercise, 2, 0, 1), 1e-3);
  }
}

// A viewer has no vote, so it is no reason to rest.
TEST(OwnedBodies, DoNotNeedTheirViewers) {
  OwnersExercise exercise(3, cubes_scene(1));
  exercise.start(0, 1);
  exercise.start(1, 0);
  exercise.start(2, 0);
  exercise.run(3000);
  EXPECT_EQ(exercise.owners(0).protocol().acts().decided().roll.size(), 1u);
  exercise.kill(1);
  exercise.kill(2);
  exercise.run(4000);
  EXPECT_TRUE(exercise.simulates(0, 0));
  OwnersExercise watched(2, cubes_scene(1));
  watched.start(0, 1);
  watched.start(1, 0);
  watched.run(3000);
  watched.kill(0);
  watched.run(10'000);
  EXPECT_FALSE(watched.simulates(1, 0));
  watched.owners(1).acquire(0);
  watched.run(3000);
  EXPECT_FALSE(watched.simulates(1, 0)) << "a viewer never owns";
}

// Beyond the radius of interest of the others, a body keeps its owner. It is adopted where it was
// received last.
TEST(OwnedBodies, StayWithTheirOwnerFarAway) {
  OwnersExercise exercise(3, cubes_scene(2));
  exercise.start_all();
  exercise.run(3000);
  for (int step = 0; step < 500; ++step) {
    const double x = 0.1 + 0.01 * step;
    ASSERT_TRUE(exercise.owners(0).order(placed(1, {x, 0, 0.02}, {2.5, 0, 0})));
    exercise.run(4);
  }
  exercise.run(3000);
  EXPECT_EQ(exercise.peer(1).model().remote().find(peer::body_id(1)), nullptr);
  EXPECT_EQ(exercise.owner(1, 1), exercise.epoch(0));
  exercise.kill(0);
  exercise.run(5000);
  const std::size_t heir = exercise.simulates(1, 1) ? 1 : 2;
  ASSERT_TRUE(exercise.simulates(heir, 1));
  EXPECT_GT(exercise.body(heir, 1).position.x(), 1.9);
}

// The owner stops 30 ms after it throws one body and slides another. They come to rest at the other
// peers, and stay visible until they are adopted.
TEST(OwnedBodies, StayInSightWhenTheirOwnerFails) {
  OwnersExercise exercise(3, cubes_scene(2));
  exercise.start_all();
  exercise.run(3000);
  ASSERT_TRUE(exercise.owners(0).order(placed(0, {0, 0, 0.1}, {2, 0, 3})));
  ASSERT_TRUE(exercise.owners(0).order(placed(1, {0.1, 0, 0.02}, {0, 3, 0})));
  exercise.run(30);
  exercise.stop(0);
  const auto is_adopted = [&](std::size_t body) {
    return exercise.simulates(1, body) || exercise.simulates(2, body);
  };
  for (int t = 0; t < 5000; ++t) {
    exercise.step();
    for (std::size_t body = 0; body < 2; ++body) {
      if (is_adopted(body)) continue;
      const peer::RemoteEntity* row = exercise.peer(2).model().remote().find(peer::body_id(body));
      ASSERT_NE(row, nullptr) << body << " after " << t << " ms";
      if (t < 1700) continue;
      EXPECT_EQ(row->shown(exercise.now()).velocity.norm(), 0.0) << body << " after " << t << " ms";
    }
  }
  EXPECT_TRUE(is_adopted(0));
  EXPECT_TRUE(is_adopted(1));
}

// A listener without Reckon's rules sees one entity that goes on, now from another sender.
TEST(OwnedBodies, ArriveAtPlainDisWithoutAGap) {
  OwnersExercise exercise(3, cubes_scene(1));
  exercise.network().impair(line_of(milliseconds(20), {}, 0.0));
  exercise.start(0, 1);
  exercise.start(1, 2);
  peer::Link& listener = exercise.network().link(2);
  const peer::GroupPool pool = peer::pool_of(exercise.scene());
  static_cast<void>(listener.join(pool.base()));
  for (std::size_t i = 0; i < pool.size(); ++i) static_cast<void>(listener.join(pool.address(i)));
  exercise.run(3000);
  ASSERT_TRUE(exercise.owners(0).order(placed(0, {0, 0, 0.1}, {0.3, 0, 6.0})));
  exercise.run(100);
  exercise.owners(1).acquire(0);
  std::size_t senders = 0;
  nanoseconds last = exercise.now(), gap{0};
  peer::IpEndpoint sender{};
  std::array<peer::Datagram, 64> datagrams;
  for (int t = 0; t < 500; ++t) {
    exercise.step();
    for (const auto& datagram : std::span(datagrams).first(listener.receive(datagrams))) {
      for (const pdu::BundledPdu& pdu : pdu::BundleReader(datagram.bytes)) {
        pdu::EntityState state;
        const bool is_cube = pdu::decode(pdu.bytes, state) == pdu::DecodeError::none &&
                             state.entity_id == peer::body_id(0);
        if (!is_cube) continue;
        senders += datagram.sender == sender ? 0 : 1;
        sender = datagram.sender;
        gap = std::max(gap, exercise.now() - last);
        last = exercise.now();
      }
    }
  }
  EXPECT_TRUE(exercise.simulates(1, 0));
  EXPECT_EQ(senders, 2u) << "the first owner, then the second one";
  EXPECT_LE(gap, milliseconds(210)) << "a repetition of an unchanged motion";
}

TEST(OwnedBodies, ExcludeWhatATimeFunctionMoves) {
  const std::string scene = cubes_scene(1) + R"(
[[node]]
name = "table"
turn_rate = "1 rad/s"
[[object]]
name = "lever"
node = "table"
box = "40 40 40 mm"
position = "0.5 0 0.5"
surface = {stiffness = "400 N/m"}
)";
  OwnersExercise exercise(2, scene);
  exercise.start_all();
  exercise.run(3000);
  EXPECT_TRUE(exercise.simulates(0, 0));
  exercise.owners(1).acquire(1);
  exercise.run(2000);
  EXPECT_EQ(exercise.simulating(1), 0u);
  EXPECT_FALSE(exercise.owners(1).owns(1));
  EXPECT_EQ(exercise.peer(1).model().remote().find(peer::body_id(1)), nullptr) << "it is not sent";
}

TEST(OwnedBodies, ChangeOwnerWhileFrozen) {
  OwnersExercise exercise(2, cubes_scene(1, 0.5, "allow_management = \"anyone\""));
  exercise.start_all();
  exercise.run(3000);
  ASSERT_TRUE(exercise.owners(0).order(placed(0, {0, 0, 0.5})));
  exercise.run(20);
  for (std::size_t i = 0; i < 2; ++i) exercise.peer(i).model().find_own(1)->set_frozen(true);
  exercise.run(50);
  const double height = exercise.body(0, 0).position.z();
  ASSERT_GT(height, 0.4);
  exercise.owners(1).acquire(0);
  exercise.run(500);
  ASSERT_TRUE(exercise.simulates(1, 0));
  EXPECT_NEAR(exercise.body(1, 0).position.z(), height, 1e-3);
  for (std::size_t i = 0; i < 2; ++i) exercise.peer(i).model().find_own(1)->set_frozen(false);
  exercise.run(1000);
  EXPECT_NEAR(exercise.body(1, 0).position.z(), 0.02, 1e-3);
}

}  // namespace
}  // namespace reckon::test
