// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Source of motion for carried objects of a scene: a function of time, or the peer that owns them.
#pragma once

#include <chrono>
#include <cstdint>

#include "reckon/haptics/scene/effect_plan.hpp"

namespace reckon::haptics {

/// Motion of carried objects. Servo thread; no lock, no allocation.
class ObjectMover {
 public:
  ObjectMover() = default;
  ObjectMover(const ObjectMover&) = delete;
  ObjectMover& operator=(const ObjectMover&) = delete;
  virtual ~ObjectMover() = default;

  /// @param object index in the plan @param now clock of the servo
  /// @return its pose in the scene, S, with the velocity of its origin
  [[nodiscard]] virtual ObjectMotion motion_of(std::uint32_t object,
                                               std::chrono::nanoseconds now) noexcept = 0;
  /// This peer no longer owns a body: it stands at `motion` until its new owner's motion is known.
  virtual void leave_at(std::uint32_t object, const ObjectMotion& motion) noexcept {
    static_cast<void>(object);
    static_cast<void>(motion);
  }
};

}  // namespace reckon::haptics
