// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Entities received from outside the radius of interest are shown once they are within, whether
// they or the focus moved.
#include "reckon/peer/world/outside_entities.hpp"

#include <gtest/gtest.h>

#include <array>
#include <map>
#include <random>
#include <string>
#include <vector>

#include "reckon/deadreckon/motion/articulation.hpp"
#include "reckon/pdu/seconds.hpp"
#include "reckon/tests/src/support/incoming_half.hpp"
#include "reckon/tests/support/allocation_guard.hpp"

namespace reckon::peer::outside_entities_test {
namespace {

using deadreckon::KinematicState;
using Eigen::Vector3d;
using std::chrono::nanoseconds;

constexpr pdu::EntityId kTank{7, 8, 9};
constexpr pdu::SimulationAddress kOwner{7, 8};
constexpr double kRadius = 1000;  // [m]

// The incoming half of a peer that receives all cells, with a focus of 1 km that the test moves.
class Receiver {
 public:
  explicit Receiver(std::size_t capacity = 1000)
      : half_("[aoim]\nradius = \"1 km\"\ncell = \"1 km\"\npool = 1\n",
              [capacity](const SceneFile&) {
                RemoteSettings settings;
                settings.capacity = capacity;
                settings.strangers_memory = std::size_t{1} << 30;
                return settings;
              }) {}

  void stand_at(const Vector3d& place, double seconds, double speed = 0) {
    half_.stand_at(place, pdu::from_seconds(seconds), speed);
  }
  void look(double seconds) {
    half_.remote.look_shown(pdu::from_seconds(seconds));
    half_.remote.look_outside(pdu::from_seconds(seconds));
  }

  void hear(const pdu::EntityId& id, const Vector3d& position, const Vector3d& velocity,
            double seconds, std::uint32_t appearance = 0) {
    KinematicState state;
    state.algorithm = pdu::DeadReckoningAlgorithm::fpw;
    state.position = position;
    state.velocity = velocity;
    Inbound update;
    update.has_model = haptic;
    update.model.k1 = 100;
    update.state.entity_type = {pdu::EntityKind::platform, pdu::EntityDomain::land};
    update.state.variable_parameters = parts;
    half_.put_state(update, id, state, pdu::from_seconds(seconds));
    update.state.appearance = appearance;
    half_.take(update, pdu::from_seconds(seconds), 0, from);
  }
  void hear_model_alone(const pdu::EntityId& id, double seconds) {
    Inbound update;
    update.entity = id;
    update.has_model = true;
    update.model.k1 = 100;
    half_.take(update, pdu::from_seconds(seconds));
  }

  [[nodiscard]] const RemoteEntity* find(const pdu::EntityId& id = kTank) {
    return half_.remote.find(id);
  }
  [[nodiscard]] std::uint64_t count(std::string_view name) const { return half_.count(name); }
  RemoteEntities& remote() { return half_.remote; }

  bool haptic = false;
  std::span<const std::byte> parts;
  aoim::SourceAddress from;  // source of received states

