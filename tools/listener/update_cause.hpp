// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Why an entity's update was sent and how far it was off the prediction, as far as a listener can
// tell from this update and the one before.
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "reckon/deadreckon/motion/kinematic_state.hpp"

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

/// An Entity State PDU without its variable parameters.
inline constexpr std::size_t kFixedOctets = 144;
using FixedOctets = std::array<std::byte, kFixedOctets>;

/// An update as it is remembered until the next one.
struct LastUpdate {
  FixedOctets octets{};  ///< length 144, no variable parameters
  std::chrono::nanoseconds arrival{};
  deadreckon::KinematicState state;  ///< geocentric
  double heartbeat = 0;              ///< of the entity's kind [s]
  double least_early_jump = 0;       ///< of those before their heartbeat [m]; 0: none yet
  double told_time = 0;              ///< passed by timestamps, where they went forward [s]
  double arrival_time = 0;           ///< and by arrivals meanwhile [s]
  std::uint8_t late_in_a_row = 0;    ///< timestamps in a row that lay before
};

/// Time between two updates.
struct Interval {
  double seconds = 0;
  double noise = 0;        ///< [s]
  bool late = false;       ///< overtaken by the one before: not to be used
  bool duplicate = false;  ///< a copy of the one before
  bool set_back = false;   ///< the sender's clock was set back: nothing to compare
};

/// By timestamps where they run at about the pace of the arrivals (up to 100 times faster, as a
/// replay does, 4 times slower), else by arrivals.
[[nodiscard]] Interval interval(const LastUpdate& last, const FixedOctets& octets,
                                std::chrono::nanoseconds arrival) noexcept;

/// Time that timestamps say has passed [s], never negative.
[[nodiscard]] double told_seconds(const LastUpdate& last, const FixedOctets& octets) noexcept;

/// How far an update was off the extrapolation of the one before.
struct Innovation {
  double jump = 0;  ///< [m]
  double turn = 0;  ///< [rad]
  bool above_noise = false;
};

[[nodiscard]] Innovation innovation(const deadreckon::KinematicState& before,
                                    const deadreckon::KinematicState& now,
                                    const Interval& between) noexcept;

/// Whether something changed that is told at once, whatever the motion.
[[nodiscard]] bool is_event(const FixedOctets& before, const FixedOctets& now) noexcept;

/// Threshold, heartbeat or repeat. What comes near the heartbeat counts as such unless it is off by
/// more than what came before its time; keeps that in `last`.
[[nodiscard]] UpdateCause cause_of(LastUpdate& last, const Innovation& found,
                                   double interval) noexcept;

}  // namespace reckon::tools
