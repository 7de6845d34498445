// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// `reckon demo`: in which DIS exercise it runs.
#include <gmock/gmock.h>

#include <fstream>
#include <set>
#include <string>
#include <vector>

#include "reckon/tests/support/scratch_folder.hpp"
#include "reckon/tests/tools/support/captured_console.hpp"
#include "reckon/tools/command_line/console.hpp"

namespace reckon::tools {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

class DemoExercise : public testing::Test {
 protected:
  /// What a demo of this scene says beside its report.
  std::string said(const std::string& scene, std::vector<std::string> more) {
    const std::string path = folder_.file("scene.toml");
    std::ofstream(path) << scene << "[[operator]]\npassive = true\n";
    std::vector<std::string> words{"demo", path, "--for", "50ms", "--json"};
    words.insert(words.end(), more.begin(), more.end());
    const auto result = test::run_reckon(words);
    no_loopback_ = result.status == exit_status(ExitCode::environment);
    EXPECT_TRUE(no_loopback_ || result.status == 0) << result.err;
    return result.err;
  }

  reckon::test::ScratchFolder folder_;
  bool no_loopback_ = false;
};

TEST_F(DemoExercise, IsTheScenesWhereItNamesOneAndElseDrawnEachTime) {
  const std::string named = said("[network]\nexercise = 77\n", {});
  if (no_loopback_) GTEST_SKIP() << "no multicast on loopback: " << named;
  EXPECT_THAT(named, HasSubstr("DIS exercise 77\n"));
  std::set<std::string> drawn;
  for (int i = 0; i < 6; ++i) {
    const std::string text = said("", {});
    EXPECT_THAT(text, HasSubstr("drawn at random"));
    drawn.insert(text.substr(0, text.find(',')));
  }
  EXPECT_GT(drawn.size(), 1u);
}

TEST_F(DemoExercise, StaysWhereTimeIsSimulatedSoThatResultsDo) {
  EXPECT_THAT(said("", {"--simulated-time"}), Not(HasSubstr("DIS exercise")));
}

}  // namespace
}  // namespace reckon::tools
