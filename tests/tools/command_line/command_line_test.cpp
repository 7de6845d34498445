// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/command_line/command_line.hpp"

#include <gmock/gmock.h>

#include <array>

#include "reckon/peer/notation/nearest_word.hpp"
#include "reckon/tests/tools/support/captured_console.hpp"

namespace reckon::tools {
namespace {

using std::chrono_literals::operator""ms;
using ::testing::HasSubstr;

struct Parsed {
  bool json = false;
  std::optional<std::chrono::nanoseconds> duration;
  std::optional<std::uint64_t> count;
  std::uint64_t peers = 2;
  std::string pace;
  std::string source;
  std::optional<int> status;
  std::string out;
  std::string err;
};

Parsed parse(const std::vector<std::string_view>& arguments) {
  Parsed parsed;
  const test::CapturedStream out;
  const test::CapturedStream err;
  Console console;
  console.out = out.file();
  console.err = err.file();
  CommandLine line("walk", "Walks.", "reckon walk --json\nreckon walk --for 10s home");
  line.flag("--json", parsed.json, "as JSON");
  line.option("--for", parsed.duration, "how long");
  line.option("--count", parsed.count, "how many");
  line.option("--peers", parsed.peers, "how many peers");
  line.choice("--pace", parsed.pace, {"slow", "fast"}, "how");
  line.word("SOURCE", parsed.source, false, "where from");
  parsed.status = line.parse(arguments, console);
  parsed.out = out.text();
  parsed.err = err.text();
  return parsed;
}

TEST(CommandLine, SetsGivenValuesAndKeepsTheDefaults) {
  const Parsed parsed = parse({"--json", "--for", "250 ms", "--count=7", "here"});
  EXPECT_FALSE(parsed.status.has_value());
  EXPECT_TRUE(parsed.json);
  EXPECT_EQ(parsed.duration, 250ms);
  EXPECT_EQ(parsed.count, 7U);
  EXPECT_EQ(parsed.peers, 2U);
  EXPECT_EQ(parsed.source, "here");
}

TEST(CommandLine, TakesASingleDashAsAWord) { EXPECT_EQ(parse({"-"}).source, "-"); }

TEST(CommandLine, ShowsExamplesInItsHelp) {
  const Parsed parsed = parse({"--help"});
  EXPECT_EQ(parsed.status, 0);
  EXPECT_THAT(parsed.out,
              HasSubstr("Examples:\n  reckon walk --json\n  reckon walk --for 10s home"));
  EXPECT_TRUE(parsed.err.empty());
}

// Flags of the whole verb, of one word after it, and of two.
std::string help_of(const std::vector<std::string_view>& arguments) {
  const test::CapturedStream out;
  Console console;
  console.out = out.file();
  std::string where;
  bool json = false, shoes = false, ticket = false;
  CommandLine line("go", "Goes.", "reckon go afoot --shoes\nreckon go by_train --ticket");
  line.word("HOW", where, true, "how");
  line.flag("--json", json, "as JSON");
  line.only_for("afoot");
  line.flag("--shoes", shoes, "afoot: with shoes");
  line.only_for("by_train by_bus");
  line.flag("--ticket", ticket, "with a ticket");
  EXPECT_EQ(line.parse(arguments, console), 0);
  return out.text();
}

TEST(CommandLine, ShowsFlagsByTheirWords) {
  const std::string help = help_of({"--help"});
  EXPECT_THAT(help, HasSubstr("Options:"));
  EXPECT_THAT(help,
              HasSubstr("as JSON\n\nOf go afoot:\n  --shoes                     with shoes\n"));
  EXPECT_THAT(help, HasSubstr("Of go by_train, by_bus:\n  --ticket"));
  EXPECT_THAT(help, HasSubstr("reckon go afoot --shoes\n  reckon go by_train --ticket"));
}

TEST(CommandLine, ShowsOnlyAWordsOwnFlagsAndExamples) {
  const std::string help = help_of({"by_train", "--help"});
  EXPECT_THAT(help, HasSubstr("--json"));
  EXPECT_THAT(help, HasSubstr("Of go by_train:\n  --ticket"));
  EXPECT_THAT(help, HasSubstr("Examples:\n  reckon go by_train --ticket"));
  EXPECT_THAT(help, ::testing::Not(HasSubstr("shoes")));
}

TEST(CommandLine, NamesTheNearestFlag) {
  const Parsed parsed = parse({"--cuont", "3"});
  EXPECT_EQ(parsed.status, 2);
  EXPECT_THAT(parsed.err, HasSubstr("did you mean '--count'?"));
  EXPECT_TRUE(parsed.out.empty());
}

TEST(CommandLine, RefusesWrongUnitsOfDurationsWithAnExample) {
  for (const std::string_view wrong : {"10 m", "-3s", "fast", "nan s", "10sec", "1e300 h"}) {
    const Parsed parsed = parse({"--for", wrong});
    EXPECT_EQ(parsed.status, 2) << wrong;
    EXPECT_THAT(parsed.err, HasSubstr("as in 10s")) << wrong;
  }
}

TEST(CommandLine, RefusesNumbersThatAreNone) {
  EXPECT_EQ(parse({"--count", "3x"}).status, 2);
  EXPECT_EQ(parse({"--count", "-3"}).status, 2);
  EXPECT_EQ(parse({"--peers", "99999999999999999999999"}).status, 2);
}

TEST(CommandLine, ListsItsFlagsAndWordsForCompletion) {
  const Parsed parsed = parse({kListFlags});
  EXPECT_EQ(parsed.status, 0);
  EXPECT_EQ(parsed.out, "--help\n--json\n--for\n--count\n--peers\n--pace slow fast\nSOURCE\n");
}

TEST(CommandLine, NamesTheNearestChoice) {
  const Parsed parsed = parse({"--pace", "fats"});
  EXPECT_EQ(parsed.status, 2);
  EXPECT_THAT(parsed.err, HasSubstr("--pace: 'fats' is none of slow, fast; did you mean 'fast'?"));
}

TEST(CommandLine, BlamesTheUnknownFlagInsteadOfItsValue) {
  for (const auto& words : std::vector<std::vector<std::string_view>>{
           {"--cuont", "3", "here"}, {"here", "--cuont=3"}, {"--for", "1s", "--cuont", "3"}}) {
    const Parsed parsed = parse(words);
    EXPECT_EQ(parsed.status, 2);
    EXPECT_THAT(parsed.err, HasSubstr("there is no flag '--cuont'; did you mean '--count'?"));
  }
  EXPECT_THAT(parse({"-x"}).err, HasSubstr("there is no flag '-x'"));
}

TEST(CommandLine, NamesTheMissingValueAndItsKind) {
  EXPECT_THAT(parse({"here", "--for"}).err, HasSubstr("--for needs a value after it: DURATION"));
  EXPECT_THAT(parse({"--pace"}).err, HasSubstr("needs a value after it: slow|fast"));
}

TEST(CommandLine, NamesTheSuperfluousWordAndTheUsage) {
  EXPECT_THAT(parse({"here", "there"}).err,
              HasSubstr("unexpected argument 'there'; write reckon walk [SOURCE] [FLAGS]"));
}

TEST(CommandLine, TakesAValueThatLooksLikeAFlag) {
  EXPECT_THAT(parse({"--count", "-3"}).err, HasSubstr("--count: '-3' is not a whole number"));
  EXPECT_THAT(parse({"--pace", "--json"}).err, ::testing::Not(HasSubstr("there is no flag")));
}

TEST(NearestWord, SuggestsOnlySimilarWords) {
  constexpr std::array<std::string_view, 3> kWords{"inspect", "doctor", "demo"};
  EXPECT_EQ(peer::nearest_word("inspct", kWords), "inspect");
  EXPECT_EQ(peer::nearest_word("dotcor", kWords), "doctor");
  EXPECT_EQ(peer::nearest_word("dmeo", kWords), "demo");
  EXPECT_EQ(peer::nearest_word("zzz", kWords), "");
  EXPECT_EQ(peer::nearest_word("", kWords), "");
}

}  // namespace
}  // namespace reckon::tools
