// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// `reckon bench accuracy --touch`: its table, files and errors.
#include <gmock/gmock.h>

#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "reckon/bench/studies/touch/touch_study.hpp"
#include "reckon/tests/bench/support/bench_console.hpp"
#include "reckon/tests/support/scratch_folder.hpp"
#include "reckon/tests/tools/support/written_files.hpp"
#include "reckon/tools/terminal/text_table.hpp"

namespace reckon::bench {
namespace {

using nlohmann::json;
using test::cells_of;
using test::content;
using test::lines_of;
using test::run_bench;
using test::unbalanced;
using ::testing::HasSubstr;
using ::testing::Not;

TEST(BenchTouch, ShowsTheCostOfAccuracyInTheServo) {
  const auto touch = [](std::vector<std::string> words) {
    words.insert(words.begin(), {"bench", "accuracy", "--touch"});
    return run_bench(words);
  };
  const test::ScratchFolder folder;
  const std::string csv = folder.file("touch.csv"), page = folder.file("touch.html"),
                    picture = folder.file("touch.svg");
  const auto all = touch({"--delay", "50ms", "--csv", csv, "--report", page, "--plot", picture});
  ASSERT_EQ(all.status, 0) << all.err;
  EXPECT_THAT(all.err, HasSubstr("--plot leaves out the axis owner"));
  for (const std::string& line : all.lines()) EXPECT_LE(tools::text_width(line), 100U) << line;
  for (const TouchAxis& axis : touch_axes()) {
    EXPECT_THAT(all.out, HasSubstr(std::string(axis.name) + ": "));
    EXPECT_THAT(content(page), HasSubstr("id=\"" + std::string(axis.name) + "\""));
    EXPECT_THAT(content(csv), HasSubstr("\n" + std::string(axis.name) + ",\""));
  }
  for (const LeftOutAxis& axis : left_out_axes())
    EXPECT_THAT(all.out, HasSubstr("Left out: " + std::string(axis.name)));
  EXPECT_EQ(unbalanced(content(page)), "");
  EXPECT_EQ(unbalanced(content(picture)), "");
  for (const char* needed : {"1 ms, a servo step", "50 mN, the least noticeable force"})
    EXPECT_THAT(content(picture), HasSubstr(needed));
  const auto titles = cells_of(lines_of(content(csv)).front());
  for (const std::string& line : lines_of(content(csv)))
    EXPECT_EQ(cells_of(line).size(), titles.size()) << line;
}

TEST(BenchTouch, DrawsTheErrorByDelayAndRule) {
  const test::ScratchFolder folder;
  const std::string picture = folder.file("owner.svg");
  const auto result = run_bench({"bench", "accuracy", "--touch", "--axis", "owner", "--delay",
                                 "20ms", "--seeds", "2", "--json", "--plot", picture});
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_THAT(result.err, Not(HasSubstr("leaves out")));
  for (const char* needed : {"fixed", "first hand", "before touch", "push: solid", "one way [ms]"})
    EXPECT_THAT(content(picture), HasSubstr(needed));
  EXPECT_EQ(unbalanced(content(picture)), "");
  int rows = 0;
  for (const std::string& line : result.lines()) {
    const json row = json::parse(line);
    if (row["kind"] != "touch") continue;
    ++rows;
    EXPECT_EQ(row["delay_s"], 0.02);
    EXPECT_LE(row["error_share"], row["error_share_worst"]);
    EXPECT_GT(row["step_ns"].get<double>(), 0);
  }
  EXPECT_EQ(rows, 4 * 3);
}

TEST(BenchTouch, WritesOneJsonObjectPerSetting) {
  const auto result =
      run_bench({"bench", "accuracy", "--touch", "--axis", "quantisation,integrator", "--json"});
  std::map<std::string, int> kinds;
  for (const std::string& line : result.lines()) {
    const json row = json::parse(line);
    ++kinds[row["kind"]];
    if (row["kind"] != "touch") continue;
    EXPECT_LE(row["error_rms_n"], row["error_max_n"]);
    EXPECT_LE(row["error_p99_n"], row["error_max_n"]);
    EXPECT_EQ(row["felt"].get<bool>(), row["noticed"].get<double>() > 0.01);
    EXPECT_EQ(row["front"].get<bool>(), !row.contains("beaten_by"));
    EXPECT_GT(row["step_ns"].get<double>(), 0);
    EXPECT_LE(row["step_p10_ns"], row["step_ns"]);
    EXPECT_LE(row["step_ns"], row["step_p90_ns"]);
  }
  EXPECT_EQ(kinds["touch_study"], 1);
  EXPECT_EQ(kinds["touch_axis"], 2);
  EXPECT_EQ(kinds["touch"], 16 + 7);
  EXPECT_EQ(kinds["touch_left_out"], static_cast<int>(left_out_axes().size()));
}

}  // namespace
}  // namespace reckon::bench
