// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// `reckon bench stability`: its files, an interrupted study, scenes and recorded hands.
#include <gmock/gmock.h>

#include <atomic>
#include <fstream>
#include <nlohmann/json.hpp>

#include "reckon/tests/bench/support/bench_console.hpp"
#include "reckon/tests/support/scratch_folder.hpp"
#include "reckon/tests/tools/support/written_files.hpp"

namespace reckon::bench {
namespace {

using nlohmann::json;
using test::content;
using test::run_bench;
using ::testing::HasSubstr;
using ::testing::Not;

std::vector<std::string> study(const std::vector<std::string>& more) {
  std::vector<std::string> words{"bench", "stability",  "--for",
                                 "3s",    "--coupling", "reckon,gain_cut"};
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

json first_line(const std::vector<std::string>& more) {
  std::vector<std::string> words = study(more);
  words.push_back("--json");
  const auto result = run_bench(words);
  EXPECT_EQ(result.status, 0) << result.err;
  return result.lines().empty() ? json() : json::parse(result.lines().front());
}

TEST(StabilityVerb, ContinuesAnInterruptedFile) {
  const test::ScratchFolder scratch;
  const std::string whole = scratch.file("whole.csv"), cut = scratch.file("cut.csv");
  const auto words = [](const std::string& file) {
    return study({"--sweep", "delay=0,50ms", "--sweep", "loss=0,30%", "--csv", file});
  };
  const auto first = run_bench(words(whole));
  ASSERT_EQ(first.status, 0) << first.err;
  EXPECT_THAT(first.err, Not(HasSubstr("left"))) << "a bar is for terminals";
  const std::string text = content(whole);
  EXPECT_EQ(std::ranges::count(text, '\n'), 2 + 8);
  for (const std::size_t length :
       {std::size_t{0}, std::size_t{9}, text.size() / 2, text.size() - 3, text.size()}) {
    std::ofstream(cut, std::ios::binary) << text.substr(0, length);
    const auto again = run_bench(words(cut));
    EXPECT_EQ(again.status, 0) << again.err;
    EXPECT_EQ(content(cut), text) << length;
    EXPECT_EQ(again.out, first.out) << length;
  }
}

TEST(StabilityVerb, StopsWithItsResultsAndCanContinue) {
  const test::ScratchFolder scratch;
  const std::string file = scratch.file("s.csv");
  const std::atomic<bool> stop{true};
  const auto result = run_bench(study({"--sweep", "delay=0..1s/50", "--csv", file}), &stop);
  EXPECT_EQ(result.status, 0);
  EXPECT_EQ(result.out, "");
  EXPECT_THAT(result.err, HasSubstr("of 100; the same command continues from"));
  EXPECT_THAT(content(file), ::testing::StartsWith("# reckon bench stability: modes="));
}

TEST(StabilityVerb, RefusesAFileOfOtherOptions) {
  const test::ScratchFolder scratch;
  const std::string file = scratch.file("s.csv");
  ASSERT_EQ(run_bench(study({"--sweep", "delay=0", "--csv", file})).status, 0);
  const std::string before = content(file);
  const auto result = run_bench(study({"--sweep", "delay=1ms", "--csv", file}));
  EXPECT_EQ(result.status, 2);
  EXPECT_THAT(result.err,
              HasSubstr("it has impairment.delay=0 s, this study impairment.delay=1 ms"));
  EXPECT_EQ(content(file), before);
}

TEST(StabilityVerb, SceneIsTheBaseOfTheCells) {
  const test::ScratchFolder scratch;
  const std::string scene = scratch.file("lab.toml"), file = scratch.file("s.csv");
  std::ofstream(scene) << "[hand]\nk1 = \"300 N/m\"\n"
                          "[impairment]\ndelay = \"40 ms\"\njitter = \"10 ms\"\nloss = 0.1\n"
                          "burst_loss = 0.1\nseed = 7\n"
                          "[[operator]]\npassive = true\n"
                          "[[device]]\ndamping = \"2 N s/m\"\nrate = \"2 kHz\"\ndelay = \"1 ms\"\n";
  const auto result = run_bench(study({scene, "--csv", file}));
  ASSERT_EQ(result.status, 0) << result.err;
  for (const char* part :
       {"hand.k1=300 N/m", "impairment.delay=40 ms", "impairment.jitter=10 ms",
        "impairment.loss=10 %", "device.damping=2 N s/m", "device.rate=2 kHz", "seed=7"})
    EXPECT_THAT(content(file), HasSubstr(part));
  EXPECT_THAT(result.out, HasSubstr("1 cell of 3 s"));
  EXPECT_THAT(result.out, HasSubstr("note: [[device]] delay of the scene is not part"));
  EXPECT_THAT(result.out, HasSubstr("note: [impairment] burst_loss"));
  EXPECT_EQ(first_line({scene, "--sweep", "hand.k1=100"})["axes"]["hand.k1"], 100.0);
}

TEST(StabilityVerb, RunsOneCouplingOfAScene) {
  const test::ScratchFolder scratch;
  const std::string scene = scratch.file("lab.toml");
  std::ofstream(scene) << "[[operator]]\npassive = true\n";
  const auto lines =
      run_bench({"bench", "stability", "--for", "3s", "--json", scene, "--coupling", "effort_flow"})
          .lines();
  ASSERT_EQ(lines.size(), 2U) << "a cell, a mode";
  EXPECT_EQ(json::parse(lines.front())["mode"], "effort_flow");
}

TEST(StabilityVerb, HandFollowsARecording) {
  const test::ScratchFolder scratch;
  const std::string trace = scratch.file("hand.csv");
  std::ofstream file(trace);
  file << "t_s,px_m,py_m,pz_m\n";
  for (int i = 0; i < 200; ++i) file << 0.02 * i << ",0,0," << (i / 20 % 2 == 0 ? 0.01 : 0) << "\n";
  file.close();
  const json recorded = first_line({"--hand", trace});
  const json pushed = first_line({"--sweep", "delay=0"});
  EXPECT_NE(recorded["peak_force_N"], pushed["peak_force_N"]);
  EXPECT_GT(recorded["truth_rms_N"].get<double>(), 0.0) << "it touches";
  const auto none = run_bench(study({"--hand", trace, "--sweep", "operator=push"}));
  EXPECT_EQ(none.status, 2);
  EXPECT_THAT(none.err, HasSubstr("the swept operators lack trace"));
  EXPECT_THAT(run_bench(study({"--hand", "nowhere.csv"})).err, HasSubstr("--hand: nowhere.csv"));
}

TEST(StabilityVerb, RefusesAnotherRecordingOfTheSameName) {
  const test::ScratchFolder scratch;
  const std::string trace = scratch.file("hand.csv"), file = scratch.file("s.csv");
  const auto run = [&](double end) {
    std::ofstream(trace) << "t_s,px_m,py_m,pz_m\n0,0,0,0.01\n4,0,0," << end << "\n";
    return run_bench(study({"--hand", trace, "--csv", file}));
  };
  ASSERT_EQ(run(0.0).status, 0);
  EXPECT_EQ(run(0.0).status, 0);
  const auto other = run(0.002);
  EXPECT_EQ(other.status, 2);
  EXPECT_THAT(other.err, HasSubstr("contains the study with other options: it has hand="));
}

TEST(StabilityVerb, ReportsEverywhereThatTheGateIsOff) {
  const test::ScratchFolder scratch;
  const std::string page = scratch.file("s.html");
  const auto result = run_bench(study({"--no-gate", "--sweep", "delay=0", "--report", page}));
  EXPECT_EQ(result.status, 0);
  EXPECT_THAT(result.out, HasSubstr("THE GATE IS OFF"));
  EXPECT_THAT(result.err, HasSubstr("THE GATE IS OFF"));
  EXPECT_THAT(content(page), HasSubstr("THE GATE IS OFF"));
}

TEST(StabilityVerb, PeakAndSeedHaveTheirEffect) {
  const auto counted = [](const std::string& peak) {
    return run_bench(study({"--sweep", "delay=0", "--peak", peak})).out;
  };
  EXPECT_THAT(counted("1mN"), HasSubstr("PEAK > 0.001 N"));
  EXPECT_NE(counted("1mN").substr(40), counted("1kN").substr(40));
  const std::vector<std::string> noisy{"--sweep", "delay=80ms", "--sweep", "loss=30%", "--seed"};
  const auto seeded = [&](const std::string& seed) {
    auto words = noisy;
    words.push_back(seed);
    return first_line(words);
  };
  EXPECT_EQ(seeded("1"), seeded("1"));
  EXPECT_NE(seeded("1"), seeded("2"));
}

TEST(StabilityVerb, RefusesFlagsOfOtherStudies) {
  for (const std::vector<std::string>& words :
       {std::vector<std::string>{"bench", "stability", "--delay", "5ms"},
        {"bench", "stability", "--force"},
        {"bench", "stability", "--iface", "lo"},
        {"bench", "accuracy", "--sweep", "delay=0"},
        {"bench", "latency", "--no-gate"},
        {"bench", "latency", "--report", "x.html"},
        {"bench", "stability", "a.toml", "b.toml"}}) {
    const auto result = run_bench(words);
    EXPECT_EQ(result.status, 2) << words.back();
    EXPECT_EQ(result.out, "");
  }
  EXPECT_THAT(run_bench({"bench", "latency", "--csv", "x.csv"}).err,
              HasSubstr("--csv is a flag of reckon bench accuracy"));
}

}  // namespace
}  // namespace reckon::bench
