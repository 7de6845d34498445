// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/bench/studies/scale/run.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <ctime>
#include <functional>
#include <iterator>
#include <thread>
#include <utility>
#include <vector>

#include "reckon/bench/studies/frame/text_lines.hpp"
#include "reckon/bench/studies/scale/comparison.hpp"
#include "reckon/bench/studies/scale/live_costs.hpp"
#include "reckon/bench/studies/scale/mechanisms.hpp"
#include "reckon/bench/studies/scale/page.hpp"
#include "reckon/bench/studies/scale/prediction.hpp"
#include "reckon/bench/studies/scale/text.hpp"
#include "reckon/bench/studies/sweep/progress_bar.hpp"
#include "reckon/tools/command_line/output_file.hpp"
#include "reckon/tools/command_line/version.hpp"
#include "reckon/tools/terminal/text_table.hpp"

namespace reckon::bench {
namespace {

/// Runs of equal weight, one after the other.
class Sweep {
 public:
  Sweep(std::size_t runs, const tools::Console& console)
      : runs_(runs), console_(console), bar_(console) {}

  /// @param run takes a callback for its progress  @return false if the study was stopped
  bool next(const std::function<void(const ScaleProgress&)>& run) {
    run([&](double share) {
      bar_.show((static_cast<double>(done_) + share) / static_cast<double>(runs_),
                fmt::format("run {} of {}", done_ + 1, runs_));
      return !console_.stopped();
    });
    ++done_;
    return !console_.stopped();
  }

