// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/bench/studies/stability/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <span>

#include "reckon/bench/statistics/quantile.hpp"
#include "reckon/bench/studies/frame/fields.hpp"
#include "reckon/bench/studies/pose/study_text.hpp"
#include "reckon/tools/terminal/text_end.hpp"
#include "reckon/tools/terminal/text_table.hpp"

namespace reckon::bench {
namespace {

/// The list of numbers of a result, with their names in files and tables.
struct Measure {
  std::string_view name;
  double StabilityResult::*member;
};
constexpr std::array kResultMeasures{Measure{"least_energy_J", &StabilityResult::least_energy},
                                     Measure{"peak_force_N", &StabilityResult::peak_force},
                                     Measure{"rms_speed_m_s", &StabilityResult::rms_speed},
                                     Measure{"amplitude_m", &StabilityResult::amplitude},
                                     Measure{"error_rms_N", &StabilityResult::error_rms},
                                     Measure{"error_p95_N", &StabilityResult::error_p95},
                                     Measure{"truth_rms_N", &StabilityResult::truth_rms},
                                     Measure{"truth_p95_N", &StabilityResult::truth_p95},
                                     Measure{"stiffness_kept", &StabilityResult::kept}};

double share(std::size_t part, std::size_t all) {
  return all == 0 ? 0 : static_cast<double>(part) / static_cast<double>(all);
}

std::string percent(const std::optional<double>& value) {
  if (!value) return "-";
  return *value > 0 && *value < 0.001 ? "< 0.1 %" : fmt::format("{:.1f} %", 100 * *value);
}

StabilitySummary summary_of(const StabilityReport& report, std::size_t mode) {
  const StabilityPlan& plan = report.plan;
  StabilitySummary summary;
  summary.mode = plan.mode_name(plan.modes[mode]);
  summary.cells = plan.cells();
  std::size_t energy = 0, away = 0, peaks = 0, should_rest = 0, cycles = 0, felt = 0, wrong = 0,
              right = 0;
  std::vector<double> kept;
  for (std::size_t cell = 0; cell < summary.cells; ++cell) {
    const StabilityResult& result = report.results[mode * summary.cells + cell];
    const StabilitySetting setting = plan.setting(cell);
    const StabilityVerdict verdict = verdict_of(setting, result);
    energy += result.diverged || !(result.least_energy >= kMadeEnergy);
    away += result.diverged;
    peaks += !(result.peak_force <= plan.peak);
    if (comes_to_rest(setting)) {
      ++should_rest;
      cycles += result.diverged || !(result.rms_speed <= kRest);
    }
    if (const auto off = force_off(result)) {
      ++felt;
      wrong += !(*off <= kWrong);
    }
    right += verdict == StabilityVerdict::right;
    if (result.diverged) continue;
    summary.least_energy = std::min(summary.least_energy, result.least_energy);
    kept.push_back(result.kept);
  }
  summary.made_energy = share(energy, summary.cells);
  summary.diverged = share(away, summary.cells);
  summary.peak = share(peaks, summary.cells);
  if (should_rest > 0) summary.cycles = share(cycles, should_rest);
  if (felt > 0) summary.wrong = share(wrong, felt);
  summary.right = share(right, summary.cells);
  if (!kept.empty()) summary.kept = median(kept);
  return summary;
}

std::optional<double> number_of(std::string_view text) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

Fields run_fields(const StabilityPlan& plan, std::size_t run, const StabilityResult& result) {
  const std::size_t cell = plan.cell_of(run);
  Fields fields("cell"), axes;
  fields.csv("run", run).value("mode", plan.mode_name(plan.mode_of(run))).json("cell", cell);
  for (std::size_t i = 0; i < plan.axes.size(); ++i) {
    const auto& [parameter, values] = plan.axes[i];
    const double number = values[plan.place(cell, i)];
    const Value value =
        parameter->words.empty() ? Value(number) : Value(value_text(*parameter, number));
    axes.json(parameter->name, value);
    fields.csv(parameter->name, value);
  }
  fields.json("axes", axes);
  for (const Measure& measure : kResultMeasures) fields.value(measure.name, result.*measure.member);
  return fields.value("diverged", result.diverged);
}

Fields summary_fields(const StabilitySummary& row, const StabilityPlan& plan) {
  Fields fields("mode");
  fields.json("mode", row.mode)
      .json("cells", row.cells)
      .word("MODE", row.mode)
      .page_word("mode", fmt::format("<a href=\"#{0}\">{0}</a>", row.mode));
  const auto share = [&](std::string_view name, std::string title, std::string_view page_title,
                         const std::optional<double>& value) {
    fields.json(name, value)
        .shown(std::move(title), page_title, value.value_or(-1), percent(value));
  };
  share("right", "RIGHT", "right", row.right);
  share("made_energy", "MAKES ENERGY", "makes energy", row.made_energy);
  share("diverged", "RUNS AWAY", "runs away", row.diverged);
  fields.json("peak_above", plan.peak);
  share("peak", fmt::format("PEAK > {:g} N", plan.peak), fmt::format("peak &gt; {:g} N", plan.peak),
        row.peak);
  share("no_rest", "NO REST", "no rest", row.cycles);
  share("force_off", "FORCE OFF", "force off", row.wrong);
  return fields.json("stiffness_kept", row.kept)
      .json("worst_energy_J", row.least_energy)
      .json("gate", plan.gate)
      .shown("KEPT", "stiffness kept", row.kept.value_or(-1),
             row.kept ? number_text(*row.kept) : "-")
      .shown("WORST [J]", "worst energy [J]", row.least_energy, number_text(row.least_energy));
}

/// The fields of a mode, for a study with this plan.
auto fields_in(const StabilityPlan& plan) {
  return [&plan](const StabilitySummary& row) { return summary_fields(row, plan); };
}

}  // namespace

std::vector<StabilitySummary> summaries_of(const StabilityReport& report) {
  std::vector<StabilitySummary> summaries;
  for (std::size_t mode = 0; mode < report.plan.modes.size(); ++mode)
    summaries.push_back(summary_of(report, mode));
  return summaries;
}

std::string_view gate_warning(const StabilityPlan& plan) {
  return plan.gate ? ""
                   : "THE GATE IS OFF in this study: the mode reckon holds any requested force and "
                     "may generate energy. Only simulated devices run like this.";
}

std::string stability_text(const StabilityReport& report) {
  std::string out;
  if (!report.plan.gate) fmt::format_to(tools::end_of(out), "{}\n\n", gate_warning(report.plan));
  for (const std::string& note : report.notes)
    fmt::format_to(tools::end_of(out), "note: {}\n", note);
  fmt::format_to(tools::end_of(out), "{} of {:g} s each, in {}\n{}",
                 tools::counted(report.plan.cells(), "cell"), report.plan.base.run.duration,
                 tools::counted(report.plan.modes.size(), "mode"),
                 table_of(summaries_of(report), fields_in(report.plan)));
  out += fmt::format(
      "\nRIGHT: no energy generated, at rest when expected, force error at most {:g} % (rms, of "
      "the correct\nforce). MAKES ENERGY: more than 1 nJ generated. RUNS AWAY: beyond 10 m or 1 "
      "MN. NO REST: moves at more\nthan {:g} m/s under a constant push against a fixed environment "
      "(-: not applicable). FORCE OFF: by more\nthan that, of runs that did not run away. KEPT: "
      "share of the stiffness, median. WORST: energy, of runs\nthat did not run away.\n",
      100 * kWrong, kRest);
  return out;
}

std::string stability_columns(const StabilityPlan& plan) {
  return run_fields(plan, 0, {}).csv_names();
}

std::string stability_row(const StabilityPlan& plan, std::size_t run,
                          const StabilityResult& result) {
  return run_fields(plan, run, result).csv_values();
}

std::optional<std::pair<std::size_t, StabilityResult>> read_stability_row(const StabilityPlan& plan,
                                                                          std::string_view line) {
  const auto fields = parts_between_commas(line);
  if (fields.size() != plan.axes.size() + kResultMeasures.size() + 3) return std::nullopt;
  const auto number = number_of(fields[0]);
  if (!number || !(*number >= 0 && *number < static_cast<double>(plan.runs()))) return std::nullopt;
  const auto run = static_cast<std::size_t>(*number);
  StabilityResult result;
  std::size_t place = plan.axes.size() + 2;  // after number, mode and axes
  const std::string own = stability_row(plan, run, result);
  const auto own_fields = parts_between_commas(own);
  if (!std::ranges::equal(std::span(fields).first(place), std::span(own_fields).first(place)))
    return std::nullopt;
  for (const Measure& measure : kResultMeasures) {
    const auto value = number_of(fields[place++]);
    if (!value) return std::nullopt;
    result.*measure.member = *value;
  }
  if (fields[place] != "0" && fields[place] != "1") return std::nullopt;
  result.diverged = fields[place] == "1";
  return std::pair{run, result};
}

std::string stability_page_table(const StabilityReport& report) {
  return page_table_of(summaries_of(report), fields_in(report.plan));
}

std::string stability_json(const StabilityReport& report) {
  const StabilityPlan& plan = report.plan;
  std::string out;
  for (std::size_t run = 0; run < report.results.size(); ++run) {
    const StabilityResult& result = report.results[run];
    out += run_fields(plan, run, result)
               .json("force_off", force_off(result))
               .json("verdict", name_of(verdict_of(plan.setting(plan.cell_of(run)), result)))
               .object() +
           '\n';
  }
  return out + json_of(summaries_of(report), fields_in(plan));
}

}  // namespace reckon::bench
