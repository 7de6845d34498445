// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// What an event device says of itself, and whether it can be used.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "reckon/haptics/evdev/condition_effect.hpp"
#include "reckon/haptics/evdev/event_calls.hpp"
#include "reckon/haptics/evdev/event_state.hpp"

namespace reckon::haptics {

/// Of a device that was opened.
struct EventFacts {
  std::string name;  ///< of the product
  /// ABS_X and ABS_Y; none: it has no such axis.
  std::array<std::optional<EventAxis>, EventState::kAxes> axes{};
  std::vector<std::uint16_t> buttons;  ///< codes, ascending
  bool has_springs = false, has_constant_forces = false;
  bool has_gain = false, has_autocenter = false;
  int most_effects = 0;  ///< at once
  std::string fault;     ///< what else keeps it from being used, as a sentence
};

/// @return nothing where it gives no force feedback, or does not answer
[[nodiscard]] std::optional<EventFacts> event_facts(EventCalls& calls, int file);

/// Why `axes` of it, 1 or 2, cannot be driven: a sentence; empty: they can.
[[nodiscard]] std::string fault_of(const EventFacts& facts, int axes);

/// Where all axes and buttons are now. @return whether it answers
[[nodiscard]] bool ask_state(EventCalls& calls, int file, EventState& state) noexcept;

/// A device of this host with force feedback.
struct EventDeviceSeen {
  std::string path;
  EventFacts facts;     ///< where it does not open, of its name alone
  std::string remedy;   ///< not empty: this user may not open it
  std::string problem;  ///< another reason why it does not open
};

/// Opens each event device of this host, and closes it again. No force is asked for.
[[nodiscard]] std::vector<EventDeviceSeen> event_devices(EventCalls& calls);

}  // namespace reckon::haptics
