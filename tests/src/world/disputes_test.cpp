// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/world/disputes.hpp"

#include <gtest/gtest.h>

namespace reckon::peer {
namespace {

using std::chrono::milliseconds;
using std::chrono::nanoseconds;
using std::chrono::seconds;

Dispute by(std::uint8_t host, std::uint16_t port = 5555) {
  return {{1, 2},
          {{0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0xFF, 0xFF, 10, 0, 0, 2}, 40000},
          {{0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0xFF, 0xFF, 10, 0, 0, host}, port}};
}

TEST(Disputes, AreNewsOnceWhileTheyLast) {
  Disputes disputes;
  EXPECT_FALSE(disputes.take_news(seconds(1)));
  int told = 0;
  for (nanoseconds now = seconds(1); now < seconds(200); now += milliseconds(20)) {
    disputes.note(by(9, static_cast<std::uint16_t>(now / milliseconds(20))), now);
    if (const auto news = disputes.take_news(now)) {
      EXPECT_EQ(news->name, (aoim::PeerId{1, 2}));
      EXPECT_EQ(news->speaker.octets, by(9).speaker.octets);
      ++told;
    }
  }
  EXPECT_EQ(told, 1);
}

TEST(Disputes, AreNewsAgainAfterAQuietMinute) {
  Disputes disputes;
  disputes.note(by(9), seconds(1));
  EXPECT_TRUE(disputes.take_news(seconds(1)));
  disputes.note(by(9), seconds(60));
  EXPECT_FALSE(disputes.take_news(seconds(62)));
  disputes.note(by(9), seconds(121));
  EXPECT_TRUE(disputes.take_news(seconds(122)));
}

TEST(Disputes, OfManyHostsAreReportedOnceASecond) {
  Disputes disputes;
  int told = 0;
  for (nanoseconds now = seconds(0); now < seconds(10); now += milliseconds(1)) {
    disputes.note(by(static_cast<std::uint8_t>(now / milliseconds(1) % 250)), now);
    if (disputes.take_news(now)) ++told;
  }
  EXPECT_EQ(told, 10);
}

}  // namespace
}  // namespace reckon::peer
