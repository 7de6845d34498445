// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// `reckon bench accuracy`: its tables, files and errors.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>

#include "reckon/bench/studies/pose/pose_models.hpp"
#include "reckon/bench/studies/tracks/motions.hpp"
#include "reckon/tests/bench/support/bench_console.hpp"
#include "reckon/tests/support/reference_data.hpp"
#include "reckon/tests/support/scratch_folder.hpp"
#include "reckon/tests/tools/support/written_files.hpp"
#include "reckon/tools/terminal/text_table.hpp"

namespace reckon::bench {
namespace {

using nlohmann::json;
using test::cells_of;
using test::content;
using test::lines_of;
using test::ProgramResult;
using test::run_bench;
using test::unbalanced;
using ::testing::HasSubstr;
using ::testing::Not;

/// A study that takes milliseconds, with more arguments after it.
ProgramResult small_study(std::vector<std::string> more = {}) {
  std::vector<std::string> words{"bench",    "accuracy",   "--motion",     "circle,hand",
                                 "--for",    "4s",         "--models",     "auto,fpw,rvw",
                                 "--curves", "snap,cubic", "--thresholds", "20mm,0.5m"};
  words.insert(words.end(), more.begin(), more.end());
  return run_bench(words);
}

class BenchAccuracy : public testing::Test {
 protected:
  std::string file(const std::string& name) { return folder_.file(name); }

 private:
  test::ScratchFolder folder_;
};

// --- tables ---

TEST_F(BenchAccuracy, ShowsTheFrontAndTheDominatedCount) {
  const auto result = small_study();
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("circle: 100 m radius at 20 m/s"));
  EXPECT_THAT(result.out, HasSubstr("hand: reaches of 10 cm"));
  EXPECT_THAT(result.out, HasSubstr(" of 12 settings; "));
  EXPECT_THAT(result.out, HasSubstr(" dominated"));
  EXPECT_THAT(result.out, HasSubstr("172 octets an update"));
  for (const std::string& line : result.lines()) EXPECT_LE(tools::text_width(line), 100U) << line;
}

TEST_F(BenchAccuracy, FitsAHundredColumns) {
  const auto result =
      run_bench({"bench", "accuracy", "--all", "--for", "2s", "--loss", "10%", "--delay", "80ms",
                 "--jitter", "40%", "--seeds", "2", "--first-heartbeat", "200ms"});
  EXPECT_EQ(result.status, 0) << result.err;
  for (const std::string& line : result.lines()) EXPECT_LE(tools::text_width(line), 100U) << line;
  for (const Motion& motion : motions())
    EXPECT_THAT(result.out, HasSubstr(std::string(motion.name) + ": "));
  for (const PoseModel& model : kPoseModels)
    EXPECT_THAT(result.out, HasSubstr("\n" + std::string(model.name) + " "));
}

TEST_F(BenchAccuracy, ShowsDominatedSettingsOnRequest) {
  EXPECT_GT(small_study({"--all"}).lines().size(), small_study().lines().size());
}

TEST_F(BenchAccuracy, GivesTheSavingAtTheSameError) {
  const auto result = run_bench({"bench", "accuracy", "--against", "fpw:1m", "--motion", "circle",
                                 "--for", "10s", "--models", "rvb", "--angle", "none"});
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("SAVING"));
  const auto lines = run_bench({"bench", "accuracy", "--against", "fpw:1m", "--motion", "circle",
                                "--for", "10s", "--models", "rvb", "--angle", "none", "--json"})
                         .lines();
  ASSERT_EQ(lines.size(), 1U);
  const json row = json::parse(lines.front());
  EXPECT_EQ(row["baseline"]["model"], "fpw");
  // The tangent leaves the circle after 43 samples: 14 updates in 10 s, compared with 3 heartbeats.
  EXPECT_NEAR(row["saving"].get<double>(), 11.0 / 14, 1e-12);
  EXPECT_LE(row["rival"]["position_m"]["p99"], row["baseline"]["position_m"]["p99"]);
}

TEST_F(BenchAccuracy, DefaultClearsTheBarOfTheCircle) {
  const auto good =
      run_bench({"bench", "accuracy", "--circle", "--curves", "cubic", "--seeds", "3"});
  EXPECT_EQ(good.status, 0) << good.out;
  EXPECT_THAT(good.out, HasSubstr("cleared"));
  EXPECT_THAT(good.out, HasSubstr("bar: RMS at most 5 mm"));
  const auto lines = run_bench({"bench", "accuracy", "--circle", "--models", "rvb", "--curves",
                                "snap", "--seeds", "1", "--json"})
                         .lines();
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_TRUE(json::parse(lines.front())["clears"].get<bool>());
}

