// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "reckon/bench/studies/stability/options.hpp"
#include "reckon/bench/studies/stability/text.hpp"
#include "reckon/bench/studies/sweep/journal.hpp"
#include "reckon/bench/studies/sweep/progress_bar.hpp"
#include "reckon/tools/terminal/text_table.hpp"

namespace reckon::bench {
namespace {

constexpr std::string_view kStudy = "reckon bench stability";

/// Results that are already in the journal.
StabilityResults results_in(const SweepJournal& journal, const StabilityPlan& plan,
                            const std::string& path) {
  StabilityResults results(plan.runs());
  for (std::size_t i = 0; i < journal.found().size(); ++i) {
    const auto row = read_stability_row(plan, journal.found()[i]);
    if (!row)
      throw tools::UsageError(fmt::format("{}:{}: not a result of this study; write a new file",
                                          path,
                                          i + 3));  // after two header lines
    results[row->first] = row->second;
  }
  return results;
}

/// Performs the missing runs and writes each result at once. @return whether all results are there
bool run_missing(const StabilityPlan& plan, StabilityResults& results, SweepJournal& journal,
                 const tools::Console& console) {
  ProgressBar bar(console);
  return run_stability(
      plan, results,
      [&](std::size_t run) { journal.append(stability_row(plan, run, *results[run])); },
      [&](std::size_t done, std::size_t missing) {
        bar.show(static_cast<double>(done) / static_cast<double>(missing),
                 fmt::format("{} of {}", tools::counted(done, "run"), missing));
        return !console.stopped();
      });
}

std::string stop_note(const StabilityWords& words, const StabilityResults& results) {
  const auto done = std::ranges::count_if(results, [](const auto& row) { return row.has_value(); });
  return fmt::format("stopped after {} of {}; {}\n",
                     tools::counted(static_cast<std::size_t>(done), "run"), results.size(),
                     words.csv.empty()
                         ? "with --csv FILE, the next run could continue from here"
                         : fmt::format("the same command continues from {}", words.csv));
}

class StabilityStudy final : public Study {
 public:
  std::vector<Flag> flags() override { return words_.flags(); }
  SharedWords& shared() override { return words_; }

  StudyOutput run(const StudyCall& call) override {
    StabilityOptions options = read_stability_options(words_);
    const StabilityPlan& plan = options.plan;
    SweepJournal journal(words_.csv, kStudy, plan.text(), stability_columns(plan));
    StabilityResults results = results_in(journal, plan, words_.csv);
    if (!plan.gate) fmt::print(call.console.err, "{}\n", gate_warning(plan));
    if (!run_missing(plan, results, journal, call.console))
      return {.note = stop_note(words_, results)};
    StabilityReport report{call.command, plan, {}, std::move(options.notes)};
    std::vector<std::string> lines;
    for (std::size_t run = 0; run < results.size(); ++run) {
      report.results.push_back(*results[run]);
      lines.push_back(stability_row(plan, run, report.results.back()));
    }
    journal.finish(lines);
    StudyOutput output{words_.json ? stability_json(report) : stability_text(report)};
    output.page = stability_page(report);
    if (!words_.csv.empty()) output.note = fmt::format("wrote {}\n", words_.csv);
    return output;
  }

 private:
  StabilityWords words_;
};

}  // namespace

std::unique_ptr<Study> stability_study() { return std::make_unique<StabilityStudy>(); }

}  // namespace reckon::bench
