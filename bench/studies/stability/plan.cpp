// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/bench/studies/stability/plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <stdexcept>

#include "reckon/pdu/random/split_mix.hpp"
#include "reckon/pdu/seconds.hpp"
#include "reckon/tools/command_line/console.hpp"

namespace reckon::bench {
namespace {

/// Uncorrelated seeds for neighbouring numbers.
std::uint64_t mixed(std::uint64_t seed, std::uint64_t number) {
  return pdu::mixed_bits(seed * pdu::kGoldenStep + number + 1);
}

bool has_axis(const StabilityPlan& plan, std::string_view name) {
  return std::ranges::any_of(
      plan.axes, [&](const StabilityAxis& axis) { return axis.parameter->name == name; });
}

/// The greatest value of a parameter in all settings.
double most_of(const StabilityPlan& plan, std::string_view name) {
  const StabilityParameter& parameter = stability_parameter(name);
  for (const StabilityAxis& axis : plan.axes)
    if (axis.parameter == &parameter) return std::ranges::max(axis.values);
  return parameter.get(plan.base);
}

bool takes(const StabilityPlan& plan, std::string_view name, double value) {
  const StabilityParameter& parameter = stability_parameter(name);
  for (const StabilityAxis& axis : plan.axes)
    if (axis.parameter == &parameter) return std::ranges::count(axis.values, value) > 0;
  return parameter.get(plan.base) == value;
}

void check_axes(const StabilityPlan& plan) {
  std::set<std::string_view> names;
  for (const StabilityAxis& axis : plan.axes)
    if (!names.insert(axis.parameter->name).second)
      throw tools::UsageError(fmt::format(
          "--sweep: {} is swept twice; write all of its values at once", axis.parameter->name));
  const auto needs = [&](std::string_view name, std::string_view other, std::string_view example) {
    if (has_axis(plan, name) && !(most_of(plan, other) > 0))
      throw tools::UsageError(
          fmt::format("--sweep: {} has no effect if {} is 0; sweep that too, as in --sweep {}",
                      name, other, example));
  };
  needs("jitter_share", "impairment.delay", "delay=50ms");
  needs("impairment.reorder_delay", "impairment.reorder", "reorder=10%");
  if (has_axis(plan, "jitter_share") && has_axis(plan, "impairment.jitter"))
    throw tools::UsageError(
        "--sweep: jitter_share and impairment.jitter set the same value; sweep one of them");
  const auto hand = static_cast<double>(Counterpart::hand);
  if (takes(plan, "counterpart", hand)) {
    for (const auto kind :
         {EnvironmentKind::hardening, EnvironmentKind::moving, EnvironmentKind::switching})
      if (takes(plan, "environment", static_cast<double>(kind)))
        throw tools::UsageError(
            "--sweep: two hands have a linear spring between them; remove counterpart=hand, or all "
            "environments except linear");
    if (has_axis(plan, "uplink_rate") &&
        !takes(plan, "counterpart", static_cast<double>(Counterpart::server)))
      throw tools::UsageError("--sweep: uplink_rate needs a server; remove counterpart=hand");
  }
  if (takes(plan, "operator", kRecordedOperator) && !plan.base.recorded)
    throw tools::UsageError("--sweep: operator=trace needs a recording; add --hand");
}

}  // namespace

std::size_t StabilityPlan::cells() const {
  std::size_t count = 1;
  for (const StabilityAxis& axis : axes) {
    count *= axis.values.size();
    if (count > kMostRuns) return count;
  }
  return count;
}

std::size_t StabilityPlan::place(std::size_t cell, std::size_t axis) const {
  for (std::size_t i = axes.size(); --i > axis;) cell /= axes[i].values.size();
  return cell % axes[axis].values.size();
}

StabilitySetting StabilityPlan::setting(std::size_t cell) const {
  StabilitySetting setting = base;
  for (std::size_t i = 0; i < axes.size(); ++i) {
    if (axes[i].parameter->name == "impairment.jitter") setting.jitter_share.reset();
    axes[i].parameter->set(setting, axes[i].values[place(cell, i)]);
  }
  CouplingRun& run = setting.run;
  if (setting.jitter_share)
    run.network.jitter =
        pdu::from_seconds(*setting.jitter_share * pdu::to_seconds(run.network.delay));
  run.environment = {setting.environment, setting.stiffness};
  run.hand = setting.operator_number == kRecordedOperator
                 ? setting.recorded.value()
                 : operator_model(static_cast<OperatorKind>(setting.operator_number));
  run.seed = mixed(seed, cell);
  run.gate = gate;
  return setting;
}

CouplingRun StabilityPlan::run(std::size_t number) const {
  CouplingRun run = setting(cell_of(number)).run;
  run.mode = mode_of(number);
  return run;
}

std::string StabilityPlan::mode_name(CouplingMode mode) const {
  std::string name(name_of(mode));
  return mode == CouplingMode::reckon && !gate ? name + "_no_gate" : name;
}

std::string StabilityPlan::text() const {
  std::string out = "modes=";
  for (const CouplingMode mode : modes)
    out += fmt::format("{}{}", mode == modes.front() ? "" : ",", mode_name(mode));
  for (const StabilityAxis& axis : axes) {
    out += fmt::format("; {}=", axis.parameter->name);
    for (std::size_t i = 0; i < axis.values.size(); ++i)
      out += (i == 0 ? "" : ",") + value_text(*axis.parameter, axis.values[i]);
  }
  for (const StabilityParameter& parameter : stability_parameters()) {
    const bool other_jitter =
        has_axis(*this, "jitter_share") || has_axis(*this, "impairment.jitter");
    const bool is_jitter =
        parameter.name == (base.jitter_share ? "impairment.jitter" : "jitter_share");
    if (has_axis(*this, parameter.name) || is_jitter ||
        (other_jitter && parameter.name.find("jitter") != parameter.name.npos))
      continue;
    out += fmt::format("; {}={}", parameter.name, value_text(parameter, parameter.get(base)));
  }
  if (!trace_file.empty()) out += fmt::format("; hand={}", trace_file);
  return out + fmt::format("; seed={}; for={:g} s", seed, base.run.duration);
}

std::vector<StabilityAxis> default_axes() {
  std::vector<StabilityAxis> axes;
  for (const std::string_view text :
       {"hand.k1=250,500,1000,1800", "impairment.delay=0,20,50,100,200ms", "impairment.loss=0,30%",
        "jitter_share=0,30%", "environment=all"})
    axes.push_back(read_stability_axis(text));
  return axes;
}

void check(const StabilityPlan& plan) {
  check_axes(plan);
  if (plan.runs() > kMostRuns)
    throw tools::UsageError(
        fmt::format("--sweep: {} or more cells in {} modes; reduce them to at most {} runs",
                    plan.cells(), plan.modes.size(), kMostRuns));
  // simulate() refuses an impossible run at once, so the shortest run is enough for this check.
  for (std::size_t cell = 0; cell < plan.cells(); ++cell) {
    CouplingRun run = plan.setting(cell).run;
    run.mode = plan.modes.front();
    if (run.duration > kMostCouplingSamples * run.device.period)
      throw tools::UsageError(
          fmt::format("--for: {} samples in a run exceed {}: shorten it, or lower device.rate",
                      std::ceil(run.duration / run.device.period), kMostCouplingSamples));
    run.duration = run.device.period;
    try {
      static_cast<void>(simulate(run));
    } catch (const std::invalid_argument& error) {
      throw tools::UsageError(fmt::format("--sweep: a cell is invalid: {}", error.what()));
    }
  }
}

}  // namespace reckon::bench