 private:
  std::size_t runs_, done_ = 0;
  const tools::Console& console_;
  ProgressBar bar_;
};

/// Without dead reckoning the traffic is large and the same in each second: one is enough [s].
constexpr double kTickSeconds = 1;

ScaleSetting setting_of(const ScaleSetting& exercise, std::size_t mechanism) {
  ScaleSetting setting = exercise;
  setting.design = design_of(mechanism);
  if (!setting.design.dead_reckoning) setting.seconds = std::min(setting.seconds, kTickSeconds);
  return setting;
}

/// The costs on lo, measured once by this process; none if stopped. Processes of an exercise have
/// costs of their own: predicted_and_measured().
std::optional<LiveCosts> usual_costs(const tools::Console& console) {
  ScaleSetting usual;
  usual.peers = 4;
  static std::optional<LiveCosts> costs;
  if (costs) return costs;
  const auto progress = [&](double) { return !console.stopped(); };
  std::vector<CostSample> samples;
  for (const CostHalf half : {CostHalf::before, CostHalf::after}) {
    const auto more = cost_samples(usual, Meeting::lo, half, progress);
    if (more.empty()) return std::nullopt;
    samples.insert(samples.end(), more.begin(), more.end());
  }
  return costs = fitted_costs(samples);
}

/// False if stopped: the report then has the completed runs.
bool run_all(const ScalePlan& plan, const ScaleWords& words, ScaleReport& report,
             const tools::Console& console) {
  const bool live = plan.meeting != Meeting::simulated && !plan.pick;
  const auto measure_costs = [&] {
    const auto costs = usual_costs(console);
    report.limits.costs = costs.value_or(LiveCosts{});
    for (ScaleRow& row : report.rows)
      row.run.live_cpu = live_cpu(cost_counts(row.run), report.limits.costs);
    return costs.has_value();
  };
  // Other hosts say at once what they lack.
  const bool measures_last = plan.meeting == Meeting::hosts;
  if (!plan.settings.empty() && !measures_last && !measure_costs()) return false;
  const auto measured = [&](const WholeRun& simulated, const ScaleProgress& progress) {
    if (auto row = predicted_and_measured(simulated, plan.meeting, plan.hosts, progress))
      report.whole.push_back(std::move(*row));
  };
  Sweep sweep((plan.pick ? 1 : 0) + plan.drawn.size() +
                  plan.settings.size() * (kMechanisms.size() + (live ? 1 : 0)) +
                  (words.hands ? 1 : 0) + (words.many_hands ? 1 : 0),
              console);
  for (const ScaleSetting& setting : plan.settings) {
    for (std::size_t mechanism = 0; mechanism < kMechanisms.size(); ++mechanism)
      if (!sweep.next([&](const ScaleProgress& progress) {
            ScaleRow row{mechanism, run_whole_peers(setting_of(setting, mechanism),
                                                    Meeting::simulated, progress)};
            row.run.live_cpu = live_cpu(cost_counts(row.run), report.limits.costs);
            if (!console.stopped()) report.rows.push_back(std::move(row));
          }))
        return false;
    if (live && !sweep.next([&](const ScaleProgress& progress) {
          measured(report.rows.back().run, progress);
        }))
      return false;
  }
  for (const ScaleSetting& setting : plan.drawn)
    if (!sweep.next([&](const ScaleProgress& progress) {
          measured(run_whole_peers(setting, Meeting::simulated), progress);
        }))
      return false;
  if (measures_last && !measure_costs()) return false;
  if (plan.pick && !sweep.next([&](const ScaleProgress& progress) {
        report.pick = pick_policy(plan.settings.back(), *plan.pick, report.limits.costs,
                                  plan.meeting, progress);
      }))
    return false;
  for (const ScaleSetting& setting : plan.fitted)
    std::ranges::move(fitted_rows(report.rows, setting), std::back_inserter(report.fitted));
  const ScaleSetting& any = plan.settings.empty() ? plan.drawn.front() : plan.settings.front();
  if (words.hands && !sweep.next([&](const ScaleProgress& progress) {
        report.hands = run_hands(any.network, any.seed, progress);
      }))
    return false;
  return !words.many_hands || sweep.next([&](const ScaleProgress& progress) {
    report.many_hands = run_many_hands(plan.hands, any.network, any.seed, progress);
  });
}

/// "2026-11-26 12:00 UTC, reckon 0.1.0, 2 cores of Intel ..".
std::string circumstances() {
  const std::time_t now = std::time(nullptr);
  return fmt::format("{:%Y-%m-%d %H:%M} UTC, reckon {}, {} of {}", fmt::gmtime(now),
                     tools::program_version(),
                     tools::counted(std::thread::hardware_concurrency(), "core"), processor_name());
}

}  // namespace

std::string scale_findings(const ScaleReport& report, bool json, bool wide) {
  std::string out;
  const auto found = capacities(report.rows, report.limits);
  const auto add = [&](const auto& rows, auto as_json, auto as_text) {
    if (rows.empty()) return;
    if (!json && !out.empty()) out += '\n';
    out += json ? as_json() : as_text();
  };
  add(
      found, [&] { return capacity_json(found); },
      [&] { return capacity_text(found, report.limits); });
  add(
      report.rows, [&] { return scale_json(report.rows); },
      [&] { return wide ? scale_text(report.rows) : scale_summary(report.rows); });
  const auto growth = growth_rows(report.rows);
  add(
      growth, [&] { return growth_json(growth); }, [&] { return growth_text(growth); });
  add(
      report.fitted, [&] { return fitted_json(report.fitted); },
      [&] { return fitted_text(report.fitted); });
  add(
      report.whole, [&] { return whole_json(report.whole) + prediction_json(report.whole); },
      [&] { return whole_text(report.whole) + prediction_text(report.whole); });
  const std::vector<WholeRow> picked = report.pick ? report.pick->rows : std::vector<WholeRow>();
  add(
      picked, [&] { return prediction_json(picked); }, [&] { return prediction_text(picked); });
  if (report.pick && !json) out += '\n' + pick_text(*report.pick);
  add(
      report.hands, [&] { return hands_json(report.hands); },
      [&] { return hands_text(report.hands); });
  add(
      report.many_hands, [&] { return many_hands_json(report.many_hands); },
      [&] { return many_hands_text(report.many_hands); });
  add(
      report.base, [&] { return comparison_json(report.rows, report.base); },
      [&] { return comparison_text(report.rows, report.base); });
  return out;
}

int bench_scale(const ScaleWords& words, const std::string& command,
                const tools::Console& console) {
  const ScalePlan plan = read_scale_plan(words);
  if (plan.share) {
    run_host_share(plan.settings.front(), *plan.share, console);
    return tools::exit_status(tools::ExitCode::good);
  }
  tools::check_writable(words.report);
  ScaleReport report;
  report.command = command;
  report.circumstances = circumstances();
  if (!words.compare.empty()) {
    report.base = read_scale_rows(words.compare);
    check_same_exercises(plan.settings, report.base, words.compare);
  }
  const bool whole = run_all(plan, words, report, console);
  predict(report.whole);
  if (!whole) report.base.clear();  // missing rows are no difference
  const std::string out = scale_findings(report, words.json, words.wide);
  if (!whole)
    fmt::print(
        console.err, "stopped{}\n",
        out.empty() ? " before the first run was complete" : ": only completed runs are reported");
  fmt::print(console.out, "{}", out);
  if (!out.empty()) tools::write_output(words.report, scale_page(report), console);
  const bool differs = !changes_of(report.rows, report.base).empty();
  return tools::exit_status(differs ? tools::ExitCode::findings : tools::ExitCode::good);
}

}  // namespace reckon::bench
