// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/pdu/type_names.hpp"

#include <gtest/gtest.h>

#include <cctype>
#include <set>
#include <string_view>

#include "reckon/pdu/pdu_types.hpp"

namespace reckon::pdu {
namespace {

TEST(PduTypeNames, CoverTheStandardAndOurOwnTypes) {
  std::size_t named = 0;
  for (int type = 0; type < 256; ++type) named += is_named(static_cast<PduType>(type)) ? 1U : 0U;
  EXPECT_EQ(named, 1 + PduTypes::kSize);  // and 0, "Other"
  EXPECT_EQ(name(PduType::entity_state), "Entity State");
  EXPECT_EQ(name(PduType::collision_elastic), "Collision-Elastic");
  EXPECT_EQ(name(PduType::presence), "Presence");
}

TEST(PduTypeNames, GiveTheNumberOfAnUnknownType) {
  EXPECT_EQ(name(PduType{200}), "unknown type 200");
  EXPECT_EQ(name(PduType{73}), "unknown type 73");
  EXPECT_EQ(snake_name(PduType{255}), "unknown_255");
}

TEST(PduTypeNames, InSnakeCaseAreUniqueAndPlain) {
  std::set<std::string_view> names;
  for (int type = 0; type < 256; ++type) {
    const std::string_view text = snake_name(static_cast<PduType>(type));
    names.insert(text);
    for (const char c : text)
      EXPECT_TRUE(std::islower(static_cast<unsigned char>(c)) || c == '_' ||
                  std::isdigit(static_cast<unsigned char>(c)))
          << text;
  }
  EXPECT_EQ(names.size(), 256U);
  EXPECT_EQ(snake_name(PduType::start_resume_r), "start_resume_r");
  EXPECT_EQ(snake_name(PduType::is_group_of), "is_group_of");
}

}  // namespace
}  // namespace reckon::pdu