TEST_F(BenchAccuracy, SavesUpdatesOnRecordedTrajectories) {
  RECKON_NEED_DATA("trajectories");
  std::vector<std::string> words{"bench", "accuracy", "--against", "rvw:1m", "--json"};
  for (const char* name : {"vehicles_town_sumo.csv", "pedestrians_ucy_students03.csv",
                           "vessels_ais_us_2022-01-03.csv"})
    words.push_back((test::reference_data() / "trajectories" / name).string());
  const auto result = run_bench(words);
  ASSERT_EQ(result.status, 0) << result.err;
  ASSERT_EQ(result.lines().size(), 3U);
  for (const std::string& line : result.lines()) {
    const json row = json::parse(line);
    EXPECT_LE(row["rival"]["position_m"]["p99"], row["baseline"]["position_m"]["p99"]) << line;
    EXPECT_GT(row["saving"].get<double>(), 0.05) << line;
  }
}

// --- files ---

TEST_F(BenchAccuracy, WritesOneJsonObjectALine) {
  const auto lines = small_study({"--json"}).lines();
  std::map<std::string, int> kinds;
  for (const std::string& line : lines) {
    const json row = json::parse(line);
    ++kinds[row["kind"]];
    if (row["kind"] != "setting") continue;
    EXPECT_LE(row["position_m"]["rms"], row["position_m"]["max"]);
    EXPECT_LE(row["position_m"]["p99"], row["position_m"]["max"]);
    EXPECT_EQ(row["front"].get<bool>(), !row.contains("beaten_by")) << line;
    EXPECT_GT(row["query_ns"].get<double>(), 0) << line;
    EXPECT_NEAR(row["octets_per_s"], 172 * row["updates_per_s"].get<double>(), 1e-6);
  }
  EXPECT_EQ(kinds["study"], 1);
  EXPECT_EQ(kinds["subject"], 2);
  EXPECT_EQ(kinds["setting"], 24);
  const auto front = small_study({"--json", "--front"}).lines();
  EXPECT_LT(front.size(), lines.size());
  for (const std::string& line : front) EXPECT_THAT(line, Not(HasSubstr("beaten_by")));
}

TEST_F(BenchAccuracy, IsDeterministicExceptForTimes) {
  const auto without_times = [](const ProgramResult& result) {
    std::vector<json> rows;
    for (const std::string& line : result.lines()) {
      rows.push_back(json::parse(line));
      rows.back().erase("query_ns");
    }
    return rows;
  };
  const std::vector<std::string> words{"--json", "--delay", "80ms", "--loss", "10%", "--seed", "4"};
  EXPECT_EQ(without_times(small_study(words)), without_times(small_study(words)));
}

TEST_F(BenchAccuracy, CsvMatchesTheTable) {
  const std::string path = file("poses.csv");
  const auto result = small_study({"--csv", path});
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_THAT(result.err, HasSubstr("wrote " + path));
  const auto lines = lines_of(content(path));
  ASSERT_EQ(lines.size(), 25U);
  const auto titles = cells_of(lines.front());
  for (const std::string& line : lines) EXPECT_EQ(cells_of(line).size(), titles.size()) << line;
  const auto first = cells_of(lines[1]);
  EXPECT_EQ(first.front(), "circle");
  const auto front = std::count_if(lines.begin() + 1, lines.end(), [&](const std::string& line) {
    return cells_of(line)[titles.size() - 2] == "1";
  });
  EXPECT_EQ(static_cast<std::size_t>(front),
            lines_of(content((small_study({"--csv", path, "--front"}), path))).size() - 1);
}

// --- the page ---

TEST_F(BenchAccuracy, WritesASelfContainedPage) {
  const std::string path = file("poses.html");
  EXPECT_EQ(small_study({"--report", path}).status, 0);
  const std::string page = content(path);
  EXPECT_EQ(unbalanced(page), "");
  for (const char* outside : {"http:", "https:", "src=", "@import", "url(", "//cdn", "<link"})
    EXPECT_THAT(page, Not(HasSubstr(outside)));
  EXPECT_THAT(page, HasSubstr("<h1>"));
  EXPECT_THAT(page, HasSubstr("--motion circle,hand"));
  EXPECT_THAT(page, HasSubstr("octets a second of one entity"));
  EXPECT_THAT(page, HasSubstr("prefers-color-scheme:dark"));
}

