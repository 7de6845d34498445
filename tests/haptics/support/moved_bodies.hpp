// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A mover of the bodies of other peers, as a test commands it.
#pragma once

#include <chrono>
#include <cstdint>
#include <map>

#include "reckon/haptics/bodies/object_mover.hpp"

namespace reckon::haptics::tables {

/// Bodies stand where they were left, until the test moves them.
class MovedBodies final : public ObjectMover {
 public:
  ObjectMotion motion_of(std::uint32_t object, std::chrono::nanoseconds) noexcept override {
    return at_[object];
  }
  void leave_at(std::uint32_t object, const ObjectMotion& motion) noexcept override {
    at_[object] = motion;
  }
  /// Reference to the motion of an object, by its index in the plan.
  [[nodiscard]] ObjectMotion& of(std::uint32_t object) { return at_[object]; }

 private:
  std::map<std::uint32_t, ObjectMotion> at_;
};

}  // namespace reckon::haptics::tables
