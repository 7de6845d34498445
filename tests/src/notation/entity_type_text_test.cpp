// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/notation/entity_type_text.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>
#include <stdexcept>
#include <string>

namespace reckon::peer {
namespace {

using testing::HasSubstr;

pdu::EntityType tank() {
  return {pdu::EntityKind::platform, pdu::EntityDomain::land, 225, 1, 2, 3, 4};
}

TEST(EntityTypeText, IsReadByNumberWithMissingOnesZero) {
  EXPECT_EQ(parse_entity_type("1.1.225.1.2.3.4").type, tank());
  const EntityTypeText part = parse_entity_type(" 1.1.225 ");
  EXPECT_TRUE(part.good()) << part.error;
  EXPECT_EQ(part.type, (pdu::EntityType{pdu::EntityKind::platform, pdu::EntityDomain::land, 225}));
  EXPECT_EQ(parse_entity_type("255.255.65535.255.255.255.255").error, "");
  EXPECT_EQ(entity_type_numbers(tank()), "1.1.225.1.2.3.4");
}

TEST(EntityTypeText, ApiReadsItOrThrows) {
  EXPECT_EQ(entity_type("1.1.225.1.2.3.4"), tank());
  try {
    (void)entity_type("1.1.65536");
    ADD_FAILURE() << "took a country that there is not";
  } catch (const std::invalid_argument& error) {
    EXPECT_STREQ(error.what(),
                 "type \"1.1.65536\": its country '65536' is not a whole number from 0 to 65535");
  }
}

TEST(EntityTypeText, RefusesNumbersThatDoNotFit) {
  EXPECT_EQ(parse_entity_type("1.256").error,
            "its domain '256' is not a whole number from 0 to 255");
  EXPECT_EQ(parse_entity_type("1.1.65536").error,
            "its country '65536' is not a whole number from 0 to 65535");
  EXPECT_THAT(parse_entity_type("1.1.").error, HasSubstr("its country ''"));
  EXPECT_THAT(parse_entity_type("1.-1").error, HasSubstr("its domain '-1'"));
  EXPECT_THAT(parse_entity_type("1.1 .2").error, HasSubstr("its domain '1 '"));
  EXPECT_THAT(parse_entity_type("1.1.1.1.1.1.1.1").error, HasSubstr("more than 7"));
  EXPECT_THAT(parse_entity_type("").error, HasSubstr("empty"));
}

TEST(EntityTypeText, IsReadInTheWordsOfTheInspector) {
  EXPECT_EQ(parse_entity_type("Platform Land United States Tank").type,
            (pdu::EntityType{pdu::EntityKind::platform, pdu::EntityDomain::land, 225, 1}));
  EXPECT_EQ(parse_entity_type("platform  land tank").type,
            (pdu::EntityType{pdu::EntityKind::platform, pdu::EntityDomain::land, 0, 1}));
  EXPECT_EQ(parse_entity_type("Life form Land").type,
            (pdu::EntityType{pdu::EntityKind::life_form, pdu::EntityDomain::land}));
}

TEST(EntityTypeText, ReadsBackTheInspectorsWordsOfNamedTypes) {
  std::mt19937 random(5);
  int named = 0;
  for (int i = 0; i < 20'000; ++i) {
    pdu::EntityType type;
    type.kind = static_cast<pdu::EntityKind>(random() % 10);
    type.domain = static_cast<pdu::EntityDomain>(random() % 6);
    type.country = static_cast<std::uint16_t>(random() % 300);
    type.category = static_cast<std::uint8_t>(random() % 90);
    const std::string words = entity_type_words(type);
    if (words.find_first_of("0123456789") != std::string::npos) continue;  // some are unnamed
    const EntityTypeText read = parse_entity_type(words);
    ASSERT_TRUE(read.good()) << words << ": " << read.error;
    ASSERT_EQ(entity_type_words(read.type), words);
    ++named;
  }
  EXPECT_GT(named, 2000);
}

TEST(EntityTypeText, RefusalNamesTheWrongWordAndTheNearest) {
  EXPECT_EQ(parse_entity_type("Platform Lnad").error,
            "'Lnad' is no domain (did you mean \"Land\"?)");
  EXPECT_EQ(parse_entity_type("Platfrom Land").error,
            "'Platfrom Land' is no kind (did you mean \"Platform\"?)");
  EXPECT_EQ(parse_entity_type("Platform Land Untied States Tank").error,
            "'Untied States Tank' is no country and no category (did you mean \"United States\"?)");
  EXPECT_EQ(parse_entity_type("Platform Land Tnak").error,
            "'Tnak' is no country and no category (did you mean \"Tank\"?)");
  EXPECT_EQ(parse_entity_type("Platform").error, "it has no domain");
  EXPECT_THAT(parse_entity_type("M1A2").error, HasSubstr("'M1A2' is no kind; `reckon inspect"));
  EXPECT_FALSE(parse_entity_type(std::string(100'000, 'x')).good());
}

}  // namespace
}  // namespace reckon::peer
