// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Thousands of entities in one step.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>
#include <set>

#include "reckon/aoim/bundling/aggregator.hpp"
#include "reckon/pdu/bundle.hpp"
#include "reckon/pdu/entity/attribute.hpp"
#include "reckon/tests/aoim/support/samples.hpp"
#include "reckon/tests/support/allocation_guard.hpp"

namespace reckon::aoim::aggregator_many_test {
namespace {

using namespace test;

constexpr GroupIndex kGroup{3};

/// Emitted states: entity and appearance, in order.
struct States {
  std::vector<std::pair<std::uint16_t, std::uint32_t>> seen;
  void operator()(GroupIndex, std::span<const std::byte> datagram) {
    for (const pdu::BundledPdu& bundled : pdu::BundleReader(datagram)) {
      pdu::EntityState state;
      if (pdu::decode(bundled.bytes, state) != pdu::DecodeError::none) continue;
      seen.emplace_back(state.entity_id.entity, state.appearance);
    }
  }
};

TEST(AggregatorOfMany, TakesTenThousandEntitiesInOneStep) {
  Aggregator aggregator{AggregatorConfig{}};
  constexpr std::uint16_t kMany = 10000;
  for (std::uint16_t i = 0; i < kMany; ++i) {
    ASSERT_EQ(aggregator.add(kGroup, entity_state(i, 1), {}, seconds(1)), AddResult::queued);
  }
  for (std::uint16_t i = kMany; i-- > 0;) {
    ASSERT_EQ(aggregator.add(kGroup, entity_state(i, 2), {}, seconds(1)), AddResult::replaced);
  }
  EXPECT_EQ(aggregator.counts().refused, 0u);
  EXPECT_EQ(aggregator.next_deadline(), nanoseconds::min()) << "full bundles need not wait";
  States states;
  aggregator.flush_due(seconds(0), states);  // before the deadline: full bundles are sent
  aggregator.flush_due(seconds(1), states);
  ASSERT_EQ(states.seen.size(), kMany);
  for (std::uint16_t i = 0; i < kMany; ++i) {
    EXPECT_EQ(states.seen[i], (std::pair<std::uint16_t, std::uint32_t>(i, 2u)));
  }
  EXPECT_EQ(aggregator.counts().datagrams, kMany / 8u);
}

/// Reference model of the pending updates of three groups.
struct Model {
  std::map<GroupIndex, std::map<std::uint16_t, std::uint32_t>> waiting;
  std::size_t wrong = 0;
  void operator()(GroupIndex group, std::span<const std::byte> datagram) {
    States states;
    states(group, datagram);
    for (const auto& [entity, appearance] : states.seen) {
      const auto found = waiting[group].find(entity);
      if (found == waiting[group].end() || found->second != appearance) {
        ++wrong;
      } else {
        waiting[group].erase(found);
      }
    }
  }
};

TEST(AggregatorOfMany, ReplacesOnlyPendingUpdatesOfTheSameEntity) {
  std::mt19937_64 random(17);
  Aggregator aggregator{AggregatorConfig{}};
  Model model;
  nanoseconds now{0};
  for (std::uint32_t i = 0; i < 300'000; ++i) {
    const GroupIndex group{static_cast<std::uint16_t>(random() % 3)};
    const auto entity = static_cast<std::uint16_t>(random() % 4000);
    const nanoseconds deadline = now + milliseconds(random() % 50);
    if (random() % 16 == 0) {
      aggregator.add(group, raw_pdu(pdu::PduType::data, random() % 200), deadline);
    }
    auto& waiting = model.waiting[group];
    const auto expected = waiting.contains(entity) ? AddResult::replaced : AddResult::queued;
    ASSERT_EQ(aggregator.add(group, entity_state(entity, i), {}, deadline), expected) << i;
    waiting[entity] = i;
    if (random() % 1500 == 0) aggregator.flush_due(now += milliseconds(random() % 30), model);
    if (random() % 20000 == 0) aggregator.flush_all(now, model);
    ASSERT_EQ(model.wrong, 0u) << i;
  }
  aggregator.flush_all(now, model);
  EXPECT_EQ(model.wrong, 0u);
  for (const auto& [group, waiting] : model.waiting) EXPECT_TRUE(waiting.empty());
}

TEST(AggregatorOfMany, DistinguishesEntitiesByAllThreeNumbers) {
  Aggregator aggregator{AggregatorConfig{}};
  constexpr std::uint16_t kMany = 700;
  const auto add_all = [&](AddResult expected) {
    pdu::EntityState state = entity_state(0);
    for (std::uint16_t i = 0; i < kMany; ++i) {
      for (const pdu::EntityId& id :
           {pdu::EntityId{1, i, 1}, pdu::EntityId{static_cast<std::uint16_t>(i + 2), 1, 1},
            pdu::EntityId{1, 0xFFFF, static_cast<std::uint16_t>(90 * i)}}) {
        state.entity_id = id;
        ASSERT_EQ(aggregator.add(kGroup, state, {}, seconds(1)), expected) << i;
      }
    }
  };
  add_all(AddResult::queued);
  add_all(AddResult::replaced);
}

/// Removes the entities of an emitted datagram from the set of entities with pending records.
void take_sets(std::span<const std::byte> datagram, std::set<pdu::EntityId>& waiting) {
  for (const pdu::BundledPdu& bundled : pdu::BundleReader(datagram)) {
    pdu::Attribute attribute;
    if (bundled.header.pdu_type != pdu::PduType::attribute) continue;
    ASSERT_EQ(pdu::decode(bundled.bytes, attribute), pdu::DecodeError::none);
    for (const pdu::AttributeSet& set : pdu::AttributeReader(attribute)) {
      EXPECT_EQ(waiting.erase(set.entity_id), 1u);
    }
  }
}

TEST(AggregatorOfMany, FindsPendingRecordsAfterFullBundlesWereSent) {
  // Records alone are short: a bundle that is not full holds more of them than the search looks
  // through.
  std::mt19937_64 random(5);
  Aggregator aggregator{AggregatorConfig{}};
  std::set<pdu::EntityId> waiting;
  std::size_t most_kept = 0;
  for (int i = 0; i < 50'000; ++i) {
    const pdu::EntityId entity{7, 1, static_cast<std::uint16_t>(random() % 60)};
    const auto expected = waiting.contains(entity) ? AddResult::replaced : AddResult::queued;
    ASSERT_EQ(aggregator.add_records(kGroup, entity, haptic_record(1.0F), seconds(1)), expected);
    waiting.insert(entity);
    if (random() % 20 != 0) continue;
    aggregator.flush_due(seconds(0), [&](GroupIndex, std::span<const std::byte> datagram) {
      take_sets(datagram, waiting);
    });
    most_kept = std::max(most_kept, waiting.size());
  }
  EXPECT_GT(most_kept, 10u);
}

TEST(AggregatorOfMany, AllocatesNothingMoreForKnownEntities) {
  Aggregator aggregator{AggregatorConfig{}};
  const auto nothing = [](GroupIndex, std::span<const std::byte>) {};
  // The entities move through all groups, so the records of emitted updates are dropped repeatedly.
  const auto step = [&](int number) {
    for (std::uint16_t i = 0; i < 3000; ++i) {
      const GroupIndex group{static_cast<std::uint16_t>(1 + (i / 100 + number) % 256)};
      aggregator.add(group, entity_state(i), {}, nanoseconds(number));
    }
    aggregator.flush_due(nanoseconds(number), nothing);
  };
  for (int i = 0; i < 10; ++i) step(i);
  const reckon::test::AllocationGuard guard;
  for (int i = 10; i < 1000; ++i) step(i);
  EXPECT_EQ(guard.count(), 0u);
  EXPECT_EQ(aggregator.counts().refused, 0u);
}

TEST(AggregatorOfMany, KeepsMemoryBoundedForUpdatesOfVaryingLength) {
  Aggregator aggregator{AggregatorConfig{}};
  const Octets parts(16 * 50);
  pdu::EntityState small = entity_state(1), large = entity_state(1);
  large.variable_parameters = parts;
  const reckon::test::AllocationGuard guard;
  for (int i = 0; i < 10000; ++i) {
    aggregator.add(kGroup, i % 2 == 0 ? small : large, {}, seconds(1));
  }
  EXPECT_LT(guard.peak_octets(), 64u * 1024u);
}

TEST(AggregatorOfMany, TakesMemoryForGroupsWithPendingUpdatesOnly) {
  AggregatorConfig config;
  config.pool = kMaximumPool;
  const auto nothing = [](GroupIndex, std::span<const std::byte>) {};
  const reckon::test::AllocationGuard made;
  Aggregator aggregator(config);
  EXPECT_LT(made.peak_octets(), 320u * 1024u);  // most of it: 96 octets a group
  const pdu::EntityState state = entity_state(1);
  {
    const reckon::test::AllocationGuard in_turn;
    for (std::uint16_t group = 0; group <= kMaximumPool; ++group) {
      aggregator.add(GroupIndex{group}, state, {}, nanoseconds(0));
      aggregator.flush_due(nanoseconds(0), nothing);
    }
    EXPECT_EQ(in_turn.count(), 0u);
  }
  // Updates in all groups at once allocate memory the first time only.
  const auto at_once = [&] {
    for (std::uint16_t group = 0; group <= kMaximumPool; ++group)
      aggregator.add(GroupIndex{group}, state, {}, nanoseconds(0));
    aggregator.flush_due(nanoseconds(0), nothing);
  };
  at_once();
  const reckon::test::AllocationGuard again;
  at_once();
  EXPECT_EQ(again.count(), 0u);
  EXPECT_EQ(aggregator.counts().datagrams, 3u * (kMaximumPool + 1));
}

TEST(AggregatorOfMany, CountsUpdatesRefusedForWantOfRoom) {
  AggregatorConfig config;
  config.waiting_limit = 144 * 100;
  Aggregator aggregator(config);
  for (std::uint16_t i = 0; i < 130; ++i) aggregator.add(kGroup, entity_state(i), {}, seconds(1));
  EXPECT_EQ(aggregator.counts().refused, 30u);
  EXPECT_EQ(aggregator.add(kGroup, entity_state(129), {}, seconds(1)), AddResult::refused_full);
  EXPECT_EQ(aggregator.add(kGroup, entity_state(5), {}, seconds(1)), AddResult::replaced);
  config.waiting_limit = (std::size_t{1} << 30) + 1;
  EXPECT_THROW(Aggregator{config}, std::invalid_argument);
}

}  // namespace
}  // namespace reckon::aoim::aggregator_many_test
