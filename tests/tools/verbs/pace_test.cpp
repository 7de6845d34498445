// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// --pace: the budget of bodies of a slower host, written into summary and trace.
#include <gmock/gmock.h>

#include <fstream>
#include <regex>
#include <sstream>
#include <string>

#include "reckon/tests/support/places.hpp"
#include "reckon/tests/support/scratch_folder.hpp"
#include "reckon/tests/tools/support/captured_console.hpp"

namespace reckon::tools {
namespace {

using test::run_reckon;
using ::testing::HasSubstr;

class Pace : public testing::Test {
 protected:
  [[nodiscard]] std::string file(const std::string& name) const { return folder_.file(name); }
  // The trace of a run of three seconds; its JSON in `summary`.
  std::string traced(const std::string& pace, std::string& summary) const {
    const auto run = run_reckon({"demo", cubes_, "--peers", "2", "--simulated-time", "--for", "3s",
                                 "--json", "--pace", pace, "--trace", file("t.csv")});
    EXPECT_EQ(run.status, 0) << run.err;
    summary = run.out;
    std::stringstream text;
    text << std::ifstream(file("t.csv")).rdbuf();
    return text.str();
  }

  const std::string cubes_ = test::source_dir() + "/scenes/cubes.toml";

 private:
  test::ScratchFolder folder_;
};

TEST_F(Pace, RepeatsRunOfASlowerHost) {
  std::string first, second, slow;
  const std::string trace = traced("1", first);
  EXPECT_EQ(traced("1", second), trace);
  const std::string slower = traced("8", slow);
  EXPECT_THAT(first, HasSubstr(R"("pace":1})"));
  EXPECT_THAT(slow, HasSubstr(R"("pace":8})"));
  EXPECT_THAT(slower, HasSubstr(",1,8\n"));
  const auto without_pace = [](const std::string& text) {
    return std::regex_replace(text, std::regex(",[0-9]+\n"), "\n");
  };
  EXPECT_NE(without_pace(slower), without_pace(trace));
}

TEST_F(Pace, IsRefusedOutsideRangeAndWithoutBodies) {
  const auto wide = run_reckon({"demo", cubes_, "--pace", "9"});
  EXPECT_EQ(wide.status, 2);
  EXPECT_THAT(wide.err, HasSubstr("--pace: 9 is not from 0.25 to 8"));
  const auto useless = run_reckon({"demo", "--pace", "2"});
  EXPECT_EQ(useless.status, 2);
  EXPECT_THAT(useless.err, HasSubstr("--pace: no object of the scene has a mass"));
}

}  // namespace
}  // namespace reckon::tools
