// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Sweeps of couplings: their cells, the verdict of each run, and the report.
#include <gmock/gmock.h>

#include <limits>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "reckon/bench/studies/stability/options.hpp"
#include "reckon/bench/studies/stability/text.hpp"
#include "reckon/tools/command_line/console.hpp"

namespace reckon::bench {
namespace {

using nlohmann::json;
using namespace std::chrono_literals;
using ::testing::HasSubstr;
using ::testing::Not;

StabilityPlan plan_of(std::vector<std::string> sweeps,
                      std::vector<std::string> modes = {"reckon,printed_dead_reckoning"}) {
  StabilityWords words;
  words.sweeps = std::move(sweeps);
  words.modes = std::move(modes);
  words.length = std::chrono::seconds(3);
  return read_stability_options(words).plan;
}

std::string refusal(StabilityWords words) {
  try {
    static_cast<void>(read_stability_options(words));
  } catch (const tools::UsageError& error) {
    return error.what();
  }
  return "taken";
}

std::string refused_sweep(const std::string& sweep, const std::string& other = "") {
  StabilityWords words;
  words.sweeps = {sweep};
  if (!other.empty()) words.sweeps.push_back(other);
  return refusal(words);
}

TEST(StabilityPlan, CellsAreTheProductOfTheAxes) {
  const StabilityPlan plan =
      plan_of({"hand.k1=300,600", "delay=0..100ms/3", "environment=linear,moving"});
  ASSERT_EQ(plan.cells(), 12U);
  EXPECT_EQ(plan.runs(), 24U);
  EXPECT_EQ(plan.setting(0).stiffness, 300.0);
  EXPECT_EQ(plan.setting(1).environment, EnvironmentKind::moving);
  EXPECT_EQ(plan.setting(1).run.network.delay, 0ms);
  EXPECT_EQ(plan.setting(2).run.network.delay, 50ms);
  EXPECT_EQ(plan.setting(11).stiffness, 600.0);
  EXPECT_EQ(plan.setting(11).run.network.delay, 100ms);
  EXPECT_EQ(plan.mode_of(0), CouplingMode::printed_dead_reckoning) << "in the order of the list";
  EXPECT_EQ(plan.run(13).mode, CouplingMode::reckon);
  EXPECT_EQ(plan.run(13).environment.kind(), EnvironmentKind::moving);
  EXPECT_EQ(plan.run(13).environment.stiffness(), 300.0);
}

TEST(StabilityPlan, EachCellHasItsOwnSeed) {
  const StabilityPlan plan = plan_of({"delay=0..200ms/50"});
  std::set<std::uint64_t> seeds;
  for (std::size_t cell = 0; cell < 50; ++cell) {
    seeds.insert(plan.run(cell).seed);
    EXPECT_EQ(plan.run(cell).seed, plan.run(50 + cell).seed);
  }
  EXPECT_EQ(seeds.size(), 50U);
}

TEST(StabilityPlan, EveryParameterChangesItsSetting) {
  for (const StabilityParameter& parameter : stability_parameters()) {
    StabilitySetting setting;
    const double value = parameter.words.empty() ? (parameter.rule.unit == "Hz" ? 400.0 : 0.4)
                                                 : static_cast<double>(parameter.words.size() - 1);
    ASSERT_NE(parameter.get(setting), value) << parameter.name;
    parameter.set(setting, value);
    EXPECT_DOUBLE_EQ(parameter.get(setting), value) << parameter.name;
  }
}

TEST(StabilityPlan, JitterIsATimeOrAShare) {
  EXPECT_EQ(plan_of({"delay=10,40ms", "impairment.jitter=20ms"}).run(0).network.jitter, 20ms);
  const StabilityPlan shares = plan_of({"jitter_share=50%", "delay=0,10,40ms"});
  EXPECT_EQ(shares.run(0).network.jitter, 0ms);
  EXPECT_EQ(shares.run(1).network.jitter, 5ms);
  EXPECT_EQ(shares.run(2).network.jitter, 20ms);
}

TEST(StabilityPlan, TextContainsAllInputsOfAnOutcome) {
  const std::string one = plan_of({"delay=0,10ms"}).text();
  EXPECT_THAT(one, HasSubstr("impairment.delay=0 s,10 ms"));
  EXPECT_THAT(one, HasSubstr("seed=1; for=3 s"));
  for (const StabilityParameter& parameter : stability_parameters()) {
    if (parameter.name == "jitter_share") continue;
    EXPECT_THAT(one, HasSubstr(std::string(parameter.name) + "=")) << "said where it is not swept";
  }
  StabilityWords words;
  words.sweeps = {"delay=0,10ms"};
  words.no_gate = true;
  EXPECT_THAT(read_stability_options(words).plan.text(), HasSubstr("reckon_no_gate"));
}

TEST(StabilityPlan, DefaultSweepsStiffnessDelayLossJitterAndEnvironment) {
  const StabilityPlan plan = read_stability_options({}).plan;
  EXPECT_EQ(plan.modes.size(), kCouplingModes.size());
  EXPECT_EQ(plan.axes.size(), 5U);
  EXPECT_EQ(plan.cells(), 320U);
}

TEST(StabilityPlan, RefusesBadAxesWithTheRemedy) {
  EXPECT_THAT(refused_sweep("dely=0..1s"), HasSubstr("did you mean 'delay'?"));
  EXPECT_THAT(refused_sweep("hand.k2=5"), HasSubstr("did you mean 'hand.k1'?"));
  EXPECT_THAT(refused_sweep("delay"), HasSubstr("has no values; write NAME=A..B/N"));
  EXPECT_THAT(refused_sweep("delay=5 N"), HasSubstr("--sweep impairment.delay: unit 'N'"));
  EXPECT_THAT(refused_sweep("environment=linar"), HasSubstr("did you mean 'linear'?"));
  EXPECT_THAT(refused_sweep("environment=linear,linear"), HasSubstr("given twice"));
  EXPECT_THAT(refused_sweep("delay=0,1s", "impairment.delay=2s"), HasSubstr("swept twice"));
  EXPECT_THAT(refused_sweep("jitter_share=0,30%"),
              HasSubstr("has no effect if impairment.delay is 0"));
  EXPECT_THAT(refused_sweep("reorder_delay=1,2ms"), HasSubstr("no effect if impairment.reorder"));
  EXPECT_THAT(refused_sweep("counterpart=server,hand", "environment=linear,moving"),
              HasSubstr("two hands have a linear spring"));
  EXPECT_THAT(refused_sweep("operator=trace"), HasSubstr("add --hand"));
  EXPECT_THAT(refused_sweep("update_rate=2kHz"), HasSubstr("a cell is invalid"));
  EXPECT_THAT(refused_sweep("delay=0..1s/1000", "hand.k1=1..1000/1000"),
              HasSubstr("reduce them to at most"));
}

TEST(StabilityPlan, RefusesWordsWithoutEffect) {
  StabilityWords words;
  words.modes = {"gain_cut"};
  words.no_gate = true;
  EXPECT_THAT(refusal(words), HasSubstr("--no-gate needs the mode reckon"));
  words = {};
  words.modes = {"recon"};
  EXPECT_THAT(refusal(words), HasSubstr("did you mean 'reckon'?"));
  words = {};
  words.peak = "0";
  EXPECT_THAT(refusal(words), HasSubstr("--peak"));
  words = {};
  words.length = std::chrono::seconds(1);
  EXPECT_THAT(refusal(words), HasSubstr("--for"));
}

TEST(StabilityVerdict, WorstCriterionCountsFirst) {
  StabilitySetting push;
  StabilityResult result;
  result.truth_rms = 2.0;
  result.error_rms = 0.19;
  EXPECT_EQ(verdict_of(push, result), StabilityVerdict::right);
  result.error_rms = 0.21;
  EXPECT_EQ(verdict_of(push, result), StabilityVerdict::wrong_force);
  result.rms_speed = 0.03;
  EXPECT_EQ(verdict_of(push, result), StabilityVerdict::cycles);
  StabilitySetting driven = push;
  driven.operator_number = 2;
  EXPECT_EQ(verdict_of(driven, result), StabilityVerdict::wrong_force) << "it is moved";
  result.least_energy = -2e-9;
  EXPECT_EQ(verdict_of(push, result), StabilityVerdict::made_energy);
  result.least_energy = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(verdict_of(push, result), StabilityVerdict::made_energy);
  result.diverged = true;
  EXPECT_EQ(verdict_of(push, result), StabilityVerdict::diverged);
}

TEST(StabilityText, RowsAreRestoredToTheLastBit) {
  const StabilityPlan plan = plan_of({"delay=0,10ms", "environment=all"});
  StabilityResult result{-1.0 / 3, 1e300, 0.1, 1e-17, 2.0 / 7, 0, 1, 2, 0.99, true};
  const std::string line = stability_row(plan, 13, result);
  const auto read = read_stability_row(plan, line);
  ASSERT_TRUE(read);
  EXPECT_EQ(read->first, 13U);
  EXPECT_EQ(read->second, result);
  EXPECT_FALSE(read_stability_row(plan, line.substr(0, line.size() - 2)));
  EXPECT_FALSE(read_stability_row(plan, line + ",1"));
  EXPECT_FALSE(read_stability_row(plan, "99" + line.substr(2))) << "no such run";
  EXPECT_FALSE(read_stability_row(plan, "12" + line.substr(2))) << "of another cell";
  EXPECT_EQ(std::ranges::count(line, ','), std::ranges::count(stability_columns(plan), ','));
}

/// A study of two modes in six cells, with invented numbers.
StabilityReport made_up() {
  StabilityReport report{
      "reckon bench stability <x>", plan_of({"delay=0..100ms/3", "hand.k1=1,2kN/m"}), {}, {}};
  report.results.resize(12);
  for (StabilityResult& result : report.results) {
    result.truth_rms = 1;
    result.kept = 1;
    result.peak_force = 5;
  }
  report.results[1].least_energy = -0.5;
  report.results[2].diverged = true;
  report.results[3].error_rms = 0.5;
  report.results[4].peak_force = 11;
  report.results[7].rms_speed = 1;
  return report;
}

TEST(StabilityText, SharesReferToTheCellsOfAMode) {
  const auto rows = summaries_of(made_up());
  ASSERT_EQ(rows.size(), 2U);
  EXPECT_EQ(rows[0].mode, "printed_dead_reckoning");
  EXPECT_DOUBLE_EQ(rows[0].made_energy, 2.0 / 6) << "what ran away among it";
  EXPECT_DOUBLE_EQ(rows[0].diverged, 1.0 / 6);
  EXPECT_DOUBLE_EQ(rows[0].peak, 1.0 / 6);
  EXPECT_DOUBLE_EQ(rows[0].wrong.value(), 1.0 / 5);
  EXPECT_DOUBLE_EQ(rows[0].right, 3.0 / 6);
  EXPECT_DOUBLE_EQ(rows[0].least_energy, -0.5);
  EXPECT_DOUBLE_EQ(rows[1].made_energy, 0.0);
  EXPECT_DOUBLE_EQ(rows[1].cycles.value(), 1.0 / 6);
}

TEST(StabilityText, JsonHasEveryRunAndEveryMode) {
  std::istringstream lines(stability_json(made_up()));
  std::vector<json> rows;
  for (std::string line; std::getline(lines, line);) rows.push_back(json::parse(line));
  ASSERT_EQ(rows.size(), 14U);
  EXPECT_EQ(rows[2]["verdict"], "runs away");
  EXPECT_EQ(rows[2]["force_off"], nullptr);
  EXPECT_EQ(rows[3]["axes"]["impairment.delay"], 0.05);
  EXPECT_EQ(rows[3]["axes"]["hand.k1"], 2000.0);
  EXPECT_EQ(rows[13]["kind"], "mode");
  EXPECT_EQ(rows[13]["mode"], "reckon");
  EXPECT_EQ(rows[13]["no_rest"], 1.0 / 6);
}

TEST(StabilityText, ReportsThatTheGateIsOff) {
  StabilityReport report = made_up();
  EXPECT_THAT(stability_text(report), Not(HasSubstr("GATE")));
  EXPECT_THAT(stability_page(report), Not(HasSubstr("GATE")));
  report.plan.gate = false;
  EXPECT_THAT(stability_text(report), HasSubstr("THE GATE IS OFF"));
  EXPECT_THAT(stability_text(report), HasSubstr("reckon_no_gate"));
  EXPECT_THAT(stability_page(report), HasSubstr("class=\"loud\">THE GATE IS OFF"));
}

TEST(StabilityPage, HasAMapOfEachModeWithNumbers) {
  const std::string page = stability_page(made_up());
  std::size_t cells = 0;
  for (std::size_t at = page.find("<title>"); at != page.npos; at = page.find("<title>", at + 1))
    ++cells;
  EXPECT_EQ(cells, 1 + 12U) << "the page's and one a cell";
  EXPECT_THAT(page, HasSubstr("<h2>reckon</h2>"));
  EXPECT_THAT(page, HasSubstr("reckon bench stability &lt;x&gt;"));
  EXPECT_THAT(page, HasSubstr("impairment.delay 50 ms, hand.k1 2 kN/m\nwrong force\n"));
  EXPECT_THAT(page, HasSubstr(">E</text>")) << "told apart without colours";
  EXPECT_THAT(page, HasSubstr(">X</text>"));
  EXPECT_THAT(page, Not(HasSubstr("http://"))) << "needs no other file";
  EXPECT_THAT(page, Not(HasSubstr("https://")));
}

TEST(StabilityPage, MapsTakeAnyNumberOfAxes) {
  for (const std::vector<std::string>& sweeps :
       {std::vector<std::string>{"environment=linear"},
        {"operator=all"},
        {"loss=0,10%"},
        {"hand.k1=1,2"},
        {"loss=0,10%", "delay=5,6ms", "hand.k1=1,2", "operator=push,soft"}}) {
    StabilityReport report{"", plan_of(sweeps, {"reckon"}), {}, {}};
    report.results.resize(report.plan.runs());
    const std::string page = stability_page(report);
    std::size_t cells = 0;
    for (std::size_t at = page.find("<rect class=\"v0\" x="); at != page.npos;
         at = page.find("<rect class=\"v0\" x=", at + 1))
      ++cells;
    EXPECT_EQ(cells, report.plan.cells()) << sweeps.front();
  }
}

TEST(StabilityStudy, RunsOnlyTheMissingCells) {
  const StabilityPlan plan = plan_of({"delay=0,50ms", "loss=0,30%"});
  const auto go_on = [](std::size_t, std::size_t) { return true; };
  StabilityResults whole(plan.runs());
  std::size_t told = 0;
  EXPECT_TRUE(run_stability(
      plan, whole, [&](std::size_t) { ++told; }, go_on));
  EXPECT_EQ(told, plan.runs());
  StabilityResults part = whole;
  part[1].reset();
  part[6].reset();
  std::vector<std::size_t> runs;
  EXPECT_TRUE(run_stability(
      plan, part, [&](std::size_t run) { runs.push_back(run); }, go_on));
  EXPECT_THAT(runs, ::testing::UnorderedElementsAre(1, 6));
  EXPECT_EQ(part, whole);
}

TEST(StabilityStudy, PrintedDeadReckoningAloneMakesEnergy) {
  const StabilityPlan plan = plan_of({"environment=switching", "delay=50ms", "hand.k1=1kN/m"});
  StabilityResults results(plan.runs());
  ASSERT_TRUE(run_stability(
      plan, results, [](std::size_t) {}, [](std::size_t, std::size_t) { return true; }));
  EXPECT_LT(results[0]->least_energy, kMadeEnergy);
  EXPECT_GE(results[1]->least_energy, kMadeEnergy);
}

}  // namespace
}  // namespace reckon::bench
