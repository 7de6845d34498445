// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Fields that are present or absent by flag octets. The octets are written by hand.
#include "reckon/pdu/live_entity/live_entity.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "reckon/pdu/live_entity/appearance.hpp"
#include "reckon/pdu/live_entity/le_detonation.hpp"
#include "reckon/pdu/live_entity/le_fire.hpp"
#include "reckon/pdu/live_entity/tspi.hpp"
#include "reckon/tests/support/wire_samples.hpp"

namespace reckon::pdu {
namespace {

// A PDU of DIS 7 from its type and the octets after its header.
std::vector<std::byte> with_header(PduType type, const std::string& hex) {
  auto octets = test::octets_from_hex("07 01 00 0b 00 00 00 00 00 00 00 00" + hex);
  store_big_endian(octets.data() + 2, type);
  store_big_endian(octets.data() + 8, static_cast<std::uint16_t>(octets.size()));
  return octets;
}

template <typename T>
std::vector<std::byte> encoded(const T& pdu) {
  std::vector<std::byte> octets(wire_size(pdu));
  EXPECT_EQ(encode(pdu, octets), octets.size());
  return octets;
}

TEST(Tspi, WithoutFlagsHasItsIdAndLocation) {
  const auto octets = with_header(PduType::tspi, "01 02 00 03 00 0007 0010 fff0 8000");
  Tspi pdu;
  ASSERT_EQ(decode(octets, pdu), DecodeError::none);
  EXPECT_EQ(pdu.live_entity_id.entity, 3);
  EXPECT_EQ(pdu.entity_location.reference_point, 7);
  EXPECT_EQ(pdu.entity_location.delta_y, -16);
  EXPECT_EQ(pdu.entity_location.delta_z, -32768);
  EXPECT_EQ(encoded(pdu), octets);
}

TEST(Tspi, HasExactlyTheFieldsOfItsFlags) {
  // Bits 0, 1 and 5: linear velocity, orientation, measured speed.
  const auto octets =
      with_header(PduType::tspi, "01 02 00 03 23 0007 0010 fff0 0001 000a fff6 0000 01 02 ff 0100");
  Tspi pdu;
  pdu.position_error.vertical_error = 9;
  ASSERT_EQ(decode(octets, pdu), DecodeError::none);
  EXPECT_EQ(pdu.entity_linear_velocity.y, -10);
  EXPECT_EQ(pdu.entity_orientation.phi, -1);
  EXPECT_EQ(pdu.measured_speed, 256);
  EXPECT_EQ(pdu.position_error.vertical_error, 0) << "an absent field is as newly made";
  EXPECT_EQ(encoded(pdu), octets);
}

TEST(Tspi, RefusesSystemSpecificDataBeyondTheEnd) {
  const auto good = with_header(PduType::tspi, "01 02 00 03 40 0007 0010 fff0 0001 02 aabb");
  Tspi pdu;
  ASSERT_EQ(decode(good, pdu), DecodeError::none);
  EXPECT_EQ(pdu.system_specific_data.bytes.size(), 2U);
  const auto bad = with_header(PduType::tspi, "01 02 00 03 40 0007 0010 fff0 0001 03 aabb");
  EXPECT_EQ(decode(bad, pdu), DecodeError::count);
}

TEST(Appearance, HasASecondFlagOctetByTheFirst) {
  // Bits 0 and 7: force, second flag octet. Bit 1 of the second: acoustic appearance.
  const auto both = with_header(PduType::appearance, "01 02 00 03 81 02 03 12345678");
  Appearance pdu;
  ASSERT_EQ(decode(both, pdu), DecodeError::none);
  EXPECT_EQ(static_cast<unsigned>(pdu.force_id), 3U);
  EXPECT_EQ(pdu.acoustic_appearance, 0x12345678U);
  EXPECT_EQ(encoded(pdu), both);

  const auto one = with_header(PduType::appearance, "01 02 00 03 01 03");
  ASSERT_EQ(decode(one, pdu), DecodeError::none);
  EXPECT_EQ(pdu.acoustic_appearance, 0U);
  EXPECT_EQ(encoded(pdu), one);
}

TEST(LeFire, OmitsAddressesOfTheFiringEntity) {
  // Bit 2: munition id, without its address (bit 1), as the event id is without its own (bit 3).
  const auto octets = with_header(
      PduType::le_fire, "01 02 012c 04 01f4 002a 02 02 00e1 02 01 00 00 0001 0002 fffd 03e8");
  LeFire pdu;
  ASSERT_EQ(decode(octets, pdu), DecodeError::none);
  EXPECT_EQ(pdu.shot.munition_number, 500);
  EXPECT_EQ(pdu.shot.event_number, 42);
  EXPECT_EQ(pdu.shot.munition_type.country, 225);
  EXPECT_EQ(pdu.shot.warhead, 0);
  EXPECT_EQ(pdu.velocity.z, -3);
  EXPECT_EQ(pdu.range, 1000);
  EXPECT_EQ(encoded(pdu), octets);
}

TEST(LeFire, IgnoresAnAddressFlagWithoutAMunitionId) {
  const auto octets = with_header(PduType::le_fire,
                                  "01 02 012c 02 002a 02 02 00e1 02 01 00 00 0001 0002 fffd 03e8");
  LeFire pdu;
  ASSERT_EQ(decode(octets, pdu), DecodeError::none);
  EXPECT_EQ(pdu.shot.event_number, 42);
  EXPECT_EQ(encoded(pdu), octets);
}

TEST(LeDetonation, HasItsLocationInFlaggedAxes) {
  const auto in_world =
      with_header(PduType::le_detonation,
                  "01 02 012c 00 0007 0001 fffe 0003 0004 0005 0006 02 02 00e1 02 01 00 00 05");
  LeDetonation pdu;
  ASSERT_EQ(decode(in_world, pdu), DecodeError::none);
  EXPECT_EQ(pdu.world_location.delta_y, -2);
  EXPECT_EQ(pdu.velocity.x, 4);
  EXPECT_EQ(pdu.detonation_result, 5);
  EXPECT_EQ(encoded(pdu), in_world);

  const auto in_target = with_header(
      PduType::le_detonation,
      "01 02 012c 41 09 09 0384 0004 0005 0006 02 02 00e1 02 01 00 00 000a 000b 000c 05");
  ASSERT_EQ(decode(in_target, pdu), DecodeError::none);
  EXPECT_EQ(pdu.shot.target_id.entity, 900);
  EXPECT_EQ(pdu.entity_location.z, 12);
  EXPECT_EQ(pdu.world_location.delta_y, 0);
  EXPECT_EQ(encoded(pdu), in_target);
}

TEST(LeDetonation, ReadsOneOctetAnglesForLackOfRoom) {
  // Bit 7 of the first flags, bit 0 of the second: munition orientation.
  const std::string head = "01 02 012c 80 01 0007 0001 0002 0003 0004 0005 0006";
  const std::string tail = "02 02 00e1 02 01 00 00 05";
  const auto wide = with_header(PduType::le_detonation, head + "0101 0202 ff00" + tail);
  LeDetonation pdu;
  ASSERT_EQ(decode(wide, pdu), DecodeError::none);
  EXPECT_FALSE(pdu.short_orientation);
  EXPECT_EQ(pdu.munition_orientation.psi, 0x0101);
  EXPECT_EQ(pdu.munition_orientation.phi, -256);
  EXPECT_EQ(pdu.detonation_result, 5);
  EXPECT_EQ(encoded(pdu), wide);

  const auto narrow = with_header(PduType::le_detonation, head + "01 02 ff" + tail);
  ASSERT_EQ(decode(narrow, pdu), DecodeError::none);
  EXPECT_TRUE(pdu.short_orientation);
  EXPECT_EQ(pdu.short_munition_orientation.phi, -1);
  EXPECT_EQ(pdu.detonation_result, 5);
  EXPECT_EQ(encoded(pdu), narrow);
}

}  // namespace
}  // namespace reckon::pdu
