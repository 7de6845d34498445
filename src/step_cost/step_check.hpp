// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Finds scenes whose servo steps this host cannot make in time.
#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <vector>

#include "reckon/haptics/scene/effect_plan.hpp"
#include "reckon/peer/step_cost/stage_costs.hpp"
#include "reckon/peer/step_cost/step_too_dear.hpp"

namespace reckon::peer {

/// "a servo step that touches stone takes 2.3 ms of this host and has 1 ms (dearest: contact 2.1
/// ms, ..)" with the object's three dearest stages.
[[nodiscard]] std::string too_dear_sentence(const DearestStep& step,
                                            std::chrono::nanoseconds period,
                                            const std::vector<haptics::PlanStage>& stages,
                                            const std::vector<double>& costs);

/// Measures the dearest step, and its stages only if it takes longer than the period. Set-up code:
/// takes some ms if the scene has meshes or solids of parts, else nothing.
/// @param radius of the probe [m]
[[nodiscard]] std::optional<StepTooDear> find_step_too_dear(const haptics::Scene& scene,
                                                            const haptics::EffectPlan& plan,
                                                            double radius,
                                                            std::chrono::nanoseconds period);

}  // namespace reckon::peer
