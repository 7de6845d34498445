// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/aoim/bundling/aggregator.hpp"

#include <gtest/gtest.h>

#include <map>
#include <random>
#include <set>

#include "reckon/tests/aoim/support/samples.hpp"

namespace reckon::aoim::aggregator_test {
namespace {

using namespace test;

constexpr GroupIndex kGroup{5};
constexpr GroupIndex kInteropGroup{6};
constexpr std::size_t kLimit = 1352 - 64;

AggregatorConfig config() {
  AggregatorConfig result;
  result.sender = {7, 1};
  result.epoch = 0xCAFE;
  return result;
}

/// The PDUs of a datagram. Fails the test if the datagram is not a valid bundle.
std::vector<pdu::BundledPdu> pdus_of(const Datagram& datagram) {
  std::vector<pdu::BundledPdu> result;
  for (const pdu::BundledPdu& bundled : pdu::BundleReader(datagram.octets)) {
    EXPECT_EQ(bundled.error, pdu::DecodeError::none) << pdu::sentence(bundled.error);
    result.push_back(bundled);
  }
  return result;
}

/// The records of a datagram's Attribute PDU, by entity.
std::map<pdu::EntityId, std::vector<pdu::AttributeRecord>> records_of(const Datagram& datagram) {
  std::map<pdu::EntityId, std::vector<pdu::AttributeRecord>> result;
  for (const pdu::BundledPdu& bundled : pdus_of(datagram)) {
    if (bundled.header.pdu_type != pdu::PduType::attribute) continue;
    pdu::Attribute attribute;
    EXPECT_EQ(pdu::decode(bundled.bytes, attribute), pdu::DecodeError::none);
    for (const pdu::AttributeSet& set : pdu::AttributeReader(attribute)) {
      EXPECT_FALSE(result.contains(set.entity_id)) << "two record sets of one entity";
      for (const pdu::AttributeRecord& record : set.records()) {
        result[set.entity_id].push_back(record);
      }
    }
  }
  return result;
}

TEST(Aggregator, HoldsAPoseUntilItsDeadline) {
  Aggregator aggregator(config());
  Collector sent;
  EXPECT_FALSE(aggregator.next_deadline());
  aggregator.add(kGroup, entity_state(1), {}, milliseconds(5));
  EXPECT_EQ(aggregator.next_deadline(), milliseconds(5));
  aggregator.flush_due(milliseconds(4), sent);
  EXPECT_TRUE(sent.datagrams.empty());
  aggregator.flush_due(milliseconds(5), sent);
  ASSERT_EQ(sent.datagrams.size(), 1u);
  EXPECT_EQ(sent.datagrams[0].octets.size(), 144u + 24u);
  EXPECT_EQ(sent.datagrams[0].group, kGroup);
  EXPECT_FALSE(aggregator.next_deadline());
  EXPECT_EQ(aggregator.counts().by_deadline, 1u);
}

TEST(Aggregator, SendsPendingPosesWithAnUrgentHapticUpdate) {
  Aggregator aggregator(config());
  Collector sent;
  aggregator.add(kGroup, entity_state(1), {}, milliseconds(10));
  aggregator.add(GroupIndex{9}, entity_state(2), {}, milliseconds(10));
  aggregator.add(kGroup, entity_state(3), haptic_record(200.0F), nanoseconds(0));
  aggregator.flush_due(milliseconds(1), sent);
  ASSERT_EQ(sent.datagrams.size(), 1u) << "the other group's pose is not due";
  EXPECT_EQ(pdus_of(sent.datagrams[0]).size(), 4u);  // two states, Attribute, trailer
}

TEST(Aggregator, SendsAFullBundleAtOnce) {
  Aggregator aggregator(config());
  Collector sent;
  for (std::uint16_t i = 0; i < 11; ++i) aggregator.add(kGroup, entity_state(i), {}, seconds(1));
  EXPECT_LT(*aggregator.next_deadline(), nanoseconds(0));
  aggregator.flush_due(nanoseconds(0), sent);
  ASSERT_EQ(sent.datagrams.size(), 1u);
  EXPECT_EQ(sent.datagrams[0].octets.size(), 8u * 144u + 24u);
  EXPECT_EQ(aggregator.counts().full, 1u);
  aggregator.flush_due(seconds(1), sent);
  ASSERT_EQ(sent.datagrams.size(), 2u);
  EXPECT_EQ(sent.datagrams[1].octets.size(), 3u * 144u + 24u);
}

TEST(Aggregator, KeepsTheNewestStateAndTheEarlierDeadline) {
  Aggregator aggregator(config());
  Collector sent;
  EXPECT_EQ(aggregator.add(kGroup, entity_state(1, 10), {}, milliseconds(5)), AddResult::queued);
  EXPECT_EQ(aggregator.add(kGroup, entity_state(1, 11), {}, milliseconds(9)), AddResult::replaced);
  aggregator.flush_due(milliseconds(5), sent);
  ASSERT_EQ(sent.datagrams.size(), 1u);
  const auto pdus = pdus_of(sent.datagrams[0]);
  ASSERT_EQ(pdus.size(), 2u);
  pdu::EntityState state;
  ASSERT_EQ(pdu::decode(pdus[0].bytes, state), pdu::DecodeError::none);
  EXPECT_EQ(state.appearance, 11u);
}

TEST(Aggregator, AReplacingStateMayBeLongerOrShorter) {
  Aggregator aggregator(config());
  Collector sent;
  const Octets parameters(5 * 16);
  pdu::EntityState state = entity_state(1, 20);
  aggregator.add(kGroup, state, {}, milliseconds(5));
  aggregator.add(kGroup, entity_state(2, 30), {}, milliseconds(5));
  state.variable_parameters = parameters;
  state.appearance = 21;
  aggregator.add(kGroup, state, {}, milliseconds(5));
  EXPECT_EQ(aggregator.add(kGroup, entity_state(2, 31), {}, milliseconds(5)), AddResult::replaced);
  aggregator.flush_due(milliseconds(5), sent);
  const auto pdus = pdus_of(sent.datagrams.at(0));
  ASSERT_EQ(pdus.size(), 3u);
  EXPECT_EQ(pdus[0].bytes.size(), 144u + 80u);
  pdu::EntityState second;
  ASSERT_EQ(pdu::decode(pdus[1].bytes, second), pdu::DecodeError::none);
  EXPECT_EQ(second.appearance, 31u);
}

TEST(Aggregator, MergesRecordsByTypeAndCounterpart) {
  Aggregator aggregator(config());
  Collector sent;
  aggregator.add(kGroup, entity_state(1),
                 haptic_record(1.0F) + energy_record(2, 0.1) + energy_record(3, 0.2), seconds(1));
  aggregator.add(kGroup, entity_state(1, 5), {}, seconds(1));  // pose only: the model stays
  aggregator.add_records(kGroup, {7, 1, 1}, energy_record(3, 0.7), seconds(1));
  aggregator.add_records(kGroup, {7, 1, 1}, haptic_record(2.0F), nanoseconds(0));
  aggregator.flush_due(nanoseconds(0), sent);
  ASSERT_EQ(sent.datagrams.size(), 1u);
  const auto sets = records_of(sent.datagrams[0]);
  ASSERT_EQ(sets.size(), 1u);
  const auto& records = sets.at({7, 1, 1});
  ASSERT_EQ(records.size(), 3u);
  double given = 0.0;
  for (const pdu::AttributeRecord& record : records) {
    pdu::HapticRecord haptic;
    pdu::EnergyAccountRecord energy;
    if (pdu::decode(record, haptic) == pdu::DecodeError::none) {
      EXPECT_EQ(haptic.k1, 2.0F);
    }
    if (pdu::decode(record, energy) == pdu::DecodeError::none) given += energy.given;
  }
  EXPECT_DOUBLE_EQ(given, 0.1 + 0.7);
}

TEST(Aggregator, CouplesStateAndAttributeByStatusAndTimestamp) {
  Aggregator aggregator(config());
  Collector sent;
  aggregator.add(kGroup, entity_state(1), {}, seconds(1));
  aggregator.add(kGroup, entity_state(2), haptic_record(1.0F), nanoseconds(0));
  aggregator.flush_due(nanoseconds(0), sent);
  const auto pdus = pdus_of(sent.datagrams.at(0));
  ASSERT_EQ(pdus.size(), 4u);
  EXPECT_FALSE(pdus[0].header.coupled_extension());
  EXPECT_TRUE(pdus[1].header.coupled_extension());
  EXPECT_EQ(pdus[2].header.pdu_type, pdu::PduType::attribute);
  EXPECT_FALSE(pdus[2].header.coupled_extension());
  EXPECT_EQ(pdus[2].header.timestamp, pdus[1].header.timestamp);
  pdu::Attribute attribute;
  ASSERT_EQ(pdu::decode(pdus[2].bytes, attribute), pdu::DecodeError::none);
  EXPECT_EQ(attribute.originating_simulation, (pdu::SimulationAddress{7, 1}));
}

TEST(Aggregator, SendsAPduThatIsTooLongAlone) {
  Aggregator aggregator(config());
  Collector sent;
  const Octets parameters(120 * 16);
  pdu::EntityState big = entity_state(2);
  big.variable_parameters = parameters;
  aggregator.add(kGroup, entity_state(1), {}, seconds(1));
  aggregator.add(kGroup, big, {}, seconds(1));
  aggregator.add(kGroup, entity_state(3), {}, seconds(1));
  aggregator.flush_all(nanoseconds(0), sent);
  ASSERT_EQ(sent.datagrams.size(), 3u);
  EXPECT_EQ(sent.datagrams[1].octets.size(), 144u + 1920u + 24u);
  EXPECT_EQ(aggregator.counts().oversized, 1u);
}

TEST(Aggregator, SendsPduThatGrewTooLongWhilePending) {
  Aggregator aggregator(config());
  Collector sent;
  const Octets parameters(255 * 16);
  pdu::EntityState big = entity_state(2);
  big.variable_parameters = parameters;
  aggregator.add(kGroup, entity_state(2), {}, seconds(1));
  EXPECT_EQ(aggregator.add(kGroup, big, {}, seconds(1)), AddResult::replaced);
  aggregator.flush_all(nanoseconds(0), sent);
  ASSERT_EQ(sent.datagrams.size(), 1u);
  EXPECT_EQ(sent.datagrams[0].octets.size(), 144u + 4080u + 24u);
}

TEST(Aggregator, NumbersTrailersPerGroupWithoutGaps) {
  Aggregator aggregator(config());
  aggregator.set_utc_offset(seconds(1000), true);
  Collector sent;
  for (std::uint16_t i = 0; i < 300; ++i) {
    aggregator.add(GroupIndex{static_cast<std::uint16_t>(i % 3)}, entity_state(i), {},
                   nanoseconds(0));
    aggregator.flush_due(milliseconds(i), sent);
  }
  std::map<GroupIndex, std::uint32_t> next;
  for (const Datagram& datagram : sent.datagrams) {
    const auto pdus = pdus_of(datagram);
    pdu::DatagramTrailer trailer;
    ASSERT_EQ(pdu::decode(pdus.back().bytes, trailer), pdu::DecodeError::none);
    EXPECT_EQ(trailer.sequence, ++next[datagram.group]);
    EXPECT_EQ(trailer.epoch, 0xCAFEu);
  }
  pdu::DatagramTrailer last;
  ASSERT_EQ(pdu::decode(pdus_of(sent.datagrams.back()).back().bytes, last), pdu::DecodeError::none);
  EXPECT_EQ(last.send_time, pdu::trailer_time(seconds(1000) + milliseconds(299)));
}

TEST(Aggregator, SendsAMarkBesideItsPdu) {
  const Octets mark = raw_pdu(pdu::PduType::assured_record, 288);
  for (std::size_t filler = 200; filler < 1200; filler += 50) {
    Aggregator aggregator(config());
    Collector sent;
    aggregator.add(kGroup, raw_pdu(pdu::PduType::cell_roles, filler), milliseconds(5));
    EXPECT_EQ(aggregator.add(kGroup, raw_pdu(pdu::PduType::fire, 238), milliseconds(0), mark),
              AddResult::queued);
    aggregator.add(kGroup, entity_state(1), {}, milliseconds(5));
    aggregator.flush_all(milliseconds(0), sent);
    std::size_t found = 0;
    for (const Datagram& datagram : sent.datagrams) {
      std::vector<std::size_t> sizes;
      for (const pdu::BundledPdu& bundled : pdus_of(datagram))
        sizes.push_back(bundled.bytes.size());
      const bool has_pdu = std::ranges::count(sizes, 250U) > 0;
      EXPECT_EQ(has_pdu, std::ranges::count(sizes, 300U) > 0) << filler;
      found += has_pdu ? 1 : 0;
      EXPECT_LE(datagram.octets.size(), kLimit) << filler;
    }
    EXPECT_EQ(found, 1U);
  }
  Aggregator interop(config());
  interop.set_interop(kInteropGroup, true);
  EXPECT_EQ(interop.add(kInteropGroup, raw_pdu(pdu::PduType::fire, 238), milliseconds(0), mark),
            AddResult::refused_kind);
}

TEST(Aggregator, AddsNoExtensionsToAnInteropGroup) {
  Aggregator aggregator(config());
  aggregator.set_interop(kInteropGroup, true);
  Collector sent;
  const Octets ours = raw_pdu(static_cast<pdu::PduType>(142), 20);
  EXPECT_EQ(aggregator.add(kInteropGroup, ours, nanoseconds(0)), AddResult::refused_kind);
  aggregator.add(kInteropGroup, entity_state(1), haptic_record(1.0F), nanoseconds(0));
  aggregator.flush_due(nanoseconds(0), sent);
  const auto pdus = pdus_of(sent.datagrams.at(0));
  ASSERT_EQ(pdus.size(), 2u);
  EXPECT_EQ(pdus.back().header.pdu_type, pdu::PduType::attribute);
}

TEST(Aggregator, ReportsWhyAnUpdateIsRefused) {
  AggregatorConfig small = config();
  small.waiting_limit = 1000;
  Aggregator aggregator(small);
  const auto now = nanoseconds(0);
  EXPECT_EQ(aggregator.add(GroupIndex{400}, entity_state(1), {}, now), AddResult::refused_group);
  EXPECT_EQ(aggregator.add(kGroup, Octets(5), now), AddResult::refused_kind);
  Octets wrong_length = encoded(entity_state(1));
  wrong_length.push_back(std::byte{0});
  EXPECT_EQ(aggregator.add(kGroup, wrong_length, now), AddResult::refused_kind);
  EXPECT_EQ(aggregator.add(kGroup, raw_pdu(pdu::PduType::attribute, 20), now),
            AddResult::refused_kind);
  EXPECT_EQ(aggregator.add(kGroup, raw_pdu(pdu::PduType::entity_state, 2), now),
            AddResult::refused_kind);
  Octets broken = haptic_record(1.0F);
  broken.resize(70);
  EXPECT_EQ(aggregator.add(kGroup, entity_state(1), broken, now), AddResult::refused_kind);
  EXPECT_EQ(aggregator.add(kGroup, raw_pdu(pdu::PduType::data, 65500), now),
            AddResult::refused_size);
  for (std::uint16_t i = 0; i < 6; ++i) {
    EXPECT_EQ(aggregator.add(kGroup, entity_state(i), {}, now), AddResult::queued);
  }
  EXPECT_EQ(aggregator.add(kGroup, entity_state(9), {}, now), AddResult::refused_full);
  EXPECT_EQ(aggregator.counts().refused, 8u);
  EXPECT_THROW(
      [] {
        AggregatorConfig tiny = config();
        tiny.payload_limit = 200;
        Aggregator unusable(tiny);
      }(),
      std::invalid_argument);
}

/// One random update into one of two groups; returns the group.
GroupIndex add_random(Aggregator& aggregator, std::mt19937_64& random, std::uint64_t& queued) {
  const GroupIndex group = random() % 2 == 0 ? kGroup : kInteropGroup;
  const nanoseconds deadline = milliseconds(random() % 20);
  const auto entity = static_cast<std::uint16_t>(random() % 40);
  Octets records;
  if (random() % 2 == 0) records = haptic_record(1.0F);
  if (random() % 3 == 0)
    records = records + energy_record(static_cast<std::uint16_t>(random() % 3), 1.0);
  const Octets parameters(16 * (random() % 4 == 0 ? random() % 100 : 0));
  pdu::EntityState state = entity_state(entity);
  state.variable_parameters = parameters;
  AddResult result = AddResult::refused_kind;
  switch (random() % 5) {
    case 0:
    case 1:
      result = aggregator.add(group, state, records, deadline);
      break;
    case 2:
      if (!records.empty())
        result = aggregator.add_records(group, state.entity_id, records, deadline);
      break;
    case 3:
      result = aggregator.add(group, raw_pdu(pdu::PduType::data, random() % 900), deadline);
      break;
    case 4:
      result =
          aggregator.add(group, raw_pdu(static_cast<pdu::PduType>(145), random() % 300), deadline);
      break;
  }
  queued += result == AddResult::queued ? 1 : 0;
  return group;
}

void check_bundle(const Datagram& datagram) {
  const auto pdus = pdus_of(datagram);
  const auto sets = records_of(datagram);
  std::set<pdu::EntityId> states;
  std::size_t attributes = 0, updates = 0;
  std::uint8_t rank = 0;
  for (const pdu::BundledPdu& bundled : pdus) {
    const std::uint8_t next = pdu::bundle_rank(bundled.header.pdu_type);
    EXPECT_GE(next, rank) << "out of order";
    rank = next;
    attributes += next == 2 ? 1 : 0;
    updates += next == 2 || next == 4 ? 0 : 1;
    if (next != 0) continue;
    pdu::EntityState state;
    ASSERT_EQ(pdu::decode(bundled.bytes, state), pdu::DecodeError::none);
    EXPECT_TRUE(states.insert(state.entity_id).second) << "two states of one entity";
    EXPECT_EQ(bundled.header.coupled_extension(), sets.contains(state.entity_id));
  }
  EXPECT_LE(attributes, 1u);
  EXPECT_EQ(rank == 4, datagram.group == kGroup) << "trailer exactly where there is no interop";
  if (datagram.group == kInteropGroup) {
    EXPECT_LE(rank, 2u);
  }
  if (datagram.octets.size() > kLimit) {
    EXPECT_LE(updates, 1u) << "an oversized PDU goes alone";
  }
}

TEST(Aggregator, KeepsBundleOrderForRandomUpdates) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    std::mt19937_64 random(seed);
    Aggregator aggregator(config());
    aggregator.set_interop(kInteropGroup, true);
    Collector sent;
    std::uint64_t queued = 0;
    nanoseconds now{0};
    for (int i = 0; i < 2000; ++i) {
      add_random(aggregator, random, queued);
      if (random() % 10 == 0) aggregator.flush_due(now += milliseconds(random() % 5), sent);
    }
    aggregator.flush_all(now, sent);

    // Every queued update that was not replaced is sent once.
    std::uint64_t left = 0;
    for (const Datagram& datagram : sent.datagrams) {
      check_bundle(datagram);
      const auto sets = records_of(datagram);
      std::set<pdu::EntityId> entities;
      for (const auto& [entity, records] : sets) entities.insert(entity);
      for (const pdu::BundledPdu& bundled : pdus_of(datagram)) {
        const std::uint8_t rank = pdu::bundle_rank(bundled.header.pdu_type);
        if (rank == 1 || rank == 3) ++left;
        if (rank != 0) continue;
        pdu::EntityState state;
        ASSERT_EQ(pdu::decode(bundled.bytes, state), pdu::DecodeError::none);
        entities.insert(state.entity_id);
      }
      left += entities.size();
    }
    EXPECT_EQ(left, queued) << "seed " << seed;
    EXPECT_EQ(aggregator.counts().datagrams, sent.datagrams.size());
  }
}

}  // namespace
}  // namespace reckon::aoim::aggregator_test
