// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Reads the capabilities of an event device and checks whether it can render walls.
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

/// Capabilities of an open device.
struct EventFacts {
  std::string name;  ///< product name
  /// ABS_X and ABS_Y; std::nullopt: it has no such axis.
  std::array<std::optional<EventAxis>, EventState::kAxes> axes{};
  std::vector<std::uint16_t> buttons;  ///< key codes, ascending
  bool has_springs = false, has_constant_forces = false;
  bool has_gain = false, has_autocenter = false;
  int most_effects = 0;  ///< that it holds at once
  std::string fault;     ///< another reason why it cannot be used, as a sentence
};

/// @return std::nullopt: no force feedback, or no answer
[[nodiscard]] std::optional<EventFacts> event_facts(EventCalls& calls, int file);

/// Why the first `axes` (1 or 2) axes cannot be driven, as a sentence; empty: they can.
[[nodiscard]] std::string fault_of(const EventFacts& facts, int axes);

/// Reads the present state of all axes and buttons. @return whether the device answers
[[nodiscard]] bool ask_state(EventCalls& calls, int file, EventState& state) noexcept;

/// A device of this host with force feedback.
struct EventDeviceSeen {
  std::string path;
  EventFacts facts;     ///< only the name if it cannot be opened
  std::string remedy;   ///< not empty: the user lacks permission to open it
  std::string problem;  ///< another reason why it cannot be opened
};

/// Opens and closes each event device of this host. Renders no force.
[[nodiscard]] std::vector<EventDeviceSeen> event_devices(EventCalls& calls);

}  // namespace reckon::haptics
