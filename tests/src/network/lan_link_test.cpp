// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/network/lan_link.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "reckon/tests/src/support/udp_on_loopback.hpp"

namespace reckon::peer {
namespace {

TEST(LanLink, ImpairsEachReceiverDifferently) {
  LanLinkOptions options;
  options.udp.interface = "lo";
  LanLink good(options, test::kClock);
  EXPECT_EQ(static_cast<const Link*>(&good.link()), &good.udp());

  options.law.loss = 0.5;
  std::vector<std::vector<std::string>> heard;
  for (const std::uint64_t receiver : {0u, 1u}) {
    options.receiver = receiver;
    LanLink bad(options, test::kClock);
    EXPECT_NE(static_cast<const Link*>(&bad.link()), &bad.udp());
    ASSERT_FALSE(bad.link().join(test::group(63)));
    for (int i = 0; i < 64; ++i)
      ASSERT_TRUE(good.link().send(test::group(63), test::octets(std::to_string(i))));
    heard.push_back(test::hear(bad.link()));
    EXPECT_GT(heard.back().size(), 0u);
    EXPECT_LT(heard.back().size(), 64u);
  }
  EXPECT_NE(heard[0], heard[1]);
}

}  // namespace
}  // namespace reckon::peer
