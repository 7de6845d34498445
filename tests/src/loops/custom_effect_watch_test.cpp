// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/loops/custom_effect_watch.hpp"

#include <gmock/gmock.h>

#include <string>
#include <vector>

namespace reckon::peer {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class CustomEffectWatchTest : public testing::Test {
 protected:
  CustomEffectWatchTest() {
    report_->key = "honey";
    report_->object = "table";
  }
  std::vector<std::string> look() {
    watch_.look(notices_);
    std::vector<std::string> told;
    for (; notices_.front() != nullptr; notices_.pop())
      told.emplace_back(notices_.front()->text.data());
    return told;
  }
  std::shared_ptr<haptics::GuardReport> report_ = std::make_shared<haptics::GuardReport>();
  haptics::SpscRing<Notice> notices_{16};
  CustomEffectWatch watch_{{report_}};
};

TEST_F(CustomEffectWatchTest, IsSilentForAGoodEffect) { EXPECT_THAT(look(), IsEmpty()); }

TEST_F(CustomEffectWatchTest, ReportsEachFaultOnceByName) {
  report_->not_finite = 3;
  EXPECT_THAT(
      look(),
      ElementsAre(HasSubstr("the effect honey of table returns values that are not finite")));
  report_->not_finite = 9;
  report_->too_strong = 1;
  report_->not_booked = true;
  EXPECT_THAT(look(), ElementsAre(HasSubstr("above 100 N"), HasSubstr("held for each sample")));
  report_->slowest = 2'140'000;
  report_->switched_off = true;
  EXPECT_THAT(look(), ElementsAre(HasSubstr("switched off, because it took up to 2.1 ms")));
  EXPECT_THAT(look(), IsEmpty());
}

}  // namespace
}  // namespace reckon::peer