 private:
  test::IncomingHalf half_;
};

TEST(OutsideEntities, AreShownOnceWeHaveComeNear) {
  Receiver receiver;
  receiver.hear(kTank, {1500, 0, 0}, {0, 0, 0}, 0.1);
  receiver.look(0.2);
  ASSERT_EQ(receiver.find(), nullptr);
  receiver.stand_at({600, 0, 0}, 1);
  receiver.look(1.3);
  ASSERT_NE(receiver.find(), nullptr);
  EXPECT_NEAR(receiver.find()->shown(pdu::from_seconds(1.3)).position.x(), 1500, 1e-3);
  EXPECT_EQ(receiver.count("entered"), 1u);
}

TEST(OutsideEntities, AreShownAfterTheirOwnMotionBringsThem) {
  Receiver receiver;
  receiver.hear(kTank, {1100, 0, 0}, {-50, 0, 0}, 0);
  for (double t = 0.1; t < 1.95; t += 0.1) {
    receiver.look(t);
    ASSERT_EQ(receiver.find(), nullptr) << t;
  }
  for (double t = 2; t < 2.35; t += 0.1) receiver.look(t);
  ASSERT_NE(receiver.find(), nullptr);
  EXPECT_NEAR(receiver.find()->shown(pdu::from_seconds(4)).position.x(), 900, 1e-3);
}

TEST(OutsideEntities, ReturnWithTheStateOfTheirDeparture) {
  Receiver receiver;
  receiver.hear(kTank, {500, 0, 0}, {0, 0, 0}, 0);
  ASSERT_NE(receiver.find(), nullptr);
  receiver.hear(kTank, {1400, 0, 0}, {0, 0, 0}, 1);
  ASSERT_EQ(receiver.find(), nullptr);
  receiver.stand_at({900, 0, 0}, 2);
  receiver.look(2.2);
  EXPECT_NE(receiver.find(), nullptr);
}

TEST(OutsideEntities, BringTheirForceModelHoweverItCame) {
  for (const bool alone : {false, true}) {
    Receiver receiver;
    receiver.haptic = !alone;
    receiver.hear(kTank, {1500, 0, 0}, {0, 0, 0}, 0);
    receiver.haptic = false;
    if (alone) {
      receiver.hear_model_alone(kTank, 0.1);
    } else {
      receiver.hear(kTank, {1500, 0, 1}, {0, 0, 0}, 0.1);  // a state without the force model
    }
    receiver.stand_at({600, 0, 0}, 1);
    receiver.look(1.3);
    ASSERT_NE(receiver.find(), nullptr);
    EXPECT_TRUE(receiver.find()->haptic);
  }
}

TEST(OutsideEntities, BringTheirArticulatedParts) {
  std::array<std::byte, 16> part{};  // articulated: the azimuth of the first turret, 0
  part[6] = std::byte{0x10};
  part[7] = std::byte{0x0B};
  Receiver receiver;
  receiver.parts = part;
  receiver.hear(kTank, {1500, 0, 0}, {0, 0, 0}, 0);
  receiver.stand_at({600, 0, 0}, 1);
  receiver.look(1.3);
  ASSERT_NE(receiver.find(), nullptr);
  EXPECT_EQ(receiver.remote().with_parts(), 1u);
}

TEST(OutsideEntities, AreForgottenWithOwnerEpochOrDeactivation) {
  for (const int way : {0, 1, 2, 3}) {
    Receiver receiver;
    receiver.hear(kTank, {1500, 0, 0}, {0, 0, 0}, 0);
    if (way == 0) receiver.remote().drop_peer(kOwner, Gone::silent, {});
    if (way == 1) receiver.remote().claim(kOwner, 77);
    if (way == 2) receiver.hear(kTank, {1500, 0, 0}, {0, 0, 0}, 0.5, pdu::kAppearanceDeactivated);
    const double then = way == 3 ? 200 : 1;  // way 3: silent for longer than allowed
    receiver.stand_at({600, 0, 0}, then);
    receiver.look(then + 0.3);
    receiver.look(then + 2);
    EXPECT_EQ(receiver.find(), nullptr) << way;
    EXPECT_EQ(receiver.count("entered"), 0u) << way;
  }
}

TEST(OutsideEntities, KeepTheirPlainDisOwnerWhileItSends) {
  for (const bool deactivates : {false, true}) {
    Receiver receiver;
    receiver.from.port = 3000;
    receiver.hear(kTank, {1500, 0, 0}, {0, 0, 0}, 0);
    receiver.remote().heard(receiver.from, pdu::from_seconds(20));
    receiver.from.port = 3001;
    const std::uint32_t appearance = deactivates ? pdu::kAppearanceDeactivated : 0;
    receiver.hear(kTank, {500, 0, 0}, {0, 0, 0}, 24, appearance);
    EXPECT_EQ(receiver.find(), nullptr);
    EXPECT_EQ(receiver.count("disputed_in"), 1u);

    // The same holds once it is shown: its owner was received 5 s ago.
    receiver.stand_at({600, 0, 0}, 24.5);
    receiver.look(25);
    receiver.hear(kTank, {500, 0, 0}, {0, 0, 0}, 25.1, appearance);
    ASSERT_NE(receiver.find(), nullptr);
    EXPECT_NEAR(receiver.find()->state->position.x(), 1500, 1e-3);
    EXPECT_EQ(receiver.count("disputed_in"), 2u);
  }
}

TEST(OutsideEntities, FollowSilentPlainDisOwnersToOtherAddresses) {
  Receiver receiver;
  receiver.from.port = 3000;
  receiver.hear(kTank, {1500, 0, 0}, {0, 0, 0}, 0);
  receiver.from.port = 3001;
  receiver.hear(kTank, {500, 0, 0}, {0, 0, 0}, 5);
  EXPECT_EQ(receiver.find(), nullptr);
  receiver.hear(kTank, {500, 0, 0}, {0, 0, 0}, 13);
  EXPECT_NE(receiver.find(), nullptr);
  EXPECT_EQ(receiver.count("disputed_in"), 1u);
}

TEST(OutsideEntities, AppearWithTheirNextUpdateBeyondTheCapacity) {
  Receiver receiver(2);
  for (std::uint16_t i = 1; i <= 3; ++i) {
    receiver.hear({7, 8, i}, {1500, 10.0 * i, 0}, {0, 0, 0}, 0.1 * i);
  }
  receiver.stand_at({600, 0, 0}, 1);
  receiver.look(1.3);
  EXPECT_NE(receiver.find({7, 8, 1}), nullptr);
  EXPECT_NE(receiver.find({7, 8, 2}), nullptr);
  EXPECT_EQ(receiver.find({7, 8, 3}), nullptr);
}

TEST(OutsideEntities, AllocateNothing) {
  Receiver receiver;
  const test::AllocationGuard guard;
  for (int step = 0; step < 400; ++step) {
    const double t = 0.1 * step;
    const auto number = static_cast<std::uint16_t>(1 + step % 100);
    receiver.hear({7, 8, number}, {1200.0 + step, 0, 0}, {-40, 0, 0}, t);
    receiver.look(t);
  }
  EXPECT_EQ(guard.count(), 0u);
}

TEST(ShownEntities, GoOutOfSightWhenWeGoAway) {
  Receiver receiver;
  receiver.hear(kTank, {500, 0, 0}, {0, 0, 0}, 0);
  ASSERT_NE(receiver.find(), nullptr);
  for (int step = 1; step <= 100; ++step) {  // 3 km at 300 m/s
    const double t = 0.1 * step, place = -30.0 * step;
    receiver.stand_at({place, 0, 0}, t, 300);
    receiver.look(t);
    const double away = 500 - place;
    const bool shown = receiver.find() != nullptr;
    EXPECT_TRUE(shown || away >= 1.1 * kRadius) << away;
    EXPECT_FALSE(shown && away > 1.12 * kRadius) << away;
  }
  EXPECT_EQ(receiver.count("left"), 1U);
  receiver.stand_at({0, 0, 0}, 11);
  receiver.look(11);
  receiver.look(12);
  ASSERT_NE(receiver.find(), nullptr);
  EXPECT_EQ(receiver.count("entered"), 1U);
}

TEST(ShownEntities, ComeBackAsTheyWere) {
  Receiver receiver;
  receiver.haptic = true;
  receiver.hear(kTank, {500, 3, 0}, {0, 0, 0}, 0, 1 << 3);
  const RemoteEntity before = *receiver.find();
  receiver.stand_at({-3000, 0, 0}, 2);
  receiver.look(2);
  ASSERT_EQ(receiver.find(), nullptr);
  receiver.stand_at({0, 0, 0}, 3);
  receiver.look(3.2);
  ASSERT_NE(receiver.find(), nullptr);
  const RemoteEntity& after = *receiver.find();
  EXPECT_EQ(after.state->position, before.state->position);
  EXPECT_EQ(after.state_time, before.state_time);
  EXPECT_EQ(after.last_heard, before.last_heard);
  EXPECT_EQ(after.timestamp, before.timestamp);
  EXPECT_EQ(after.type, before.type);
  EXPECT_EQ(after.appearance, before.appearance);
  EXPECT_EQ(after.marking, before.marking);
  EXPECT_EQ(after.haptic, before.haptic);
  EXPECT_EQ(after.model.k1, before.model.k1);
  EXPECT_EQ(after.valid_until, before.valid_until);
  EXPECT_EQ(after.timeout, before.timeout);
  // It gets no new time-out.
  receiver.remote().expire(pdu::from_seconds(before.timeout + 0.1));
  EXPECT_EQ(receiver.find(), nullptr);
}

TEST(ShownEntities, BringTheirArticulatedPartsBack) {
  deadreckon::PartState turret;
  deadreckon::PartParameter part;
  part.part = 4096;
  part.metric = deadreckon::PartMetric::azimuth;
  part.value = 0.25;
  ASSERT_TRUE(turret.set(part));
  std::array<std::byte, 64> records{};
  const std::size_t size = deadreckon::to_wire(turret, records);
  Receiver receiver;
  receiver.parts = std::span(records).first(size);
  receiver.hear(kTank, {500, 0, 0}, {0, 0, 0}, 0);
  ASSERT_EQ(receiver.remote().with_parts(), 1U);
  receiver.stand_at({-3000, 0, 0}, 2);
  receiver.look(2);
  EXPECT_EQ(receiver.remote().with_parts(), 0U);
  receiver.stand_at({0, 0, 0}, 3);
  receiver.look(3.2);
  ASSERT_EQ(receiver.remote().with_parts(), 1U);
  EXPECT_EQ(receiver.remote().parts(kTank, pdu::from_seconds(3.2))[0].value, 0.25);
}

TEST(ShownEntities, StayWhereWeTremble) {
  Receiver receiver;
  receiver.hear(kTank, {1095, 0, 0}, {0, 0, 0}, 0);  // outside, until the focus comes near
  receiver.stand_at({200, 0, 0}, 1);
  receiver.look(1);
  receiver.look(2.1);
  ASSERT_NE(receiver.find(), nullptr);
  for (int step = 0; step < 500; ++step) {
    const double t = 2.1 + 0.1 * step;
    receiver.stand_at({step % 2 == 0 ? 0.0 : 10.0, 0, 0}, t, 100);
    receiver.look(t);
    ASSERT_NE(receiver.find(), nullptr) << step;
  }
}

// Its owner is in a cell that is no longer received.
TEST(ShownEntities, DisappearWhenTheyMoveAwayUnreceived) {
  Receiver receiver;
  receiver.hear(kTank, {900, 0, 0}, {60, 0, 0}, 0);
  for (int step = 1; step < 50; ++step) {
    const double t = 0.1 * step, away = 900 + 60 * t;
    receiver.look(t);
    const bool shown = receiver.find() != nullptr;
    EXPECT_TRUE(shown || away >= 1.1 * kRadius) << away;
    EXPECT_FALSE(shown && away > 1.1 * kRadius + 61) << away;
  }
}

TEST(ShownEntities, AreCheckedInBoundedNumbersPerPass) {
  Receiver receiver(40'000);
  constexpr std::uint16_t kMany = 40'000;
  for (std::uint16_t i = 1; i <= kMany; ++i) receiver.hear({7, 8, i}, {500, 0, 0}, {0, 0, 0}, 0);
  ASSERT_EQ(receiver.remote().rows().size(), kMany);
  receiver.stand_at({-3000, 0, 0}, 1);
  const test::AllocationGuard guard;
  for (std::size_t left = kMany; left > 0;) {
    left -= std::min(left, SightWatch::kMostLooks);
    receiver.look(1);
    EXPECT_EQ(receiver.remote().rows().size(), left);
  }
  EXPECT_EQ(guard.count(), 0U);
  receiver.stand_at({0, 0, 0}, 2);
  receiver.look(2.2);
  EXPECT_EQ(receiver.remote().rows().size(), kMany);
}

// An entity within the radius for a second is shown; a distant one is not. The oracle computes
// every distance at every step.
TEST(OutsideEntities, AgreeWithALookAtAllOfThem) {
  struct Truth {
    Vector3d position, velocity;
    double since;
  };
  for (unsigned seed = 1; seed <= 20; ++seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> place(-6000, 6000), speed(-60, 60), chance(0, 1);
    Receiver receiver;
    std::map<std::uint16_t, Truth> truths;
    std::map<std::uint16_t, double> within, beyond;  // start times
    Vector3d focus(0, 0, 0), way(speed(random), speed(random), 0);
    for (int step = 0; step < 600; ++step) {
      const double t = 0.1 * step;
      if (chance(random) < 0.01) focus = {place(random), place(random), 0};  // a jump
      focus += 0.1 * way;
      for (int k = 0; k < 3; ++k) {
        const auto number = static_cast<std::uint16_t>(1 + random() % 150);
        const bool moves = chance(random) < 0.5;
        const Vector3d velocity =
            moves ? Vector3d(speed(random), speed(random), 0) : Vector3d(0, 0, 0);
        const Truth truth{{place(random), place(random), 0}, velocity, t};
        truths[number] = truth;
        within.erase(number);
        beyond.erase(number);
        receiver.hear({7, 8, number}, truth.position, truth.velocity, t);
      }
      receiver.stand_at(focus, t, way.norm());
      receiver.remote().expire(pdu::from_seconds(t));
      receiver.look(t);
      for (const auto& [number, truth] : truths) {
        const double away = (truth.position + (t - truth.since) * truth.velocity - focus).norm();
        const bool silent = t - truth.since > 11;  // moving entities are forgotten at 12 s
        if (away < 1.12 * kRadius) beyond.erase(number);
        if (receiver.find({7, 8, number}) != nullptr && away > 1.12 * kRadius) {
          const double since = beyond.emplace(number, t).first->second;
          ASSERT_LT(t - since, 1.21) << "seed " << seed << ", entity " << number;
        }
        if (away > kRadius - 1 || silent) {
          within.erase(number);
        } else if (t - within.emplace(number, t).first->second > 1.01) {
          ASSERT_NE(receiver.find({7, 8, number}), nullptr)
              << "seed " << seed << ", entity " << number << " at " << t << " s";
        }
      }
    }
    EXPECT_GT(receiver.count("entered"), 5u);
  }
}

}  // namespace
}  // namespace reckon::peer::outside_entities_test
