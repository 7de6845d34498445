// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Texts and files of the study of scale.
#include <gmock/gmock.h>

#include <atomic>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "reckon/bench/studies/scale/capacity.hpp"
#include "reckon/bench/studies/scale/mechanisms.hpp"
#include "reckon/bench/studies/scale/options.hpp"
#include "reckon/bench/studies/scale/page.hpp"
#include "reckon/bench/studies/scale/run.hpp"
#include "reckon/tests/bench/support/bench_console.hpp"
#include "reckon/tests/support/scratch_folder.hpp"
#include "reckon/tools/command_line/console.hpp"

namespace reckon::bench {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;
using ::testing::Not;

/// 10 peers over 2 s, which gives round numbers per peer and second.
ScaleRow row_of(std::size_t mechanism, std::uint64_t datagrams) {
  ScaleRow row;
  row.mechanism = mechanism;
  row.run.setting.peers = 10;
  row.run.setting.crowd.entities = 100;
  WholeCounts& counts = row.run.counts;
  counts.seconds = 2;
  counts.datagrams = datagrams;
  counts.octets = 200 * datagrams;
  counts.updates = 400;
  counts.heard_updates = 2000;
  counts.heard_datagrams = 9 * datagrams;
  counts.wanted = 80;
  counts.lost = datagrams;
  counts.looks = 1000;
  counts.unseen = 10;
  counts.cpu = 0.02;
  row.run.pose.p99 = 0.5;
  return row;
}

double value_of(const ScaleRow& row, std::string_view name) {
  for (const ScaleMeasure& measure : scale_measures())
    if (measure.name == name) return measure.of(row);
  ADD_FAILURE() << name;
  return 0;
}

TEST(ScaleText, HasNumbersOfOnePeerInASecond) {
  const ScaleRow row = row_of(1, 60);
  EXPECT_DOUBLE_EQ(value_of(row, "sent_packets_per_s"), 3);
  EXPECT_DOUBLE_EQ(value_of(row, "sent_bytes_per_s"), 600);
  EXPECT_DOUBLE_EQ(value_of(row, "heard_packets_per_s"), 27);
  EXPECT_DOUBLE_EQ(value_of(row, "wanted_updates_per_s"), 4);
  EXPECT_DOUBLE_EQ(value_of(row, "unwanted_updates_per_s"), 96);
  EXPECT_DOUBLE_EQ(value_of(row, "lost_share"), 0.1);
  EXPECT_DOUBLE_EQ(value_of(row, "unseen_share"), 0.01);
  EXPECT_DOUBLE_EQ(value_of(row, "loops_cpu_share"), 0.001);
  const std::vector rows{row};
  EXPECT_THAT(scale_text(rows), HasSubstr("10 peers with 100 entities over 2 s"));
  EXPECT_THAT(scale_text(rows), HasSubstr("+ dead reckoning"));
}

TEST(ScaleText, WritesWhatItCanCompareWith) {
  const test::ScratchFolder folder;
  const std::string file = folder.file("base.json");
  const std::vector before{row_of(0, 600), row_of(1, 60)};
  std::ofstream(file) << scale_json(before);
  std::istringstream lines(scale_json(before));
  std::string line;
  for (int count = 0; std::getline(lines, line); ++count) {
    const json object = json::parse(line);
    EXPECT_EQ(object["kind"], "row");
    EXPECT_EQ(object["mechanism"], std::string(kMechanisms[static_cast<std::size_t>(count)].name));
    EXPECT_EQ(object["peers"], 10);
  }
  const auto base = read_scale_rows(file);
  ASSERT_EQ(base.size(), 2U);
  EXPECT_TRUE(changes_of(before, base).empty());
  EXPECT_THAT(comparison_text(before, base), HasSubstr("2 of 2 rows"));

  // A tenth more datagrams in one of them.
  const std::vector now{row_of(0, 600), row_of(1, 66)};
  const auto changes = changes_of(now, base);
  ASSERT_FALSE(changes.empty());
  for (const ScaleChange& change : changes) {
    EXPECT_EQ(change.mechanism, kMechanisms[1].name);
    EXPECT_NEAR(change.ratio(), 1.1, 1e-12) << change.measure;
  }
  EXPECT_THAT(comparison_json(now, base), HasSubstr("sent_packets_per_s"));
}

TEST(ScaleText, RepeatedRunsOfTheBaseBoundTheNoise) {
  const test::ScratchFolder folder;
  const std::string file = folder.file("base.json");
  std::ofstream(file) << scale_json(std::vector{row_of(1, 60)})
                      << scale_json(std::vector{row_of(1, 80)});
  const auto base = read_scale_rows(file);
  for (const std::uint64_t datagrams : {60u, 66u, 80u, 81u})
    EXPECT_TRUE(changes_of(std::vector{row_of(1, datagrams)}, base).empty()) << datagrams;
  const auto changes = changes_of(std::vector{row_of(1, 100)}, base);
  ASSERT_FALSE(changes.empty());
  EXPECT_DOUBLE_EQ(changes.front().ratio(), 1.25);
}

TEST(ScaleText, CpuIsJudgedOnlyByRepeatedRuns) {
  const test::ScratchFolder folder;
  const std::string file = folder.file("base.json");
  std::ofstream(file) << scale_json(std::vector{row_of(1, 60)});
  ScaleRow slow = row_of(1, 60);
  slow.run.counts.cpu *= 3;
  slow.run.live_cpu = 1;
  EXPECT_TRUE(changes_of(std::vector{slow}, read_scale_rows(file)).empty());
  std::ofstream(file, std::ios::app) << scale_json(std::vector{row_of(1, 60)});
  const auto changes = changes_of(std::vector{slow}, read_scale_rows(file));
  ASSERT_EQ(changes.size(), 1u);
  EXPECT_EQ(changes.front().measure, "loops_cpu_share");
}

TEST(ScaleText, RefusesABaseOfOtherExercises) {
  const test::ScratchFolder folder;
  const std::string file = folder.file("base.json");
  std::ofstream(file) << scale_json(std::vector{row_of(1, 60)});
  const auto result =
      reckon::test::run_bench({"bench", "scale", "--peers", "4", "--for", "1s", "--compare", file});
  EXPECT_EQ(result.status, 2);
  EXPECT_THAT(result.err, HasSubstr("no exercise of 4 peers with 400 entities, only 10 peers with "
                                    "100 entities"));
}

TEST(ScaleText, RefusesFilesThatHaveNoRows) {
  const test::ScratchFolder folder;
  const std::string file = folder.file("other.json");
  std::ofstream(file) << "{\"kind\":\"row\",\"mechanism\":\"every tick\",\"peers\":3}\n";
  EXPECT_THROW(static_cast<void>(read_scale_rows(file)), tools::UsageError);
  std::ofstream(file, std::ios::trunc) << "{}\n";
  EXPECT_THROW(static_cast<void>(read_scale_rows(file)), tools::UsageError);
  EXPECT_THROW(static_cast<void>(read_scale_rows(folder.file("none.json"))), tools::UsageError);
}

/// All mechanisms at one size. Datagrams received by a peer grow as a power of the number of peers.
std::vector<ScaleRow> exercise_of(std::size_t peers, double power) {
  std::vector<ScaleRow> rows;
  for (std::size_t mechanism = 0; mechanism < kMechanisms.size(); ++mechanism) {
    ScaleRow row = row_of(mechanism, 60);
    row.run.setting.peers = peers;
    row.run.setting.crowd.entities = 100 * peers;
    const double heard = 20'000.0 * std::pow(static_cast<double>(peers) / 10, power);  // a second
    const double sum = heard * row.run.counts.seconds * static_cast<double>(peers);
    row.run.counts.heard_datagrams = static_cast<std::uint64_t>(sum);
    row.run.counts.heard_updates = row.run.counts.wanted = 0;
    row.run.counts.heard_octets = 0;
    row.run.counts.cpu = 0;
    rows.push_back(row);
  }
  return rows;
}

// 20,000 datagrams of 10 us take a fifth of a core; half a core is 2.5 times that.
TEST(ScaleCapacity, QuantityAtItsLimitEndsTheExercise) {
  const HostLimits limits{1e9, 0.5, 0.5, {0, 0, 10e-6}};
  for (const double power : {0.5, 1.0, 2.0}) {
    std::vector<ScaleRow> rows = exercise_of(10, power);
    for (const ScaleRow& row : exercise_of(20, power)) rows.push_back(row);
    for (ScaleRow& row : rows) row.run.live_cpu = live_cpu(cost_counts(row.run), limits.costs);
    const auto found = capacities(rows, limits);
    ASSERT_EQ(found.size(), kMechanisms.size());
    EXPECT_NEAR(found.back().peers, 10 * std::pow(2.5, 1 / power), 0.01) << power;
    EXPECT_NEAR(found.back().entities, 100 * found.back().peers, 1e-6);
    EXPECT_EQ(found.back().limit, "the CPU of a host");
    EXPECT_EQ(found.back().within, power == 2.0);
    EXPECT_THAT(capacity_text(found, limits), HasSubstr("the CPU of a host is the first limit"));
    std::istringstream lines(capacity_json(found));
    std::string line;
    std::getline(lines, line);
    EXPECT_NEAR(json::parse(line)["peers"].get<double>(), found.front().peers, 1e-6);
  }
}

TEST(ScaleCapacity, IsTheLinkWhereThatIsFullFirst) {
  const HostLimits limits{1e9, 0.5, 0.5, {0, 0, 1e-6}};
  std::vector<ScaleRow> rows = exercise_of(10, 1);
  for (const ScaleRow& row : exercise_of(20, 1)) rows.push_back(row);
  for (ScaleRow& row : rows) row.run.counts.heard_octets = 1000 * row.run.counts.heard_datagrams;
  // 20,000 datagrams of 1,000 octets are 0.16 Gbit/s.
  const auto found = capacities(rows, limits);
  EXPECT_NEAR(found.back().peers, 10 * 0.5 / 0.16, 0.1);
  EXPECT_EQ(found.back().limit, "the link of a host");
}

TEST(ScaleCapacity, FarExercisesAreNotExtrapolated) {
  const HostLimits limits{1e9, 0.5, 0.5, {0, 0, 1e-6}};
  std::vector<ScaleRow> rows = exercise_of(10, 0);
  EXPECT_TRUE(capacities(rows, limits).empty());
  EXPECT_EQ(capacity_text({}, limits), "");
  for (const ScaleRow& row : exercise_of(20, 0)) rows.push_back(row);
  for (ScaleRow& row : rows) row.run.counts.cpu = 1e-3 * static_cast<double>(row.peers());
  const auto found = capacities(rows, limits);
  EXPECT_DOUBLE_EQ(found.back().peers, 20 * kFarthest);
  EXPECT_EQ(found.back().limit, "");
  EXPECT_THAT(capacity_text(found, limits), HasSubstr("at least 600 peers with 60,000 entities"));
  for (ScaleRow& row : rows) row.run.setting.crowd.entities += row.peers() == 20 ? 500 : 0;
  EXPECT_TRUE(capacities(rows, limits).empty()) << "other peers have other numbers of entities";
}

TEST(ScaleSummary, TableFitsInto80Columns) {
  std::vector<ScaleRow> rows = exercise_of(10, 1);
  for (const ScaleRow& row : exercise_of(1000, 1.2)) rows.push_back(row);
  rows.back().run.counts.heard_datagrams /= 2;
  rows.back().run.pose.p99 = 123.456;
  for (ScaleRow& row : rows) row.run.setting.grid.cell_size = 2000;
  const std::string text = scale_summary(rows);
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 80U) << line;
  EXPECT_THAT(text, HasSubstr("1000 peers with 100000 entities"));
  EXPECT_THAT(text, HasSubstr("+ compression: heard 2 x less"));
  EXPECT_THAT(text, HasSubstr("pose 123 m"));
  EXPECT_THAT(text, HasSubstr("All mechanisms together"));
  EXPECT_THAT(text,
              HasSubstr("From 100000 entities on, each peer receives 1.3e+02 times as much.\n"));
  for (ScaleRow& row : rows) row.run.setting.grid.cell_size = 10;
  EXPECT_THAT(scale_summary(rows), HasSubstr("cells\nshare the groups"));
}

