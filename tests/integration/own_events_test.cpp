// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// When the owner sends an update at once, and with which model.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "reckon/deadreckon/motion/drm.hpp"
#include "reckon/pdu/management/start_resume.hpp"
#include "reckon/pdu/management/stop_freeze.hpp"
#include "reckon/pdu/seconds.hpp"
#include "reckon/pdu/timestamp.hpp"
#include "reckon/peer/scene/scene_words.hpp"
#include "reckon/peer/world/hand_port.hpp"
#include "reckon/tests/support/in_process.hpp"

namespace reckon::test {
namespace {

using deadreckon::SendReason;
using Algorithm = pdu::DeadReckoningAlgorithm;
using Eigen::Vector3d;

constexpr double kTeleport = 0.5;  // [m]

peer::EntityDescription hand_of(const peer::DeadReckoningConfig& config) {
  peer::EntityDescription hand;
  hand.marking = "HAND";
  hand.type = peer::hand_type();
  hand.dead_reckoning = config;
  hand.model = peer::to_force_model({});
  return hand;
}

// A hand whose servo snapshots the test makes, 2 ms apart, and its last update.
class Owner {
 public:
  explicit Owner(const peer::DeadReckoningConfig& config = {})
      : frame_(0.8, 0.1, 400),
        hand_(frame_, hand_of(config), {1, 1, 1}, 1, kTeleport),
        port_(snapshots_, contacts_, 1) {}

  SendReason step(const Vector3d& place, const Vector3d& velocity = Vector3d::Zero(),
                  const Vector3d& acceleration = Vector3d::Zero(),
                  std::span<const deadreckon::ProbeState> probes = {}) {
    servo_.time += milliseconds(2);
    ++servo_.step;
    servo_.device = servo_.scp = place;
    servo_.velocity = velocity;
    servo_.acceleration = acceleration;
    snapshots_.write_slot() = servo_;
    snapshots_.publish();
    EXPECT_TRUE(port_.update());
    port_.tell(hand_);
    const SendReason reason = hand_.decide(servo_.time, probes);
    if (reason != SendReason::none) {
      EXPECT_TRUE(hand_.build(servo_.time, std::chrono::hours(1) + servo_.time, reason,
                              port_.accounts(), update_));
      ++sent_[static_cast<std::size_t>(reason)];
    }
    return reason;
  }
  void touch(bool touching) {
    servo_.count = touching ? 1 : 0;
    servo_.contacts[0].ungated_force = {touching ? 1.0 : 0.0, 0, 0};
  }
  // The algorithm of the last update.
  [[nodiscard]] Algorithm algorithm() const { return update_.state.dead_reckoning.algorithm; }
  // The speed in the last update [m/s].
  [[nodiscard]] double speed() const {
    const auto& v = update_.state.linear_velocity;
    return std::hypot(v.x, v.y, v.z);
  }
  [[nodiscard]] int sent(SendReason reason) const {
    return sent_[static_cast<std::size_t>(reason)];
  }
  [[nodiscard]] int sent() const {
    int sum = 0;
    for (const int count : sent_) sum += count;
    return sum;
  }
  [[nodiscard]] peer::OwnedEntity& hand() { return hand_; }

