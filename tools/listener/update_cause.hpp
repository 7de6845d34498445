// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Why an entity's update was sent and how far it was off the prediction, as far as a listener can
// tell from this update and the one before.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

#include "reckon/deadreckon/motion/kinematic_state.hpp"
#include "reckon/tools/listener/received_entity.hpp"
#include "reckon/tools/listener/update_pace.hpp"

namespace reckon::tools {

/// Why an update was sent: the first that holds.
enum class UpdateCause : std::uint8_t {
  none,       ///< no update yet
  first,      ///< the entity was not known, or had been silent past its time-out
  event,      ///< force, type, appearance, marking, capabilities or dead reckoning model changed
  threshold,  ///< the pose is off the extrapolation of the update before
  force,      ///< the force model changed
  heartbeat,  ///< about a heartbeat after the update before
  repeat      ///< nothing new, and sooner than the heartbeat
};
inline constexpr std::size_t kUpdateCauses = 7;
[[nodiscard]] std::string_view name(UpdateCause cause) noexcept;

/// How far an update was off the extrapolation of the one before.
struct Innovation {
  double jump = 0;  ///< [m]
  double turn = 0;  ///< [rad]
  bool above_noise = false;
};

[[nodiscard]] Innovation innovation(const deadreckon::KinematicState& before,
                                    const deadreckon::KinematicState& now,
                                    const Interval& between) noexcept;

/// Whether something changed that is sent at once, whatever the motion.
[[nodiscard]] bool is_event(const FixedOctets& before, const FixedOctets& now) noexcept;

/// Threshold, heartbeat or repeat. What comes near the heartbeat [s] counts as such unless it is
/// off by more than what came before its time: `least_early_jump` [m], 0 before any, which it
/// keeps.
[[nodiscard]] UpdateCause cause_of(const Innovation& found, double interval, double heartbeat,
                                   double& least_early_jump) noexcept;

}  // namespace reckon::tools
