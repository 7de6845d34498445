// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Whether a solid lies between two hands: then they do not touch one another.
#pragma once

#include <Eigen/Core>
#include <span>

#include "reckon/haptics/bodies/body_world.hpp"
#include "reckon/haptics/scene/effect_plan.hpp"

namespace reckon::haptics {

/// A solid cuts the segment between two proxies if the segment is within it deeper than 2 mm, or
/// than a tenth of the length inside plus twice the depth of the deeper proxy if that is less. So
/// two fingers side by side on a ball still touch, and a finger that slides along an edge does not
/// come and go: once apart, they stay so down to half of that. Open meshes have no inside and cut
/// nothing.
///
/// Bodies far from both cost a few comparisons each, all else its place in the plan's tree. No
/// allocation; tens of ns a solid near both, microseconds a mesh.
/// @param bodies where those of the plan's objects that move are now  @param from, to [m], S
/// @param apart whether they were in the call before
[[nodiscard]] bool is_between_hands(const EffectPlan& plan, std::span<const BodyState> bodies,
                                    const Eigen::Vector3d& from, const Eigen::Vector3d& to,
                                    bool apart) noexcept;

}  // namespace reckon::haptics
