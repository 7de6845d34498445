// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <unistd.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "reckon/tests/support/scratch_folder.hpp"
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

TEST(Doctor, PrintsOneFindingPerLineWithItsRemedy) {
  const auto result = run_reckon({"doctor", "--iface", "lo"});
  EXPECT_THAT(result.out, HasSubstr("note  lo is loopback"));
  EXPECT_THAT(result.out, HasSubstr("\n      fix: "));
  EXPECT_THAT(result.err, HasSubstr(" failed\n"));
}

TEST(Doctor, ReportsWhetherProcessorsCanStayAwake) {
  const auto result = run_reckon({"doctor", "--iface", "lo"});
  const bool may = access("/dev/cpu_dma_latency", W_OK) == 0;
  EXPECT_THAT(result.out, HasSubstr(may ? "/dev/cpu_dma_latency is writable: "
                                        : "/dev/cpu_dma_latency is not writable: "));
}

TEST(Doctor, ChecksTheScenesGroupAndPort) {
  const reckon::test::ScratchFolder folder;
  const std::string scene = folder.file("scene.toml");
  std::ofstream(scene) << R"([scene]
name = "elsewhere"
origin = {latitude = "47 deg", longitude = "8 deg", height = "0 m"}
[network]
group = "239.192.9.0"
port = 3987
iface = "lo"
[aoim]
pool = 16
)";
  const auto result = run_reckon({"doctor", scene});
  EXPECT_THAT(result.out, HasSubstr("multicast on lo to 239.192.9.0:3987: "));
  EXPECT_THAT(result.out, HasSubstr("16 groups behind 239.192.9.0:3987 can be joined"));
  EXPECT_EQ(run_reckon({"doctor", folder.file("none.toml")}).status, 2);
}

TEST(Doctor, ReportsAMissingInterface) {
  const auto result = run_reckon({"doctor", "--iface", "no-such-interface"});
  EXPECT_EQ(result.status, 3);
  EXPECT_TRUE(result.out.empty());
  EXPECT_THAT(result.err, HasSubstr("no-such-interface"));
}

}  // namespace
}  // namespace reckon::tools
