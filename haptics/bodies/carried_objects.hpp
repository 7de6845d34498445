// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Bodies that a mover carries: the solver moves them, whatever pushes them.
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
  /// @param mover may be null if the plan has none of them
  /// @throws std::invalid_argument if it has and there is no mover
  CarriedObjects(const EffectPlan& plan, const BodySolver& solver,
                 std::shared_ptr<ObjectMover> mover);

  [[nodiscard]] bool empty() const noexcept { return carried_.empty(); }
  /// Asks the mover where they are.
  void see(std::chrono::nanoseconds now) noexcept;
  /// In the next steps they get from where they were to where they are, at one speed.
  /// @param gap [s], between both
  void drive(BodySolver& solver, double gap) const noexcept;
  /// Puts them where they are.
  void put(BodySolver& solver) const noexcept;

 private:
  struct Carried {
    std::size_t slot = 0;
    std::uint32_t object = 0;
    Eigen::Vector3d origin = Eigen::Vector3d::Zero();  // of its shape's axes in its own [m]
    ObjectMotion before{}, now{};
  };

  std::shared_ptr<ObjectMover> mover_;
  std::vector<Carried> carried_;
};

}  // namespace reckon::haptics
