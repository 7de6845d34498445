// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// `reckon bench accuracy --trace`: one run, sample by sample.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "reckon/tests/bench/support/bench_console.hpp"
#include "reckon/tests/support/scratch_folder.hpp"

namespace reckon::bench {
namespace {

using test::ProgramResult;
using test::run_bench;
using ::testing::HasSubstr;

/// Numbers by column; an empty cell is NaN.
using Row = std::map<std::string, double>;

std::vector<Row> rows_of(const std::string& path) {
  std::ifstream file(path);
  std::string line, cell;
  std::getline(file, line);
  std::vector<std::string> names;
  for (std::istringstream head(line); std::getline(head, cell, ',');) names.push_back(cell);
  std::vector<Row> rows;
  while (std::getline(file, line)) {
    std::istringstream cells(line);
    rows.emplace_back();
    for (const std::string& name : names) {
      std::getline(cells, cell, ',');
      rows.back()[name] = cell.empty() ? std::nan("") : std::stod(cell);
    }
  }
  return rows;
}

double apart(const Row& a, const Row& b, const std::string& of_a, const std::string& of_b) {
  double squares = 0;
  for (const char* axis : {"_x_m", "_y_m", "_z_m"})
    squares += std::pow(a.at(of_a + axis) - b.at(of_b + axis), 2);
  return std::sqrt(squares);
}

class PoseTraceFile : public testing::Test {
 protected:
  ProgramResult trace(std::vector<std::string> more) {
    std::vector<std::string> words{"bench", "accuracy", "--trace", path()};
    words.insert(words.end(), more.begin(), more.end());
    return run_bench(words);
  }
  std::string path() { return folder_.file("trace.csv"); }
  std::vector<Row> rows() { return rows_of(path()); }

