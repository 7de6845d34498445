// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Cause of an entity's update and its difference from the prediction, as far as they follow from
// this update and the one before.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

#include "reckon/deadreckon/motion/kinematic_state.hpp"
#include "reckon/tools/listener/received_entity.hpp"
#include "reckon/tools/listener/update_pace.hpp"

namespace reckon::tools {

/// Cause of an update: the first that applies.
enum class UpdateCause : std::uint8_t {
  none,       ///< no update yet
  first,      ///< the entity was unknown, or silent past its time-out
  event,      ///< force, type, appearance, marking, capabilities or dead reckoning model changed
  threshold,  ///< the pose differs from the extrapolation of the update before
  force,      ///< the force model changed
  heartbeat,  ///< about a heartbeat after the update before
  repeat      ///< nothing new, and earlier than the heartbeat
};
inline constexpr std::size_t kUpdateCauses = 7;
[[nodiscard]] std::string_view name(UpdateCause cause) noexcept;

/// Difference of an update from the extrapolation of the one before.
struct Innovation {
  double jump = 0;  ///< [m]
  double turn = 0;  ///< [rad]
  bool above_noise = false;
};

[[nodiscard]] Innovation innovation(const deadreckon::KinematicState& before,
                                    const deadreckon::KinematicState& now,
                                    const Interval& between) noexcept;

/// Whether a field changed that is sent at once, independent of motion.
[[nodiscard]] bool is_event(const FixedOctets& before, const FixedOctets& now) noexcept;

/// Threshold, heartbeat or repeat. An update near the heartbeat [s] counts as a heartbeat unless
/// its jump reaches the least jump of earlier threshold updates: `least_early_jump` [m], 0 before
/// any; maintained by this function.
[[nodiscard]] UpdateCause cause_of(const Innovation& found, double interval, double heartbeat,
                                   double& least_early_jump) noexcept;

}  // namespace reckon::tools
