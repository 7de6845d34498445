// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Readable values of fields, in the tree and in JSON with names.
#include "reckon/pdu/field_readings.hpp"

#include <gmock/gmock.h>

#include <cstdint>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>

#include "reckon/pdu/print.hpp"
#include "reckon/pdu/timestamp.hpp"

namespace reckon::pdu::field_readings_test {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;
using ::testing::Not;

template <typename Pdu>
std::string tree(const Pdu& pdu) {
  std::string text;
  TextSink sink(text);
  print_tree(pdu, sink);
  return text;
}
template <typename Pdu>
json named(const Pdu& pdu) {
  std::string text;
  TextSink sink(text);
  print_named_json(pdu, sink);
  return json::parse(text);
}
template <typename Pdu>
json plain(const Pdu& pdu) {
  std::string text;
  TextSink sink(text);
  print_json(pdu, sink);
  return json::parse(text);
}

TEST(Readings, OfATimestampAreMinutesAndSeconds) {
  EntityState pdu;
  pdu.header.timestamp = 305419897;
  EXPECT_THAT(tree(pdu), HasSubstr(" (past_the_hour 04:15.999999, clock absolute)"));
  pdu.header.timestamp = to_dis_timestamp(std::chrono::milliseconds(5), false);
  const json read = named(pdu)["header"]["timestamp_read"];
  EXPECT_EQ(read["clock"], "relative");
  EXPECT_THAT(read["past_the_hour"].get<std::string>(), ::testing::StartsWith("00:00.00"));
  EXPECT_TRUE(named(pdu)["header"]["timestamp"].is_number());
  EXPECT_FALSE(plain(pdu)["header"].contains("timestamp_read"));
}

TEST(Readings, OfAnEntityAreItsPlaceAndAttitude) {
  EntityState pdu;
  pdu.location = {6378237.0, 0, 0};
  pdu.orientation = {1.5707964F, 0, -1.5707964F};  // level, to the east
  EXPECT_THAT(tree(pdu), HasSubstr("entity_location x 6378237 y 0 z 0 (latitude 0.0000000 deg, "
                                   "longitude 0.0000000 deg, height 100.000 m)\n"));
  const json fields = named(pdu);
  EXPECT_NEAR(fields["entity_location_read"]["height_m"], 100.0, 1e-3);
  EXPECT_NEAR(fields["entity_location_read"]["latitude_deg"], 0.0, 1e-9);
  EXPECT_NEAR(fields["entity_orientation_read"]["heading_deg"], 90.0, 1e-3);
  EXPECT_NEAR(fields["entity_orientation_read"]["pitch_deg"], 0.0, 1e-3);
  EXPECT_NEAR(fields["entity_orientation_read"]["roll_deg"], 0.0, 1e-3);
}

TEST(Readings, OfAnglesWithoutAPlaceAreDegrees) {
  EntityState pdu;
  pdu.orientation = {1.5707964F, 0, 0};
  EXPECT_NEAR(named(pdu)["entity_orientation_read"]["psi_deg"], 90.0, 1e-3);
  EXPECT_FALSE(named(pdu).contains("entity_location_read"));
}

TEST(Readings, OfAClockTimeAreDateOrHours) {
  StartResume pdu;
  pdu.real_world_time.hour = 24 * 20783 + 14;  // 2026-11-26
  pdu.simulation_time.hour = 2;
  const json fields = named(pdu);
  EXPECT_EQ(fields["real_world_time_read"]["time"], "2026-11-26T14:00:00.000000");
  EXPECT_EQ(fields["simulation_time_read"]["time"], "2:00:00.000000");
}

TEST(Readings, OfAnInvalidClockTimeAreItsHours) {
  StartResume pdu;
  pdu.real_world_time.hour = std::numeric_limits<std::int32_t>::max();
  pdu.simulation_time.hour = std::numeric_limits<std::int32_t>::min();
  const json fields = named(pdu);
  EXPECT_EQ(fields["real_world_time_read"]["time"], "2147483647:00:00.000000");
  EXPECT_EQ(fields["simulation_time_read"]["time"], "-2147483648:00:00.000000");
  pdu.real_world_time.hour = 24 * 2932896 + 23;  // 9999-12-31
  pdu.simulation_time.hour = 24 * 2932897;
  const json last = named(pdu);
  EXPECT_EQ(last["real_world_time_read"]["time"], "9999-12-31T23:00:00.000000");
  EXPECT_EQ(last["simulation_time_read"]["time"], "70389528:00:00.000000");
}

Iff transponder() {
  Iff pdu;
  pdu.system_type = 1;
  pdu.parameter_1 = 0x2000 | 03 << 3 | 05;                      // 5, 3
  pdu.parameter_2 = 07 << 9 | 03 << 6 | 02 << 3 | 01;           // 1237, off
  pdu.parameter_3 = 0x2000 | 01 << 9 | 02 << 6 | 07 << 3 | 04;  // 4721
  pdu.parameter_4 = 0x4000 | 291;
  pdu.parameter_5 = 0x2000 | 45 << 1 | 1;
  pdu.system_status = 1;
  return pdu;
}

TEST(Readings, OfIffModesAreCodesAndTheAltitude) {
  const std::string text = tree(transponder());
  for (const char* line : {"parameter_1 8221 (mode_1 53, state on)\n", "(mode_2 1237, state off)\n",
                           "(mode_3a 4721, state on)\n", "(mode_4 291, state damaged)\n",
                           "(altitude -4500 ft, mode_c_state on)\n"})
    EXPECT_THAT(text, HasSubstr(line));
  const json fields = named(transponder());
  EXPECT_EQ(fields["parameter_3_read"]["mode_3a"], "4721");
  EXPECT_EQ(fields["parameter_5_read"]["altitude_ft"], -4500);
  EXPECT_EQ(fields["parameter_3"], plain(transponder())["parameter_3"]);
}

TEST(Readings, OfIffModesDependOnCapabilityAndSystem) {
  Iff pdu = transponder();
  pdu.system_status |= 1U << 3;
  pdu.parameter_5 = 0x2000 | 0x7FF << 1;
  EXPECT_THAT(tree(pdu), HasSubstr("(mode_3a 4721, state not capable)"));
  EXPECT_THAT(tree(pdu), HasSubstr("(mode_c no altitude, mode_c_state on)"));
  pdu.system_type = 3;  // a system without these modes
  EXPECT_THAT(tree(pdu), Not(HasSubstr("mode_3a")));
}

TEST(Readings, OfDatumsAreTheirText) {
  std::array<std::byte, 64> buffer{};
  VariableDatumWriter writer(buffer);
  constexpr std::string_view kText = "hands \"touch\"";
  ASSERT_TRUE(writer.add(3000, std::as_bytes(std::span(kText))));
  const std::array<std::byte, 4> number{std::byte{1}, std::byte{2}, std::byte{3}, std::byte{4}};
  ASSERT_TRUE(writer.add(3001, number));
  Comment pdu;
  pdu.variable_datums = writer.datums();
  EXPECT_THAT(tree(pdu), HasSubstr(" (text \"hands \\\"touch\\\"\")\n"));
  const json datums = named(pdu)["variable_datum_records"];
  EXPECT_EQ(datums[0]["variable_datum_text"], kText);
  EXPECT_FALSE(datums[1].contains("variable_datum_text"));
}

TEST(DescriptorKinds, AreShownByTheStatus) {
  Fire fire;
  fire.descriptor.warhead = 602;
  EXPECT_EQ(plain(fire)["descriptor"]["warhead"], 602);
  fire.header.pdu_status = 0x10;
  EXPECT_TRUE(plain(fire)["descriptor"].contains("expendable_type"));
  EXPECT_FALSE(plain(fire)["descriptor"].contains("warhead"));
  EXPECT_THAT(tree(fire), HasSubstr("expendable_type kind 0"));
  fire.header.protocol_version = 6;  // padding there
  EXPECT_EQ(plain(fire)["descriptor"]["warhead"], 602);

  Detonation detonation;
  detonation.header.pdu_status = 0x20;
  detonation.descriptor.warhead = 602;      // explosive material
  detonation.descriptor.quantity = 0x42C8;  // the upper half of 100.0F
  const json descriptor = plain(detonation)["descriptor"];
  EXPECT_EQ(descriptor["explosive_material"], 602);
  EXPECT_EQ(descriptor["explosive_force"], 100.0);
  EXPECT_TRUE(descriptor.contains("exploding_object_type"));
}

TEST(DescriptorKinds, DoNotChangeTheOctets) {
  Detonation detonation;
  detonation.header.pdu_status = 0x20;
  detonation.descriptor = {{}, 1, 2, 3, 4};
  std::vector<std::byte> octets(wire_size(detonation));
  ASSERT_EQ(encode(detonation, octets), octets.size());
  Detonation back;
  ASSERT_EQ(decode(octets, back), DecodeError::none);
  EXPECT_EQ(back.descriptor.rate, 4);
}

TEST(JsonNumbers, BeyondThePrecisionOfADoubleAreText) {
  Presence pdu;
  pdu.scene_hash = 10428333160412253831U;
  EXPECT_EQ(plain(pdu)["scene_hash"], "10428333160412253831");
  pdu.scene_hash = std::uint64_t{1} << 53;
  EXPECT_EQ(plain(pdu)["scene_hash"], std::uint64_t{1} << 53);
}

}  // namespace
}  // namespace reckon::pdu::field_readings_test
