// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/viewer/web/access.hpp"

#include <gtest/gtest.h>

namespace reckon::tools {
namespace {

TEST(Access, MatchesItsOwnAddressesAsWholeStrings) {
  const Access access({"localhost", "127.0.0.1"}, 8642, "word");
  EXPECT_TRUE(access.is_own_host("127.0.0.1:8642"));
  EXPECT_TRUE(access.is_own_host("localhost:8642"));
  for (const auto* host : {"", "127.0.0.1", "127.0.0.1:8643", "evil.example:8642", "127.0.0.2:8642",
                           "127.0.0.1.evil.example:8642", "127.0.0.1:8642 ", "LOCALHOST:8642"})
    EXPECT_FALSE(access.is_own_host(host)) << host;
}

TEST(Access, TakesAnOriginOnlyWithItsHost) {
  const Access access({"localhost", "127.0.0.1"}, 8642, "word");
  EXPECT_TRUE(access.is_own_origin("http://127.0.0.1:8642", "127.0.0.1:8642"));
  EXPECT_FALSE(access.is_own_origin("http://localhost:8642", "127.0.0.1:8642"));
  EXPECT_FALSE(access.is_own_origin("http://evil.example:8642", "evil.example:8642"));
  for (const auto* origin : {"", "null", "https://127.0.0.1:8642", "http://127.0.0.1:9000",
                             "http://127.0.0.1:8642/", "http://127.0.0.1"})
    EXPECT_FALSE(access.is_own_origin(origin, "127.0.0.1:8642")) << origin;
}

TEST(Access, OmitsTheHttpPortAsBrowsersDo) {
  EXPECT_TRUE(Access({"127.0.0.1"}, 80, "word").is_own_host("127.0.0.1"));
}

TEST(Access, SecurePagesHaveHttpsAndItsPort) {
  const Access access({"127.0.0.1"}, 443, "word", true);
  EXPECT_TRUE(access.is_own_origin("https://127.0.0.1", "127.0.0.1"));
  EXPECT_FALSE(access.is_own_origin("http://127.0.0.1", "127.0.0.1"));
}

TEST(Access, TakesTheWordAndNothingElse) {
  const Access access({"127.0.0.1"}, 8642, "1f2e");
  EXPECT_TRUE(access.is_word("1f2e"));
  for (const auto* word : {"", "1f2", "1f2e0", "1f2f", "0f2e"})
    EXPECT_FALSE(access.is_word(word)) << word;
  EXPECT_FALSE(Access({"127.0.0.1"}, 8642, "").is_word(""));
}

TEST(Access, DrawsAnotherWordEachTime) {
  EXPECT_EQ(draw_word().size(), 32U);
  EXPECT_NE(draw_word(), draw_word());
}

}  // namespace
}  // namespace reckon::tools
