// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Verbs of another program, which is searched beside this one and in PATH.
#include <gmock/gmock.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include "reckon/tests/support/scratch_folder.hpp"
#include "reckon/tests/tools/support/captured_console.hpp"

namespace reckon::tools {
namespace {

using test::run_reckon;
using ::testing::HasSubstr;

class StudyVerbs : public testing::Test {
 protected:
  StudyVerbs() { setenv("PATH", folder_.file("").c_str(), 1); }
  ~StudyVerbs() override { setenv("PATH", path_.c_str(), 1); }

  /// A script that prints its arguments.
  void install() const {
    const std::string program = folder_.file("reckon-bench");
    std::ofstream(program) << "#!/bin/sh\necho \"got: $*\"\nexit 5\n";
    std::filesystem::permissions(program, std::filesystem::perms::owner_all);
  }

 private:
  test::ScratchFolder folder_;
  std::string path_ = std::getenv("PATH");
};

TEST_F(StudyVerbs, NameTheRemedyForAMissingProgram) {
  for (const char* verb : {"bench", "figures", "tune", "zwidth"}) {
    const auto result = run_reckon({verb, "--json"});
    EXPECT_EQ(result.status, 3) << verb;
    EXPECT_TRUE(result.out.empty()) << verb;
    EXPECT_THAT(result.err, HasSubstr("./run build reckon-bench")) << verb;
    EXPECT_THAT(result.err, HasSubstr("the Debian package reckon has it")) << verb;
  }
  EXPECT_THAT(run_reckon({"help", "--man"}).out, HasSubstr("SS reckon zwidth"));
  EXPECT_EQ(run_reckon({"completion", "bash"}).status, 0);
}

TEST_F(StudyVerbs, PassTheirWordsAndReturnItsStatus) {
  install();
  const auto result = run_reckon({"bench", "scale", "--peers", "4 5"});
  EXPECT_EQ(result.status, 5);
  EXPECT_EQ(result.out, "got: bench scale --peers 4 5\n");
}

TEST_F(StudyVerbs, AreExplainedByIt) {
  install();
  EXPECT_EQ(run_reckon({"help", "tune"}).out, "got: tune --help\n");
}

}  // namespace
}  // namespace reckon::tools
