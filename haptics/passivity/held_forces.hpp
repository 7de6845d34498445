// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The forces written to a device, and the one at the handle. A device with a delay holds in each
// sample a force that was written some samples before.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <utility>
#include <vector>

#include "reckon/haptics/passivity/split.hpp"

namespace reckon::haptics {

/// A queue of `delay` forces that advances at each write. One thread; O(1), except under_way(),
/// which is O(delay); allocates only at construction.
template <int axes>
class HeldForcesOf {
 public:
  using Force = AxisForces<axes>;

  /// @param delay [samples] >= 0, from a write to the force at the handle
  explicit HeldForcesOf(int delay) : under_way_(static_cast<std::size_t>(delay), kNone) {}

  /// Writes `force` [N]; the oldest pending force reaches the handle.
  void write(const Force& force) noexcept {
    at_handle_ = force;
    if (under_way_.empty()) return;
    std::swap(at_handle_, under_way_[next_]);
    next_ = next_ + 1 == under_way_.size() ? 0 : next_ + 1;
  }
  /// The device dropped all forces by itself.
  void drop() noexcept {
    at_handle_ = kNone;
    for (Force& force : under_way_) force = kNone;
  }

  [[nodiscard]] int delay() const noexcept { return static_cast<int>(under_way_.size()); }
  [[nodiscard]] const Force& at_handle() const noexcept { return at_handle_; }
  /// The pending forces, each minus `walls` [N].
  [[nodiscard]] UnderWayOf<axes> under_way(const Force& walls) const noexcept {
    UnderWayOf<axes> out;
    out.count = static_cast<double>(under_way_.size());
    for (const Force& force : under_way_) {
      out.sum += force - walls;
      out.squares += (force - walls).squaredNorm();
    }
    return out;
  }

 private:
  inline static const Force kNone = Force::Zero();

  Force at_handle_ = kNone;
  std::vector<Force> under_way_;  // a ring buffer, the oldest force at next_
  std::size_t next_ = 0;
};

using HeldForces = HeldForcesOf<3>;

}  // namespace reckon::haptics
