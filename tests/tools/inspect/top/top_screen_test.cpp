// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The screen of the view `top`, without a terminal.
#include <gmock/gmock.h>

#include <algorithm>
#include <string>
#include <vector>

#include "reckon/tests/support/capture_builder.hpp"
#include "reckon/tests/tools/support/watched_entities.hpp"
#include "reckon/tools/inspect/top/columns.hpp"
#include "reckon/tools/inspect/top/panes.hpp"
#include "reckon/tools/inspect/top/top_view.hpp"
#include "reckon/tools/terminal/text_table.hpp"

namespace reckon::tools {
namespace {

using namespace watched;
using test::append_pdu;
using test::Octets;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

/// A table with `count` entities, last received at 10 s.
TopData data_of(std::uint16_t count) {
  TopData data;
  data.source = "lo 239.1.2.3:3000";
  DatagramInspector inspector;
  for (int time = 0; time <= 10; time += 5) {
    for (std::uint16_t i = 1; i <= count; ++i) {
      Octets octets;
      append_pdu(octets, entity_at(time, i * (time / 5), i, "VEH" + std::to_string(i)));
      peer::SourceDatagram datagram;
      datagram.time = after(time);
      datagram.bytes = octets;
      (void)inspector.inspect(datagram, [&](const PduRow& row) {
        data.totals.count(row);
        data.entities.take_pdu(row, datagram);
        return true;
      });
      data.totals.count(datagram);
    }
  }
  data.now = after(10);
  return data;
}

std::string text_of(const std::vector<ScreenLine>& lines) {
  std::string text;
  for (const ScreenLine& line : lines) text += line.text + '\n';
  return text;
}

void type(TopScreen& screen, std::string_view letters, const TopData& data) {
  for (const char letter : letters) screen.press({Key::character, letter}, data);
}

TEST(TopScreen, FitsEveryTerminal) {
  const TopData data = data_of(50);
  for (const std::size_t rows : {0U, 1U, 2U, 3U, 5U, 24U, 80U}) {
    for (const std::size_t columns : {1U, 2U, 9U, 40U, 80U, 300U}) {
      TopScreen screen;
      for (const std::string_view keys : {"", "b", "b", "c", "c", "s", "/side ==", "x"}) {
        type(screen, keys, data);
        const auto lines = screen.lines(data, {}, {rows, columns});
        EXPECT_EQ(lines.size(), rows);
        for (const ScreenLine& line : lines) EXPECT_LE(text_width(line.text), columns);
      }
      screen.press({Key::enter}, data);
      screen.press({Key::escape}, data);
      screen.press({Key::enter}, data);
      EXPECT_EQ(screen.lines(data, {}, {rows, columns}).size(), rows);
    }
  }
}

TEST(TopScreen, CutsOnlyWholeColumns) {
  const TopData data = data_of(3);
  TopScreen wide;
  const auto all = wide.lines(data, {}, {24, 400});
  const auto row_of = [](const std::vector<ScreenLine>& lines) {
    return std::ranges::find_if(lines,
                                [](const ScreenLine& one) { return one.text.starts_with("1:2:2"); })
        ->text;
  };
  const std::string whole = row_of(all);
  for (std::size_t columns = 40; columns < 200; ++columns) {
    TopScreen screen;
    std::string row = row_of(screen.lines(data, {}, {24, columns}));
    row.erase(row.find_last_not_of(' ') + 1);
    ASSERT_TRUE(whole.starts_with(row)) << row;
    EXPECT_TRUE((whole + "  ").substr(row.size()).starts_with("  ")) << columns << ": " << row;
  }
  TopScreen screen;
  screen.press({Key::right}, data);
  EXPECT_TRUE(screen.lines(data, {}, {8, 40})[3].text.starts_with("MARK")) << "a column of a key";
}

TEST(TopScreen, ShowsHowToQuitInAnyTerminal) {
  const TopData data = data_of(5);
  TopScreen screen;
  for (const bool pane : {false, true}) {
    if (pane) type(screen, "b", data);
    for (const std::size_t columns : {40U, 80U, 200U})
      EXPECT_THAT(screen.lines(data, {}, {24, columns})[23].text, HasSubstr("[q] quit"));
  }
  screen.press({Key::escape}, data);
  EXPECT_THAT(screen.lines(data, {}, {24, 80})[23].text, testing::EndsWith("[b] bundles"));
  EXPECT_THAT(screen.lines(data, {}, {24, 120})[23].text, testing::EndsWith("[space] freeze"));
}

TEST(TopScreen, ReportsSilenceInsteadOfAnUnknownTime) {
  TopData data;
  data.source = "239.192.1.0:3000";
  data.now = after(1e6);
  data.notices = {"nothing received yet at 239.192.1.0:3000 on lo and eth0"};
  TopScreen screen;
  const std::string silent = text_of(screen.lines(data, {}, {24, 40}));
  EXPECT_THAT(silent, HasSubstr("   ex -   0:00 "));
  EXPECT_THAT(silent, HasSubstr("nothing received yet at 239.192.1.0:3000\non lo and eth0"));
  peer::SourceDatagram datagram;
  datagram.time = after(1e6 - 5);
  data.totals.count(datagram);
  data.interfaces = "lo, eth0";
  const std::string heard = text_of(screen.lines(data, {}, {24, 200}));
  EXPECT_THAT(heard, HasSubstr("239.192.1.0:3000   on lo, eth0   ex -   0:05 "));
  EXPECT_THAT(heard, Not(HasSubstr("nothing received yet")));
}

TEST(TopScreen, ScrollsThroughAllRows) {
  const TopData data = data_of(50);
  TopScreen screen;
  const ScreenSize size{12, 200};
  EXPECT_THAT(text_of(screen.lines(data, {}, size)), HasSubstr("VEH1 "));
  for (int i = 0; i < 49; ++i) screen.press({Key::down}, data);
  EXPECT_THAT(text_of(screen.lines(data, {}, size)), HasSubstr("VEH50 "));
  for (int i = 0; i < 9; ++i) screen.press({Key::page_up}, data);
  EXPECT_THAT(text_of(screen.lines(data, {}, size)), HasSubstr("VEH1 "));
  screen.press({Key::end}, data);
  EXPECT_THAT(text_of(screen.lines(data, {}, size)), HasSubstr("VEH50 "));
  screen.press({Key::home}, data);
  EXPECT_THAT(text_of(screen.lines(data, {}, size)), HasSubstr("VEH1 "));
}

TEST(TopScreen, SortsByTheColumnThatSChooses) {
  const TopData data = data_of(5);
  TopScreen screen;
  const auto first_row = [&] {
    const auto lines = screen.lines(data, {}, {24, 200});
    const auto titles = std::find_if(lines.begin(), lines.end(), [](const ScreenLine& line) {
      return line.text.starts_with("ID");
    });
    return titles == lines.end() ? std::string() : (titles + 1)->text;
  };
  EXPECT_THAT(first_row(), HasSubstr("VEH1"));
  type(screen, "s", data);  // rate
  type(screen, "s", data);  // median of jumps
  EXPECT_THAT(text_of(screen.lines(data, {}, {24, 200})), HasSubstr("JUMP p50v"));
  EXPECT_THAT(first_row(), HasSubstr("VEH5"));
  type(screen, "r", data);
  EXPECT_THAT(first_row(), HasSubstr("VEH1"));
}

TEST(TopScreen, FiltersAndMarksTheColumnOfAnError) {
  const TopData data = data_of(5);
  TopScreen screen;
  const ScreenSize size{24, 200};
  type(screen, "/side == friendly and knd == platform", data);
  screen.press({Key::enter}, data);
  const auto lines = screen.lines(data, {}, size);
  ASSERT_GE(lines.size(), 3U);
  const std::string& written = lines[size.rows - 3].text;
  EXPECT_THAT(written, HasSubstr("filter: side == friendly and knd"));
  EXPECT_EQ(lines[size.rows - 2].text.find('^'), written.find("knd"));
  EXPECT_THAT(lines[size.rows - 1].text, HasSubstr("no field 'knd'"));
  for (int i = 0; i < 50; ++i) screen.press({Key::backspace}, data);
  type(screen, "marking == VEH3", data);
  screen.press({Key::enter}, data);
  const std::string text = text_of(screen.lines(data, {}, size));
  EXPECT_THAT(text, HasSubstr("1:2:3"));
  EXPECT_THAT(text, Not(HasSubstr("VEH2")));
  EXPECT_THAT(text, HasSubstr("filter: marking == VEH3"));
}

TEST(TopScreen, FollowsOneEntity) {
  const TopData data = data_of(5);
  TopScreen screen;
  const ScreenSize size{40, 100};
  (void)screen.lines(data, {}, size);
  screen.press({Key::down}, data);
  (void)screen.lines(data, {}, size);
  screen.press({Key::enter}, data);
  const std::string text = text_of(screen.lines(data, {}, size));
  EXPECT_THAT(text, HasSubstr("1:2:2  VEH2"));
  EXPECT_THAT(text, HasSubstr("location      (6378137.000, 0.000, 4.000) m"));
  EXPECT_THAT(text, HasSubstr("last 2.00 m"));
  EXPECT_THAT(text, HasSubstr("last 2 jumps, the largest 2.00 m"));
  EXPECT_THAT(text, HasSubstr("##"));
  screen.press({Key::escape}, data);
  EXPECT_THAT(text_of(screen.lines(data, {}, size)), HasSubstr("VEH5"));
}

TEST(TopScreen, StaysConstantWhileFrozen) {
  TopScreen screen;
  const TopData before = data_of(2);
  (void)screen.lines(before, {}, {24, 200});
  type(screen, " ", before);
  const TopData later = data_of(3);
  const std::string frozen = text_of(screen.lines(later, {}, {24, 200}));
  EXPECT_THAT(frozen, HasSubstr("FROZEN"));
  EXPECT_THAT(frozen, Not(HasSubstr("VEH3")));
  type(screen, " ", later);
  EXPECT_THAT(text_of(screen.lines(later, {}, {24, 200})), HasSubstr("VEH3"));
}

TEST(TopScreen, NamesTheBusiestSimulation) {
  TopData data = data_of(5);
  EXPECT_EQ(top_advice(data), "");  // there is no other
  DatagramInspector inspector;
  Octets octets;
  pdu::EntityState other = entity_at(0, 0, 1, "OTHER");
  other.entity_id = {7, 8, 9};
  append_pdu(octets, other);
  peer::SourceDatagram datagram;
  datagram.time = after(10);
  datagram.bytes = octets;
  (void)inspector.inspect(datagram, [&](const PduRow& row) {
    data.entities.take_pdu(row, datagram);
    return true;
  });
  const std::string advice = top_advice(data);
  EXPECT_THAT(advice, HasSubstr("1:2:* sends 94 % of the octets of entities"));
  EXPECT_THAT(advice, HasSubstr("99 % of its jumps are below 5.00 m"));
  TopScreen screen;
  EXPECT_THAT(text_of(screen.lines(data, {}, {24, 200})), HasSubstr("advice: 1:2:* sends"));
}

TEST(TopScreen, EndsByQExceptWhileTypingAFilter) {
  const TopData data = data_of(1);
  TopScreen screen;
  type(screen, "/q", data);
  EXPECT_FALSE(screen.quit());
  screen.press({Key::escape}, data);
  type(screen, "q", data);
  EXPECT_TRUE(screen.quit());
}

TEST(TopScreen, DrawsBarsInStepsOfTheLargest) {
  const std::vector<double> values{0, 1, 2, 4, 0.1};
  EXPECT_THAT(bar_plot(values, 4), ElementsAre("   # ", "   # ", "  ## ", " ###."));
  EXPECT_THAT(bar_plot(std::vector<double>{0, 0}, 2), ElementsAre("  ", "  "));
}

TEST(TopColumns, WritesDistancesAsPeopleDo) {
  EXPECT_EQ(distance_text(0), "0");
  EXPECT_EQ(distance_text(2.1e-4), "0.21 mm");
  EXPECT_EQ(distance_text(0.012), "12 mm");
  EXPECT_EQ(distance_text(0.48), "0.48 m");
  EXPECT_EQ(distance_text(123.4), "123 m");
  EXPECT_EQ(distance_text(45'600), "46 km");
}

}  // namespace
}  // namespace reckon::tools
