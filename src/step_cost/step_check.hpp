// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Finds scenes whose servo steps this host cannot make in time.
#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <vector>

#include "reckon/haptics/scene/effect_plan.hpp"
#include "reckon/peer/step_cost/body_costs.hpp"
#include "reckon/peer/step_cost/stage_costs.hpp"
#include "reckon/peer/step_cost/step_too_dear.hpp"

namespace reckon::peer {

/// "a servo step that touches stone takes 2.3 ms on this host, and its period is 1 ms (costliest:
/// contact 2.1 ms, ..)" with the object's three dearest stages.
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

/// "the servo steps of one period among 64 moving bodies take 1.3 ms at p99 on this host, ..".
[[nodiscard]] std::string bodies_too_dear_sentence(const BodyCosts& costs,
                                                   std::chrono::nanoseconds period);

/// Measures steps with hands among the scene's moving bodies; too dear if the steps of one period
/// in a hundred take longer. Set-up code: takes some 80 ms in a scene with bodies, else nothing.
/// @param hands number of hands, > 0  @param pace see haptics::BodyWorld::set_pace()
[[nodiscard]] std::optional<StepTooDear> find_bodies_too_dear(const SceneFile& scene,
                                                              std::size_t hands,
                                                              std::chrono::nanoseconds period,
                                                              double pace);

}  // namespace reckon::peer
