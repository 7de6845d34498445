// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/step_cost/step_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <numeric>

#include "reckon/pdu/seconds.hpp"

namespace reckon::peer {
namespace {

constexpr std::size_t kNamedStages = 3;

std::string milliseconds_text(double seconds) { return fmt::format("{:.2g} ms", 1e3 * seconds); }

}  // namespace

std::string too_dear_sentence(const DearestStep& step, std::chrono::nanoseconds period,
                              const std::vector<haptics::PlanStage>& stages,
                              const std::vector<double>& costs) {
  std::vector<std::size_t> order(stages.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, std::ranges::greater{}, [&](std::size_t i) { return costs[i]; });
  std::string dearest;
  for (const std::size_t i : order) {
    const bool counts = stages[i].object == step.object && costs[i] > 0.0;
    if (!counts) continue;
    dearest += fmt::format("{}{} {}", dearest.empty() ? "" : ", ", stages[i].name,
                           milliseconds_text(costs[i]));
    if (static_cast<std::size_t>(std::ranges::count(dearest, ',')) + 1 == kNamedStages) break;
  }
  return fmt::format(
      "a servo step that touches {} takes {} on this host, and its period is {} (costliest: {})",
      step.object, milliseconds_text(step.seconds), milliseconds_text(pdu::to_seconds(period)),
      dearest);
}

std::optional<StepTooDear> find_step_too_dear(const haptics::Scene& scene,
                                              const haptics::EffectPlan& plan, double radius,
                                              std::chrono::nanoseconds period) {
  const double most = pdu::to_seconds(period);
  const DearestStep step = measure_dearest_step(scene, plan, radius, 0.5 * most);
  if (!(step.seconds > most)) return std::nullopt;
  const StageCosts costs = measure_stages(scene, plan, radius);
  return StepTooDear(too_dear_sentence(step, period, plan.stages(), costs.stages), step.seconds,
                     period);
}

std::string bodies_too_dear_sentence(const BodyCosts& costs, std::chrono::nanoseconds period) {
  return fmt::format(
      "the servo steps of one period among {} moving bodies take {} at p99 on this host, and the "
      "period is {} ({} of {} periods are late; costliest: bodies)",
      costs.bodies, milliseconds_text(costs.p99), milliseconds_text(pdu::to_seconds(period)),
      costs.late, costs.steps);
}

std::optional<StepTooDear> find_bodies_too_dear(const SceneFile& scene, std::size_t hands,
                                                std::chrono::nanoseconds period, double pace) {
  const auto costs = measure_bodies(scene, hands, period, {1, 0.08, pace});
  if (!costs || !(costs->p99 > pdu::to_seconds(period))) return std::nullopt;
  return StepTooDear(bodies_too_dear_sentence(*costs, period), costs->p99, period);
}

}  // namespace reckon::peer
