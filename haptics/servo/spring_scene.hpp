// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Converts surfaces of a scene to springs along the axes of a device of one or two axes.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <limits>
#include <optional>
#include <vector>

#include "reckon/haptics/exchange/servo_types.hpp"
#include "reckon/haptics/passivity/spring_wall.hpp"
#include "reckon/haptics/scene/effect_plan.hpp"

namespace reckon::haptics {

/// Static planes and boxes with faces perpendicular to the axes of the device. Servo thread; no
/// allocation after construction.
class SpringScene {
 public:
  /// @param axes 1 or 2 @param most_stiffness [N/m] > 0, limit of all surfaces
  /// @throws std::invalid_argument naming the object that the device cannot render, and why
  SpringScene(const EffectPlan& plan, const ServoConfig& config, int axes, double most_stiffness);

  /// The walls around a handle. A handle inside a box stays at the face by which it entered.
  /// @param place [m], frame D @param most_force [N], of each wall
  [[nodiscard]] SpringModel walls_at(const Eigen::Vector3d& place, double most_force) noexcept;

 private:
  static constexpr double kFar = std::numeric_limits<double>::infinity();
  struct Face {
    std::size_t axis = 0;
    WallSide side = WallSide::below;  // direction of its force
  };
  struct Solid {
    std::array<double, SpringModel::kAxes> from{-kFar, -kFar}, to{kFar, kFar};  // [m], frame D
    double stiffness = 0.0;
    std::optional<Face> entered;  // face ahead of the handle, or by which it entered
  };

  [[nodiscard]] std::optional<Solid> solid_of(const PlannedObject& object,
                                              const ServoConfig& config) const;
  [[nodiscard]] bool has(const Solid& solid, std::size_t axis,
                         const Eigen::Vector3d& place) const noexcept;
  [[nodiscard]] std::optional<Face> nearest_face(const Solid& solid,
                                                 const Eigen::Vector3d& place) const noexcept;
  void add(const Solid& solid, Face face, double most_force, SpringModel& model) const noexcept;

  std::size_t axes_;
  double most_stiffness_;
  std::vector<Solid> solids_;
};

}  // namespace reckon::haptics
