// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/bench/studies/stability/run.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "reckon/bench/studies/stability/options.hpp"
#include "reckon/bench/studies/stability/page.hpp"
#include "reckon/bench/studies/stability/text.hpp"
#include "reckon/bench/studies/sweep/journal.hpp"
#include "reckon/bench/studies/sweep/progress_bar.hpp"
#include "reckon/tools/command_line/output_file.hpp"
#include "reckon/tools/terminal/text_table.hpp"

namespace reckon::bench {
namespace {

constexpr std::string_view kStudy = "reckon bench stability";

/// What the journal holds already.
StabilityResults results_in(const SweepJournal& journal, const StabilityPlan& plan,
                            const std::string& path) {
  StabilityResults results(plan.runs());
  for (std::size_t i = 0; i < journal.found().size(); ++i) {
    const auto row = read_stability_row(plan, journal.found()[i]);
    if (!row)
      throw tools::UsageError(fmt::format("{}:{}: is no result of this study; name a new file",
                                          path,
                                          i + 3));  // below two lines of header
    results[row->first] = row->second;
  }
  return results;
}

/// Runs what is missing and keeps each as it comes. @return whether all are there
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

void tell_stop(const StabilityWords& words, const StabilityResults& results,
               const tools::Console& console) {
  const auto done = std::ranges::count_if(results, [](const auto& row) { return row.has_value(); });
  fmt::print(console.err, "stopped after {} of {}; {}\n",
             tools::counted(static_cast<std::size_t>(done), "run"), results.size(),
             words.csv.empty() ? "with --csv FILE the next time could go on from here"
                               : fmt::format("the same command goes on from {}", words.csv));
}

}  // namespace

int bench_stability(const StabilityWords& words, const std::string& command,
                    const tools::Console& console) {
  StabilityOptions options = read_stability_options(words);
  const StabilityPlan& plan = options.plan;
  tools::check_writable(words.report);
  SweepJournal journal(words.csv, kStudy, plan.text(), stability_columns(plan));
  StabilityResults results = results_in(journal, plan, words.csv);
  if (!plan.gate) fmt::print(console.err, "{}\n", gate_warning(plan));
  if (!run_missing(plan, results, journal, console)) {
    tell_stop(words, results, console);
    return tools::exit_status(tools::ExitCode::good);
  }
  StabilityReport report{command, plan, {}, std::move(options.notes)};
  std::vector<std::string> lines;
  for (std::size_t run = 0; run < results.size(); ++run) {
    report.results.push_back(*results[run]);
    lines.push_back(stability_row(plan, run, report.results.back()));
  }
  journal.finish(lines);
  fmt::print(console.out, "{}", words.json ? stability_json(report) : stability_text(report));
  if (!words.csv.empty()) fmt::print(console.err, "wrote {}\n", words.csv);
  tools::write_output(words.report, stability_page(report), console);
  return tools::exit_status(tools::ExitCode::good);
}

}  // namespace reckon::bench