 private:
  test::ScratchFolder folder_;
};

TEST_F(PoseTraceFile, HeldPositionIsOneChordBehind) {
  const auto result = trace({"--motion", "circle", "--for", "10s", "--models", "static", "--curves",
                             "snap", "--period", "1s"});
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("11 updates, 600 samples drawn"));
  const auto found = rows();
  ASSERT_EQ(found.size(), 600U);
  for (const Row& row : found) {
    const double t = row.at("t_s"), behind = t - (std::ceil(t - 1e-4) - 1);
    // The time has six decimals, which are 10 um of the path; the wire's angles are float32.
    EXPECT_NEAR(row.at("error_m"), 200 * std::sin(0.1 * behind), 2e-5) << t;
    EXPECT_NEAR(row.at("true_x_m"), 100 * std::cos(0.2 * t), 2e-5) << t;
    EXPECT_NEAR(row.at("angle_rad"), 0.2 * behind, 1e-6) << t;
    EXPECT_EQ(row.at("sent"), std::floor(t + 1e-4) + 1) << t;
    EXPECT_EQ(row.at("arrived"), std::ceil(t - 1e-4)) << t;
  }
}

TEST_F(PoseTraceFile, ContainsTheSamplesOfTheStudysSums) {
  const std::vector<std::string> run{
      "--motion", "weave", "--for",   "20s",  "--models", "rvw", "--thresholds", "0.5m",
      "--curves", "cubic", "--delay", "80ms", "--jitter", "40%", "--loss",       "10%"};
  ASSERT_EQ(trace(run).status, 0);
  std::vector<std::string> words{"bench", "accuracy", "--json"};
  words.insert(words.end(), run.begin(), run.end());
  const auto setting = nlohmann::json::parse(run_bench(words).lines().back());

  const auto found = rows();
  double squares = 0, greatest_step = 0;
  std::vector<double> errors;
  for (std::size_t i = 0; i < found.size(); ++i) {
    errors.push_back(apart(found[i], found[i], "true", "shown"));
    squares += errors.back() * errors.back();
    EXPECT_NEAR(errors.back(), found[i].at("error_m"), 1e-5);
    EXPECT_GE(found[i].at("sent"), found[i].at("lost") + found[i].at("arrived"));
    if (i == 0) continue;
    const double speed = 60 * apart(found[i], found[i - 1], "shown", "shown");
    EXPECT_NEAR(found[i].at("drawn_speed_mps"), speed, 1e-3);
    if (i > 1)
      greatest_step = std::max(greatest_step, std::abs(found[i].at("drawn_speed_mps") -
                                                       found[i - 1].at("drawn_speed_mps")));
  }
  EXPECT_TRUE(std::isnan(found.front().at("drawn_speed_mps")));
  EXPECT_NEAR(std::sqrt(squares / static_cast<double>(errors.size())),
              setting["position_m"]["rms"].get<double>(), 1e-6);
  EXPECT_NEAR(*std::max_element(errors.begin(), errors.end()),
              setting["position_m"]["max"].get<double>(), 1e-5);
  // A change of speed is at most the change of velocity.
  EXPECT_LE(greatest_step, setting["velocity_step_mps"]["max"].get<double>() + 1e-6);
  EXPECT_EQ(found.back().at("sent"), setting["updates"].get<double>());
  EXPECT_GT(found.back().at("lost"), 0);
}

TEST_F(PoseTraceFile, NamesEntitiesAsInTheirFile) {
  test::ScratchFolder folder;
  const std::string cars = folder.file("cars.csv");
  std::ofstream(cars) << "id,t_s,x_m,y_m\nred,0,0,0\nred,1,1,0\nred,2,2,0\nblue,0,5,0\nblue,1,5,1\n"
                         "blue,2,5,2\n";
  const auto result = trace({cars, "--models", "fpw", "--thresholds", "1m"});
  ASSERT_EQ(result.status, 0) << result.err;
  std::ifstream file(path());
  std::stringstream text;
  text << file.rdbuf();
  EXPECT_THAT(text.str(), HasSubstr("1.000000,red,1,0,0,"));
  EXPECT_THAT(text.str(), HasSubstr("1.000000,blue,5,1,0,"));
}

TEST_F(PoseTraceFile, AsksForOneRun) {
  const auto many = trace({"--motion", "weave,hand", "--models", "auto,fpw", "--curves", "cubic"});
  EXPECT_EQ(many.status, 2);
  EXPECT_THAT(many.err, HasSubstr("2 subjects x 2 models x 6 thresholds x 1 curves"));
  EXPECT_THAT(many.err, HasSubstr("write --motion weave --models auto"));
  EXPECT_FALSE(std::ifstream(path()));
  const auto circle = trace({"--circle"});
  EXPECT_EQ(circle.status, 2);
  EXPECT_THAT(circle.err, HasSubstr("remove --circle"));
}

TEST_F(PoseTraceFile, SendsAtAPeriodOrByAThreshold) {
  const std::vector<std::string> run{"--motion", "weave", "--models", "fpw", "--curves", "cubic"};
  auto both = run;
  both.insert(both.end(), {"--period", "1s", "--thresholds", "1m"});
  EXPECT_THAT(trace(both).err, HasSubstr("it replaces --thresholds"));
  const auto alone = run_bench({"bench", "accuracy", "--period", "1s"});
  EXPECT_EQ(alone.status, 2);
  EXPECT_THAT(alone.err, HasSubstr("with --trace FILE.csv only"));
}

TEST_F(PoseTraceFile, ReportsAnUnwritableFile) {
  const auto result =
      run_bench({"bench", "accuracy", "--trace", "/no/such/folder/trace.csv", "--motion", "weave",
                 "--models", "fpw", "--curves", "cubic", "--period", "1s"});
  EXPECT_EQ(result.status, 2);
  EXPECT_THAT(result.err, HasSubstr("/no/such/folder/trace.csv: cannot be written"));
}

}  // namespace
}  // namespace reckon::bench