TEST_F(BenchAccuracy, PageHasAllSettingsAndPictureTheFront) {
  const std::string path = file("poses.html");
  (void)small_study({"--report", path});
  const std::string page = content(path);
  const auto count = [&](const std::string& text) {
    std::size_t found = 0;
    for (std::size_t at = 0; (at = page.find(text, at)) != std::string::npos; at += text.size())
      ++found;
    return found;
  };
  const std::size_t dominated = count("<tr class=\"d\">");
  EXPECT_GT(dominated, 0U);
  EXPECT_EQ(dominated + count("<tr><td"), 24U);
  EXPECT_EQ(count("<svg class=\"plot\""), 2U);
  // A title for each mark, and one for the page; coincident marks are one.
  const std::size_t pale = count(", dominated</title>");
  EXPECT_LE(pale, dominated);
  EXPECT_LE(count("</title>") - 1 - pale, 24 - dominated);
}

TEST_F(BenchAccuracy, DetectsAnUnwritablePageBeforeTheStudy) {
  const auto result = small_study({"--report", "/no/such/folder/page.html"});
  EXPECT_EQ(result.status, 2);
  EXPECT_TRUE(result.out.empty());
  EXPECT_THAT(result.err, HasSubstr("/no/such/folder/page.html: cannot be written"));
}

// --- forces ---

TEST_F(BenchAccuracy, ShowsTheCostOfContactsBesidePoses) {
  const std::vector<std::string> tap{"--contact", "tap", "--send-at", "20mN,50Hz", "--for", "3s"};
  const auto with = [&](std::vector<std::string> words) {
    words.insert(words.begin(), {"bench", "accuracy", "--force"});
    words.insert(words.end(), tap.begin(), tap.end());
    return run_bench(words);
  };
  const auto forces = with({});
  ASSERT_EQ(forces.status, 0) << forces.err;
  EXPECT_THAT(forces.out, HasSubstr("tap: 10 mm in and out"));
  EXPECT_THAT(forces.out, HasSubstr("20 mN"));
  EXPECT_THAT(forces.out, HasSubstr("50 Hz"));
  EXPECT_THAT(forces.out, HasSubstr("LINGER"));
  EXPECT_THAT(forces.out, Not(HasSubstr("circle")));
  const auto both = with({"--pose", "--motion", "circle", "--models", "auto", "--curves", "cubic"});
  ASSERT_EQ(both.status, 0) << both.err;
  EXPECT_THAT(both.out, HasSubstr("LINGER"));
  EXPECT_THAT(both.out, HasSubstr("circle"));
}

// --- errors ---

TEST_F(BenchAccuracy, NamesTheNearestWordOfAMistypedOne) {
  const std::map<std::vector<std::string>, std::string> wrong{
      {{"accurracy"}, "did you mean 'accuracy'?"},
      {{"accuracy", "--motion", "circel"}, "did you mean 'circle'?"},
      {{"accuracy", "--models", "auto,rvww"}, "did you mean 'rvw'?"},
      {{"accuracy", "--curves", "cubik"}, "did you mean 'cubic'?"},
      {{"accuracy", "--against", "rwv"}, "write MODEL:LENGTH, for example rvw:1m"},
      {{"accuracy", "--modles", "auto"}, "did you mean '--models'?"},
  };
  for (const auto& [words, remedy] : wrong) {
    std::vector<std::string> all{"bench"};
    all.insert(all.end(), words.begin(), words.end());
    const auto result = run_bench(all);
    EXPECT_EQ(result.status, 2) << words.back();
    EXPECT_TRUE(result.out.empty()) << words.back();
    EXPECT_THAT(result.err, HasSubstr(remedy)) << words.back();
  }
}

