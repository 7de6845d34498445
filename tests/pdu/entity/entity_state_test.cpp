// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/pdu/entity/entity_state.hpp"

#include <gtest/gtest.h>

#include <array>
#include <string>
#include <vector>

#include "reckon/pdu/codec/record_range.hpp"
#include "reckon/tests/support/wire_samples.hpp"

namespace reckon::pdu {
namespace {

TEST(EntityState, TakesTheOctetsOfTheStandard) {
  EXPECT_EQ(kFixedSize<EntityState>, 144U);
  EXPECT_EQ(wire_size(EntityState{}), 144U);
}

class EntityStateVersions : public testing::TestWithParam<int> {};

TEST_P(EntityStateVersions, ReadAsTheSameLayout) {
  auto octets = test::sample_octets("entity_state");
  octets[0] = static_cast<std::byte>(GetParam());
  EntityState pdu;
  ASSERT_EQ(decode(octets, pdu), DecodeError::none);
  EXPECT_EQ(pdu.header.protocol_version, GetParam());
  EXPECT_EQ(pdu.entity_id, (EntityId{100, 7, 3}));
  EXPECT_EQ(pdu.location.x, 4437345.6789);
}
INSTANTIATE_TEST_SUITE_P(Dis5To7, EntityStateVersions, testing::Values(5, 6, 7));

TEST(EntityState, RefusesProtocolVersionsItDoesNotKnow) {
  auto octets = test::sample_octets("entity_state");
  for (const int version : {0, 1, 4, 8, 99, 255}) {
    octets[0] = static_cast<std::byte>(version);
    EntityState pdu;
    EXPECT_EQ(decode(octets, pdu), DecodeError::version) << version;
  }
}

TEST(EntityState, RefusesMoreVariableParametersThanItHasOctets) {
  auto octets = test::sample_octets("entity_state");
  EntityState pdu;
  for (const int announced : {3, 128, 255}) {
    octets[19] = static_cast<std::byte>(announced);
    EXPECT_EQ(decode(octets, pdu), DecodeError::count) << announced;
  }
}

TEST(EntityState, KeepsVariableParametersAsViewIntoTheInput) {
  const auto octets = test::sample_octets("entity_state");
  EntityState pdu;
  ASSERT_EQ(decode(octets, pdu), DecodeError::none);
  EXPECT_EQ(pdu.variable_parameters.data(), octets.data() + 144);
  EXPECT_EQ(pdu.variable_parameters.size(), 32U);
}

TEST(EntityState, DistinguishesFrozenDeactivatedAndCoupled) {
  const auto octets = test::sample_octets("entity_state");
  EntityState pdu;
  ASSERT_EQ(decode(octets, pdu), DecodeError::none);
  EXPECT_EQ(pdu.appearance, kAppearanceFrozen | kAppearanceDeactivated | 1U);
  EXPECT_TRUE(pdu.header.coupled_extension());
}

TEST(EntityMarking, TruncatesTextBeyondElevenCharacters) {
  EntityMarking marking;
  marking.set("HAND-OF-GOD-2");
  EXPECT_EQ(marking.view(), "HAND-OF-GOD");
  marking.set("A");
  EXPECT_EQ(marking.view(), "A");
  EXPECT_EQ(marking.text[10], '\0');
}

TEST(VariableParameter, KnowsStandardKindsAndKeepsOthersAsOctets) {
  int known = 0;
  int unknown = 0;
  for (int type = 0; type < 256; ++type) {
    std::array<std::byte, 16> record{static_cast<std::byte>(type)};
    visit_variable_parameter(record, [&](const auto& typed) {
      const bool raw = std::is_same_v<std::decay_t<decltype(typed)>, VariableParameter>;
      (raw ? unknown : known) += 1;
      EXPECT_EQ(static_cast<int>(typed.record_type), type);
    });
  }
  EXPECT_EQ(known, 5);
  EXPECT_EQ(unknown, 251);
}

TEST(VariableParameter, CallsNothingForACutRecord) {
  const std::array<std::byte, 15> record{};
  visit_variable_parameter(record, [](const auto&) { FAIL(); });
}

TEST(VariableParameter, ReadsAnArticulatedPart) {
  const auto octets = test::sample_octets("entity_state");
  EntityState pdu;
  ASSERT_EQ(decode(octets, pdu), DecodeError::none);
  ArticulatedPart part;
  ASSERT_TRUE(load_record(pdu.variable_parameters, part));
  EXPECT_EQ(part.parameter_type, 4107U);
  EXPECT_EQ(part.parameter_value, 0.75F);
}

}  // namespace
}  // namespace reckon::pdu
