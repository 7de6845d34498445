// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// One step of the force loop: read, predict, contact, gate, safety, write, publish. A thread of its
// own calls step() every period; tests call it by hand.
#pragma once

#include <array>
#include <chrono>
#include <cstdint>

#include "haptics/contact_solver.hpp"
#include "haptics/effect_plan.hpp"
#include "haptics/haptic_device.hpp"
#include "haptics/motion_filter.hpp"
#include "haptics/remote_contact.hpp"
#include "haptics/safety.hpp"
#include "haptics/servo_types.hpp"
#include "haptics/static_contact.hpp"
#include "haptics/triple_buffer.hpp"

namespace reckon::haptics {

/// The servo of one device. Reads the newest ContactSet, writes a ServoSnapshot every step.
class ServoLoop {
 public:
  /// @param device outlives the loop; its limits are read once, here.
  /// @throws std::invalid_argument when a setting is out of range; the text says which.
  ServoLoop(HapticDevice& device, EffectPlan plan, const ServoConfig& config);

  ServoLoop(const ServoLoop&) = delete;
  ServoLoop& operator=(const ServoLoop&) = delete;

  /// One servo period. @param now steady, never decreasing. Servo thread only; no allocation, no
  /// lock, no clock.
  void step(std::chrono::nanoseconds now) noexcept;

  /// The model loop writes the remote hands here.
  [[nodiscard]] TripleBuffer<ContactSet>& contacts() noexcept { return contacts_; }
  /// The model loop reads the outcome here.
  [[nodiscard]] TripleBuffer<ServoSnapshot>& snapshots() noexcept { return snapshots_; }

  /// Records every step from now on; nullptr stops. Call while the servo stands still.
  void trace(TraceRing* ring) noexcept { trace_ = ring; }
};

}  // namespace reckon::haptics
