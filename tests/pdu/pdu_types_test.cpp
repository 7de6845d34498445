// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/pdu/pdu_types.hpp"

#include <gtest/gtest.h>

#include <array>
#include <string>
#include <vector>

#include "reckon/pdu/type_names.hpp"
#include "reckon/tests/support/declarations.hpp"

namespace reckon::pdu {
namespace {

TEST(PduTypes, HoldEachTypeOnce) {
  std::size_t listed = 0;
  for (int type = 0; type < 256; ++type) listed += is_listed(static_cast<PduType>(type)) ? 1U : 0U;
  EXPECT_EQ(listed, PduTypes::kSize);
}

TEST(PduTypes, HoldAllOfTheStandard) {
  for (int type = 1; type <= 72; ++type) EXPECT_TRUE(is_listed(static_cast<PduType>(type))) << type;
}

// A template has a row for each of its types.
TEST(PduTypes, HaveARowForEveryTypedStruct) {
  std::size_t structs = 0;
  for (const std::string& header : test::headers_in("pdu")) {
    const std::string text = test::source_text(header);
    for (const std::string& name : test::structs_with(text, "PduType kPduType")) {
      const auto aliases = test::all_of(text, "using (\\w+) = " + name + "<");
      for (const std::string& type : aliases.empty() ? std::vector{name} : aliases) {
        EXPECT_TRUE(test::is_row("pdu/pdu_types.hpp", "using PduTypes", type))
            << header << " declares " << type << ": it needs a row in PduTypes";
        ++structs;
      }
    }
  }
  EXPECT_EQ(structs, PduTypes::kSize);
}

template <typename... T>
void expect_own_headers(TypeList<T...>) {
  const auto expect_own_header = []<typename Pdu>(const Pdu& pdu) {
    EXPECT_EQ(pdu.header.pdu_type, Pdu::kPduType);
    EXPECT_EQ(pdu.header.protocol_family, Pdu::kProtocolFamily) << snake_name(Pdu::kPduType);
  };
  (expect_own_header(T{}), ...);
}

TEST(PduTypes, TakeTypeAndFamilyIntoANewHeader) { expect_own_headers(PduTypes{}); }

TEST(PduTypes, ReportTypesWithoutFieldTableAsUnknown) {
  std::array<std::byte, 12> octets{std::byte{7}, std::byte{1}, std::byte{200}};
  store_big_endian(octets.data() + 8, std::uint16_t{12});
  PduHeader header;
  ASSERT_EQ(decode_header(octets, header), DecodeError::none);
  EXPECT_EQ(visit(octets, header, [](const auto&) { FAIL(); }), DecodeError::unknown_type);
}

TEST(Encode, RefusesABlockWithAPartialRecord) {
  const std::array<std::byte, 4096> octets{};
  std::array<std::byte, 8192> out;
  EntityState pdu;
  pdu.variable_parameters = std::span(octets).first(17);
  EXPECT_EQ(encode(pdu, out), 0U);
}

TEST(Encode, RefusesMoreRecordsThanItsCountFieldHolds) {
  const std::array<std::byte, 4096> octets{};
  std::array<std::byte, 8192> out;
  EntityState pdu;
  pdu.variable_parameters = std::span(octets).first(16 * 255);
  EXPECT_EQ(encode(pdu, out), 144U + 16 * 255);
  pdu.variable_parameters = std::span(octets).first(16 * 256);
  EXPECT_EQ(encode(pdu, out), 0U);
}

TEST(Encode, RefusesMoreOctetsThanTheLengthFieldHolds) {
  const std::vector<std::byte> octets(65536);
  std::vector<std::byte> out(70000);
  Data pdu;
  pdu.fixed_datums = std::span(octets).first(65488);
  EXPECT_EQ(encode(pdu, out), 65528U);
  pdu.fixed_datums = std::span(octets).first(65496);
  EXPECT_EQ(encode(pdu, out), 0U);
}

}  // namespace
}  // namespace reckon::pdu
