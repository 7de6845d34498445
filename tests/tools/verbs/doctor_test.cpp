// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "reckon/tests/tools/support/captured_console.hpp"

namespace reckon::tools {
namespace {

using nlohmann::json;
using test::run_reckon;
using ::testing::AnyOf;
using ::testing::HasSubstr;

TEST(Doctor, GivesEachFindingWithItsLevelAsJson) {
  const auto result = run_reckon({"doctor", "--iface", "lo", "--json"});
  bool failed = false;
  ASSERT_GE(result.lines().size(), 5U);
  for (const std::string& line : result.lines()) {
    const json finding = json::parse(line);
    EXPECT_THAT(finding["level"].get<std::string>(), AnyOf("ok", "note", "warn", "fail"));
    EXPECT_FALSE(finding["what"].get<std::string>().empty());
    EXPECT_TRUE(finding["remedy"].is_string());
    failed = failed || finding["level"] == "fail";
  }
  EXPECT_EQ(result.status, failed ? 1 : 0);
}

TEST(Doctor, PrintsOneFindingALineWithItsRemedyBelow) {
  const auto result = run_reckon({"doctor", "--iface", "lo"});
  EXPECT_THAT(result.out, HasSubstr("note  lo is loopback"));
  EXPECT_THAT(result.out, HasSubstr("\n      fix: "));
  EXPECT_THAT(result.err, HasSubstr(" failed\n"));
}

TEST(Doctor, TellsOfAnInterfaceThatIsNotThere) {
  const auto result = run_reckon({"doctor", "--iface", "no-such-interface"});
  EXPECT_EQ(result.status, 3);
  EXPECT_TRUE(result.out.empty());
  EXPECT_THAT(result.err, HasSubstr("no-such-interface"));
}

}  // namespace
}  // namespace reckon::tools
