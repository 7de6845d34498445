// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Accepted and refused input of listeners of each kind, and the consistency of their data.
#include "reckon/tools/listener/listener.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <map>
#include <random>
#include <vector>

#include "reckon/pdu/bundle.hpp"
#include "reckon/pdu/management/entity_request.hpp"
#include "reckon/pdu/timestamp.hpp"
#include "reckon/peer/compression/state_compressor.hpp"
#include "reckon/tests/support/allocation_guard.hpp"
#include "reckon/tests/tools/support/compressed_ship.hpp"
#include "reckon/tests/tools/support/haptic_traffic.hpp"

namespace reckon::tools::listener_test {
namespace {

using std::chrono::milliseconds;
using std::chrono::nanoseconds;
using std::chrono::seconds;
using test::Ball;
using test::Octets;

constexpr nanoseconds kStart = seconds(1'700'000'000);
/// Exercise of the PDUs in these tests.
const std::uint8_t kExercise = pdu::EntityState{}.header.exercise_id;

void take(Listener& listener, const Octets& datagram, nanoseconds arrival) {
  for (const pdu::BundledPdu& pdu : pdu::BundleReader(datagram))
    listener.take_pdu(pdu.bytes, pdu.header, arrival);
}

void take(Listener& listener, const Ball& ball, nanoseconds arrival) {
  take(listener, test::datagram_of(ball), arrival);
  listener.end_datagram();
}

void take(Listener& listener, const pdu::EntityState& state, nanoseconds arrival) {
  Octets octets;
  test::append_pdu(octets, state);
  take(listener, octets, arrival);
  listener.end_datagram();
}

TEST(Listener, RestoresCompressedStatesByAnyRules) {
  using pdu::CompressedForm;
  for (const CompressedForm form : {CompressedForm::compact, CompressedForm::residual}) {
    SCOPED_TRACE(static_cast<int>(form));
    peer::StateCompressor compressor(form);
    Listener monitor(kMonitorRules), capture(kCaptureRules);
    pdu::EntityState state;
    for (int update = 0; update < 40; ++update) {
      const nanoseconds time = kStart + update * milliseconds(500);
      const Octets datagram = test::compressed_ship(compressor, update, time, state);
      for (Listener* listener : {&monitor, &capture}) take(*listener, datagram, time);
    }
    for (const Listener* listener : {&monitor, &capture}) {
      ASSERT_EQ(listener->entities().size(), 1U);
      // The key before the first compressed state was not kept: 1 or 2 are not restored.
      EXPECT_GE(listener->entities()[0].updates, 38U);
      EXPECT_EQ(pdu::numbers_of(listener->entities()[0].entity_state(), {}),
                pdu::numbers_of(state, {}));
    }
  }
}

TEST(Listener, RefusesImpossibleNumbersByAnyRules) {
  for (const ListenerRules& rules : {kPeerRules, kCaptureRules, kMonitorRules}) {
    Listener listener(rules);
    take(listener, Ball{.up = std::numeric_limits<double>::quiet_NaN(), .time = kStart}, kStart);
    EXPECT_EQ(listener.refusals().values, 1U);
    // Only a listener that shows bad PDUs keeps the entity, without a state or a model.
    ASSERT_EQ(listener.entities().size(), rules.keeps ? 1U : 0U);
    for (const ReceivedEntity& entity : listener.entities())
      EXPECT_FALSE(entity.has_state || entity.is_haptic());
    take(listener, Ball{.time = kStart + seconds(1)}, kStart + seconds(1));
    ASSERT_EQ(listener.entities().size(), 1U);
    EXPECT_EQ(listener.entities()[0].updates, 1U);
  }
}

TEST(Listener, RefusesModelsWithImpossibleNumbersByAnyRules) {
  for (const ListenerRules& rules : {kPeerRules, kMonitorRules}) {
    Listener listener(rules);
    take(listener, Ball{.k1 = -5, .time = kStart}, kStart);
    EXPECT_EQ(listener.refusals().values, 1U);
    EXPECT_FALSE(listener.entities()[0].is_haptic());
  }
}

TEST(Listener, TakesOlderStatesByItsRules) {
  const std::map<ListenerRules::Timing, std::uint64_t> updates{
      {ListenerRules::Timing::sender_clock, 1},
      {ListenerRules::Timing::sender_clock_or_arrival, 2},
      {ListenerRules::Timing::pace, 1}};
  for (const ListenerRules& rules : {kPeerRules, kCaptureRules, kMonitorRules}) {
    Listener listener(rules);
    take(listener, Ball{.time = kStart + seconds(1)}, kStart + seconds(1));
    take(listener, Ball{.up = 5, .time = kStart}, kStart + milliseconds(1010));
    const std::uint64_t expected = updates.at(rules.timing);
    EXPECT_EQ(listener.entities()[0].updates, expected);
    EXPECT_EQ(listener.refusals().stale, 2 - expected);
  }
}

TEST(Listener, UsesArrivalTimesForConstantTimestamps) {
  Listener listener(kCaptureRules);
  for (int i = 0; i < 5; ++i) {
    take(listener, Ball{.up = 1.0 * i, .rising = 1, .time = kStart}, kStart + seconds(i));
    const nanoseconds off = listener.entities()[0].state_time - (kStart + seconds(i));
    EXPECT_LT(std::chrono::abs(off), std::chrono::microseconds(2));  // a timestamp's unit
  }
}

TEST(Listener, KnowsUncoupledEntitiesByItsRules) {
  for (const ListenerRules& rules : {kPeerRules, kCaptureRules, kMonitorRules}) {
    Listener listener(rules);
    pdu::EntityState state = test::state_of({.time = kStart});
    state.header.pdu_status = 0;
    take(listener, state, kStart);
    EXPECT_EQ(listener.entities().size(), rules.uncoupled ? 1U : 0U);
  }
}

TEST(Listener, DistinguishesExercisesByItsRules) {
  for (const ListenerRules& rules : {kPeerRules, kMonitorRules}) {
    Listener listener(rules);
    pdu::EntityState state = test::state_of({.time = kStart});
    for (const std::uint8_t exercise : {std::uint8_t{1}, std::uint8_t{2}}) {
      state.header.exercise_id = exercise;
      state.header.timestamp += 1000;
      take(listener, state, kStart + milliseconds(exercise));
    }
    EXPECT_EQ(listener.entities().size(), rules.by_exercise ? 2U : 1U);
    EXPECT_NE(listener.find_entity(state.entity_id, 2), nullptr);
  }
}

TEST(Listener, RefusesTheModelOfARefusedState) {
  Listener listener(kPeerRules);
  take(listener, Ball{.time = kStart + seconds(1)}, kStart + seconds(1));
  take(listener, Ball{.k1 = 900, .time = kStart}, kStart + milliseconds(1010));  // overtaken
  EXPECT_EQ(listener.model_of(listener.entities()[0])->model.k1, 500);
  take(listener, Ball{.k1 = 900, .time = kStart + seconds(2)}, kStart + seconds(2));
  EXPECT_EQ(listener.model_of(listener.entities()[0])->model.k1, 900);
}

TEST(Listener, KeepsTheDataBeforeTheDatagram) {
  Listener listener(kPeerRules);
  take(listener, Ball{.time = kStart}, kStart);
  take(listener, test::datagram_of({.k1 = 900, .time = kStart + seconds(1)}), kStart + seconds(1));
  ASSERT_EQ(listener.touched().size(), 1U);
  EXPECT_TRUE(listener.touched()[0].known);
  EXPECT_EQ(listener.touched()[0].before.updates, 1U);
  EXPECT_EQ(listener.touched()[0].model_before.model.k1, 500);
  listener.end_datagram();
  EXPECT_TRUE(listener.touched().empty());
}

TEST(Listener, SeparateModelsDoNotMoveAnEntity) {
  for (const ListenerRules& rules : {kPeerRules, kMonitorRules}) {
    Listener listener(rules);
    const Ball ball{.rising = 0.5, .time = kStart};
    take(listener, ball, kStart);
    const auto before = listener.entities()[0].pose_at(kStart + seconds(1)).position;
    Octets alone;
    test::append_attribute(alone, test::state_of(ball), test::record_of(ball));
    take(listener, alone, kStart + milliseconds(700));
    EXPECT_EQ(listener.entities()[0].pose_at(kStart + seconds(1)).position, before);
    EXPECT_EQ(listener.models()[0].valid_until(), kStart + seconds(1));
  }
}

TEST(Listener, StopsFrozenAndByItsRulesSilentEntities) {
  for (const ListenerRules& rules : {kPeerRules, kMonitorRules}) {
    Listener listener(rules);
    take(listener, Ball{.entity = 1, .rising = 1, .time = kStart}, kStart);
    pdu::EntityState frozen = test::state_of({.entity = 2, .rising = 1, .time = kStart});
    frozen.appearance = pdu::kAppearanceFrozen;
    take(listener, frozen, kStart);
    const auto path = [&](std::size_t place, nanoseconds until) {
      const ReceivedEntity& entity = listener.entities()[place];
      return (entity.pose_at(kStart + until).position - entity.pose_at(kStart).position).norm();
    };
    constexpr double kUnit = 2e-6;  // [m] within a timestamp's unit
    EXPECT_NEAR(path(0, seconds(10)), 10, kUnit);
    EXPECT_NEAR(path(0, seconds(20)), rules.holds ? 12 : 20, kUnit);  // 2.4 heartbeats of 5 s
    EXPECT_EQ(path(1, seconds(10)), 0);
  }
}

TEST(Listener, ForgetsOrMarksDepartedEntities) {
  for (const ListenerRules& rules : {kPeerRules, kCaptureRules, kMonitorRules}) {
    Listener listener(rules);
    take(listener, Ball{.time = kStart}, kStart);
    pdu::EntityState leaving = test::state_of({.time = kStart + seconds(1)});
    leaving.appearance = pdu::kAppearanceDeactivated;
    take(listener, leaving, kStart + seconds(1));
    ASSERT_EQ(listener.entities().size(), rules.keeps ? 1U : 0U);
    if (!rules.keeps) continue;
    EXPECT_TRUE(listener.entities()[0].gone);
    EXPECT_EQ(listener.entities()[0].gone_at, kStart + seconds(1));
  }
}

TEST(Listener, ReportsStatesAndModelsBeforeTakingThem) {
  struct Order : ListenerObserver {
    const Listener& listener;
    std::vector<std::uint64_t> states;
    std::vector<bool> models;
    explicit Order(const Listener& heard) : listener(heard) {}
    void receive_state(const StateUpdate& update) {
      states.push_back(listener.entities()[update.place].updates);
    }
    void receive_model(const ModelUpdate& update) {
      models.push_back(listener.entities()[update.place].is_haptic());
    }
  };
  Listener listener(kMonitorRules);
  Order order(listener);
  for (int i = 0; i < 2; ++i) {
    const nanoseconds time = kStart + seconds(i);
    const Octets octets = test::datagram_of({.time = time});
    for (const pdu::BundledPdu& pdu : pdu::BundleReader(octets))
      listener.take_pdu(pdu.bytes, pdu.header, time, order);
  }
  EXPECT_EQ(order.states, (std::vector<std::uint64_t>{0, 1}));
  EXPECT_EQ(order.models, (std::vector<bool>{false, true}));
}

TEST(Listener, KeepsModelsWithTheirEntities) {
  ListenerRules rules = kMonitorRules;
  rules.most_entities = 24;
  std::mt19937 random(5);
  Listener listener(rules);
  std::map<std::uint16_t, double> stiffness;  // 0: no model
  for (int step = 1; step <= 3000; ++step) {
    const auto id = static_cast<std::uint16_t>(1 + random() % 40);
    const nanoseconds time = kStart + milliseconds(10 * step);
    const std::size_t place = listener.place_of(kExercise, {1, 2, id});
    if (place != Listener::kNone && random() % 3 == 0) {
      listener.forget_entity(place);
      stiffness.erase(id);
    } else if (place != Listener::kNone || stiffness.size() < rules.most_entities) {
      const double k1 = static_cast<double>(1 + random() % 1000);
      const Ball ball{.entity = id, .k1 = k1, .time = time};
      if (random() % 2 == 0) {
        take(listener, ball, time);
        stiffness[id] = k1;
      } else {
        take(listener, test::state_of(ball), time);
        stiffness.try_emplace(id, 0);
      }
    }
    ASSERT_EQ(listener.entities().size(), stiffness.size());
    std::size_t models = 0;
    for (const auto& [entity, k1] : stiffness) {
      const ReceivedEntity* found = listener.find_entity({1, 2, entity}, kExercise);
      ASSERT_NE(found, nullptr);
      ASSERT_EQ(found->is_haptic(), k1 > 0);
      if (k1 == 0) continue;
      ++models;
      const ReceivedModel& model = *listener.model_of(*found);
      ASSERT_EQ(model.model.k1, k1);
      ASSERT_EQ(&listener.entities()[model.owner], found);
    }
    ASSERT_EQ(listener.models().size(), models);
  }
}

TEST(Listener, CountsEntitiesBeyondItsCapacity) {
  ListenerRules rules = kMonitorRules;
  rules.most_entities = 2;
  Listener listener(rules);
  for (std::uint16_t id = 1; id <= 5; ++id)
    take(listener, test::state_of({.entity = id, .time = kStart}), kStart);
  EXPECT_EQ(listener.take_unreadable(1, {9, 9, 9}, kStart), Listener::kNone);
  EXPECT_EQ(listener.entities().size(), 2U);
  EXPECT_EQ(listener.refusals().crowded, 4U);
}

TEST(Listener, AllocatesNothingForKnownEntities) {
  for (const ListenerRules& rules : {kPeerRules, kCaptureRules, kMonitorRules}) {
    Listener listener(rules);
    std::vector<Octets> datagrams;
    for (int i = 0; i < 50; ++i)
      datagrams.push_back(test::datagram_of({.up = 0.1 * i, .time = kStart + seconds(i)}));
    for (int i = 0; i < 2; ++i) {
      take(listener, datagrams[static_cast<std::size_t>(i)], kStart + seconds(i));
      listener.end_datagram();
    }
    const test::AllocationGuard guard;
    for (int i = 2; i < 50; ++i) {
      take(listener, datagrams[static_cast<std::size_t>(i)], kStart + seconds(i));
      listener.end_datagram();
    }
    EXPECT_EQ(guard.count(), 0U);
    EXPECT_EQ(listener.entities()[0].updates, 50U);
  }
}

}  // namespace
}  // namespace reckon::tools::listener_test
