// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/loops/notice.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <string>
#include <string_view>

#include "reckon/peer/loops/aoim_setup.hpp"
#include "reckon/peer/loops/notice_text.hpp"
#include "reckon/tests/support/places.hpp"

namespace reckon::peer {
namespace {

aoim::PresenceEvent event_of(aoim::PresenceEventKind kind) {
  aoim::PresenceEvent event;
  event.kind = kind;
  event.announced.simulation = {7, 2};
  return event;
}

TEST(Notice, NamesBothAddressesOfAnImpostor) {
  aoim::PresenceEvent event = event_of(aoim::PresenceEventKind::impostor);
  event.source = source_of(*IpEndpoint::parse("10.77.0.2:4000"));
  event.other = source_of(*IpEndpoint::parse("[fd00::9]:5000"));
  EXPECT_STREQ(
      notice_of(event).text.data(),
      "[fd00::9]:5000 is ignored: it uses the identity of peer 7:2, which is at 10.77.0.2:4000");
}

TEST(Notice, ReportsADisputeOverItsOwnId) {
  aoim::PresenceEvent event = event_of(aoim::PresenceEventKind::disputed);
  event.other = source_of(*IpEndpoint::parse("10.77.0.3:4001"));
  EXPECT_STREQ(notice_of(event).text.data(),
               "the number of this peer, 7:2, is also claimed by 10.77.0.3:4001");
}

TEST(Notice, ReportsHowLongThePeerSlept) {
  aoim::PresenceEvent event = event_of(aoim::PresenceEventKind::slept);
  event.slept = std::chrono::milliseconds(5049);
  EXPECT_STREQ(notice_of(event).text.data(), "this peer was suspended for 5.0 s");
}

bool is_printable(std::string_view text) {
  return std::all_of(text.begin(), text.end(),
                     [](char letter) { return letter >= ' ' && letter <= '~'; });
}

TEST(Notice, NeverContainsAnEscapeSequence) {
  EXPECT_STREQ(make_notice(NoticeKind::other, "'{}' joined", "\x1b[2J\x1b]0;me\x07").text.data(),
               "'?[2J?]0;me?' joined");
  EXPECT_STREQ(make_notice(NoticeKind::other, "'{}'", "two\nlines\r\ttab").text.data(),
               "'two?lines??tab'");
  EXPECT_STREQ(make_notice(NoticeKind::other, "'{}'", "a\x7f\x08z").text.data(), "'a??z'");
  EXPECT_STREQ(make_notice(NoticeKind::other, "'{}'",
                           "\xc2\x9b"
                           "31m \x9b"
                           "31m")
                   .text.data(),
               "'??31m ?31m'");  // C1
  EXPECT_EQ(make_notice(NoticeKind::other, "{}", "\xff\xfe\xe2\x82").text.data(),
            std::string(4, '?'));
}

TEST(Notice, IsPrintableForEachOctetThereIs) {
  for (int octet = 1; octet < 256; ++octet) {
    const std::string name(3, static_cast<char>(octet));
    const Notice notice = make_notice(NoticeKind::other, "{} is {}", name, octet);
    const std::string_view text = notice.text.data();
    EXPECT_TRUE(is_printable(text)) << octet;
    EXPECT_TRUE(text.ends_with("is " + std::to_string(octet))) << text;
  }
}

TEST(Notice, IsCutToItsRoomAndTerminated) {
  const Notice notice = make_notice(NoticeKind::other, "{}", std::string(1000, '\x1b'));
  EXPECT_EQ(std::string_view(notice.text.data()), std::string(notice.text.size() - 1, '?'));
}

TEST(Notice, RemovesControlCharactersFromPeerNames) {
  aoim::PresenceEvent event;
  event.kind = aoim::PresenceEventKind::newcomer;
  constexpr std::string_view kName = "\x1b[31mRED";
  std::copy(kName.begin(), kName.end(), reinterpret_cast<char*>(event.announced.name.data()));
  const std::string text = notice_of(event).text.data();
  EXPECT_NE(text.find("'?[31mRED' joined"), std::string::npos) << text;
}

TEST(Notice, ThatEndsAConditionIsInformation) {
  EXPECT_EQ(make_notice(NoticeKind::send_fails, "SENDING fails").severity, Severity::error);
  EXPECT_EQ(make_end(NoticeKind::send_fails, "sending works").severity, Severity::info);
  EXPECT_EQ(notice_of(event_of(aoim::PresenceEventKind::impostor)).kind, NoticeKind::impostor);
}

TEST(Notice, OfEachKindIsInTheTable) {
  std::string table;
  for (const NoticeFacts& facts : all_notice_facts())
    table += fmt::format("| `{}` | {} | {} |\n", facts.id, name_of(facts.severity), facts.meaning);
  std::ifstream page(test::source_dir() + "/docs/notices.md");
  const std::string text((std::istreambuf_iterator<char>(page)), {});
  EXPECT_NE(text.find(table), std::string::npos) << "docs/notices.md is behind:\n" << table;
  EXPECT_EQ(facts_of(NoticeKind::scene_not_offered).id, "scene-not-offered") << "the last of both";
  EXPECT_EQ(all_notice_facts().size(), static_cast<std::size_t>(NoticeKind::scene_not_offered) + 1);
}

}  // namespace
}  // namespace reckon::peer
