// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/loops/limit_watch.hpp"

#include <gmock/gmock.h>

#include <string>
#include <vector>

namespace reckon::peer {
namespace {

using std::chrono::milliseconds;
using std::chrono::nanoseconds;
using std::chrono::seconds;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr aoim::SourceAddress kCrowder{{0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0xFF, 0xFF, 10, 0, 0, 9},
                                       5555};

class LimitWatchTest : public testing::Test {
 protected:
  /// The notices within this time, at 20 checks a second.
  std::vector<std::string> run(nanoseconds length, std::size_t unfelt = 0,
                               std::size_t unpressed = 0) {
    for (const nanoseconds end = now_ + length; now_ < end; now_ += milliseconds(50))
      watch_.look(unfelt, unpressed, kCrowder, {7, 8, 9}, now_, notices_);
    std::vector<std::string> told;
    for (; notices_.front() != nullptr; notices_.pop())
      told.emplace_back(notices_.front()->text.data());
    return told;
  }
  Counters counters_;
  haptics::SpscRing<Notice> notices_{64};
  LimitWatch watch_{1234, counters_};
  nanoseconds now_ = seconds(100);
};

TEST_F(LimitWatchTest, IsSilentWhileNothingIsLeftOut) { EXPECT_THAT(run(seconds(60)), IsEmpty()); }

TEST_F(LimitWatchTest, ReportsUnfeltHandsOnceAndTheirEndOnce) {
  EXPECT_THAT(run(seconds(20), 3),
              ElementsAre(HasSubstr(
                  "32 bodies of a servo are near a hand, most of them from 10.0.0.9:5555")));
  EXPECT_THAT(run(seconds(1), 1), IsEmpty());
  EXPECT_EQ(counters_.find("hands_unfelt")->value(), 3U);  // the maximum
  EXPECT_THAT(run(seconds(4)), ElementsAre(HasSubstr("felt again")));
}

TEST_F(LimitWatchTest, ReportsHandsThatDoNotPress) {
  EXPECT_THAT(run(seconds(1), 0, 2), ElementsAre(HasSubstr("more than 8 hands of other peers")));
  EXPECT_EQ(counters_.find("hands_unpressed")->value(), 2U);
  EXPECT_THAT(run(seconds(4)), ElementsAre(HasSubstr("press them again")));
}

TEST_F(LimitWatchTest, ReportsAFullTableAndFullRings) {
  counters_.make("table_full", "").add();
  EXPECT_THAT(run(seconds(1)), ElementsAre(AllOf(HasSubstr("full with 1234 rows"),
                                                 HasSubstr("raise [network] entities"))));
  EXPECT_THAT(run(seconds(4)),
              ElementsAre(HasSubstr("the table of remote entities has room again")));
  counters_.make("write_overflow", "").add();
  counters_.make("read_waits", "").add();
  EXPECT_THAT(run(seconds(1)), ElementsAre(HasSubstr("the ring to the network is full"),
                                           HasSubstr("from the network is full")));
}

TEST_F(LimitWatchTest, ReportsAMissingKey) {
  counters_.make("sealed_unread_in", "").add();
  EXPECT_THAT(run(seconds(1)), ElementsAre(HasSubstr("set [network] key")));
}

TEST_F(LimitWatchTest, ReportsARefusedForceModelAndItsEnd) {
  counters_.make("models_refused", "").add();
  EXPECT_THAT(run(seconds(1)),
              ElementsAre(HasSubstr("force model of 7:8:9 has impossible values")));
  EXPECT_THAT(run(seconds(4)), ElementsAre(HasSubstr("no force model was refused since")));
}

}  // namespace
}  // namespace reckon::peer
