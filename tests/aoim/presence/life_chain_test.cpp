// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A peer proves its identity over time by a hash chain; others cannot.
#include "reckon/aoim/presence/life_chain.hpp"

#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "reckon/tests/aoim/support/samples.hpp"

namespace reckon::aoim::life_chain_test {
namespace {

using test::presence_of;

std::size_t calls = 0;

ChainLink counted(const ChainLink& link, std::uint32_t number) noexcept {
  ++calls;
  return test::scrambled(link, number);
}

// One each 62.5 ms: 16 in each slot.
std::vector<pdu::Presence> announcements(std::size_t count, std::uint8_t secret = 1) {
  LifeChain chain({test::scrambled, nullptr}, {secret});
  std::vector<pdu::Presence> said(count, presence_of(2, 22));
  std::chrono::nanoseconds now = std::chrono::hours(3);
  for (pdu::Presence& one : said) {
    chain.sign(one, {}, now);
    now += std::chrono::microseconds(62'500);
  }
  return said;
}

TEST(LifeChain, AnyLaterAnnouncementOpensTheEarlierOnes) {
  const auto said = announcements(9000);
  std::mt19937 random(7);
  LifeTip tip(said[0], std::chrono::seconds(0));
  for (std::size_t i = 0; i + 1 < said.size();) {
    const std::size_t next = std::min<std::size_t>(i + 1 + random() % 200, said.size() - 1);
    ASSERT_EQ(tip.judge(said[next], test::scrambled, 256), Opening::newer) << i << ", " << next;
    tip = LifeTip(said[next], std::chrono::seconds(0));
    for (const std::size_t old : {next, i, std::size_t(0)})
      ASSERT_EQ(tip.judge(said[old], test::scrambled, 256), Opening::known) << old;
    i = next;
  }
}

TEST(LifeChain, CannotBeForged) {
  const auto said = announcements(600), others = announcements(600, 2);
  std::mt19937 random(3);
  for (std::size_t i = 0; i < 500; ++i) {
    const LifeTip tip(said[i], std::chrono::seconds(0));
    for (std::size_t ahead = 1; ahead < 60; ahead += 7) {
      EXPECT_EQ(tip.judge(others[i + ahead], test::scrambled, 256), Opening::wrong);
      pdu::Presence later = said[i];  // a received announcement, presented as the next one
      later.chain_number = said[i + ahead].chain_number;
      EXPECT_EQ(tip.judge(later, test::scrambled, 256), Opening::wrong);
      pdu::Presence altered = said[i + ahead];
      altered.chain_link[random() % 16] ^= static_cast<std::uint8_t>(1 + random() % 255);
      EXPECT_EQ(tip.judge(altered, test::scrambled, 256), Opening::wrong);
      altered = said[i + ahead];
      altered.chain_number += kChainLength;
      EXPECT_EQ(tip.judge(altered, test::scrambled, 256), Opening::wrong);
    }
    pdu::Presence other = said[i];
    other.chain_link = others[i].chain_link;
    EXPECT_EQ(tip.judge(other, test::scrambled, 256), Opening::wrong);
  }
}

TEST(LifeChain, JudgingCostsAtMostTheAllowedCalls) {
  auto said = announcements(600);
  const LifeTip tip(said[10], std::chrono::seconds(0));
  EXPECT_EQ(tip.farthest(std::chrono::seconds(1)), 184u);
  EXPECT_EQ(tip.farthest(std::chrono::hours(9)), kChainLength);
  for (const std::uint32_t number : {11u, 14u, 15u, 200u, 256u, 300u, 600u, 0xFFFF'FFFFu}) {
    pdu::Presence one = said[20];
    one.chain_number = number;
    calls = 0;
    EXPECT_EQ(tip.judge(one, counted, 4), Opening::wrong);
    EXPECT_LE(calls, 4u);
  }
  EXPECT_EQ(tip.judge(said[14], counted, 4), Opening::newer);
  EXPECT_EQ(tip.judge(said[15], counted, 4), Opening::wrong);
}

TEST(LifeChain, SlotsFollowTheClockAndBridgeASuspension) {
  LifeChain chain({test::scrambled, nullptr}, {7});
  std::chrono::nanoseconds now = std::chrono::hours(1);
  pdu::Presence last, said = presence_of(2, 22);
  for (int i = 0; i < 40; ++i) chain.sign(said, {}, now);
  EXPECT_EQ(said.chain_number, kSlotLinks - 1) << "further announcements repeat the last link";
  for (const int pause_ms : {1000, 600, 3000, 7900, 86'400'000, 250, 999}) {
    last = said;
    now += std::chrono::milliseconds(pause_ms);
    chain.sign(said, {}, now);
    EXPECT_EQ(LifeTip(last, now).judge(said, test::scrambled, 9 * kSlotLinks), Opening::newer);
  }
  EXPECT_EQ(slot_of(said.chain_number), 21u) << "a day counts as 8 s";
  EXPECT_EQ(said.slot_time, 749'000u);
}

TEST(LifeChain, ProvesNothingWithoutAFunction) {
  LifeChain chain({}, {5});
  pdu::Presence said = presence_of(2, 22);
  chain.sign(said, {}, std::chrono::seconds(1));
  EXPECT_EQ(said.chain_link, ChainLink{});
  EXPECT_FALSE(LifeTip(said, std::chrono::seconds(0)).is_chained());
  const LifeTip tip(announcements(1)[0], std::chrono::seconds(0));
  EXPECT_EQ(tip.judge(announcements(2)[1], nullptr, 256), Opening::none);
}

}  // namespace
}  // namespace reckon::aoim::life_chain_test