TEST_F(BenchAccuracy, ExplainsAWrongValueAndItsRemedy) {
  const std::map<std::vector<std::string>, std::string> wrong{
      {{"--thresholds", "0"}, "--thresholds: '0' is not above 0; write for example 50mm"},
      {{"--thresholds", "1m,3s"}, "--thresholds: "},
      {{"--thresholds", "1m,"}, "--thresholds: "},
      {{"--loss", "120%"}, "write for example 10%"},
      {{"--jitter", "40%"}, "write --delay 80ms --jitter 40%"},
      {{"--delay", "80"}, "as in 10s"},
      {{"--heartbeat", "0s"}, "for example 5s"},
      {{"--angle", "0"}, "write for example 3deg, or none"},
      {{"--seeds", "0"}, "not from 1 to 1000"},
      {{"--for", "2h"}, "at most 1 h"},
      {{"--against", "rvw:1m"}, "write files, or motions with --motion"},
      {{"--circle", "--loss", "5%"}, "--circle is a fixed case"},
      {{"--circle", "--force"}, "--circle is a fixed case"},
      {{"--against", "rvw:1m", "--force"}, "remove --force"},
      {{"--force", "--motion", "hand"}, "add --pose"},
      {{"--force", "--pose", "--csv", "/dev/null"}, "write --pose or --force alone"},
      {{"--force", "--for", "0.5s"}, "write 1 s to 1 h"},
      {{"--force", "--contact", "tip"}, "did you mean 'tap'?"},
      {{"--force", "--send-at", "0N"}, "write for example 15mN,50Hz"},
      {{"--force", "--send-at", "1kHz"}, "a rate from 20 to 500 Hz"},
      {{"--contact", "tap"}, "add --force"},
      {{"--axis", "order"}, "add --touch"},
      {{"--touch", "--axis", "ordre"}, "did you mean 'order'?"},
      {{"--touch", "--axis", "energy port"}, "energy port is left out: "},
      {{"--touch", "--force"}, "remove --force"},
      {{"--touch", "--axis", "order", "--delay", "5ms"}, "add --axis owner"},
      {{"--touch", "--delay", "2s"}, "at most 1s"},
      {{"--touch", "--jitter", "10%"}, "remove --jitter"},
      {{"--touch", "--plot", "/no/such/folder/a.svg"}, "cannot be written"},
      {{"/no/such/file.csv"}, "/no/such/file.csv"},
  };
  for (const auto& [words, remedy] : wrong) {
    std::vector<std::string> all{"bench", "accuracy"};
    all.insert(all.end(), words.begin(), words.end());
    const auto result = run_bench(all);
    EXPECT_EQ(result.status, 2) << words.back() << result.out;
    EXPECT_THAT(result.err, HasSubstr(remedy)) << words.back();
  }
}

TEST_F(BenchAccuracy, RefusesArgumentsThatOtherStudiesCannotUse) {
  const auto file = run_bench({"bench", "latency", "cars.csv"});
  EXPECT_EQ(file.status, 2);
  EXPECT_THAT(file.err, HasSubstr("takes no FILE"));
  const auto brief = run_bench({"bench", "latency", "--for", "1s"});
  EXPECT_EQ(brief.status, 2);
  EXPECT_THAT(brief.err, HasSubstr("at least 4s"));
  const auto nowhere = run_bench({"bench", "latency", "--iface", "no_such_interface"});
  EXPECT_EQ(nowhere.status, 3);
  EXPECT_THAT(nowhere.err, HasSubstr("no_such_interface"));
  EXPECT_TRUE(nowhere.out.empty());
}

TEST_F(BenchAccuracy, RefusesFlagsOfTheOtherStudyByName) {
  const std::vector<std::vector<std::string>> of_accuracy{
      {"--csv", "a.csv"}, {"--loss", "10%"}, {"--motion", "circle"},
      {"--circle"},       {"--seeds", "3"},  {"--report", "a.html"}};
  for (const auto& words : of_accuracy) {
    std::vector<std::string> all{"bench", "latency"};
    all.insert(all.end(), words.begin(), words.end());
    const auto result = run_bench(all);
    EXPECT_EQ(result.status, 2) << words.front();
    EXPECT_THAT(result.err, HasSubstr(words.front() + " is a flag of reckon bench accuracy"));
    EXPECT_TRUE(result.out.empty());
  }
  const auto iface = run_bench({"bench", "accuracy", "--iface", "lo"});
  EXPECT_EQ(iface.status, 2);
  EXPECT_THAT(iface.err, HasSubstr("--iface is a flag of reckon bench latency"));
  const auto apart = run_bench({"bench", "accuracy", "--contact-groups"});
  EXPECT_EQ(apart.status, 2);
  EXPECT_THAT(apart.err, HasSubstr("--contact-groups is a flag of reckon bench latency"));
}

TEST_F(BenchAccuracy, StopsOnRequest) {
  const std::atomic<bool> stop{true};
  const auto result = run_bench({"bench", "accuracy"}, &stop);
  EXPECT_EQ(result.status, 0) << result.err;
}

}  // namespace
}  // namespace reckon::bench
