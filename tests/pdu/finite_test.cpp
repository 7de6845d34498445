// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/pdu/finite.hpp"

#include <gtest/gtest.h>

#include <array>
#include <limits>

#include "reckon/pdu/pdu_types.hpp"
#include "reckon/tests/support/wire_samples.hpp"

namespace reckon::pdu {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

TEST(Finite, NamesTheFirstFieldThatIsNot) {
  EntityState pdu;
  EXPECT_TRUE(all_finite(pdu));
  pdu.dead_reckoning.angular_velocity.z = kNan;
  EXPECT_EQ(first_not_finite(pdu), "dead_reckoning_parameters");
  pdu.location.x = std::numeric_limits<double>::infinity();
  EXPECT_EQ(first_not_finite(pdu), "entity_location");
}

TEST(Finite, LooksIntoArticulatedParts) {
  std::array<std::byte, 16> record{};
  ArticulatedPart part;
  part.parameter_value = kNan;
  ASSERT_EQ(store_record(part, record), 16U);
  EntityState pdu;
  pdu.variable_parameters = record;
  EXPECT_EQ(first_not_finite(pdu), "variable_parameters");
}

TEST(Finite, LooksIntoHapticRecords) {
  std::array<std::byte, 128> buffer;
  AttributeWriter writer(buffer, Attribute{});
  HapticRecord haptic;
  haptic.k1 = kNan;
  ASSERT_TRUE(writer.begin_set({1, 2, 3}) && writer.add(haptic));
  Attribute pdu;
  ASSERT_EQ(decode(std::span(buffer).first(writer.finish()), pdu), DecodeError::none);
  EXPECT_EQ(first_not_finite(pdu), "attribute_record_sets");
}

}  // namespace
}  // namespace reckon::pdu
