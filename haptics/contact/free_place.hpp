// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Finds a position outside all objects of a plan, for a probe that starts inside some.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <limits>
#include <span>

#include "reckon/haptics/geometry/surface_contact_point.hpp"
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
  [[nodiscard]] std::uint32_t overlapped(const Eigen::Vector3d& p) const noexcept {
    std::uint32_t found = kNobody;
    const Eigen::Vector3d room = Eigen::Vector3d::Constant(radius_);
    const SurfaceContactPoint probe(radius_);
    const auto see = [&](std::uint32_t index) {
      if (found != kNobody) return;
      const PlannedObject& object = *objects_[index];
      if (probe.overlaps(object.shape, object.to_object(p))) found = index;
    };
    plan_.visit_near({p - room, p + room}, see);
    for (std::uint32_t i = 0; i < objects_.size(); ++i)
      if (objects_[i]->moves()) see(i);
    return found;
  }
  /// Moves p out of one object after the other. @return whether it is outside all
  [[nodiscard]] bool push_out(Eigen::Vector3d& p) const noexcept {
    for (int round = 0; round < kPushes; ++round) {
      const std::uint32_t index = overlapped(p);
      if (index == kNobody) return true;
      const PlannedObject& object = *objects_[index];
      SurfaceContactPoint point(radius_);
      point.reset(object.shape, object.to_object(p));
      p = object.to_scene(point.scp());
    }
    return overlapped(p) == kNobody;
  }
  /// The nearest free position along the axes and the diagonals, in growing steps; `device` itself
  /// if none is found.
  [[nodiscard]] Eigen::Vector3d search(const Eigen::Vector3d& device) const noexcept {
    for (double reach = kSearchFrom; reach < kSearchTo; reach *= 2.0) {
      for (int way = 0; way < 27; ++way) {
        const Eigen::Vector3d p =
            device +
            reach * Eigen::Vector3d(way % 3 - 1, way / 3 % 3 - 1, way / 9 - 1).stableNormalized();
        if (overlapped(p) == kNobody) return p;
      }
    }
    return device;
  }

 private:
  // Number of overlapping objects that the search leaves one by one before it moves straight out,
  // and the lengths [m] that it tries.
  static constexpr int kPushes = 32;
  static constexpr double kSearchFrom = 1e-4;
  static constexpr double kSearchTo = 1e5;

  const EffectPlan& plan_;
  std::span<const PlannedObject* const> objects_;
  double radius_;
};

}  // namespace reckon::haptics
