// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/loops/loss_watch.hpp"

#include <gmock/gmock.h>

#include <string>
#include <vector>

namespace reckon::peer {
namespace {

class LossWatchTest : public testing::Test {
 protected:
  // The notices while 70 datagrams a second are sent, of which this share is lost.
  std::vector<std::string> run(int length, double share) {
    for (int i = 0; i < 20 * length; ++i, now_ += std::chrono::milliseconds(50)) {
      sent_ += 3.5;
      gone_ += 3.5 * share;
      counts_.lost = static_cast<std::uint64_t>(gone_);
      counts_.received = static_cast<std::uint64_t>(sent_) - counts_.lost;
      watch_.look(counts_, now_, notices_);
    }
    std::vector<std::string> told;
    for (; notices_.front() != nullptr; notices_.pop())
      told.emplace_back(notices_.front()->text.data());
    return told;
  }
  aoim::SequenceCounts counts_;
  haptics::SpscRing<Notice> notices_{64};
  LossWatch watch_;
  std::chrono::nanoseconds now_ = std::chrono::seconds(100);
  double sent_ = 1000, gone_ = 0;
};

TEST_F(LossWatchTest, ReportsTenSecondsOfLossOnce) {
  EXPECT_THAT(run(20, 0.0), testing::IsEmpty());
  const auto told = run(20, 0.3);
  ASSERT_EQ(told.size(), 1u);
  EXPECT_THAT(told[0], testing::HasSubstr("datagrams of the other peers (30 %) were lost in 10 s"));
}

TEST_F(LossWatchTest, ReportsLastingLossOnceAMinute) {
  EXPECT_THAT(run(300, 0.1), testing::SizeIs(5));
}

TEST_F(LossWatchTest, IsSilentBelowFivePercent) {
  EXPECT_THAT(run(300, 0.045), testing::IsEmpty());
}

TEST_F(LossWatchTest, TakesALateDatagramForNoLoss) {
  EXPECT_THAT(run(25, 0.0), testing::IsEmpty());
  counts_.lost += 40;
  gone_ += 40;
  EXPECT_THAT(run(2, 0.0), testing::IsEmpty());
  gone_ -= 40;
  EXPECT_THAT(run(60, 0.0), testing::IsEmpty());
}

}  // namespace
}  // namespace reckon::peer
