// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The live table of demo and peer in terminals of all sizes.
#include "reckon/tools/exercise/live_table.hpp"

#include <gmock/gmock.h>

#include <memory>
#include <string>
#include <vector>

#include "reckon/tools/terminal/text_table.hpp"

namespace reckon::tools {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;

/// This number of peers; each sees `entities` on a line away from it.
class Peers {
 public:
  Peers(std::size_t peers, std::size_t entities, std::size_t hands = 1) {
    counters_.make("datagrams_out", "").set(120);
    counters_.make("datagrams_lost", "").set(3);
    for (std::size_t i = 0; i < peers; ++i) {
      auto view = std::make_unique<peer::PeerView>();
      view->own = {1, static_cast<std::uint16_t>(i + 1), 1};
      view->hand_count = hands;
      for (std::size_t h = 0; h < hands; ++h) {
        view->hands[h].id = {1, view->own.application, static_cast<std::uint16_t>(h + 1)};
        view->hands[h].servo.enabled = true;
      }
      view->entities = entities;
      view->count = std::min(entities, peer::PeerView::kRows);
      for (std::size_t e = 0; e < view->count; ++e) {
        peer::EntityView& row = view->rows[e];
        row.id = {7, 7, static_cast<std::uint16_t>(e + 1)};
        row.marking = {'E', 'N', 'T'};
        row.position.x() = static_cast<double>(view->count - e);  // the last is the nearest
        row.haptic = true;
        row.rate_hz = 2.5;
      }
      rows_.push_back({view.get(), &counters_});
      views_.push_back(std::move(view));
    }
    scene_.name = "a scene";
  }
  peer::PeerView& view(std::size_t i) { return *views_[i]; }
  [[nodiscard]] LivePicture picture() const {
    return {rows_, scene_, 12.0, notices_, strongest_, head_};
  }
  /// The lines on a terminal of this size; each fits.
  [[nodiscard]] std::vector<std::string> shown(std::size_t rows, std::size_t columns) const {
    std::vector<std::string> texts;
    for (const ScreenLine& line : live_lines(picture(), {rows, columns})) {
      EXPECT_LE(text_width(line.text), columns) << line.text;
      texts.push_back(line.text);
    }
    EXPECT_EQ(texts.size(), rows);
    return texts;
  }
  std::vector<std::string> notices_;
  double strongest_ = 1;
  std::string head_;
  peer::SceneFile scene_;

