// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Notices of several peers are combined into few sentences.
#include "reckon/tools/exercise/notice_digest.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "reckon/peer/loops/notice.hpp"

namespace reckon::tools {
namespace {

using aoim::PeerId;
using peer::NoticeKind;
using std::chrono::milliseconds;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

ReceivedNotice joined(std::uint16_t by, std::uint16_t who) {
  aoim::PresenceEvent event;
  event.kind = aoim::PresenceEventKind::newcomer;
  event.announced.simulation = {1, who};
  event.announced.set_name("HAND");
  return {{1, by}, peer::notice_of(event)};
}

ReceivedNotice of(std::uint16_t by, aoim::PresenceEventKind kind, std::uint16_t who) {
  ReceivedNotice heard = joined(by, who);
  aoim::PresenceEvent event;
  event.kind = kind;
  event.announced.simulation = {1, who};
  heard.notice = peer::notice_of(event);
  return heard;
}

ReceivedNotice sentence(std::uint16_t by, std::string_view text) {
  ReceivedNotice heard;
  heard.by = {1, by};
  text.copy(heard.notice.text.data(), text.size());
  return heard;
}

TEST(NoticeDigest, MakesOneLineOfFiftySix) {
  NoticeDigest digest(true);
  for (std::uint16_t by = 1; by <= 8; ++by)
    for (std::uint16_t who = 1; who <= 8; ++who)
      if (by != who) digest.add(joined(by, who), milliseconds(by));
  EXPECT_THAT(digest.take(milliseconds(307)), IsEmpty());  // the last came 299 ms ago
  EXPECT_THAT(digest.take(milliseconds(308)), ElementsAre("8 peers: each sees 7 others"));
  EXPECT_THAT(digest.take_all(), IsEmpty());
}

TEST(NoticeDigest, KeepsTheSentenceOfASingleOne) {
  NoticeDigest alone(false), several(true);
  alone.add(joined(1, 2), milliseconds(0));
  several.add(joined(1, 2), milliseconds(0));
  EXPECT_THAT(alone.take_all(), ElementsAre("peer 1:2 'HAND' joined"));
  EXPECT_THAT(several.take_all(), ElementsAre("1:1: peer 1:2 'HAND' joined"));
}

TEST(NoticeDigest, NamesAFewOfMany) {
  NoticeDigest digest(false);
  for (std::uint16_t who = 2; who <= 8; ++who) digest.add(joined(1, who), milliseconds(0));
  EXPECT_THAT(digest.take_all(), ElementsAre("7 peers joined: 1:2, 1:3, 1:4, 1:5 and 3 more"));
}

TEST(NoticeDigest, ReportsADepartureSeenByAllOnce) {
  NoticeDigest digest(true);
  for (std::uint16_t by = 1; by <= 7; ++by)
    digest.add(of(by, aoim::PresenceEventKind::departed, 8), milliseconds(0));
  EXPECT_THAT(digest.take_all(), ElementsAre("7 peers: peer 1:8 left"));
}

TEST(NoticeDigest, KeepsKindsAndSentencesApart) {
  NoticeDigest digest(true);
  digest.add(joined(1, 2), milliseconds(0));
  digest.add(sentence(1, "all is well"), milliseconds(1));
  digest.add(of(2, aoim::PresenceEventKind::timed_out, 9), milliseconds(2));
  digest.add(sentence(2, "all is well"), milliseconds(3));
  digest.add(sentence(2, "not so here"), milliseconds(4));
  digest.add(joined(2, 1), milliseconds(5));
  EXPECT_THAT(digest.take_all(), ElementsAre("2 peers: each sees 1 other", "2 peers: all is well",
                                             "1:2: peer 1:9 is silent: its entities were dropped",
                                             "1:2: not so here"));
}

TEST(NoticeDigest, WaitsNoLongerThanASecond) {
  NoticeDigest digest(false);
  std::vector<std::string> told;
  for (int ms = 0; ms < 3000 && told.empty(); ms += 100) {
    digest.add(sentence(1, "again"), milliseconds(ms));
    told = digest.take(milliseconds(ms));
  }
  EXPECT_THAT(told, ElementsAre("again (11 times)"));
}

TEST(NoticeDigest, HasNamesOfOthersMadeHarmless) {
  aoim::PresenceEvent event;
  event.kind = aoim::PresenceEventKind::newcomer;
  event.announced.set_name("A\033[2JB");
  EXPECT_EQ(std::string(peer::notice_of(event).text.data()), "peer 0:0 'A?[2JB' joined");
}

}  // namespace
}  // namespace reckon::tools
