// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/world/contact_recorder.hpp"

#include <gtest/gtest.h>

namespace reckon::peer {
namespace {

using namespace std::chrono_literals;

haptics::ContactSet one_hand(std::uint32_t version) {
  haptics::ContactSet set;
  set.count = 1;
  set.hands[0].id = {1, 2, 3};
  set.hands[0].version = version;
  set.hands[0].valid_until = 5s;
  return set;
}

TEST(ContactRecorder, RecordsEachChangedSet) {
  haptics::ContactRing ring(16);
  ContactRecorder recorder;
  recorder.note(one_hand(1), 1s);
  EXPECT_TRUE(ring.empty());
  recorder.record_into(&ring);
  recorder.note({}, 1s);  // the initial set of a servo
  EXPECT_TRUE(ring.empty());

  haptics::ContactSet set = one_hand(1);
  const auto kept = [&](std::chrono::nanoseconds now) {
    recorder.note(set, now);
    haptics::TimedContactSet last;
    bool is_kept = false;
    while (ring.pop(last)) is_kept = true;
    return is_kept && last.time == now && last.set.count == set.count;
  };
  EXPECT_TRUE(kept(1s));
  EXPECT_FALSE(kept(2s));
  set = one_hand(2);
  EXPECT_TRUE(kept(3s));
  set.hands[0].valid_until = 4s;
  EXPECT_TRUE(kept(4s));
  set.frozen = true;
  EXPECT_TRUE(kept(5s));
  set.hands[0].id.entity = 4;
  EXPECT_TRUE(kept(6s));
  set.count = 2;
  EXPECT_TRUE(kept(7s));
  EXPECT_FALSE(kept(8s));
  set = {};
  EXPECT_TRUE(kept(9s));
}

TEST(ContactRecorder, RetriesAfterAFullRing) {
  haptics::ContactRing ring(2);
  ContactRecorder recorder;
  recorder.record_into(&ring);
  for (std::uint32_t version = 1; version <= 3; ++version) recorder.note(one_hand(version), 1s);
  ring.pop();
  ring.pop();
  EXPECT_TRUE(ring.empty());
  recorder.note(one_hand(3), 2s);
  ASSERT_FALSE(ring.empty());
  EXPECT_EQ(ring.front()->set.hands[0].version, 3U);
}

}  // namespace
}  // namespace reckon::peer