 private:
  deadreckon::LocalFrame frame_;
  haptics::TripleBuffer<haptics::ServoSnapshot> snapshots_;
  haptics::TripleBuffer<haptics::ContactSet> contacts_;
  peer::OwnedEntity hand_;
  peer::HandPort port_;
  haptics::ServoSnapshot servo_;
  peer::EntityUpdate update_;
  std::array<int, 7> sent_{};
};

TEST(OwnEvents, TeleportedHandIsAnEvent) {
  Owner owner;
  EXPECT_EQ(owner.step({0.1, 0, 0}), SendReason::first);
  EXPECT_EQ(owner.step({0.1, 0, 0}), SendReason::none);
  EXPECT_EQ(owner.step({0.1 + kTeleport + 0.01, 0, 0}), SendReason::event);
  EXPECT_EQ(owner.step({0.1 + kTeleport + 0.01, 0, 0}), SendReason::none);
  // A shorter displacement is an ordinary position error.
  EXPECT_EQ(owner.step({0.1 + 0.02, 0, 0}), SendReason::position);
}

TEST(OwnEvents, MakeAndBreakOfATouchAreEvents) {
  Owner owner;
  EXPECT_EQ(owner.step({0, 0, 0}), SendReason::first);
  owner.touch(true);
  EXPECT_EQ(owner.step({0, 0, 0}), SendReason::event);
  EXPECT_EQ(owner.step({0, 0, 0}), SendReason::none);
  owner.touch(false);
  EXPECT_EQ(owner.step({0, 0, 0}), SendReason::event);
}

// The motion into a touch ends with it: extrapolated, the hand would move through the body.
TEST(OwnEvents, TouchIsSentAtRestItsEndMoving) {
  Owner owner;
  for (int i = 0; i < 100; ++i) owner.step({0.001 * i, 0, 0}, {0.5, 0, 0});
  EXPECT_NEAR(owner.speed(), 0.5, 1e-6);
  owner.touch(true);
  EXPECT_EQ(owner.step({0.1, 0, 0}, {0.5, 0, 0}), SendReason::event);
  EXPECT_LT(owner.speed(), 0.05);
  for (int i = 1; i < 200; ++i) owner.step({0.1 + 0.001 * i, 0, 0}, {0.5, 0, 0});
  EXPECT_NEAR(owner.speed(), 0.5, 0.1) << "a slow part that lasts is told";
  owner.touch(false);
  EXPECT_EQ(owner.step({0.3, 0, 0}, {0.5, 0, 0}), SendReason::event);
  EXPECT_NEAR(owner.speed(), 0.5, 1e-6);
}

TEST(OwnEvents, ChangesOfAppearanceAndNameAreEvents) {
  Owner owner;
  EXPECT_EQ(owner.step({0, 0, 0}), SendReason::first);
  owner.hand().set_frozen(true);
  EXPECT_EQ(owner.step({0, 0, 0}), SendReason::event);
  owner.hand().set_frozen(false);
  EXPECT_EQ(owner.step({0, 0, 0}), SendReason::event);
  owner.hand().rename({1, 2, 1});
  EXPECT_EQ(owner.step({0, 0, 0}), SendReason::event);
  owner.hand().set_deactivated();
  EXPECT_EQ(owner.step({0, 0, 0}), SendReason::event);
  EXPECT_EQ(owner.step({0, 0, 0}), SendReason::none);
}

// --- the model that the owner chooses

// A hand on a parabola: back and forth, half a second each way, 4 m/s^2.
int updates_on_parabolas(Owner& owner, int steps) {
  for (int i = 0; i < steps; ++i) {
    const double t = 0.002 * i;
    const double phase = std::fmod(t, 1.0);
    const double sign = phase < 0.5 ? 1 : -1;
    const double u = std::fmod(phase, 0.5);
    owner.step({sign * (u - 2 * u * u), 0, 0}, {sign * (1 - 4 * u), 0, 0}, {-4 * sign, 0, 0});
  }
  return owner.sent();
}

TEST(OwnModel, FollowsTheMotionUnlessTheSceneNamesOne) {
  Owner straight;
  for (int i = 0; i < 2000; ++i) straight.step({0.0004 * i, 0, 0}, {0.2, 0, 0});
  EXPECT_EQ(straight.algorithm(), Algorithm::fpw);

  Owner thrown;
  const int chosen = updates_on_parabolas(thrown, 10'000);
  EXPECT_TRUE(deadreckon::drm_terms(thrown.algorithm()).acceleration);
  for (const Algorithm named : {Algorithm::fpw, Algorithm::rvw}) {
    peer::DeadReckoningConfig config;
    config.algorithm = named;
    Owner owner(config);
    const int updates = updates_on_parabolas(owner, 10'000);
    EXPECT_EQ(owner.algorithm(), named);
    std::printf("parabolas for 20 s: %d updates by the chosen model, %d by %s\n", chosen, updates,
                std::string(peer::word_of(config.algorithm)).c_str());
    EXPECT_LE(chosen, updates + 10);  // the cost of the first choices
  }
}

// --- rules

TEST(OwnRules, JudgeThePositionAsConfigured) {
  const auto reason_at = [](const peer::DeadReckoningConfig& config, const Vector3d& error) {
    Owner owner(config);
    owner.step({0, 0, 0});
    return owner.step(error, {1, 0, 0});
  };
  peer::DeadReckoningConfig config;
  config.algorithm = Algorithm::fpw;
  config.thresholds.position = 0.01;
  const Vector3d corner(0.008, 0.008, 0);
  EXPECT_EQ(reason_at(config, corner), SendReason::position);
  config.rule = &deadreckon::kSendRules[1];
  EXPECT_EQ(config.rule->name, "per_axis");
  EXPECT_EQ(reason_at(config, corner), SendReason::none);
  config.rule = &deadreckon::kSendRules[2];
  EXPECT_EQ(config.rule->name, "velocity_aware");
  config.thresholds.of<deadreckon::VelocityAware>().speed_allowance = 0.05;  // 50 mm at 1 m/s
  EXPECT_EQ(reason_at(config, {0.059, 0, 0}), SendReason::none);
  EXPECT_EQ(reason_at(config, {0.061, 0, 0}), SendReason::position);
  config.rule = &deadreckon::kSendRules[3];
  EXPECT_EQ(config.rule->name, "seen_from");
  config.thresholds.of<deadreckon::SeenFrom>().viewer_distance =
      100;  // one minute of arc is 29 mm there
  EXPECT_EQ(reason_at(config, {0.029, 0, 0}), SendReason::none);
  EXPECT_EQ(reason_at(config, {0.0295, 0, 0}), SendReason::position);
}

// A probe 5 mm deep in a hand of 475 N/m feels 2.4 N; 10 % of that is 0.24 N, 0.5 mm.
TEST(OwnRules, PermitForceErrorByShareAtEachContact) {
  const auto reason_at = [](double share, double error,
                            std::span<const deadreckon::ProbeState> probes) {
    peer::DeadReckoningConfig config;
    config.algorithm = Algorithm::fpw;
    config.thresholds = {0.1, 1.0, 0.03};
    config.thresholds.weber = share;
    Owner owner(config);
    owner.step({0, 0, 0}, Vector3d::Zero(), Vector3d::Zero(), probes);
    return owner.step({0, 0, error}, Vector3d::Zero(), Vector3d::Zero(), probes);
  };
  const deadreckon::ProbeState deep{{0, 0, 0.025}, Vector3d::Zero(), 0.01};
  const std::array<deadreckon::ProbeState, 1> one{deep};
  EXPECT_EQ(reason_at(0, 0.0001, one), SendReason::force);    // 48 mN > 30 mN
  EXPECT_EQ(reason_at(0.1, 0.0001, one), SendReason::none);   // of 2.42 N
  EXPECT_EQ(reason_at(0.1, 0.0005, one), SendReason::none);   // 0.24 N of 2.6 N
  EXPECT_EQ(reason_at(0.1, 0.0006, one), SendReason::force);  // 0.28 N of 2.66 N
  // A weak contact has no share in the large force of another.
  const deadreckon::ProbeState grazing{{0, 0, -0.0299}, Vector3d::Zero(), 0.01};
  const std::array<deadreckon::ProbeState, 2> both{deep, grazing};
  EXPECT_EQ(reason_at(0.1, 0.0005, both), SendReason::force);
}

// --- through whole peers: events do not wait in bundles

std::string with_hold(std::string_view hold) {
  return std::string(kTwoHandsOnAWall) + "\n[network.bundle]\nhold = \"" + std::string(hold) +
         "\"\n";
}

// Ages of a peer's states when the listener received them [ms], frozen ones and others.
struct Ages {
  std::vector<double> frozen, moving;
};

Ages ages_of(InProcess& world, const pdu::EntityId& id) {
  Ages ages;
  for (const Heard& datagram : world.heard()) {
    for (const pdu::BundledPdu& pdu : pdu::BundleReader(datagram.octets)) {
      pdu::EntityState state;
      if (pdu.header.pdu_type != pdu::PduType::entity_state ||
          pdu::decode(pdu.bytes, state) != pdu::DecodeError::none || state.entity_id != id) {
        continue;
      }
      const nanoseconds utc = world.clock().utc_now() - (world.clock().now() - datagram.time);
      const auto units =
          pdu::difference_units(pdu::to_dis_timestamp(utc, true), state.header.timestamp);
      const double ms = 3.6e6 * static_cast<double>(units) / pdu::kTimestampUnitsPerHour;
      ((state.appearance & pdu::kAppearanceFrozen) != 0 ? ages.frozen : ages.moving).push_back(ms);
    }
  }
  return ages;
}

double largest(const std::vector<double>& values) {
  return values.empty() ? -1 : *std::max_element(values.begin(), values.end());
}

TEST(EventsAtOnce, LeaveWhilePosesWaitForCompany) {
  // Only the first hand, which moves back and forth with no other near.
  const peer::SceneFile scene = managed_by("anyone", scene_of(with_hold("300 ms")));
  InProcess world(1);
  world.listen(scene);
  world.start(0, scene);
  world.run(4000);
  pdu::StopFreeze order;
  order.header.exercise_id = scene.network.exercise;
  order.originating_entity_id = {9, 9, 0};
  order.receiving_entity_id = world.peer(0).own_id();
  world.say(order, scene);
  world.run(1000);
  const Ages ages = ages_of(world, world.peer(0).own_id());
  ASSERT_GT(ages.moving.size(), 10U);
  ASSERT_GE(ages.frozen.size(), 1U);
  EXPECT_GT(largest(ages.moving), 100);  // the hold time is kept
  EXPECT_LE(ages.frozen.front(), 4);     // but not for a change of appearance
  EXPECT_GT(world.count(0, "sent_event"), 0U);
}

TEST(EventsAtOnce, NothingWaitsByDefaultOrNearAHand) {
  for (const char* hold : {"0 ms", "300 ms"}) {
    SCOPED_TRACE(hold);
    const peer::SceneFile scene = scene_of(with_hold(hold));
    InProcess world(2);
    world.listen(scene);
    world.start(0, scene);
    world.start(1, scene);
    world.run(1000);
    world.heard().clear();
    world.run(5000);  // the hands are never farther apart than the contact range
    const Ages ages = ages_of(world, world.peer(0).own_id());
    ASSERT_GT(ages.moving.size(), 20U);
    EXPECT_LE(largest(ages.moving), 4);
  }
}

TEST(EventsAtOnce, AreShownAtOnceByTheOthers) {
  const peer::SceneFile scene = managed_by("anyone", scene_of(kTwoHandsOnAWall));
  InProcess world(2);
  world.listen(scene);
  world.start(0, scene);
  world.start(1, scene);
  world.run(1100);
  pdu::StopFreeze order;
  order.header.exercise_id = scene.network.exercise;
  order.originating_entity_id = {9, 9, 0};
  order.receiving_entity_id = world.peer(0).own_id();
  world.say(order, scene);
  world.run(10);
  EXPECT_EQ(world.count(1, "snaps"), 1U);
  const auto place = [&] {
    return world.peer(1).model().remote().rows()[0].shown(world.clock().now()).position;
  };
  const Vector3d at_once = place();
  world.run(500);
  EXPECT_LE((place() - at_once).norm(), 1e-12);
}

TEST(SendCounters, CountDecisionsUpdatesAndOctets) {
  const peer::SceneFile scene = scene_of(kTwoHandsOnAWall);
  InProcess world(2);
  world.start(0, scene);
  world.start(1, scene);
  world.run(10'000);
  EXPECT_NEAR(static_cast<double>(world.count(0, "send_checks")), 5000, 5);  // one per model step
  std::uint64_t updates = 0;
  for (const char* reason : {"first", "event", "position", "orientation", "force", "heartbeat"}) {
    updates += world.count(0, std::string("sent_") + reason);
  }
  const std::uint64_t octets = world.count(0, "own_octets");
  EXPECT_EQ(world.count(0, "updates_out"), updates);
  EXPECT_GT(updates, 50U);
  EXPECT_LT(updates, 1000U);
  EXPECT_GE(octets, updates * (144 + 72));
  EXPECT_LE(octets, updates * (144 + 72 + 24));     // with one account
  EXPECT_LE(octets, world.count(0, "octets_out"));  // bundles add headers and trailers
}

}  // namespace
}  // namespace reckon::test
