// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The table of emissions by entity and time: merges, expiry, and the limits for strangers.
#include "reckon/peer/emissions/emission_table.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

#include "reckon/tests/support/allocation_guard.hpp"
#include "reckon/tests/support/emission_samples.hpp"

namespace reckon::peer::emission_table_test {
namespace {

using namespace std::chrono_literals;
using std::chrono::nanoseconds;
using test::SampleSystem;

constexpr pdu::EntityId kShip{1, 1, 9};

aoim::SourceAddress host(std::uint8_t number) {
  return {{0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0xFF, 0xFF, 10, 0, 0, number}, 3000};
}

template <typename Pdu>
std::vector<std::byte> octets_of(const Pdu& pdu) {
  std::vector<std::byte> octets(wire_size(pdu));
  EXPECT_GT(encode(pdu, octets), 0U);
  return octets;
}

struct Emissions : ::testing::Test {
  void take(const std::vector<std::byte>& pdu, nanoseconds now, std::uint8_t from = 1,
            bool guest = true, bool owns = false) {
    table.take(pdu, {host(from), now, guest, owns});
  }
  void emit(const std::vector<SampleSystem>& systems, nanoseconds now, std::uint8_t changes = 0,
            std::uint8_t version = 7) {
    take(test::emission_pdu(kShip, systems, changes, version), now);
  }
  const Emission* row(Emission::Kind kind, std::uint16_t number) const {
    const auto found = std::ranges::find_if(table.rows(), [&](const Emission& row) {
      return row.kind() == kind && row.number == number;
    });
    return found == table.rows().end() ? nullptr : &*found;
  }
  const EmitterState& system(std::uint16_t number) const {
    return std::get<EmitterState>(row(Emission::Kind::emitter, number)->state);
  }
  std::size_t rows_of(std::uint16_t application) const {
    return static_cast<std::size_t>(std::ranges::count_if(
        table.rows(), [&](const Emission& row) { return row.entity.application == application; }));
  }
  EmissionTable table{64};
};

TEST_F(Emissions, KeepSystemsWithAndWithoutBeams) {
  for (const std::uint8_t version : {std::uint8_t{6}, std::uint8_t{7}}) {
    emit(test::kThreeSystems, 1s * version, 0, version);
    ASSERT_EQ(table.rows().size(), 3U);
    EXPECT_EQ(system(1).count, 0);
    EXPECT_FALSE(row(Emission::Kind::emitter, 1)->emits());
    ASSERT_EQ(system(2).count, 2);
    EXPECT_EQ(system(2).system.name, 1002);
    EXPECT_EQ(system(2).beams[0].known_targets().size(), 1U);
    EXPECT_EQ(system(2).beams[0].known_targets()[0].entity_id, (pdu::EntityId{2, 1, 100}));
    EXPECT_EQ(system(2).beams[1].known_targets().size(), 0U);
    EXPECT_EQ(system(2).beams[1].beam.frequency, 9.4e9F);
    ASSERT_EQ(system(3).count, 1);
    EXPECT_EQ(system(3).beams[0].known_targets()[1].entity_id, (pdu::EntityId{2, 1, 101}));
    EXPECT_TRUE(row(Emission::Kind::emitter, 3)->emits());
    EXPECT_EQ(row(Emission::Kind::emitter, 3)->since, 6s) << "of the first PDU";
  }
}

TEST_F(Emissions, MergeChangedDataBeamByBeam) {
  emit(test::kThreeSystems, 1s);
  emit({{2, {{2, 3}, {5, 0}}}}, 2s, 1);
  ASSERT_EQ(system(2).count, 3);
  EXPECT_EQ(system(2).beams[0].known_targets().size(), 1U) << "was not in the PDU";
  EXPECT_EQ(system(2).beams[1].known_targets().size(), 3U);
  EXPECT_EQ(system(2).beams[1].since, 1s) << "it was active before";
  EXPECT_EQ(system(2).beams[2].since, 2s);
  EXPECT_EQ(system(3).count, 1) << "was not in the PDU";
  emit({{2, {{5, 0, 1}}}}, 3s, 1);
  EXPECT_FALSE(system(2).beams[2].is_active());
  EXPECT_EQ(system(2).beams[2].since, 3s);
  EXPECT_EQ(row(Emission::Kind::emitter, 2)->since, 1s) << "other beams are on";
}

TEST_F(Emissions, ReplaceAllBeamsByAFullUpdate) {
  emit(test::kThreeSystems, 1s);
  emit({{2, {{7, 0}}}}, 2s);
  ASSERT_EQ(system(2).count, 1);
  EXPECT_EQ(system(2).beams[0].beam.beam_number, 7);
  emit({{3}}, 3s, 1);
  EXPECT_EQ(system(3).count, 0) << "changed to no beam";
  EXPECT_EQ(row(Emission::Kind::emitter, 3)->since, 3s);
}

TEST_F(Emissions, HoldIffCodesAndRadios) {
  pdu::Iff iff;
  iff.header.protocol_version = 7;
  iff.emitting_entity_id = kShip;
  iff.system_type = 1;
  iff.system_status = 1;
  iff.parameter_3 = 0xA000 | 01274;
  take(octets_of(iff), 1s);
  iff.system_type = 2;
  iff.system_status = 0;
  take(octets_of(iff), 1s);
  pdu::Transmitter radio;
  radio.header.protocol_version = 7;
  radio.radio_reference_id = kShip;
  radio.radio_number = 4;
  radio.transmit_state = 1;
  radio.frequency = 251'000'000;
  take(octets_of(radio), 1s);
  radio.transmit_state = 2;
  take(octets_of(radio), 3s);
  EXPECT_EQ(table.rows().size(), 3U) << "transponder and interrogator apart";
  EXPECT_EQ(row(Emission::Kind::radio, 4)->since, 3s) << "on the air";

  std::vector<EntityView> views(2);
  views[0].id = {1, 1, 8};
  views[1].id = kShip;
  emit(test::kThreeSystems, 3s);
  table.summarise(views);
  EXPECT_FALSE(views[0].emits.any());
  const EmittedView& emits = views[1].emits;
  EXPECT_EQ(emits.emitters, 3);
  EXPECT_EQ(emits.beams, 3);
  EXPECT_EQ(emits.targets, 3);
  EXPECT_EQ(emits.iff, 2);
  EXPECT_EQ(emits.iff_on, 1);
  EXPECT_EQ(emits.mode_3a & 0xFFF, 01274);
  EXPECT_EQ(emits.transmitting, 1);
  EXPECT_EQ(emits.radio_hz, 251e6);
}

TEST_F(Emissions, ExpireAfterTwoHeartbeats) {
  pdu::Transmitter radio;
  radio.header.protocol_version = 7;
  radio.radio_reference_id = kShip;
  emit(test::kThreeSystems, 0s);
  take(octets_of(radio), 0s);
  table.expire(4800ms);
  EXPECT_EQ(table.rows().size(), 4U);
  table.expire(4801ms);
  EXPECT_EQ(table.rows().size(), 3U) << "2.4 times 2 s";
  emit({{1}}, 10s);
  table.expire(24'001ms);
  ASSERT_EQ(table.rows().size(), 1U) << "2.4 times 10 s";
  EXPECT_EQ(table.rows()[0].number, 1);
  emit({{1, {{1, 0}}}}, 40s, 1);
  EXPECT_EQ(row(Emission::Kind::emitter, 1)->since, 40s) << "begins anew";
}

TEST_F(Emissions, BelongToTheHostThatSentThem) {
  emit({{1, {{1, 0}}}}, 1s);
  take(test::emission_pdu(kShip, {{1}}), 2s, 2);
  EXPECT_EQ(system(1).count, 1);
  EXPECT_EQ(table.refusals().disputed, 1U);
  take(test::emission_pdu(kShip, {{2}}), 3s, 2, false, true);
  ASSERT_EQ(table.rows().size(), 1U) << "the owner of the entity";
  EXPECT_EQ(table.rows()[0].number, 2);
  table.drop(kShip.simulation());
  EXPECT_TRUE(table.rows().empty());
}

TEST_F(Emissions, BoundSystemsBeamsAndTargetsOfAnEntity) {
  std::vector<SampleSystem> systems;
  for (std::uint8_t i = 0; i < 40; ++i) systems.push_back({i});
  emit(systems, 1s);
  EXPECT_EQ(table.rows().size(), EmissionTable::kRowsOfEntity);
  EXPECT_EQ(table.refusals().no_room, 24U);
  SampleSystem wide{0};
  for (std::uint8_t i = 0; i < 12; ++i) wide.beams.push_back({i, 14});
  emit({wide}, 2s);
  EXPECT_EQ(system(0).count, EmitterState::kBeams);
  EXPECT_EQ(system(0).left_out, 4);
  EXPECT_EQ(system(0).beams[0].known_targets().size(), EmittedBeam::kTargets);
}

TEST_F(Emissions, ShareAFullTableAmongHosts) {
  for (std::uint16_t i = 0; i < 200; ++i) take(test::emission_pdu({1, 1, i}, {{1}}), 1s, 1);
  EXPECT_EQ(table.rows().size(), 64U);
  EXPECT_EQ(table.refusals().no_room, 136U);
  for (std::uint16_t i = 0; i < 200; ++i) take(test::emission_pdu({1, 2, i}, {{1}}), 1s, 2);
  EXPECT_EQ(rows_of(1), 32U);
  EXPECT_EQ(rows_of(2), 32U);
  for (std::uint16_t i = 0; i < 64; ++i) take(test::emission_pdu({1, 3, i}, {{1}}), 1s, 3, false);
  EXPECT_EQ(rows_of(3), 64U) << "a peer goes before guests";
}

TEST_F(Emissions, TakeAnyOctetsWithoutAllocating) {
  std::mt19937_64 random(7);
  std::vector<std::vector<std::byte>> pdus;
  for (int i = 0; i < 2000; ++i) {
    auto pdu = test::emission_pdu({1, 1, static_cast<std::uint16_t>(random() % 8)},
                                  test::kThreeSystems, random() % 2, random() % 2 ? 6 : 7);
    pdu[random() % pdu.size()] = static_cast<std::byte>(random());
    pdu.resize(pdu.size() - random() % 3 * (random() % pdu.size()) / 3);
    pdus.push_back(std::move(pdu));
  }
  const test::AllocationGuard guard;
  for (std::size_t i = 0; i < pdus.size(); ++i) {
    const nanoseconds now = 1s * i / 10;
    table.take(pdus[i], {host(static_cast<std::uint8_t>(i % 5)), now, i % 3 > 0, i % 7 == 0});
    table.expire(now);
  }
  EXPECT_EQ(guard.count(), 0U);
  EXPECT_GT(table.refusals().damaged, 0U);
  EXPECT_LE(table.rows().size(), 64U);
}

}  // namespace
}  // namespace reckon::peer::emission_table_test
