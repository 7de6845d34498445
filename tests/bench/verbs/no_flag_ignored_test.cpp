// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Every flag of a study with every mode of it: it changes the output, or it is refused by name.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "reckon/tests/bench/support/bench_console.hpp"
#include "reckon/tests/support/places.hpp"
#include "reckon/tests/support/scratch_folder.hpp"

namespace reckon::bench {
namespace {

using test::flags_of;
using test::ProgramResult;
using ::testing::HasSubstr;
using Words = std::vector<std::string>;

/// By the program of the verb.
ProgramResult run(const Words& words) {
  const bool is_study = words.front() != "demo" && words.front() != "key";
  return is_study ? test::run_bench(words) : test::run_reckon(words);
}

Words operator+(Words words, const Words& more) {
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

class NoFlagIgnored : public testing::Test {
 protected:
  void SetUp() override {
    std::ofstream tracks(tracks_);
    tracks << "t_s,x_m,y_m\n";
    for (int t = 0; t < 90; ++t)
      tracks << t << ',' << 20 * std::cos(t / 6.0) << ',' << 20 * std::sin(t / 4.0) << '\n';
    std::ofstream force(force_);
    force << "t_s,f_N,g_N\n";
    for (int t = 0; t < 90; ++t) force << 0.01 * t << ',' << 1 + 0.03 * t << ',' << t % 7 << '\n';
  }

  [[nodiscard]] std::string content(const std::string& path) const {
    std::ostringstream text;
    text << std::ifstream(path).rdbuf();
    return text.str();
  }

  struct Outcome {
    ProgramResult result;
    /// All output of the run, files included, without measured times and the command itself.
    std::string text;
  };

  [[nodiscard]] Outcome outcome(const Words& words) {
    for (const std::string& file : written_) std::ofstream(file, std::ios::trunc).close();
    const ProgramResult result = run(words);
    std::string text = result.out;
    for (const std::string& file : written_) text += content(file);
    static const std::regex times(
        R"x((query_ns|servo_step_ns|loops_cpu_share|live_cpu_share|cpu_share|command|step_ns|step_p10_ns|step_p90_ns|front|beaten_by)":("[^"]*"|[-0-9.e+]+|null|true|false))x");
    return {result, std::regex_replace(text, times, "")};
  }

  static void expect_accepted(const ProgramResult& result, const Words& words) {
    EXPECT_THAT(result.status, testing::AnyOf(0, 1)) << result.err << testing::PrintToString(words);
  }

  [[nodiscard]] std::string accepted(const Words& words) {
    const auto [result, text] = outcome(words);
    expect_accepted(result, words);
    return text;
  }

  /// Each flag with its value added to `mode`, whose base has none of them. `neutral` are flags
  /// that only state a default.
  void check(const Words& mode, const std::map<std::string, Words>& values,
             const std::set<std::string>& neutral) {
    const std::string plain = accepted(mode);
    for (const auto& [flag, value] : values) {
      if (std::ranges::count(mode, flag) > 0 || neutral.contains(flag)) continue;
      const Words with = mode + (flag.starts_with("--") ? Words{flag} + value : value);
      const auto [result, text] = outcome(with);
      if (result.status == 2) {
        EXPECT_THAT(result.err, HasSubstr(flag)) << testing::PrintToString(with);
        EXPECT_TRUE(result.out.empty()) << testing::PrintToString(with);
      } else {
        expect_accepted(result, with);
        EXPECT_TRUE(text != plain) << "ignored: " << testing::PrintToString(with);
      }
    }
  }

  /// A value for each flag of the studies of accuracy.
  [[nodiscard]] std::map<std::string, Words> values_of_accuracy() const {
    return {
        {"FILE", {tracks_}},
        {"--json", {}},
        {"--seed", {"7"}},
        {"--for", {"5s"}},
        {"--pose", {}},
        {"--force", {}},
        {"--contact", {"tap"}},
        {"--send-at", {"70mN"}},
        {"--motion", {"weave"}},
        {"--models", {"rvb"}},
        {"--thresholds", {"0.3m"}},
        {"--curves", {"linear"}},
        {"--angle", {"0.1deg"}},
        {"--heartbeat", {"0.5s"}},
        {"--first-heartbeat", {"100ms"}},
        {"--converge", {"300ms"}},
        {"--converge-longest", {"150ms"}},
        {"--delay", {"90ms"}},
        {"--jitter", {"40%"}},
        {"--loss", {"20%"}},
        {"--seeds", {"3"}},
        {"--against", {"fpw:0.4m"}},
        {"--circle", {}},
        {"--all", {}},
        {"--front", {}},
        {"--csv", {csv_}},
        {"--trace", {csv_}},
        {"--period", {"1s"}},
        {"--report", {page_}},
        {"--touch", {}},
        {"--axis", {"quantisation"}},
        {"--plot", {picture_}},
        {"--sweep", {"delay=5ms"}},
        {"--peers", {"3"}},
        {"--coupling", {"reckon"}},
        {"--no-gate", {}},
        {"--hand", {test::source_dir() + "/scenes/wall_trace.csv"}},
        {"--peak", {"5N"}},
    };
  }

  test::ScratchFolder folder_;
  std::string tracks_ = folder_.file("tracks.csv"), force_ = folder_.file("force.csv"),
              csv_ = folder_.file("out.csv"), page_ = folder_.file("out.html"),
              picture_ = folder_.file("out.svg");
  std::vector<std::string> written_{csv_, page_, picture_};
};

TEST_F(NoFlagIgnored, ByTheStudiesOfAccuracy) {
  const std::map<std::string, Words> values = values_of_accuracy();
  Words flags = flags_of({"bench"}, run_program);
  // Flags of other studies are refused as such.
  std::erase_if(flags, [](const std::string& flag) {
    const std::string error = run({"bench", "accuracy", "--motion", "none", flag + "=1"}).err;
    return flag == "STUDY" || flag == "--help" ||
           error.find("is a flag of reckon bench") != std::string::npos;
  });
  for (const std::string& flag : flags) EXPECT_TRUE(values.contains(flag)) << flag;

  const Words accuracy{"bench", "accuracy"};
  const Words pose =
      accuracy + Words{"--motion",  "hand",     "--for",           "4s",       "--thresholds",
                       "20mm,50mm", "--models", "fpw,auto,static", "--curves", "cubic"};
  const Words noisy{"--delay", "60ms", "--loss", "15%"};
  const Words touch = accuracy + Words{"--force", "--contact", "press-10", "--for",
                                       "3s",      "--send-at", "20mN",     "--json"} +
                      noisy;
  check(pose + noisy, values, {"--pose"});
  check(pose + Words{"--json"} + noisy, values, {"--pose"});
  check(touch, values, {});
  check(touch +
            Words{"--pose", "--motion", "hand", "--models", "fpw,auto,static", "--curves", "cubic"},
        values, {});
  check(accuracy + Words{"--against", "fpw:50mm", "--motion", "hand", "--for", "4s"} + noisy,
        values, {"--pose", "--trace", "--circle"});
  check(accuracy + Words{"--against", "fpw:0.5m", tracks_}, values,
        {"--pose", "--trace", "--circle"});
  check(accuracy + Words{"--circle", "--seeds", "2"}, values, {"--pose", "--trace"});
  check(accuracy +
            Words{"--trace", csv_, "--motion", "hand", "--models", "fpw", "--curves", "cubic",
                  "--thresholds", "50mm", "--for", "4s"} +
            noisy,
        values, {"--pose", "FILE", "--converge-longest"});
  check(accuracy + Words{"--touch", "--axis", "integrator", "--json"}, values, {"--pose"});
}

TEST_F(NoFlagIgnored, ByTheStudyOfStability) {
  const std::string scenes = test::source_dir() + "/scenes/", hand = scenes + "wall_trace.csv";
  const std::map<std::string, Words> values{
      {"FILE", {scenes + "two_hands.toml"}},
      {"--json", {}},
      {"--seed", {"7"}},
      {"--for", {"4s"}},
      {"--csv", {csv_}},
      {"--report", {page_}},
      {"--sweep", {"hand.k1=200"}},
      {"--coupling", {"gain_cut"}},
      {"--no-gate", {}},
      {"--hand", {hand}},
      {"--peak", {"5N"}},
      {"--delay", {"90ms"}},
      {"--touch", {}},
      {"--iface", {"lo"}},
  };
  const Words stability{"bench", "stability"};
  check(stability + Words{"--coupling", "reckon,transmission_line", "--sweep", "loss=10,30%"},
        values, {});
  check(stability + Words{"--hand", hand, "--for", "3s"}, values, {});
}

TEST_F(NoFlagIgnored, ByTheStudyOfScale) {
  const Words scale{"bench", "scale"};
  const std::string base = folder_.file("base.json");
  std::ofstream(base) << run(scale + Words{"--json", "--peers", "2", "--entities", "40", "--for",
                                           "1s", "--rate", "5"})
                             .out;
  const std::map<std::string, Words> values{
      {"FILE", {tracks_}},
      {"--json", {}},
      {"--seed", {"7"}},
      {"--for", {"2s"}},
      {"--report", {page_}},
      {"--delay", {"90ms"}},
      {"--jitter", {"40%"}},
      {"--loss", {"20%"}},
      {"--peers", {"3"}},
      {"--entities", {"60"}},
      {"--movement", {"walkers"}},
      {"--density", {"900"}},
      {"--cell", {"60m"}},
      {"--pool", {"4"}},
      {"--radius", {"50m"}},
      {"--rate", {"10"}},
      {"--threshold", {"0.2m"}},
      {"--whole", {"lo"}},
      {"--drawn", {"1"}},
      {"--pick", {"2m"}},
      {"--hosts", {"a,b"}},
      {"--ssh", {"ssh -4"}},
      {"--share", {"1-1"}},
      {"--port", {"3001"}},
      {"--hands", {}},
      {"--many-hands", {}},
      {"--compare", {base}},
      {"--csv", {csv_}},
      {"--sweep", {"delay=5ms"}},
      {"--touch", {}},
      {"--iface", {"lo"}},
      {"--scheme", {"quadtree"}},
  };
  // About one tick: jitter decides in which tick an update arrives.
  check(scale + Words{"--peers", "2", "--entities", "40", "--for", "1s", "--rate", "5", "--delay",
                      "190ms", "--json"},
        values, {});
}

TEST_F(NoFlagIgnored, ByTune) {
  const std::map<std::string, Words> values{
      {"--error", {"3m"}},      {"--budget", {"0.3"}},  {"--models", {"rvw"}},
      {"--thresholds", {"3m"}}, {"--angle", {"1deg"}},  {"--heartbeat", {"2s"}},
      {"--delay", {"90ms"}},    {"--jitter", {"40%"}},  {"--loss", {"20%"}},
      {"--seed", {"7"}},        {"--plot", {picture_}}, {"--all", {}},
      {"--force", {}},          {"--columns", {"g_N"}}, {"--floor", {"1N"}},
      {"--for", {"4s"}},        {"--json", {}},         {"--csv", {}},
  };
  Words flags = flags_of({"tune"}, run_program);
  std::erase_if(flags, [](const std::string& flag) { return flag == "FILE" || flag == "--help"; });
  for (const std::string& flag : flags) EXPECT_TRUE(values.contains(flag)) << flag;

  const Words noisy{"--delay", "1500ms", "--loss", "15%"};
  check(Words{"tune", tracks_} + noisy, values, {});
  check(Words{"tune", tracks_, "--json"} + noisy, values, {});
  check(Words{"tune", "--force", force_}, values, {});
  check(Words{"tune", "--force", force_, "--columns", "g_N"}, values, {});
  check(Words{"tune", "--force", test::source_dir() + "/scenes/two_hands.toml", "--for", "3s",
              "--delay", "20ms", "--loss", "15%"},
        values, {});
}

TEST_F(NoFlagIgnored, ByTuneOfForceTakesTheNetwork) {
  const Words touch{"tune", "--force", "--for", "3s", "--csv"};
  const std::string plain = accepted(touch);
  EXPECT_NE(accepted(touch + Words{"--delay", "20ms"}), plain);
  EXPECT_NE(accepted(touch + Words{"--loss", "10%"}), plain);
  EXPECT_THAT(run(touch + Words{"--jitter", "40%"}).err, HasSubstr("--delay 80ms"));
}

TEST_F(NoFlagIgnored, ByASimulatedDemo) {
  const std::string corner = folder_.file("corner.obj"), key = folder_.file("group.key");
  std::ofstream(corner) << "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n"
                           "f 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";
  ASSERT_EQ(run({"key", "new", key}).status, 0);
  const std::string scenes = test::source_dir() + "/scenes/";
  const std::map<std::string, Words> values{
      {"--peers", {"3"}},         {"--for", {"4s"}},
      {"--mesh", {corner}},       {"--hand", {scenes + "wall_trace.csv"}},
      {"--impair", {"loss=30%"}}, {"--seed", {"7"}},
      {"--iface", {"lo"}},        {"--key", {key}},
      {"--trace", {csv_}},        {"--trace-bodies", {csv_}},
      {"--trace-loop", {csv_}},   {"--simulated-time", {}},
      {"--no-transfer", {}},      {"--json", {}},
      {"--device", {"falcon"}},   {"--firmware", {corner}},
      {"--log", {csv_}},
  };
  Words flags = flags_of({"demo"});
  const std::set<std::string> refused{"--view", "--listen",        "--open",   "--even-if-slow",
                                      "--tls",  "--behind-tunnel", "--plugin", "--pace"};  // Pace
  std::erase_if(flags, [&](const std::string& flag) {
    return flag == "SCENE" || flag == "--help" || refused.contains(flag);
  });
  for (const std::string& flag : flags) EXPECT_TRUE(values.contains(flag)) << flag;
  const Words demo{"demo", "--simulated-time", "--for", "3s", "--json"};
  const Words poor{"--impair", "delay=20ms jitter=10ms loss=20%"};
  // Hands that meet at once, and later move over the mesh. Sealed datagrams change no result unless
  // some are lost.
  check(demo, values, {"--mesh", "--key"});
  check(demo + poor, values, {"--mesh"});
  // A hand that touches an object, and no other hand.
  check(Words{"demo", scenes + "slip.toml"} + Words(demo.begin() + 1, demo.end()), values,
        {"--no-transfer", "--key"});
}

TEST_F(NoFlagIgnored, BySimulatedDemosAndFigures) {
  const auto iface = run({"demo", "--simulated-time", "--for", "1s", "--iface", "lo"});
  EXPECT_EQ(iface.status, 2);
  EXPECT_THAT(iface.err, HasSubstr("--iface: --simulated-time has no sockets"));
  const auto slow = run({"demo", "--simulated-time", "--for", "1s", "--even-if-slow"});
  EXPECT_EQ(slow.status, 2);
  EXPECT_THAT(slow.err, HasSubstr("--even-if-slow has no effect with --simulated-time"));
  for (const Words& page : {Words{"--listen", "0.0.0.0"}, Words{"--open"},
                            Words{"--tls", "page.crt", "page.key"}, Words{"--behind-tunnel"}}) {
    const auto pageless = run(Words{"demo", "--simulated-time", "--for", "1s"} + page);
    EXPECT_EQ(pageless.status, 2);
    EXPECT_THAT(pageless.err, HasSubstr(page.front()));
  }
  const auto view = run({"demo", "--simulated-time", "--for", "1s", "--view"});
  EXPECT_EQ(view.status, 2);
  EXPECT_THAT(view.err, HasSubstr("--view: --simulated-time sends no datagrams"));
  const auto out = run({"figures", "--list", "--out", folder_.file("pictures")});
  EXPECT_EQ(out.status, 2);
  EXPECT_THAT(out.err, HasSubstr("remove --out"));
}

TEST_F(NoFlagIgnored, WithoutContactThereAreNoErrors) {
  const std::string scene = folder_.file("apart.toml");
  std::ofstream(scene) << "[[operator]]\npassive = true\n[[operator]]\npassive = true\n"
                          "position = \"1 0 0 m\"\n";
  const auto text = run({"tune", "--force", scene, "--for", "1s"});
  EXPECT_EQ(text.status, 1);
  EXPECT_THAT(text.err, HasSubstr("the hands never touched"));
  const auto row = run({"tune", "--force", scene, "--for", "1s", "--json"});
  EXPECT_THAT(row.out, HasSubstr(R"("rms":null,"p99":null,"max":null)"));

  // They begin 20 mm apart and start after 2 s.
  const Words contact{"bench", "accuracy", "--force", "--contact", "press-10", "--for", "1s"};
  EXPECT_THAT(run(contact).out, HasSubstr("did not touch"));
  const auto rows = run(contact + Words{"--json"});
  EXPECT_THAT(rows.out,
              HasSubstr(R"("error_shown_n":null,"error_asked_n":null,"twin_rms_n":null)"));
  (void)run(contact + Words{"--csv", csv_, "--report", page_, "--send-at", "20mN"});
  EXPECT_THAT(content(csv_), HasSubstr(",,,,,,,,,,,,"));
  EXPECT_THAT(content(page_), HasSubstr("did not touch"));
}

}  // namespace
}  // namespace reckon::bench
