// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The point on a mesh at which effects are evaluated.
#pragma once

#include <Eigen/Core>
#include <cstdint>

namespace reckon::haptics {

/// If a hand presses into a mesh and crosses an edge between two triangles, the normal turns
/// abruptly, and the contact point jumps by the depth times the angle between them. A texture would
/// step with both. So the point for effects moves with the hand, and returns to the contact point
/// by a tenth of the hand's motion. The normal turns by half a radian for each millimetre of that
/// motion. A jump beyond kMostShift or kMostTurn comes from the shape itself and is followed at
/// once. One for each contact; servo thread.
class MeshStroke {
 public:
  static constexpr double kMostShift = 1e-3;  ///< [m]
  static constexpr double kMostTurn = 0.2;    ///< [rad]

  /// All arguments are in the mesh's axes. @param scp, device [m] @param normal unit @param began
  /// the contact is new
  void follow(const Eigen::Vector3d& scp, const Eigen::Vector3d& device,
              const Eigen::Vector3d& normal, std::uint32_t triangle, bool began) noexcept {
    const Eigen::Vector3d hand = device - device_;
    const double way = hand.norm();
    if (began) {
      shift_.setZero();
      normal_ = normal;
    } else if (triangle != triangle_) {
      const Eigen::Vector3d jump = scp - scp_ - hand;
      shift_ -= jump - normal.dot(jump) * normal;
      if (!(shift_.norm() < kMostShift)) shift_.setZero();
    }
    if (!shift_.isZero(0.0)) shift_ -= part(shift_, kBack * way);
    const Eigen::Vector3d turn = normal - normal_;
    if (!turn.isZero(0.0))
      normal_ = turn.norm() < kMostTurn ? (normal_ + part(turn, kTurn * way)).normalized() : normal;
    scp_ = scp;
    device_ = device;
    triangle_ = triangle;
  }

  [[nodiscard]] Eigen::Vector3d place() const noexcept { return scp_ + shift_; }  ///< [m]
  [[nodiscard]] const Eigen::Vector3d& normal() const noexcept { return normal_; }

 private:
  static constexpr double kBack = 0.1;
  static constexpr double kTurn = 500.0;  // [rad/m]

  // `way`, limited to `length`.
  static Eigen::Vector3d part(const Eigen::Vector3d& way, double length) noexcept {
    const double whole = way.norm();
    return whole > length ? Eigen::Vector3d(length / whole * way) : way;
  }

  Eigen::Vector3d scp_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d device_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d shift_ = Eigen::Vector3d::Zero();  // from the contact point to place()
  Eigen::Vector3d normal_ = Eigen::Vector3d::Zero();
  std::uint32_t triangle_ = 0;
};

}  // namespace reckon::haptics
