// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Detects a solid between two hands: then they do not touch each other.
#pragma once

#include <Eigen/Core>
#include <span>

#include "reckon/haptics/bodies/body_world.hpp"
#include "reckon/haptics/scene/effect_plan.hpp"

namespace reckon::haptics {

/// A solid separates two proxies if the segment between them is deeper inside it than a limit: 2
/// mm, or a tenth of the length inside plus twice the depth of the deeper proxy, whichever is less.
/// So two fingers side by side on a ball still touch. Hysteresis avoids chatter along an edge: once
/// separated, they stay so down to half the limit. Open meshes have no inside and separate nothing.
///
/// Each body far from both costs a few comparisons; static objects cost a search of the plan's
/// tree. No allocation; tens of ns for a solid near both, microseconds for a mesh.
/// @param bodies present states of the plan's moving objects @param from, to [m], S
/// @param apart result of the last call
[[nodiscard]] bool is_between_hands(const EffectPlan& plan, std::span<const BodyState> bodies,
                                    const Eigen::Vector3d& from, const Eigen::Vector3d& to,
                                    bool apart) noexcept;

}  // namespace reckon::haptics
