// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Finds a position outside all objects of a plan, for a probe that starts inside some.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <limits>
#include <span>

#include "reckon/haptics/scene/effect_plan.hpp"

namespace reckon::haptics {

/// Allocates nothing; checks every moving object.
class FreePlace {
 public:
  static constexpr std::uint32_t kNobody = std::numeric_limits<std::uint32_t>::max();

  /// @param plan, objects the plan's objects at their present poses; both outlive this @param
  /// radius [m], >= 0
  FreePlace(const EffectPlan& plan, std::span<const PlannedObject* const> objects, double radius)
      : plan_(plan), objects_(objects), radius_(radius) {}

  /// An object whose solid the probe overlaps at p [m, S]; kNobody: none.
  [[nodiscard]] std::uint32_t overlapped(const Eigen::Vector3d& p) const noexcept;
  /// Moves p out of one object after the other. @return whether it is outside all
  [[nodiscard]] bool push_out(Eigen::Vector3d& p) const noexcept;
  /// The nearest free position along the axes and the diagonals, in growing steps; `device` itself
  /// if none is found.
  [[nodiscard]] Eigen::Vector3d search(const Eigen::Vector3d& device) const noexcept;

 private:
  const EffectPlan& plan_;
  std::span<const PlannedObject* const> objects_;
  double radius_;
};

}  // namespace reckon::haptics
