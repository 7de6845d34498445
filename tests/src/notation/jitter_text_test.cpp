// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/notation/jitter_text.hpp"

#include <gmock/gmock.h>

#include "reckon/peer/scene/scene_file.hpp"
#include "reckon/tests/src/support/refusal.hpp"

namespace reckon::peer::jitter_text_test {
namespace {

using namespace std::chrono_literals;
using test::refusal;
using testing::AllOf;
using testing::HasSubstr;

JitterText read(std::string_view text, std::chrono::nanoseconds delay = 80ms) {
  return read_jitter(text, delay, "--delay 80ms");
}

TEST(JitterText, IsATimeOrADelayShare) {
  EXPECT_EQ(read("5ms").jitter, 5ms);
  EXPECT_EQ(read("0.25 s").jitter, 250ms);
  EXPECT_EQ(read("40%").jitter, 32ms);
  EXPECT_EQ(read("12.5 %").jitter, 10ms);
  EXPECT_EQ(read("100%", 7ns).jitter, 7ns);
  EXPECT_EQ(read("33.3%", 10ns).jitter, 3ns);
  for (const char* text : {"5ms", "40%", "0", "0%", "100%"}) EXPECT_TRUE(read(text).good()) << text;
}

TEST(JitterText, TakesTimesBeyondTheDelay) { EXPECT_EQ(read("3s", 80ms).jitter, 3s); }

TEST(JitterText, NeedsADelayForAShareAboveZero) {
  EXPECT_THAT(read("40%", 0ns).error,
              AllOf(HasSubstr("'40%' is a share of the delay, which is 0"),
                    HasSubstr("write --delay 80ms too"), HasSubstr("such as 5ms")));
  EXPECT_TRUE(read("0%", 0ns).good());
  EXPECT_EQ(read("5ms", 0ns).jitter, 5ms);
}

TEST(JitterText, RefusalNamesBothSpellings) {
  for (const char* text : {"", "soft", "5", "0.4", "-5ms", "-1%", "101%", "%", "5m%", "5 m", "nan",
                           "inf s", "1e300s"}) {
    EXPECT_THAT(read(text).error, AllOf(HasSubstr("5ms"), HasSubstr("40%"))) << text;
    EXPECT_EQ(read(text).jitter, 0ns) << text;
  }
}

TEST(JitterText, KnowsAShareByItsEnd) {
  EXPECT_TRUE(is_share_of_delay("40%"));
  EXPECT_TRUE(is_share_of_delay("40 % "));
  EXPECT_FALSE(is_share_of_delay("5ms"));
  EXPECT_FALSE(is_share_of_delay(""));
}

TEST(JitterText, SceneFilesTakeBothSpellings) {
  const auto jitter = [](const std::string& keys) {
    return parse_scene_file("[impairment]\n" + keys, "x.toml").impairment.law.jitter;
  };
  EXPECT_EQ(jitter("delay = \"80 ms\"\njitter = \"40 %\"\n"), 32ms);
  EXPECT_EQ(jitter("jitter = \"40%\"\ndelay = 0.08\n"), 32ms);
  EXPECT_EQ(jitter("delay = \"80 ms\"\njitter = \"5 ms\"\n"), 5ms);
  EXPECT_EQ(jitter("jitter = 0.005\n"), 5ms);
}

TEST(JitterText, SceneFilesRefuseItAtItsPlace) {
  const auto error = [](const std::string& keys) { return refusal("[impairment]\n" + keys); };
  EXPECT_THAT(error("jitter = \"40%\"\n"),
              HasSubstr("x.toml:2:10: 'jitter': '40%' is a share of the delay, which is 0; write "
                        "delay = \"80 ms\" too, or a time, such as 5ms"));
  EXPECT_THAT(error("delay = 1\njitter = \"5 m\"\n"),
              HasSubstr("'jitter': '5 m' is not a jitter; write a time, such as 5ms, or a share of "
                        "the delay, such as 40%"));
  EXPECT_THAT(error("jitter = \"11 s\"\n"), HasSubstr("'jitter' is 11 s; it must be"));
  const std::string of_delay = error("delay = \"soon\"\njitter = \"40%\"\n");
  EXPECT_THAT(of_delay, HasSubstr("'delay'"));
  EXPECT_THAT(of_delay, testing::Not(HasSubstr("'jitter'"))) << "one fault, reported once";
}

}  // namespace
}  // namespace reckon::peer::jitter_text_test
