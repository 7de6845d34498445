// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/pdu/entity/attribute.hpp"

#include <gtest/gtest.h>

#include <array>
#include <vector>

#include "reckon/tests/pdu/support/guarded_buffer.hpp"
#include "reckon/tests/support/allocation_guard.hpp"
#include "reckon/tests/support/wire_samples.hpp"

namespace reckon::pdu {
namespace {

Attribute decoded(std::span<const std::byte> octets) {
  Attribute pdu;
  EXPECT_EQ(decode(octets, pdu), DecodeError::none);
  return pdu;
}

HapticRecord sphere() {
  HapticRecord record;
  record.kind = ForceModelKind::sphere;
  record.order = 3;
  record.surface = 17;
  record.validity_ms = 12000;
  record.grip_stiffness = 170;
  record.k1 = 800.0F;
  record.k3 = 2.5e6F;
  record.damping = 1.5F;
  record.mass = 0.25F;
  record.point = {0.01F, -0.02F, 0.03F};
  record.normal = {0.0F, 0.0F, -1.0F};
  record.static_friction = 0.5F;
  record.kinetic_friction = 0.25F;
  record.restitution = 0.75F;
  record.radius = 0.0625F;
  return record;
}

EnergyAccountRecord account() {
  EnergyAccountRecord record;
  record.counterpart = {200, 1, 9};
  record.given = 0.001953125;
  record.need = 500;
  record.spring_need = 7500;
  return record;
}

OwnershipRecord ownership() {
  OwnershipRecord record;
  record.owner = 0xA1B2C3D4;
  record.version = 0x100000002;
  return record;
}

std::array<std::byte, 10> vendor_body() {
  std::array<std::byte, 10> body;
  for (std::size_t i = 0; i < body.size(); ++i) body[i] = static_cast<std::byte>(i);
  return body;
}

Attribute sample_header() {
  Attribute pdu;
  pdu.header.exercise_id = 3;
  pdu.header.timestamp = 0x12345679;
  pdu.originating_simulation = {100, 7};
  return pdu;
}

TEST(AttributeWriter, BuildsTheGoldenSampleInPlace) {
  std::array<std::byte, 256> buffer;
  AttributeWriter writer(buffer, sample_header());
  ASSERT_TRUE(writer.begin_set({100, 7, 3}));
  ASSERT_TRUE(writer.add(sphere()));
  ASSERT_TRUE(writer.add(account()));
  ASSERT_TRUE(writer.begin_set({100, 7, 4}));
  ASSERT_TRUE(writer.add(252000, vendor_body()));
  ASSERT_TRUE(writer.begin_set({65534, 1, 2}));
  ASSERT_TRUE(writer.add(ownership()));

  const auto expected = test::sample_octets("attribute");
  ASSERT_EQ(writer.finish(), expected.size());
  EXPECT_EQ(std::vector<std::byte>(buffer.begin(), buffer.begin() + 192), expected);
}

TEST(AttributeReader, GivesTheRecordsOfEachEntity) {
  const auto octets = test::sample_octets("attribute");
  const Attribute pdu = decoded(octets);
  std::vector<std::pair<EntityId, std::uint32_t>> seen;
  for (const AttributeSet& set : AttributeReader(pdu))
    for (const AttributeRecord& record : set.records())
      seen.emplace_back(set.entity_id, record.type);
  const std::vector<std::pair<EntityId, std::uint32_t>> expected{
      {{100, 7, 3}, kHapticRecordType},
      {{100, 7, 3}, kEnergyAccountRecordType},
      {{100, 7, 4}, 252000},
      {{65534, 1, 2}, kOwnershipRecordType}};
  EXPECT_EQ(seen, expected);
}

TEST(AttributeReader, GivesAnUnknownRecordAsTypeAndOctets) {
  const auto octets = test::sample_octets("attribute");
  const Attribute pdu = decoded(octets);
  for (const AttributeSet& set : AttributeReader(pdu)) {
    if (set.entity_id != EntityId{100, 7, 4}) continue;
    const AttributeRecord record = *set.records().begin();
    EXPECT_EQ(record.length, 16);
    EXPECT_EQ(record.body().size(), 10U);
    EXPECT_EQ(visit_attribute_record(record, [](const auto&) { FAIL(); }),
              DecodeError::unknown_type);
  }
}

TEST(HapticRecord, RestoresItsCoefficients) {
  const auto octets = test::sample_octets("attribute");
  const Attribute pdu = decoded(octets);
  const AttributeSet set = *AttributeReader(pdu).begin();
  HapticRecord haptic;
  ASSERT_EQ(decode(*set.records().begin(), haptic), DecodeError::none);
  EXPECT_EQ(haptic.kind, ForceModelKind::sphere);
  EXPECT_EQ(haptic.validity_ms, 12000);
  EXPECT_EQ(haptic.k3, 2.5e6F);
  EXPECT_EQ(haptic.point, (Vector3Float{0.01F, -0.02F, 0.03F}));
  EXPECT_EQ(haptic.radius, 0.0625F);
}

// One record in a set of one entity, from raw octets.
AttributeRecord first_record(const Attribute& pdu) {
  return *(*AttributeReader(pdu).begin()).records().begin();
}

TEST(HapticRecord, IsRefusedInAnUnknownVersion) {
  auto octets = test::sample_octets("attribute");
  octets[32 + 8 + 6] = std::byte{2};
  HapticRecord haptic;
  EXPECT_EQ(decode(first_record(decoded(octets)), haptic), DecodeError::version);
}

TEST(HapticRecord, IsRefusedWhenItsRecordIsShort) {
  std::array<std::byte, 128> buffer;
  AttributeWriter writer(buffer, Attribute{});
  const std::array<std::byte, 58> body{};
  ASSERT_TRUE(writer.begin_set({1, 2, 3}));
  ASSERT_TRUE(writer.add(kHapticRecordType, body));
  HapticRecord haptic;
  EXPECT_EQ(decode(first_record(decoded(std::span(buffer).first(writer.finish()))), haptic),
            DecodeError::length);
}

TEST(HapticRecord, IsReadFromALongerRecord) {
  std::array<std::byte, 256> buffer;
  std::array<std::byte, 98> body{};
  body[0] = std::byte{HapticRecord::kVersion};
  AttributeWriter writer(buffer, Attribute{});
  ASSERT_TRUE(writer.begin_set({1, 2, 3}));
  ASSERT_TRUE(writer.add(kHapticRecordType, body));
  HapticRecord haptic;
  EXPECT_EQ(decode(first_record(decoded(std::span(buffer).first(writer.finish()))), haptic),
            DecodeError::none);
  EXPECT_EQ(haptic.length, 104);
}

TEST(HapticRecord, IsNotReadFromAnotherRecordType) {
  const auto octets = test::sample_octets("attribute");
  EnergyAccountRecord energy;
  EXPECT_EQ(decode(first_record(decoded(octets)), energy), DecodeError::pdu_type);
}

TEST(OwnershipRecord, RestoresOwnerAndVersion) {
  const auto octets = test::sample_octets("attribute");
  OwnershipRecord read;
  std::size_t found = 0;
  const Attribute pdu = decoded(octets);
  for (const AttributeSet& set : AttributeReader(pdu))
    for (const AttributeRecord& record : set.records())
      found += decode(record, read) == DecodeError::none ? 1 : 0;
  EXPECT_EQ(found, 1U);
  EXPECT_EQ(read.owner, 0xA1B2C3D4U);
  EXPECT_EQ(read.version, 0x100000002U);
}

TEST(AttributeWriter, RefusesARecordBeforeTheFirstSet) {
  std::array<std::byte, 256> buffer;
  AttributeWriter writer(buffer, Attribute{});
  EXPECT_FALSE(writer.add(sphere()));
  EXPECT_EQ(writer.finish(), 0U);
}

TEST(AttributeWriter, StaysIntactWhenARecordDoesNotFit) {
  std::array<std::byte, 32 + 8 + 72 + 23> buffer;
  AttributeWriter writer(buffer, Attribute{});
  ASSERT_TRUE(writer.begin_set({1, 2, 3}));
  ASSERT_TRUE(writer.add(sphere()));
  EXPECT_FALSE(writer.add(account()));
  EXPECT_FALSE(writer.add(5, vendor_body()) && writer.add(5, vendor_body()));
  const Attribute pdu = decoded(std::span(buffer).first(writer.finish()));
  EXPECT_EQ((*AttributeReader(pdu).begin()).count, 2);
}

TEST(AttributeWriter, NeverWritesBeyondItsBuffer) {
  test::GuardedBuffer guarded;
  for (std::size_t size = 0; size < 220; ++size) {
    const std::vector<std::byte> zeros(size);
    AttributeWriter writer(guarded.hold(zeros), Attribute{});
    static_cast<void>(writer.begin_set({1, 2, 3}));
    while (writer.add(sphere()) || writer.add(account()) || writer.add(5, {})) {
    }
    EXPECT_LE(writer.finish(), size);
  }
}

TEST(AttributeWriter, AllocatesNothing) {
  std::array<std::byte, 256> buffer;
  const test::AllocationGuard guard;
  AttributeWriter writer(buffer, Attribute{});
  const bool good = writer.begin_set({1, 2, 3}) && writer.add(sphere()) && writer.add(account());
  Attribute pdu;
  const DecodeError error = decode(std::span(buffer).first(writer.finish()), pdu);
  HapticRecord haptic;
  const DecodeError record_error = decode(first_record(pdu), haptic);
  const std::size_t allocations = guard.count();
  EXPECT_TRUE(good);
  EXPECT_EQ(error, DecodeError::none);
  EXPECT_EQ(record_error, DecodeError::none);
  EXPECT_EQ(allocations, 0U);
}

// Malformed samples: each has one wrong field.
struct Trap {
  const char* what;
  std::size_t offset;
  std::uint16_t value;
  DecodeError error;
};

class AttributeTraps : public testing::TestWithParam<Trap> {};

TEST_P(AttributeTraps, AreRefused) {
  auto octets = test::sample_octets("attribute");
  store_big_endian(octets.data() + GetParam().offset, GetParam().value);
  test::GuardedBuffer buffer;
  Attribute pdu;
  EXPECT_EQ(decode(buffer.hold(octets), pdu), GetParam().error) << GetParam().what;
}
INSTANTIATE_TEST_SUITE_P(Lies, AttributeTraps,
                         testing::Values(Trap{"65535 sets", 30, 65535, DecodeError::count},
                                         Trap{"4 sets", 30, 4, DecodeError::count},
                                         Trap{"65535 records", 38, 65535, DecodeError::record},
                                         Trap{"record of length 0", 44, 0, DecodeError::record},
                                         Trap{"record of length 5", 44, 5, DecodeError::record},
                                         Trap{"record of length 65535", 44, 65535,
                                              DecodeError::record}));

}  // namespace
}  // namespace reckon::pdu
