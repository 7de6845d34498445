// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The program reckon-bench as a whole, and the verbs of `reckon` that start it.
#include "reckon/bench/program.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <string>

#include "reckon/tests/bench/support/bench_console.hpp"

namespace reckon::bench {
namespace {

using test::run_bench;
using ::testing::HasSubstr;

TEST(BenchProgram, HasTheVerbsThatReckonStarts) {
  std::size_t started = 0;
  for (const tools::Verb& verb : tools::verbs()) {
    if (verb.program != tools::kBenchProgram) continue;
    ++started;
    const auto ours = std::ranges::find(verbs(), verb.name, &tools::Verb::name);
    ASSERT_NE(ours, verbs().end()) << verb.name;
    EXPECT_EQ(ours->summary, verb.summary);
  }
  EXPECT_EQ(started, verbs().size());
}

TEST(BenchProgram, ListsItsVerbsAndExplainsEach) {
  const auto overview = run_bench({"--help"});
  EXPECT_EQ(overview.status, 0);
  EXPECT_THAT(overview.out, HasSubstr("usage: reckon-bench VERB"));
  for (const tools::Verb& verb : verbs()) {
    EXPECT_THAT(overview.out, HasSubstr(std::string(verb.summary)));
    const auto help = run_bench({std::string(verb.name), "--help"});
    EXPECT_EQ(help.status, 0) << verb.name;
    EXPECT_THAT(help.out, HasSubstr("reckon " + std::string(verb.name))) << verb.name;
    EXPECT_THAT(help.out, HasSubstr("xample")) << verb.name;
    EXPECT_TRUE(help.err.empty()) << verb.name;
  }
}

TEST(BenchProgram, RefusesUnknownVerbsAndFlags) {
  EXPECT_THAT(run_bench({"bensh"}).err, HasSubstr("did you mean 'bench'?"));
  EXPECT_EQ(run_bench({}).status, 2);
  for (const tools::Verb& verb : verbs()) {
    const auto result = run_bench({std::string(verb.name), "--no-such-flag"});
    EXPECT_EQ(result.status, 2) << verb.name;
    EXPECT_TRUE(result.out.empty()) << verb.name;
    EXPECT_FALSE(result.err.empty()) << verb.name;
  }
}

}  // namespace
}  // namespace reckon::bench
