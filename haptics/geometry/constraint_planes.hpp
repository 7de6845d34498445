// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The planes that hold a surface contact point in one move, and the nearest allowed point to the
// device: the quadratic program min |x - device|^2, normal_i . x >= level_i, solved exactly.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>

namespace reckon::haptics {

/// Free half space of one contact.
struct ConstraintPlane {
  Eigen::Vector3d normal;  ///< unit, towards the free side
  double level;            ///< [m]: normal . x >= level
  std::uint32_t triangle;
  std::uint32_t object;  ///< number of the object, if there are several
  bool on_face;          ///< on the flat of the triangle; else a contact round an edge or a corner
};

/// Solution of the program.
struct ConstraintSolution {
  Eigen::Vector3d point = Eigen::Vector3d::Zero();  ///< allowed and nearest to the device
  Eigen::Vector3d push = Eigen::Vector3d::Zero();   ///< point - device = sum of load_i normal_i
  double load = 0.0;                                ///< sum of load_i >= 0 [m]
  std::array<std::size_t, 3> active{};              ///< planes with load > 0
  std::array<double, 3> loads{};                    ///< of these planes [m]
  std::size_t active_count = 0;
};

/// Up to eight planes. All memory is on the stack.
class ConstraintPlanes {
 public:
  static constexpr std::size_t kMax = 8;

  ConstraintPlanes() noexcept {}  // NOLINT: planes are initialised when they are added

  void clear() noexcept { count_ = 0; }
  [[nodiscard]] std::size_t size() const noexcept { return count_; }
  [[nodiscard]] const ConstraintPlane& operator[](std::size_t i) const noexcept {
    return planes_[i];
  }

  /// Adds a plane. If the set is full, it replaces the plane that is farthest below `at`.
  void add(const ConstraintPlane& plane, const Eigen::Vector3d& at) noexcept;

  /// Solves by enumeration of all sets of at most three planes, with an optimality test for each.
  /// @param tolerance [m], greatest violation of a plane by rounding
  /// @return false if rounding leaves no solution, which only near-parallel planes can cause.
  [[nodiscard]] bool solve(const Eigen::Vector3d& device, double tolerance,
                           ConstraintSolution& out) const noexcept;

 private:
  [[nodiscard]] bool try_active(const Eigen::Vector3d& device, double tolerance,
                                ConstraintSolution& out) const noexcept;

  std::array<ConstraintPlane, kMax> planes_;
  std::size_t count_ = 0;
};

}  // namespace reckon::haptics
