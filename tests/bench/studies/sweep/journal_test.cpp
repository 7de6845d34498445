// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/bench/studies/sweep/journal.hpp"

#include <gmock/gmock.h>

#include <fstream>

#include "reckon/tests/support/scratch_folder.hpp"
#include "reckon/tests/tools/support/written_files.hpp"
#include "reckon/tools/command_line/console.hpp"

namespace reckon::bench {
namespace {

using test::content;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

class Journal : public ::testing::Test {
 protected:
  [[nodiscard]] std::vector<std::string> found(std::string_view options = "a=1; b=2") const {
    return SweepJournal(path, "study", options, "x,y").found();
  }
  [[nodiscard]] std::string refusal(std::string_view options) const {
    try {
      static_cast<void>(found(options));
    } catch (const tools::UsageError& error) {
      return error.what();
    }
    return "taken";
  }
  void write(std::string_view text) const { std::ofstream(path, std::ios::binary) << text; }

  test::ScratchFolder scratch;
  std::string path = scratch.file("results.csv");
  const std::string head = "# study: a=1; b=2\nx,y\n";
};

TEST_F(Journal, ContinuesAtItsLastRow) {
  {
    SweepJournal journal(path, "study", "a=1; b=2", "x,y");
    EXPECT_THAT(journal.found(), IsEmpty());
    journal.append("1,2");
  }
  {
    SweepJournal journal(path, "study", "a=1; b=2", "x,y");
    EXPECT_THAT(journal.found(), ElementsAre("1,2"));
    journal.append("3,4");
  }
  EXPECT_EQ(content(path), head + "1,2\n3,4\n");
}

TEST_F(Journal, DropsATruncatedLine) {
  const std::string whole = head + "1,2\n3,4\n";
  for (std::size_t length = 0; length <= whole.size(); ++length) {
    write(whole.substr(0, length));
    SweepJournal(path, "study", "a=1; b=2", "x,y").append("5,6");
    const std::string kept =
        length < head.size() ? head : whole.substr(0, whole.substr(0, length).rfind('\n') + 1);
    EXPECT_EQ(content(path), kept + "5,6\n") << length;
  }
}

TEST_F(Journal, NamesTheFirstOptionThatDiffers) {
  EXPECT_THAT(found(), IsEmpty());
  EXPECT_THAT(
      refusal("a=1; b=3"),
      HasSubstr("other options: it has b=2, this study b=3; write a new file, or use its options"));
  EXPECT_THAT(refusal("a=1"), HasSubstr("it has b=2, this study no more"));
  EXPECT_THAT(refusal("a=1; b=2; c=3"), HasSubstr("it has no more, this study c=3"));
  EXPECT_EQ(content(path), head) << "left as it was";
}

TEST_F(Journal, TouchesNoForeignFile) {
  write("t_s,px_m\n0,1\n");
  EXPECT_THAT(refusal("a=1; b=2"), HasSubstr("does not contain this study"));
  EXPECT_EQ(content(path), "t_s,px_m\n0,1\n");
  write("no end of line");
  EXPECT_THAT(refusal("a=1; b=2"), HasSubstr("does not contain this study"));
}

TEST_F(Journal, RefusesUnwritablePlaces) {
  path = "/nowhere/results.csv";
  EXPECT_THAT(refusal("a=1; b=2"), HasSubstr("cannot be written"));
  path = scratch.file("");
  EXPECT_THAT(refusal("a=1; b=2"), HasSubstr("cannot be written"));
}

TEST_F(Journal, EndsWithTheResultsInOrder) {
  SweepJournal journal(path, "study", "a=1; b=2", "x,y");
  journal.append("3,4");
  journal.append("1,2");
  journal.finish({"1,2", "3,4"});
  EXPECT_EQ(content(path), head + "1,2\n3,4\n");
}

TEST_F(Journal, WithoutAPathKeepsNothing) {
  SweepJournal journal("", "study", "a=1", "x");
  journal.append("1");
  journal.finish({"1"});
  EXPECT_THAT(journal.found(), IsEmpty());
}

}  // namespace
}  // namespace reckon::bench
