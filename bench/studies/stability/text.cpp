// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/bench/studies/stability/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "reckon/bench/statistics/quantile.hpp"
#include "reckon/bench/studies/pose/study_text.hpp"
#include "reckon/tools/terminal/json_text.hpp"
#include "reckon/tools/terminal/text_end.hpp"
#include "reckon/tools/terminal/text_table.hpp"

namespace reckon::bench {
namespace {

/// THE numbers of a result, as files and tables name them.
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

/// An axis value in SI, a word as it is.
std::string plain_value(const StabilityParameter& parameter, double value) {
  return parameter.words.empty() ? fmt::format("{}", value) : value_text(parameter, value);
}

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

/// Mode and axes of a run, as they stand in its line.
std::string place_text(const StabilityPlan& plan, std::size_t run) {
  std::string out = fmt::format("{},{}", run, plan.mode_name(plan.mode_of(run)));
  for (std::size_t axis = 0; axis < plan.axes.size(); ++axis) {
    const StabilityAxis& row = plan.axes[axis];
    out += "," + plain_value(*row.parameter, row.values[plan.place(plan.cell_of(run), axis)]);
  }
  return out;
}

void append_run(std::string& out, const StabilityReport& report, std::size_t run) {
  const StabilityPlan& plan = report.plan;
  const StabilityResult& result = report.results[run];
  tools::JsonObject object(out);
  object.text("kind", "cell").text("mode", plan.mode_name(plan.mode_of(run)));
  object.value("cell", plan.cell_of(run));
  tools::JsonObject inner(object.member("axes"));
  for (std::size_t axis = 0; axis < plan.axes.size(); ++axis) {
    const StabilityAxis& row = plan.axes[axis];
    const double value = row.values[plan.place(plan.cell_of(run), axis)];
    if (row.parameter->words.empty())
      inner.value(row.parameter->name, value);
    else
      inner.text(row.parameter->name, value_text(*row.parameter, value));
  }
  inner.end();
  for (const Measure& measure : kResultMeasures)
    object.number(measure.name, result.*measure.member);
  object.value("diverged", result.diverged)
      .number("force_off", force_off(result))
      .text("verdict", name_of(verdict_of(plan.setting(plan.cell_of(run)), result)))
      .end("\n");
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
                   : "THE GATE IS OFF in this study: the mode reckon holds whatever is wanted and "
                     "may make energy. No device but a simulated one runs so.";
}

std::string stability_text(const StabilityReport& report) {
  constexpr auto kRight = tools::TextTable::Align::right;
  tools::TextTable table({{"MODE"},
                          {"RIGHT", kRight},
                          {"MAKES ENERGY", kRight},
                          {"RUNS AWAY", kRight},
                          {fmt::format("PEAK > {:g} N", report.plan.peak), kRight},
                          {"NO REST", kRight},
                          {"FORCE OFF", kRight},
                          {"KEPT", kRight},
                          {"WORST [J]", kRight}});
  for (const StabilitySummary& row : summaries_of(report))
    table.add({row.mode, percent(row.right), percent(row.made_energy), percent(row.diverged),
               percent(row.peak), percent(row.cycles), percent(row.wrong),
               row.kept ? number_text(*row.kept) : "-", number_text(row.least_energy)});
  std::string out;
  if (!report.plan.gate) fmt::format_to(tools::end_of(out), "{}\n\n", gate_warning(report.plan));
  for (const std::string& note : report.notes)
    fmt::format_to(tools::end_of(out), "note: {}\n", note);
  fmt::format_to(tools::end_of(out), "{} of {:g} s each, in {}\n{}",
                 tools::counted(report.plan.cells(), "cell"), report.plan.base.run.duration,
                 tools::counted(report.plan.modes.size(), "mode"), table.text());
  out += fmt::format(
      "\nRIGHT: no energy made, at rest where it should be, force off by {:g} % at most (rms, of "
      "the "
      "right\nforce's). MAKES ENERGY: more than 1 nJ that nobody put in. RUNS AWAY: beyond 10 m or "
      "1 MN. NO REST:\nmoves on at more than {:g} m/s under a constant push against what stands "
      "still (- where no cell is so).\nFORCE OFF: by more than that, of those that did not run "
      "away. KEPT: share of the stiffness, median.\nWORST: energy, of those that did not run "
      "away.\n",
      100 * kWrong, kRest);
  return out;
}

std::string stability_columns(const StabilityPlan& plan) {
  std::string out = "run,mode";
  for (const StabilityAxis& axis : plan.axes)
    fmt::format_to(tools::end_of(out), ",{}", axis.parameter->name);
  for (const Measure& measure : kResultMeasures)
    fmt::format_to(tools::end_of(out), ",{}", measure.name);
  return out + ",diverged";
}

std::string stability_row(const StabilityPlan& plan, std::size_t run,
                          const StabilityResult& result) {
  std::string out = place_text(plan, run);
  for (const Measure& measure : kResultMeasures)
    fmt::format_to(tools::end_of(out), ",{}", result.*measure.member);
  return out + (result.diverged ? ",1" : ",0");
}

std::optional<std::pair<std::size_t, StabilityResult>> read_stability_row(const StabilityPlan& plan,
                                                                          std::string_view line) {
  const auto fields = parts_between_commas(line);
  if (fields.size() != plan.axes.size() + kResultMeasures.size() + 3) return std::nullopt;
  const auto number = number_of(fields[0]);
  if (!number || !(*number >= 0 && *number < static_cast<double>(plan.runs()))) return std::nullopt;
  const auto run = static_cast<std::size_t>(*number);
  if (!line.starts_with(place_text(plan, run) + ",")) return std::nullopt;
  StabilityResult result;
  std::size_t place = plan.axes.size() + 2;
  for (const Measure& measure : kResultMeasures) {
    const auto value = number_of(fields[place++]);
    if (!value) return std::nullopt;
    result.*measure.member = *value;
  }
  if (fields[place] != "0" && fields[place] != "1") return std::nullopt;
  result.diverged = fields[place] == "1";
  return std::pair{run, result};
}

std::string stability_json(const StabilityReport& report) {
  std::string out;
  for (std::size_t run = 0; run < report.results.size(); ++run) append_run(out, report, run);
  for (const StabilitySummary& row : summaries_of(report)) {
    tools::JsonObject object(out);
    object.text("kind", "mode")
        .text("mode", row.mode)
        .value("cells", row.cells)
        .value("right", row.right)
        .value("made_energy", row.made_energy)
        .value("diverged", row.diverged)
        .value("peak_above", report.plan.peak)
        .value("peak", row.peak)
        .number("no_rest", row.cycles)
        .number("force_off", row.wrong)
        .number("stiffness_kept", row.kept)
        .number("worst_energy_J", row.least_energy)
        .value("gate", report.plan.gate)
        .end("\n");
  }
  return out;
}

}  // namespace reckon::bench
