// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A place outside all objects of a plan, for a probe that begins inside some.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <limits>
#include <span>

#include "reckon/haptics/scene/effect_plan.hpp"

namespace reckon::haptics {

/// Search for such a place. Allocates nothing; looks at every object that moves.
class FreePlace {
 public:
  static constexpr std::uint32_t kNobody = std::numeric_limits<std::uint32_t>::max();

  /// @param plan, objects the same where they are now; both outlive this  @param radius [m], >= 0
  FreePlace(const EffectPlan& plan, std::span<const PlannedObject* const> objects, double radius)
      : plan_(plan), objects_(objects), radius_(radius) {}

  /// An object whose solid the probe overlaps at p [m, S]; kNobody if there is none.
  [[nodiscard]] std::uint32_t overlapped(const Eigen::Vector3d& p) const noexcept;
  /// Moves p out of one object after the other. @return whether that ended outside all
  [[nodiscard]] bool push_out(Eigen::Vector3d& p) const noexcept;
  /// The nearest place found along the axes and the diagonals, in growing steps; `device` itself
  /// where nothing is found.
  [[nodiscard]] Eigen::Vector3d search(const Eigen::Vector3d& device) const noexcept;

 private:
  const EffectPlan& plan_;
  std::span<const PlannedObject* const> objects_;
  double radius_;
};

}  // namespace reckon::haptics