 private:
  peer::Counters counters_;
  std::vector<std::unique_ptr<peer::PeerView>> views_;
  std::vector<TablePeer> rows_;
};

std::size_t lines_with(const std::vector<std::string>& lines, std::string_view text) {
  return static_cast<std::size_t>(
      std::count_if(lines.begin(), lines.end(),
                    [&](const std::string& line) { return line.find(text) != line.npos; }));
}

TEST(LiveTable, FitsATerminalOfAnySize) {
  for (const std::size_t peers : {1U, 2U, 8U, 64U}) {
    const Peers all(peers, peers - 1);
    for (const std::size_t rows : {0U, 1U, 2U, 3U, 5U, 10U, 24U, 60U, 200U})
      for (const std::size_t columns : {0U, 1U, 10U, 40U, 80U, 200U})
        (void)all.shown(rows, columns);
  }
}

TEST(LiveTable, CutsOnlyWholeColumns) {
  EXPECT_EQ(Peers(1, 1).shown(8, 40).front(), "a scene  12.0 s   bars to 1 N");
  Peers all(1, 1);
  all.view(0).rows[0].jump_m = 1234.5;  // wider than its column
  for (std::size_t columns = 40; columns < 120; ++columns) {
    const auto lines = all.shown(8, columns);
    const auto row = std::ranges::find_if(
        lines, [](const std::string& line) { return line.starts_with("  7:7:1"); });
    ASSERT_NE(row, lines.end());
    const bool is_cut = row->find("1234500.00") != row->npos && row->find("00.00 mm") == row->npos;
    EXPECT_FALSE(is_cut || row->ends_with("1234500")) << columns << ": " << *row;
  }
}

TEST(LiveTable, ReportsStoppedForcesAndTheirKey) {
  Peers all(2, 1);
  EXPECT_THAT(all.shown(24, 80).back(), AllOf(HasSubstr("[s] stop all forces"), HasSubstr("[q]")));
  all.view(1).hands[0].servo.stopped = true;
  EXPECT_EQ(lines_with(all.shown(24, 80), "STOPPED"), 1U);
  EXPECT_THAT(all.shown(24, 80).back(), HasSubstr("[s] restore forces"));
  EXPECT_THAT(Peers(1, 1, 0).shown(24, 80).back(), Not(HasSubstr("[s]"))) << "no hand";
}

TEST(LiveTable, GivesEachEntityOneLineAtEightyColumns) {
  const auto lines = Peers(1, 5).shown(24, 80);
  EXPECT_EQ(lines_with(lines, "7:7:"), 5U);
  EXPECT_THAT(lines, Contains(AllOf(HasSubstr("7:7:1 "), HasSubstr("ENT"), HasSubstr("5.00 m"),
                                    HasSubstr("Hz"), HasSubstr("mm"))));
  EXPECT_EQ(lines_with(lines, "more"), 0U);
}

TEST(LiveTable, GivesEmittersALineWhereThereIsRoom) {
  Peers all(1, 3);
  peer::EmittedView& emits = all.view(0).rows[1].emits;
  emits.emitters = 3;
  emits.beams = 2;
  emits.beam_hz = 9.4e9F;
  emits.targets = 1;
  emits.iff = emits.iff_on = 1;
  emits.iff_type = 1;
  emits.mode_3a = 0x2000 | 01274;
  emits.radios = 2;
  emits.transmitting = 1;
  emits.radio_hz = 251.5375e6;
  const auto lines = all.shown(24, 120);
  const auto at = std::find_if(lines.begin(), lines.end(), [](const std::string& line) {
    return line.find("7:7:2 ") != line.npos;
  });
  ASSERT_NE(at, lines.end());
  EXPECT_THAT(at[1], HasSubstr("emits 2 beams of 3 emitters, 9.4 GHz, 1 target; IFF on, mode_3a "
                               "4721; transmits at 251.5375 MHz"));
  const auto few = all.shown(9, 120);
  EXPECT_EQ(lines_with(few, "7:7:"), 3U) << "entities first";
}

TEST(LiveTable, DropsColumnsInsteadOfEntitiesInNarrowTerminals) {
  const auto wide = Peers(1, 3).shown(24, 200);
  EXPECT_THAT(wide, Contains(AllOf(HasSubstr("LEDGER"), HasSubstr("K1"), HasSubstr("AGE"))));
  const auto narrow = Peers(1, 3).shown(24, 40);
  EXPECT_EQ(lines_with(narrow, "7:7:"), 3U);
  EXPECT_EQ(lines_with(narrow, "LEDGER"), 0U);
  EXPECT_THAT(narrow,
              Contains(AllOf(HasSubstr("REMOTE"), HasSubstr("MARKING"), HasSubstr("AWAY"))));
  EXPECT_THAT(narrow, Contains(AllOf(HasSubstr("PEER"), HasSubstr("SEES"))));
}

TEST(LiveTable, ShowsTheNearestAndCountsTheRest) {
  const auto lines = Peers(1, 10'000).shown(10, 80);
  EXPECT_EQ(lines_with(lines, "7:7:"), 4U);
  // 7:7:64 is the nearest of the 64.
  EXPECT_THAT(lines[4], HasSubstr("7:7:61 "));
  EXPECT_THAT(lines[7], HasSubstr("7:7:64 "));
  EXPECT_THAT(lines[8], HasSubstr("and 9996 more, farther away"));
  EXPECT_THAT(lines[3], HasSubstr("4 of 10000"));
  const auto all = Peers(1, 10'000).shown(100, 80);
  EXPECT_EQ(lines_with(all, "7:7:"), 64U);
  EXPECT_THAT(all, Contains(HasSubstr("and 9936 more, farther away")));
}

TEST(LiveTable, SharesTheLinesAmongPeers) {
  const auto lines = Peers(8, 7).shown(24, 80);
  EXPECT_EQ(lines_with(lines, "of 7"), 8U);  // each peer has its line with the number not shown
  EXPECT_GE(lines_with(lines, "7:7:"), 8U);
  EXPECT_THAT(Peers(64, 63).shown(10, 80), Contains(HasSubstr("and 59 more peers")));
}

TEST(LiveTable, ReportsProblemsOfAHand) {
  Peers peers(2, 0, 2);
  peers.view(0).hands[1].servo.left_out = 4;
  peers.view(1).frozen = true;
  const auto lines = peers.shown(24, 80);
  EXPECT_THAT(lines, Contains(AllOf(HasSubstr("1:1:2"), HasSubstr("4 UNFELT"))));
  EXPECT_THAT(lines, Contains(AllOf(HasSubstr("1:2:1"), HasSubstr("FROZEN"))));
  EXPECT_THAT(lines, Contains(HasSubstr("no entity received yet")));
}

TEST(LiveTable, HandThatFeelsAnEntityIsNotFree) {
  Peers peers(1, 1, 2);
  peers.view(0).hands[0].servo.force.y() = 0.4;
  const auto lines = peers.shown(24, 80);
  EXPECT_THAT(lines,
              Contains(AllOf(HasSubstr("1:1:1"), HasSubstr("0.40 N"), HasSubstr("touches"))));
  EXPECT_THAT(lines, Contains(AllOf(HasSubstr("1:1:2"), HasSubstr("0.00 N"), HasSubstr("free"))));
}

std::size_t bar_of(const std::vector<std::string>& lines, std::string_view hand) {
  for (const std::string& line : lines)
    if (line.find(hand) != line.npos)
      return static_cast<std::size_t>(std::count(line.begin(), line.end(), '#'));
  return 0;
}

TEST(LiveTable, DrawsForcesAsBarsWithinTheTerminal) {
  Peers peers(1, 1, 3);
  peers.strongest_ = 4;
  peers.view(0).hands[0].servo.force.y() = 4;
  peers.view(0).hands[1].servo.force.y() = 2;
  peers.view(0).hands[2].servo.force.y() = 0.01;
  const auto lines = peers.shown(24, 80);
  EXPECT_THAT(lines[0], HasSubstr("bars to 4 N"));
  EXPECT_EQ(bar_of(lines, "1:1:1"), 8U);
  EXPECT_EQ(bar_of(lines, "1:1:2"), 4U);
  EXPECT_THAT(lines, Contains(AllOf(HasSubstr("1:1:1"), HasSubstr("4.00 N ######## touches"))));
  EXPECT_THAT(lines, Contains(AllOf(HasSubstr("1:1:3"), HasSubstr("0.01 N .        touches"))));
  EXPECT_EQ(bar_of(peers.shown(24, 200), "1:1:1"), 24U);
  EXPECT_EQ(bar_of(peers.shown(24, 40), "1:1:1"), 3U);
  EXPECT_EQ(bar_of(peers.shown(24, 30), "1:1:1"), 0U) << "no room";
}

TEST(LiveTable, ShowsNoRateOfSilentEntities) {
  Peers peers(1, 2);
  peers.view(0).rows[0].rate_hz = 52.4;
  peers.view(0).rows[1].rate_hz = 0;
  const auto lines = peers.shown(24, 80);
  EXPECT_EQ(lines_with(lines, "52.4 Hz"), 1U);
  EXPECT_EQ(lines_with(lines, " Hz"), 1U);
}

TEST(LiveTable, KeepsAHeadBelowItsTitle) {
  Peers peers(1, 50);
  peers.notices_ = {"one", "two", "three", "four"};
  peers.head_ = "page: http://127.0.0.1:8642/#word=1f2e";
  EXPECT_EQ(peers.shown(24, 80)[1], peers.head_);
  EXPECT_EQ(peers.shown(10, 80)[1], peers.head_);
  const auto narrow = peers.shown(24, 20);
  EXPECT_EQ(narrow[1] + narrow[2], peers.head_) << "whole, where it is wider than the terminal";
}

TEST(LiveTable, MarksHeldBackContactsAndLoans) {
  Peers peers(1, 1, 3);
  for (peer::HandView& hand : peers.view(0).hands) {
    hand.servo.count = 1;
    hand.servo.contacts[0].asked_force.x() = 2.3;
  }
  peers.view(0).hands[0].servo.spring_share = 0.8;
  peers.view(0).hands[0].servo.crowd_share = 0.5;
  peers.view(0).hands[1].servo.loan = 0.0023;
  const auto lines = peers.shown(24, 80);
  EXPECT_THAT(lines, Contains(AllOf(HasSubstr("1:1:1"), HasSubstr("HELD 40%"))));
  EXPECT_THAT(lines, Contains(AllOf(HasSubstr("1:1:2"), HasSubstr("LOAN 3mJ"))));
  EXPECT_THAT(lines, Contains(AllOf(HasSubstr("1:1:3"), HasSubstr("free"))));
  peers.view(0).hands[0].servo.count = 0;
  EXPECT_EQ(lines_with(peers.shown(24, 80), "HELD"), 0U) << "nothing is touched";
  peers.view(0).hands[0].servo.softening = 0.6;
  EXPECT_THAT(peers.shown(24, 80), Contains(AllOf(HasSubstr("1:1:1"), HasSubstr("SOFT 60%"))));
  peers.view(0).hands[2].servo.limit_share = 0.75;
  EXPECT_THAT(peers.shown(24, 80), Contains(AllOf(HasSubstr("1:1:3"), HasSubstr("CUT 75%"))));
}

TEST(LiveTable, ReportsSoftenedStiffnessAndRefusedModels) {
  Peers peers(2, 2);
  EXPECT_EQ(lines_with(peers.shown(24, 80), "softer"), 0U);
  for (const std::size_t i : {0U, 1U}) {
    peers.view(i).hands[0].stiffness.walls_asked = 20000;
    peers.view(i).hands[0].stiffness.walls = 1425;
    peers.view(i).rows[0].refused = true;
    peers.view(i).rows[1].k1 = 1500;
    peers.view(i).rows[1].k1_felt = 950;
  }
  const auto lines = peers.shown(24, 80);
  EXPECT_EQ(lines_with(lines, "softer than asked: walls 1425 of 20000 N/m"), 1U);
  EXPECT_THAT(lines, Contains(AllOf(HasSubstr("7:7:1 "), HasSubstr("REFUSED"))));
  EXPECT_THAT(peers.shown(24, 120), Contains(AllOf(HasSubstr("7:7:2 "), HasSubstr("950/1500"))));
}

TEST(LiveTable, NamesTheLeadersOfAScene) {
  Peers peers(2, 2);
  EXPECT_EQ(lines_with(peers.shown(24, 80), "leaders"), 0U);
  for (const std::size_t i : {0U, 1U}) {
    peer::LeadersView& leaders = peers.view(i).leaders;
    leaders.on = true;
    leaders.scene = {1, 2};
    leaders.count = leaders.cells = 1;
    leaders.rows[0] = {3, 4, {1, 2}};
  }
  EXPECT_EQ(lines_with(peers.shown(24, 80), "leaders: scene by 1:2; cells by 1:2: 1"), 1U);
}

TEST(LiveTable, CountsMovingBodiesAndThoseNotWoken) {
  Peers peers(2, 2);
  EXPECT_EQ(lines_with(peers.shown(24, 80), "bodies"), 0U);
  peers.view(1).bodies = 150;
  peers.view(1).bodies_awake = 12;
  EXPECT_EQ(lines_with(peers.shown(24, 80), "bodies: 12 of 150 move"), 1U);
  EXPECT_EQ(lines_with(peers.shown(24, 80), "stayed at rest"), 0U);
  peers.view(1).bodies_not_woken = 7;
  EXPECT_EQ(lines_with(peers.shown(24, 80), "12 of 150 move, in 7 steps one stayed at rest"), 1U);
}

// Bodies of two owners, and one whose owner is not known.
void share_bodies(peer::PeerView& view, std::size_t ours, std::size_t others) {
  view.body_owner_count = ours + others + 1;
  for (std::size_t i = 0; i < ours + others; ++i) {
    view.body_owners[i].is_ours = i < ours;
    view.body_owners[i].owner = {1, static_cast<std::uint16_t>(i < ours ? 1 : 2)};
    view.body_owners[i].changes = i < ours ? 2 : 0;
  }
}

TEST(LiveTable, CountsTheBodiesOfEachOwner) {
  Peers one(1, 1);
  share_bodies(one.view(0), 12, 16);
  one.view(0).bodies = 12;
  one.view(0).bodies_awake = 3;
  constexpr std::string_view kAll =
      "bodies 29: 16 of 1:2, 12 ours, 1 without an owner; 24 hand-overs; 3 of our 12 move";
  EXPECT_EQ(lines_with(one.shown(24, 100), kAll), 1U);
  EXPECT_EQ(lines_with(one.shown(24, 100), "REST"), 0U);
  one.view(0).bodies_rest = true;
  one.view(0).bodies = 0;
  EXPECT_EQ(lines_with(one.shown(24, 100), "24 hand-overs; REST"), 1U);

  Peers two(2, 2);
  share_bodies(two.view(0), 1, 1);
  share_bodies(two.view(1), 1, 1);
  EXPECT_EQ(lines_with(two.shown(24, 80), "bodies 3: 1 of 1:1, 1 of 1:2, 1 without an owner"), 1U);
}

TEST(LiveTable, LetsNoOctetOfOthersMoveTheCursor) {
  Peers peers(1, 1);
  peers.view(0).rows[0].marking = {'\033', '[', '2', 'J'};
  peers.notices_ = {"peer 'a\033[2J' joined"};
  peers.scene_.name = "t\xc3\xb6rn \n";
  for (const std::string& line : peers.shown(24, 120)) {
    EXPECT_EQ(line.find('\033'), line.npos) << line;
    EXPECT_EQ(line.find('\n'), line.npos) << line;
  }
  EXPECT_THAT(peers.shown(24, 120)[0], HasSubstr("t\xc3\xb6rn"));
}

TEST(LiveTable, KeepsTheNewestNoticesAboveTheKeys) {
  Peers peers(1, 50);
  peers.notices_ = {"one", "two", "three", "four"};
  const auto lines = peers.shown(24, 80);
  EXPECT_EQ(lines[20], "two");
  EXPECT_EQ(lines[22], "four");
  EXPECT_THAT(lines[23], HasSubstr("[q] quit"));
  EXPECT_THAT(peers.shown(5, 80), Not(Contains("four")));
}

// The instruction to the user is at the end of a sentence.
TEST(LiveTable, WrapsNoticesAndShowsMoreIfRoom) {
  Peers peers(1, 1);
  peers.notices_ = {
      "an old one that is far too long to be shown beside all the others: " + std::string(500, 'x'),
      "Falcon: it has no firmware, which it forgets without power: name the file of "
      "it (firmware = FILE)",
      "one", "two", "three"};
  auto lines = peers.shown(24, 60);
  const std::vector<std::string> foot(lines.end() - 7, lines.end() - 1);
  EXPECT_THAT(foot, ::testing::ElementsAre(
                        "", "Falcon: it has no firmware, which it forgets without power:",
                        "  name the file of it (firmware = FILE)", "one", "two", "three"));
  peers.notices_.push_back(std::string(2000, 'y'));  // too long for the free lines
  lines = peers.shown(24, 60);
  EXPECT_EQ(lines_with(lines, "yyy"), 8U);
  EXPECT_EQ(lines_with(lines, "1:1:1"), 1U);
}

TEST(LiveTable, MarksAHandWithoutForce) {
  Peers peers(1, 1, 2);
  peers.view(0).hands[1].servo.enabled = false;
  const auto lines = peers.shown(24, 100);
  EXPECT_THAT(lines, Contains(AllOf(HasSubstr("1:1:1"), HasSubstr("free"))));
  EXPECT_THAT(lines, Contains(AllOf(HasSubstr("1:1:2"), HasSubstr("OFF"))));
}

TEST(LiveTable, HasAStatusOfOneLine) {
  EXPECT_EQ(live_status(Peers(2, 1).picture()),
            "12.0 s: 2 peers, 1 remote entity seen, 240 datagrams sent, 6 lost");
}

}  // namespace
}  // namespace reckon::tools
