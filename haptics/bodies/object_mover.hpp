// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Whatever moves objects of a scene besides hands and their own weight: a function of time, or the
// peer that owns them.
#pragma once

#include <chrono>
#include <cstdint>

#include "reckon/haptics/scene/effect_plan.hpp"

namespace reckon::haptics {

/// Where carried objects are. Servo thread; no lock, no allocation.
class ObjectMover {
 public:
  ObjectMover() = default;
  ObjectMover(const ObjectMover&) = delete;
  ObjectMover& operator=(const ObjectMover&) = delete;
  virtual ~ObjectMover() = default;

  /// @param object its number in the plan  @param now clock of the servo
  /// @return its pose as the scene has it, S, with the velocity of its origin
  [[nodiscard]] virtual ObjectMotion motion_of(std::uint32_t object,
                                               std::chrono::nanoseconds now) noexcept = 0;
};

}  // namespace reckon::haptics
