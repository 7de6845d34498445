// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A whole study in 50 lines: this file, except step_row(), is all that a study needs.
#include <gmock/gmock.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "reckon/bench/plots/sortable_page.hpp"
#include "reckon/bench/studies/frame/fields.hpp"
#include "reckon/bench/studies/frame/study.hpp"
#include "reckon/bench/studies/sweep/values.hpp"
#include "reckon/tests/support/scratch_folder.hpp"
#include "reckon/tests/tools/support/captured_console.hpp"
#include "reckon/tests/tools/support/written_files.hpp"

namespace reckon::bench::small_study_test {
namespace {

using ::testing::HasSubstr;

struct StepRow {
  double step = 0, error = 0;
};

/// Euler's approximation of e.
StepRow step_row(double step) {
  return {step, std::abs(std::exp(1) - std::pow(1 + step, 1 / step))};
}

Fields step_fields(const StepRow& row) {
  return Fields("step")
      .value("step_s", row.step)
      .value("error", row.error)
      .shown("STEP", "step [s]", row.step, fmt::format("{:g}", row.step))
      .shown("ERROR", "error", row.error, fmt::format("{:.1e}", row.error));
}

class StepStudy final : public Study {
 public:
  StepStudy() : Study({"What a step costs in error.", "reckon steps --steps 0.1,0.01"}) {}

  std::vector<Flag> flags() override {
    return {{"--steps", &steps_, "lengths of a step (0.1,0.01)"},
            {"--json", &shared_.json, "one JSON object per line"},
            {"--csv", &shared_.csv, "write all figures to this file"},
            {"--report", &shared_.report, "write one HTML page"}};
  }

  StudyOutput run(const StudyCall& call) override {
    std::vector<StepRow> rows;
    for (const double step : read_values(steps_, {"s", 0, 1, true}, "--steps"))
      rows.push_back(step_row(step));
    return {.out = lines_of(shared_.json, rows, step_fields) + (shared_.json ? "" : "Of e.\n"),
            .csv = csv_of(rows, step_fields),
            .page = sortable_page(call.command, "", page_table_of(rows, step_fields))};
  }

 private:
  std::string steps_ = "0.1,0.01";
};

std::unique_ptr<Study> step_study() { return std::make_unique<StepStudy>(); }

test::ProgramResult run(const std::vector<std::string_view>& words) {
  const test::CapturedStream out, err;
  tools::Console console;
  console.out = out.file();
  console.err = err.file();
  // Any row of the list of verbs provides a name.
  const int status = study_verb(tools::verb_row("zwidth"), step_study).run(words, console);
  return {status, out.text(), err.text()};
}

TEST(SmallStudy, PrintsItsTableAndSentence) {
  EXPECT_EQ(run({}).out, "STEP    ERROR\n 0.1  1.2e-01\n0.01  1.3e-02\nOf e.\n");
  EXPECT_THAT(run({"--help"}).out, HasSubstr("lengths of a step (0.1,0.01)"));
}

TEST(SmallStudy, WritesEqualRowsAsJsonCsvAndPage) {
  const test::ScratchFolder folder;
  const std::string csv = folder.file("rows.csv"), page = folder.file("rows.html");
  const auto made = run({"--json", "--csv", csv, "--report", page, "--steps", "0.5"});
  EXPECT_EQ(nlohmann::json::parse(made.lines().at(0))["step_s"], 0.5);
  EXPECT_THAT(test::content(csv), HasSubstr("step_s,error\n0.5,"));
  EXPECT_THAT(test::content(page), HasSubstr("<th>step [s]</th>"));
  EXPECT_EQ(made.err, "wrote " + csv + "\nwrote " + page + "\n");
}

TEST(SmallStudy, RefusesFilesBeforeItRuns) {
  EXPECT_THROW(run({"--csv", "/nowhere/rows.csv"}), tools::UsageError);
}

}  // namespace
}  // namespace reckon::bench::small_study_test