// Ctrl-C stops `bench scale --many-hands` in its last runs, or in its first.
TEST(ScaleFindings, HoldTheRunsBeforeAStop) {
  ScaleReport report;
  EXPECT_EQ(scale_findings(report, false), "");
  EXPECT_EQ(scale_findings(report, true), "");
  report.rows = {row_of(0, 600)};
  EXPECT_THAT(scale_findings(report, false), HasSubstr("EACH PEER"));
  EXPECT_THAT(scale_findings(report, false), Not(HasSubstr("FORCE SENT AT")));
  report.many_hands = {{0.015, 64, 4, 700, 90'000, {}}};
  EXPECT_THAT(scale_findings(report, false), HasSubstr("15 mN"));
  std::istringstream lines(scale_findings(report, true));
  std::string row, many;
  std::getline(lines, row);
  std::getline(lines, many);
  EXPECT_EQ(json::parse(row)["kind"], "row");
  EXPECT_EQ(json::parse(many)["kind"], "many_hands");
}

TEST(ScaleBench, StopAtOnceReportsThatNothingRan) {
  const std::atomic<bool> stop = true;
  const auto result =
      reckon::test::run_bench({"bench", "scale", "--peers", "4", "--for", "1s"}, &stop);
  EXPECT_EQ(result.status, 0);
  EXPECT_EQ(result.out, "");
  EXPECT_THAT(result.err, HasSubstr("stopped before the first run was complete"));
}

TEST(ScalePage, HoldsTheWholeReport) {
  ScaleReport report;
  report.command = "reckon bench scale --peers '<b>'";
  report.circumstances = "2026-11-26 12:00 UTC, reckon 0.1.0";
  report.rows = {row_of(0, 600), row_of(1, 60)};
  report.rows.push_back(row_of(0, 900));
  report.rows.back().run.setting.crowd.entities = 1000;
  report.hands = {{"press-20", 0.015, 20, 35, 11'000, {}}, {"press-20", 0.05, 23, 23, 7000, {}}};
  report.hands[0].error.p99 = 0.049;
  report.hands[1].error.p99 = 0.112;
  const std::string page = scale_page(report);
  EXPECT_THAT(page, HasSubstr("&lt;b&gt;"));
  EXPECT_THAT(page, Not(HasSubstr("'<b>'")));
  EXPECT_THAT(page, HasSubstr("2026-11-26 12:00 UTC, reckon 0.1.0"));
  EXPECT_THAT(page, HasSubstr("Datagrams received by a peer"));
  EXPECT_THAT(page, HasSubstr("press-20, sent at 50 mN: 23 a second, 112 mN"));
  for (const std::string_view foreign : {"src=\"http", "href=\"http", "@import"})
    EXPECT_THAT(page, Not(HasSubstr(std::string(foreign))));
}

std::size_t lines_of(const std::string& picture) {
  std::size_t lines = 0;
  for (std::size_t at = picture.find("<polyline"); at != std::string::npos;
       at = picture.find("<polyline", at + 1))
    ++lines;
  return lines;
}

// A line connects points of the same number of peers, never the last point of one number to the
// first of the next.
TEST(ScalePage, DrawsALineForEachNumberOfPeers) {
  ScaleReport report;
  for (const std::size_t entities : {640, 2560})
    for (const std::size_t peers : {16, 32, 64}) {
      report.rows.push_back(row_of(0, 600));
      report.rows.back().run.setting.crowd.entities = entities;
      report.rows.back().run.setting.peers = peers;
    }
  std::string page = scale_page(report);
  page = page.substr(page.find("<svg"), page.find("</svg>") - page.find("<svg"));
  EXPECT_EQ(lines_of(page), 3U);
  EXPECT_THAT(page, HasSubstr("16 peers solid, 32 peers dashed, 64 peers dotted"));
  for (ScaleRow& row : report.rows) row.run.setting.crowd.entities = 640;
  page = scale_page(report);
  page = page.substr(page.find("<svg"), page.find("</svg>") - page.find("<svg"));
  EXPECT_EQ(lines_of(page), 1U) << "over peers";
  EXPECT_THAT(page, Not(HasSubstr("peers solid")));
}

}  // namespace
}  // namespace reckon::bench
