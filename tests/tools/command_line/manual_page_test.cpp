// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The manual page and the shell completion: both contain every verb and flag, as other programs
// read them.
#include "reckon/tools/command_line/manual_page.hpp"

#include <gmock/gmock.h>

#include <array>
#include <fstream>
#include <set>
#include <sstream>

#include "reckon/tests/support/scratch_folder.hpp"
#include "reckon/tests/tools/support/captured_console.hpp"
#include "reckon/tools/command_line/command_line.hpp"

namespace reckon::tools {
namespace {

using test::run_reckon;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsSupersetOf;

/// The output and errors of a shell command.
std::string output_of(const std::string& command) {
  std::string text;
  std::FILE* pipe = popen((command + " 2>&1").c_str(), "r");
  if (pipe == nullptr) return text;
  std::array<char, 4096> part{};
  while (const std::size_t size = std::fread(part.data(), 1, part.size(), pipe))
    text.append(part.data(), size);
  pclose(pipe);
  return text;
}

bool is_installed(const std::string& program) {
  return std::system(("command -v " + program + " >/dev/null 2>&1").c_str()) == 0;
}

std::set<std::string> words_in(const std::string& text) {
  std::istringstream stream(text);
  std::set<std::string> words;
  for (std::string word; stream >> word;) words.insert(word);
  return words;
}

/// First words of the lines of a verb's help: "--json", "SOURCE".
std::set<std::string> taken_by(const Verb& verb) {
  std::set<std::string> names;
  for (const std::string& line :
       run_reckon({std::string(verb.name), std::string(kListFlags)}).lines())
    names.insert(line.substr(0, line.find(' ')));
  return names;
}

/// Files in a folder that is removed after the test.
class ManualPage : public testing::Test {
 protected:
  std::string file(const std::string& name, const std::string& text) {
    const std::string path = folder_.file(name);
    std::ofstream(path) << text;
    return path;
  }
  std::string page() { return file("reckon.1", run_reckon({"help", "--man"}).out); }

 private:
  test::ScratchFolder folder_;
};

using Completion = ManualPage;

TEST_F(ManualPage, CoversEveryVerbWithItsFlagsAndWords) {
  const std::string page = run_reckon({"help", "--man"}).out;
  for (const Verb& verb : verbs()) {
    const std::size_t begin = page.find(".SS reckon " + std::string(verb.name) + " ");
    ASSERT_NE(begin, std::string::npos) << verb.name;
    const std::string section = page.substr(begin, page.find("\n.S", begin + 1) - begin);
    for (const std::string& name : taken_by(verb))
      EXPECT_THAT(section, HasSubstr(roff_text(name) + "\\fR")) << verb.name;
    EXPECT_THAT(section, HasSubstr("Examples:\n")) << verb.name;
  }
}

TEST_F(ManualPage, HasTheSectionsThatReadersLookFor) {
  const auto lines = run_reckon({"help", "--man"}).lines();
  for (const char* title : {"NAME", "SYNOPSIS", "DESCRIPTION", "VERBS", "EXIT STATUS",
                            "ENVIRONMENT", "FILES", "SEE ALSO"})
    EXPECT_THAT(lines, Contains(std::string(".SH ") + title));
}

TEST_F(ManualPage, IsCleanToMandoc) {
  if (!is_installed("mandoc")) GTEST_SKIP() << "needs mandoc (Debian: mandoc)";
  EXPECT_EQ(output_of("mandoc -T lint " + page()), "");
}

TEST_F(ManualPage, IsCleanToGroff) {
  if (!is_installed("groff")) GTEST_SKIP() << "needs groff (Debian: groff-base)";
  EXPECT_EQ(output_of("groff -man -Tutf8 -ww " + page() + " >/dev/null"), "");
}

TEST_F(ManualPage, ShowsFlagsAndExamplesAsTheyAreTyped) {
  if (!is_installed("mandoc")) GTEST_SKIP() << "needs mandoc (Debian: mandoc)";
  const std::string shown = output_of("mandoc -T ascii -O width=200 " + page() + " | col -b");
  const std::set<std::string> words = words_in(shown);
  for (const Verb& verb : verbs()) {
    EXPECT_THAT(words, IsSupersetOf(taken_by(verb))) << verb.name;
  }
  EXPECT_THAT(shown,
              HasSubstr("reckon inspect --for 10s --json | jq -c 'select(.status != \"ok\")'"));
}

TEST_F(ManualPage, KeepsCharactersThatRoffTakesForCommands) {
  EXPECT_EQ(roff_text(".SH x"), "\\&.SH x");
  EXPECT_EQ(roff_text("'x'"), "\\&\\(aqx\\(aq");
  EXPECT_EQ(roff_text("a\\b --c ~^`"), "a\\eb \\-\\-c \\(ti\\(ha\\(ga");
}

/// The completions of bash for the typed words, the last of them incomplete.
std::set<std::string> offered(const std::string& script, const std::vector<std::string>& typed) {
  std::string command = "bash -c 'source " + script +
                        "; COMP_WORDS=(\"$@\"); COMP_CWORD=$(($# - 1)); _reckon;"
                        " echo \"${COMPREPLY[@]}\"' bash";
  for (const std::string& word : typed) command += " '" + word + "'";
  return words_in(output_of(command));
}

TEST_F(Completion, OffersEveryFlagOfEveryVerbInBash) {
  if (!is_installed("bash")) GTEST_SKIP() << "needs bash";
  const std::string script = file("reckon.bash", run_reckon({"completion", "bash"}).out);
  for (const Verb& verb : verbs()) {
    std::set<std::string> flags = taken_by(verb);
    std::erase_if(flags, [](const std::string& name) { return !name.starts_with("--"); });
    EXPECT_EQ(offered(script, {"reckon", std::string(verb.name), "--"}), flags) << verb.name;
    EXPECT_THAT(offered(script, {"reckon", ""}), Contains(std::string(verb.name)));
    EXPECT_THAT(offered(script, {"reckon", "help", ""}), Contains(std::string(verb.name)));
  }
}

TEST_F(Completion, OffersTheChoicesOfWordsAndFlags) {
  if (!is_installed("bash")) GTEST_SKIP() << "needs bash";
  const std::string script = file("reckon.bash", run_reckon({"completion", "bash"}).out);
  EXPECT_THAT(offered(script, {"reckon", "inspect", "a.pcap", ""}), Contains("check"));
  EXPECT_THAT(offered(script, {"reckon", "inspect", "--json", "a.pcap", "st"}), Contains("stats"));
  EXPECT_THAT(offered(script, {"reckon", "inspect", "a.pcap", "stats", "--by", ""}),
              Contains("entity"));
  EXPECT_EQ(offered(script, {"reckon", "scene", "ch"}), std::set<std::string>{"check"});
  EXPECT_EQ(offered(script, {"reckon", "completion", ""}),
            (std::set<std::string>{"bash", "zsh", "fish"}));
}

}  // namespace
}  // namespace reckon::tools
