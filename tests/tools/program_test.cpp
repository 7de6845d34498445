// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The program as a whole: its verbs, help, completion and exit codes.
#include "reckon/tools/program.hpp"

#include <gmock/gmock.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <string_view>

#include "reckon/tests/support/places.hpp"
#include "reckon/tests/tools/support/captured_console.hpp"
#include "reckon/tools/inspect/view_list.hpp"

namespace reckon::tools {
namespace {

using test::run_reckon;
using ::testing::HasSubstr;

TEST(Program, ListsEveryVerbInItsHelp) {
  const auto result = run_reckon({"help"});
  EXPECT_EQ(result.status, 0);
  for (const Verb& verb : verbs()) {
    EXPECT_THAT(result.out, HasSubstr(std::string(verb.name)));
    EXPECT_THAT(result.out, HasSubstr(std::string(verb.summary)));
  }
}

/// The names N of all definitions `TYPE N() {` in the files of a folder.
std::set<std::string> defined_in(const std::filesystem::path& folder, const std::string& type) {
  std::set<std::string> names;
  const std::regex definition("\\n" + type + " (\\w+)\\(\\) \\{");
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    if (entry.path().extension() != ".cpp") continue;
    std::ifstream stream(entry.path());
    const std::string text{std::istreambuf_iterator<char>(stream), {}};
    for (std::sregex_iterator at(text.begin(), text.end(), definition), end; at != end; ++at)
      names.insert((*at)[1]);
  }
  return names;
}

TEST(Program, HasARowForEachDefinedVerb) {
  const auto defined = defined_in(reckon::test::source_dir() + "/tools/verbs", "Verb");
  EXPECT_GT(defined.size(), 10U);
  std::set<std::string> listed;
  for (const Verb& verb : verbs()) listed.emplace(verb.name);
  for (const std::string& name : defined)
    EXPECT_TRUE(listed.contains(name)) << name << " has no row in verb_rows.hpp";
}

TEST(Program, StartsEachVerbInItsProgram) {
  for (const auto& [program, own] :
       {std::pair{kPeerProgram, peer_verbs()}, std::pair{kInspectProgram, inspect_verbs()}}) {
    for (const Verb& verb : own) {
      const auto row = std::ranges::find(kVerbRows, verb.name, &VerbRow::name);
      ASSERT_NE(row, kVerbRows.end()) << verb.name;
      EXPECT_EQ(row->program, program) << verb.name;
    }
    EXPECT_EQ(std::ranges::count(kVerbRows, program, &VerbRow::program), std::ssize(own));
  }
}

TEST(Program, HasARowForEachDefinedView) {
  const auto defined = defined_in(reckon::test::source_dir() + "/tools/inspect", "InspectViewKind");
  EXPECT_GT(defined.size(), 5U);
  std::set<std::string> listed;
  for (const InspectViewKind& kind : inspect_views()) listed.emplace(kind.name);
  for (const std::string& name : defined)
    EXPECT_TRUE(listed.contains(name)) << name << " has no row in tools/inspect/view_list.cpp";
}

TEST(Program, GivesAnExampleInEachVerbsHelp) {
  for (const Verb& verb : verbs()) {
    if (verb.program == kBenchProgram) continue;
    const auto result = run_reckon({std::string(verb.name), "--help"});
    EXPECT_EQ(result.status, 0) << verb.name;
    EXPECT_THAT(result.out, HasSubstr("reckon " + std::string(verb.name))) << verb.name;
    EXPECT_THAT(result.out, HasSubstr("xample")) << verb.name;
    EXPECT_TRUE(result.err.empty()) << verb.name;
    EXPECT_EQ(run_reckon({"help", std::string(verb.name)}).out, result.out) << verb.name;
  }
}

TEST(Program, GivesExamplesWithFilesThatExist) {
  const std::regex file(
      "reckon (?:inspect|view|replay|info|cut|peer|demo|scene \\w+) (\\S+\\.\\w+)|--(?:mesh|hand) "
      "(\\S+\\.\\w+)");
  std::size_t found = 0;
  for (const Verb& verb : verbs()) {
    if (verb.program == kBenchProgram) continue;
    std::istringstream help(run_reckon({std::string(verb.name), "--help"}).out);
    for (std::string line; std::getline(help, line);) {
      if (!line.starts_with("  reckon ") || line.find("--key") != line.npos) continue;
      for (std::sregex_iterator at(line.begin(), line.end(), file), end; at != end; ++at) {
        const std::string name = (*at)[1].matched ? (*at)[1] : (*at)[2];
        if (name.find_first_of(":*") != name.npos) continue;
        ++found;
        EXPECT_TRUE(std::filesystem::exists(test::source_dir() + "/" + name)) << line;
      }
    }
  }
  EXPECT_GT(found, 20U);
}

TEST(Program, PrintsItsVersion) {
  const auto result = run_reckon({"--version"});
  EXPECT_EQ(result.status, 0);
  EXPECT_THAT(result.out, ::testing::StartsWith("reckon 0."));
}

TEST(Program, ExplainsItselfOnStderrWithoutAVerb) {
  const auto result = run_reckon({});
  EXPECT_EQ(result.status, 2);
  EXPECT_TRUE(result.out.empty());
  EXPECT_THAT(result.err, HasSubstr("usage: reckon VERB"));
}

TEST(Program, NamesTheNearestVerb) {
  const auto result = run_reckon({"inspetc", "file.pcap"});
  EXPECT_EQ(result.status, 2);
  EXPECT_TRUE(result.out.empty());
  EXPECT_THAT(result.err, HasSubstr("did you mean 'inspect'?"));
}

TEST(Program, ReportsUnwritableOutput) {
  std::FILE* full = std::fopen("/dev/full", "w");
  if (full == nullptr) GTEST_SKIP() << "needs /dev/full";
  const test::CapturedStream err;
  Console console;
  console.out = full;
  console.err = err.file();
  const std::array<std::string_view, 2> words{"help", "--man"};
  EXPECT_EQ(test::run_program(words, console), 3);
  EXPECT_THAT(err.text(), HasSubstr("reckon help: writing the output: No space left"));
  std::fclose(full);
}

TEST(Program, EndsCleanlyOnRequestDuringBlockedOutput) {
  cookie_io_functions_t functions{};
  functions.write = [](void*, const char*, std::size_t) -> ssize_t { return errno = EINTR, 0; };
  for (const bool asked : {true, false}) {
    std::FILE* slow = fopencookie(nullptr, "w", functions);
    const test::CapturedStream err;
    const std::atomic<bool> stop = asked;
    Console console;
    console.out = slow;
    console.err = err.file();
    console.stop = &stop;
    const std::array<std::string_view, 2> words{"help", "--man"};
    EXPECT_EQ(test::run_program(words, console), asked ? 0 : 3) << err.text();
    std::fclose(slow);
  }
}

TEST(Program, NamesTheNearestOfItsOwnFlags) {
  const auto result = run_reckon({"--verison"});
  EXPECT_EQ(result.status, 2);
  EXPECT_THAT(result.err, HasSubstr("there is no flag '--verison'; did you mean '--version'?"));
}

TEST(Program, NamesTheFormsOfASource) {
  for (const char* wrong : {"http://x", "raw:", "iface:"}) {
    const auto result = run_reckon({"inspect", wrong});
    EXPECT_EQ(result.status, 2) << wrong;
    EXPECT_THAT(result.err, HasSubstr("write ")) << wrong;
  }
}

TEST(Program, RefusesAnUnknownFlagOfEveryVerb) {
  for (const Verb& verb : verbs()) {
    if (verb.program == kBenchProgram) continue;
    const auto result = run_reckon({std::string(verb.name), "--no-such-flag"});
    EXPECT_EQ(result.status, 2) << verb.name;
    EXPECT_TRUE(result.out.empty()) << verb.name;
    EXPECT_FALSE(result.err.empty()) << verb.name;
  }
}

TEST(Program, CompletesEveryVerbInEveryShell) {
  for (const std::string shell : {"bash", "zsh", "fish"}) {
    const auto result = run_reckon({"completion", shell});
    EXPECT_EQ(result.status, 0) << shell;
    for (const Verb& verb : verbs())
      EXPECT_THAT(result.out, HasSubstr(std::string(verb.name))) << shell;
    EXPECT_THAT(result.out, HasSubstr("json")) << shell << " misses the flags";
  }
}

TEST(Program, CompletesValuesOfFlagsAndInterfaces) {
  for (const auto& [shell, interfaces] :
       {std::pair{"bash",
                  "record:--iface) COMPREPLY=($(compgen -P \"$before\" -W '$(ls /sys/class/net)'"},
        std::pair{"zsh", "record:--iface) compset -P '*,'; compadd -- $(ls /sys/class/net);"},
        std::pair{"fish", "-l iface -x -a '(ls /sys/class/net)'"}}) {
    const std::string script = run_reckon({"completion", shell}).out;
    EXPECT_THAT(script, HasSubstr(interfaces)) << shell;
    EXPECT_THAT(script, testing::Not(HasSubstr("@interfaces"))) << shell;
  }
}

TEST(Program, CompletesTypesOfPdusForFields) {
  EXPECT_THAT(run_reckon({"completion", "bash"}).out,
              testing::ContainsRegex("inspect:--fields[^\n]*entity_state_update"));
}

TEST(Program, NeedsToKnowForWhichShell) {
  EXPECT_EQ(run_reckon({"completion"}).status, 2);
  EXPECT_EQ(run_reckon({"completion", "tcsh"}).status, 2);
}

// Sanitizers use the address space themselves.
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
/// Address space of this process [octets].
rlim_t address_space() {
  std::ifstream file("/proc/self/statm");
  rlim_t pages = 0;
  file >> pages;
  return pages * static_cast<rlim_t>(sysconf(_SC_PAGESIZE));
}

/// Runs with `more` address space than in use, and ends with its status.
[[noreturn]] void run_within(rlim_t more) {
  const rlim_t most = address_space() + more;
  const rlimit limit{most, most};
  setrlimit(RLIMIT_AS, &limit);
  const std::string scene = reckon::test::source_dir() + "/scenes/two_hands.toml";
  const std::array<std::string_view, 5> words{"demo", scene, "--simulated-time", "--for", "50ms"};
  std::_Exit(test::run_program(words, {}));
}

TEST(ProgramDeathTest, NamesTheRemedyForTooLittleAddressSpace) {
  for (const rlim_t megabytes : {4, 16, 64})
    EXPECT_EXIT(run_within(megabytes << 20), ::testing::ExitedWithCode(3),
                "reckon demo: ulimit -v .*raise it");
}
#endif

}  // namespace
}  // namespace reckon::tools
