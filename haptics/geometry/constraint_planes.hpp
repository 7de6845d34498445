// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The planes that hold a surface contact point in one move, and the nearest point to the device
// that they allow: the quadratic program min |x - device|^2, normal_i . x >= level_i, solved
// exactly.
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
  std::uint32_t object;  ///< where there are several
  bool on_face;          ///< of the triangle's flat; else touching round an edge or a corner
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

/// Up to eight planes; all work is on the stack.
class ConstraintPlanes {
 public:
  static constexpr std::size_t kMax = 8;

  ConstraintPlanes() noexcept {}  // NOLINT: the places of planes are filled when they are added

  void clear() noexcept { count_ = 0; }
  [[nodiscard]] std::size_t size() const noexcept { return count_; }
  [[nodiscard]] const ConstraintPlane& operator[](std::size_t i) const noexcept {
    return planes_[i];
  }

  /// Adds a plane. When full, the one that is farthest below `at` makes room.
  void add(const ConstraintPlane& plane, const Eigen::Vector3d& at) noexcept;

  /// Solves by going through all sets of at most three planes and checking optimality of each.
  /// @param tolerance [m] by which rounding may break a plane
  /// @return false when rounding leaves none, which only near-parallel planes can cause.
  [[nodiscard]] bool solve(const Eigen::Vector3d& device, double tolerance,
                           ConstraintSolution& out) const noexcept;

 private:
  [[nodiscard]] bool try_active(const Eigen::Vector3d& device, double tolerance,
                                ConstraintSolution& out) const noexcept;

  std::array<ConstraintPlane, kMax> planes_;
  std::size_t count_ = 0;
};

}  // namespace reckon::haptics
