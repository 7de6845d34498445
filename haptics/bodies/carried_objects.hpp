// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Kinematic bodies: a mover sets their motion, and pushes have no effect.
#pragma once

#include <Eigen/Core>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "reckon/haptics/bodies/body_solver.hpp"
#include "reckon/haptics/bodies/object_mover.hpp"

namespace reckon::haptics {

/// Servo thread.
class CarriedObjects {
 public:
  /// @param mover may be null if the plan has no carried objects
  /// @throws std::invalid_argument if it has some and there is no mover
  CarriedObjects(const EffectPlan& plan, const BodySolver& solver,
                 std::shared_ptr<ObjectMover> mover);

  [[nodiscard]] bool empty() const noexcept { return carried_.empty(); }
  /// Reads their motion from the mover.
  void see(std::chrono::nanoseconds now) noexcept;
  /// In the next steps they move from their last to their present pose at constant velocity.
  /// @param gap [s] between the two
  void drive(BodySolver& solver, double gap) const noexcept;
  /// Sets their present poses.
  void put(BodySolver& solver) const noexcept;

 private:
  struct Carried {
    std::size_t slot = 0;
    std::uint32_t object = 0;
    Eigen::Vector3d origin =
        Eigen::Vector3d::Zero();  // of the shape's axes in the object's axes [m]
    ObjectMotion before{}, now{};
  };

  std::shared_ptr<ObjectMover> mover_;
  std::vector<Carried> carried_;
};

}  // namespace reckon::haptics
