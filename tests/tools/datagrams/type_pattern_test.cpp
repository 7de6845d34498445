// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/datagrams/type_pattern.hpp"

#include <gtest/gtest.h>

#include <array>
#include <random>
#include <string>

#include "reckon/peer/federation/entity_class.hpp"
#include "reckon/peer/notation/entity_type_text.hpp"

namespace reckon::tools {
namespace {

TEST(TypePattern, ReadsNumbersAsEntityClassDoes) {
  std::mt19937 random(5);
  for (int i = 0; i < 2000; ++i) {
    std::array<std::uint8_t, 14> of{};
    for (std::uint8_t& part : of) part = static_cast<std::uint8_t>(random() % 2);
    const auto type = [&](std::size_t at) {
      return pdu::EntityType{static_cast<pdu::EntityKind>(of[at]),
                             static_cast<pdu::EntityDomain>(of[at + 1]),
                             of[at + 2],
                             of[at + 3],
                             of[at + 4],
                             of[at + 5],
                             of[at + 6]};
    };
    const std::string text = peer::entity_type_numbers(type(0));
    EXPECT_EQ(parse_type_pattern(text).pattern.matches(type(7)),
              peer::EntityClass{type(0)}.contains(type(7)))
        << text << " " << peer::entity_type_numbers(type(7));
  }
}

}  // namespace
}  // namespace reckon::tools
