// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "reckon/tools/command_line/duration_text.hpp"
#include "reckon/tools/terminal/json_text.hpp"
#include "reckon/tools/terminal/text_table.hpp"

namespace reckon::tools::text_test {
namespace {

using std::chrono_literals::operator""h;
using std::chrono_literals::operator""min;
using std::chrono_literals::operator""s;
using std::chrono_literals::operator""ms;
using std::chrono_literals::operator""us;
using std::chrono_literals::operator""ns;

TEST(DurationText, ReadsEveryUnit) {
  EXPECT_EQ(parse_duration("10s"), 10s);
  EXPECT_EQ(parse_duration("5 ms"), 5ms);
  EXPECT_EQ(parse_duration("250us"), 250us);
  EXPECT_EQ(parse_duration("7 ns"), 7ns);
  EXPECT_EQ(parse_duration("1.5 min"), 90s);
  EXPECT_EQ(parse_duration("2h"), 2h);
  EXPECT_EQ(parse_duration("0s"), 0s);
}

TEST(DurationText, RefusesOtherText) {
  for (const char* wrong : {"", "s", "ten s", "-1s", "inf s", "3 kg", "1s 2", "300 years"})
    EXPECT_FALSE(parse_duration(wrong).has_value()) << wrong;
}

TEST(DurationText, NeedsAUnitButForZero) {
  for (const char* wrong : {"10", "0.5", "1e3"})
    EXPECT_FALSE(parse_duration(wrong).has_value()) << wrong;
  EXPECT_EQ(parse_duration("0"), 0s);
}

TEST(DurationText, WritesAUnitThatSuits) {
  EXPECT_EQ(duration_text(0s), "0 s");
  EXPECT_EQ(duration_text(900ns), "900 ns");
  EXPECT_EQ(duration_text(5ms), "5 ms");
  EXPECT_EQ(duration_text(1250ms), "1.25 s");
  EXPECT_EQ(duration_text(-2ms), "-2 ms");
  EXPECT_EQ(duration_text(200s), "3 min 20 s");
  EXPECT_EQ(duration_text(3min), "3 min");
  EXPECT_EQ(duration_text(125min), "2 h 5 min");
}

TEST(Wrap, CutsBetweenWordsOrWithinLongOnes) {
  using Lines = std::vector<std::string>;
  EXPECT_EQ(wrap("", 10), Lines{""});
  EXPECT_EQ(wrap("ten or ten", 10), Lines{"ten or ten"});
  EXPECT_EQ(wrap("ten or eleven", 10), (Lines{"ten or", "  eleven"}));
  EXPECT_EQ(wrap("0123456789 0123456789", 10), (Lines{"0123456789", "  01234567", "  89"}));
  EXPECT_EQ(wrap("\u00e4\u00e4\u00e4\u00e4\u00e4 \u00e4\u00e4\u00e4\u00e4", 8),
            (Lines{"\u00e4\u00e4\u00e4\u00e4\u00e4", "  \u00e4\u00e4\u00e4\u00e4"}));
  EXPECT_EQ(wrap("to \033[2J", 20), Lines{"to .[2J"});
}

TEST(TextTable, AlignsColumnsByWidthInCodePoints) {
  TextTable table({{"NAME"}, {"N", TextTable::Align::right}});
  table.add({"\u00e4b", "7"});
  table.add({"longer", "1234"});
  table.add({"only"});
  EXPECT_EQ(table.text(),
            "NAME       N\n"
            "\u00e4b         7\n"
            "longer  1234\n"
            "only\n");
}

TEST(AngleText, HasTwoDigitsOrWholeDegrees) {
  EXPECT_EQ(angle_text(0.0009), "0");
  EXPECT_EQ(angle_text(0.214), "0.21 deg");
  EXPECT_EQ(angle_text(9.949), "9.9 deg");
  EXPECT_EQ(angle_text(171.887), "172 deg");
  EXPECT_EQ(angle_text(std::nan("")), "0");
}

TEST(Counted, MatchesTheNounToTheCount) {
  EXPECT_EQ(counted(0, "error"), "0 errors");
  EXPECT_EQ(counted(1, "error"), "1 error");
  EXPECT_EQ(counted(2, "error"), "2 errors");
}

TEST(JsonString, KeepsUtf8AndReplacesOtherOctets) {
  const auto quoted = [](std::string_view text) {
    std::string out;
    append_json_string(out, text);
    return out;
  };
  EXPECT_EQ(quoted("\u00e4\u20ac\U0001f600"), "\"\u00e4\u20ac\U0001f600\"");
  EXPECT_EQ(quoted("a\"b\\c\n"), "\"a\\\"b\\\\c\\u000a\"");
  EXPECT_EQ(quoted("\x1b[2J\x7f"), "\"\\u001b[2J\\u007f\"");
  EXPECT_EQ(quoted("\u009b31m"), "\"\\u009b31m\"");  // a control sequence in one character
  EXPECT_EQ(quoted("\xff"), "\"\\ufffd\"");
  EXPECT_EQ(quoted("\xc3"), "\"\\ufffd\"");                        // cut
  EXPECT_EQ(quoted("\xc0\xaf"), "\"\\ufffd\\ufffd\"");             // overlong
  EXPECT_EQ(quoted("\xed\xa0\x80"), "\"\\ufffd\\ufffd\\ufffd\"");  // a surrogate
}

}  // namespace
}  // namespace reckon::tools::text_test
