// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// `reckon figures`: its files, its numbers as JSON and its errors.
#include <gmock/gmock.h>

#include <filesystem>
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

std::size_t files_in(const std::string& folder) {
  std::size_t count = 0;
  for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator(folder)) ++count;
  return count;
}

TEST(FiguresVerb, MakesTheNamedFigures) {
  const test::ScratchFolder scratch;
  const std::string folder = scratch.file("new/pictures");
  const auto result = run_bench({"figures", "4.4", "3.1", "4.4", "--out", folder});
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_EQ(files_in(folder), 5U) << "two of each, and the page";
  EXPECT_THAT(content(folder + "/figure_4.4.svg"), HasSubstr("Fig 4.4: Velocity, two users"));
  EXPECT_THAT(content(folder + "/figure_4.4.csv"),
              ::testing::StartsWith("panel,curve,time [s],velocity [m/s]\n\"K, no T\",\"both push, "
                                    "either\",0,0\n"));
  const std::string page = content(folder + "/index.html");
  EXPECT_LT(page.find("id=\"f3.1\""), page.find("id=\"f4.4\"")) << "in the order of the thesis";
  EXPECT_THAT(result.out, HasSubstr("2 m/s"));
  EXPECT_THAT(result.err, HasSubstr("wrote 2 figures"));
}

TEST(FiguresVerb, ReplacesFilesOfAnOlderRun) {
  const test::ScratchFolder scratch;
  const std::string folder = scratch.file("");
  std::ofstream(folder + "figure_3.1.svg") << "old";
  EXPECT_EQ(run_bench({"figures", "3.1", "--out", folder}).status, 0);
  EXPECT_THAT(content(folder + "figure_3.1.svg"), Not(HasSubstr("old")));
}

TEST(FiguresVerb, WritesAnObjectForEachFigure) {
  const test::ScratchFolder scratch;
  const auto result =
      run_bench({"figures", "3.1", "4.3", "4.4", "--json", "--out", scratch.file("")});
  const auto lines = result.lines();
  ASSERT_EQ(lines.size(), 3U);
  EXPECT_EQ(json::parse(lines[0])["thesis"], nullptr) << "no number is printed";
  EXPECT_NEAR(json::parse(lines[0])["ours"].get<double>(), 1.0, 1e-9);
  EXPECT_EQ(json::parse(lines[0])["unit"], "mJ");
  const json velocity = json::parse(lines[2]);
  EXPECT_EQ(velocity["name"], "4.4");
  EXPECT_EQ(velocity["title"], "Velocity, two users who exchange speeds");
  EXPECT_EQ(velocity["thesis"], 2.0);
  EXPECT_NEAR(velocity["ours"].get<double>(), 2.0, 5e-4);
  EXPECT_GT(velocity["numbers"].size(), 3U);
}

TEST(FiguresVerb, DrawingsAreMarkedAndHaveNoNumbers) {
  const test::ScratchFolder scratch;
  const auto result = run_bench({"figures", "3.2", "--out", scratch.file("x")});
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_THAT(result.out, ::testing::ContainsRegex("3\\.2 .*drawing"));
  EXPECT_EQ(files_in(scratch.file("x")), 2U) << "no CSV";
  EXPECT_THAT(content(scratch.file("x/figure_3.2.svg")),
              HasSubstr("Fig 3.2, drawing: Two-port model of a haptic simulation"));
  EXPECT_THAT(content(scratch.file("x/index.html")), HasSubstr("(drawing)</h2>"));
  const json line =
      json::parse(run_bench({"figures", "3.2", "--json", "--out", scratch.file("x")}).lines()[0]);
  EXPECT_EQ(line["drawing"], true);
  EXPECT_EQ(line["ours"], nullptr);
  EXPECT_TRUE(line["numbers"].empty());
}

TEST(FiguresVerb, ListsAllFiguresAndMakesNone) {
  const auto result = run_bench({"figures", "--list"});
  EXPECT_EQ(result.status, 0);
  EXPECT_THAT(result.out, ::testing::ContainsRegex("3\\.2 .*drawing"));
  EXPECT_THAT(result.out, ::testing::ContainsRegex("4\\.13 .*experiment"));
  const auto lines = run_bench({"figures", "--list", "--json"}).lines();
  EXPECT_EQ(lines.size(), 30U);
  EXPECT_EQ(json::parse(lines.at(1))["drawing"], true);
  EXPECT_EQ(run_bench({"figures", "--list", "3.1"}).status, 2);
}

TEST(FiguresVerb, NamesTheNearestFigures) {
  const test::ScratchFolder scratch;
  const auto wrong = run_bench({"figures", "4.44", "--out", scratch.file("x")});
  EXPECT_EQ(wrong.status, 2);
  EXPECT_THAT(wrong.err, HasSubstr("there is no figure '4.44'; did you mean '4.4'?"));
  const auto far = run_bench({"figures", "3.70001", "--out", scratch.file("x")});
  EXPECT_EQ(far.status, 2);
  EXPECT_THAT(
      far.err,
      HasSubstr(
          "that chapter has 3.1, 3.2, 3.3, 3.4, 3.5, 3.6, 3.7, 3.8. `reckon figures --list`"));
  const auto chapter = run_bench({"figures", "6.1", "--out", scratch.file("x")});
  EXPECT_EQ(chapter.status, 2);
  EXPECT_THAT(chapter.err, HasSubstr("there is no figure '6.1'; `reckon figures --list`"));
  EXPECT_FALSE(std::filesystem::exists(scratch.file("x"))) << "before anything is written";
}

TEST(FiguresVerb, NamesTheUnwritableFolder) {
  const test::ScratchFolder scratch;
  std::ofstream(scratch.file("file")) << "in the way";
  const auto blocked = run_bench({"figures", "3.1", "--out", scratch.file("file/below")});
  EXPECT_EQ(blocked.status, 2);
  EXPECT_THAT(blocked.err, HasSubstr(scratch.file("file/below") + ": cannot be created"));
  EXPECT_THAT(blocked.err, HasSubstr("choose a writable folder by --out"));
  const auto taken = run_bench({"figures", "3.1", "--out", scratch.file("file")});
  EXPECT_EQ(taken.status, 2);
  std::filesystem::create_directory(scratch.file("figure_3.1.csv"));
  const auto file = run_bench({"figures", "3.1", "--out", scratch.file("")});
  EXPECT_EQ(file.status, 2);
  EXPECT_THAT(file.err, HasSubstr("figure_3.1.csv: cannot be written; choose a writable folder"));
}

}  // namespace
}  // namespace reckon::bench
