// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/exchange/servo_types.hpp"

#include <gtest/gtest.h>

#include "reckon/haptics/exchange/triple_buffer.hpp"

namespace reckon::haptics {
namespace {

ContactSet set_of(std::size_t count, std::uint32_t version) {
  ContactSet set;
  set.count = count;
  for (std::size_t i = 0; i < count; ++i) {
    set.hands[i].id = {1, 2, static_cast<std::uint16_t>(i)};
    set.hands[i].version = version;
  }
  set.frozen = true;
  set.left_out = 5;
  return set;
}

TEST(ContactSet, CopyTakesOnlyTheHandsInUse) {
  ContactSet to = set_of(kMaxRemoteHands, 1);
  to = set_of(3, 2);
  EXPECT_EQ(to.count, 3u);
  EXPECT_TRUE(to.frozen);
  EXPECT_EQ(to.left_out, 5u);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(to.hands[i].version, 2u);
  for (std::size_t i = 3; i < kMaxRemoteHands; ++i) EXPECT_EQ(to.hands[i].version, 1u);
}

TEST(ContactSet, CopyNeverReachesBeyondTheArray) {
  ContactSet from = set_of(kMaxRemoteHands, 4);
  from.count = 1'000'000;
  const ContactSet to = from;
  EXPECT_EQ(to.hands.back().version, 4u);
}

TEST(ServoSnapshot, CopyIsCompleteInItsUsedParts) {
  ServoSnapshot from;
  from.step = 9;
  from.count = 2;
  from.contacts[1].given = 0.5;
  from.contacts[2].given = 7.0;
  from.port_energy = -1.0;
  from.left_out = 3;
  ServoSnapshot to;
  to = from;
  EXPECT_EQ(to.step, 9u);
  EXPECT_EQ(to.count, 2u);
  EXPECT_EQ(to.contacts[1].given, 0.5);
  EXPECT_EQ(to.contacts[2].given, 0.0) << "not in use";
  EXPECT_EQ(to.port_energy, -1.0);
  EXPECT_EQ(to.left_out, 3u);
}

TEST(TripleBuffer, TransfersSetsThatGrowAndShrink) {
  TripleBuffer<ContactSet> buffer;
  for (std::uint32_t round = 1; round < 200; ++round) {
    const std::size_t count = round * 7 % (kMaxRemoteHands + 1);
    buffer.write(set_of(count, round));
    ASSERT_TRUE(buffer.update());
    ASSERT_EQ(buffer.read().count, count);
    for (std::size_t i = 0; i < count; ++i) ASSERT_EQ(buffer.read().hands[i].version, round);
  }
}

}  // namespace
}  // namespace reckon::haptics
