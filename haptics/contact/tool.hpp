// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The tool of a hand: positions of its probes, and their forces in the axes of the device. Frame S,
// SI units, servo thread.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>

#include "reckon/haptics/exchange/servo_types.hpp"
#include "reckon/haptics/passivity/wrench.hpp"

namespace reckon::haptics {

/// Pose of a handle.
struct HandlePose {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();               ///< [m]
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();  ///< tool -> S
};

/// Guaranteed damping of a device's axes.
struct AxisDamping {
  double translation = 0.0;  ///< [N s/m]
  double rotation = 0.0;     ///< [N m s/rad]; > 0 for 6 axes
};

/// A rigid tool on a device with `axes` axes. Its port has one coordinate for each axis, as
/// AxisForces; for six axes they are scaled by DampedAxes.
template <int axes>
class ToolOf;

/// A point: the handle is its only probe, and the port's forces are the forces on the handle.
template <>
class ToolOf<3> {
 public:
  using Force = AxisForces<3>;

  explicit ToolOf(const AxisDamping& damping = {},
                  std::span<const Eigen::Vector3d> /*probes*/ = {}) noexcept
      : damping_(damping.translation) {}

  void reset(const HandlePose& pose) noexcept { place_ = before_ = pose.position; }
  void move(const HandlePose& pose) noexcept {
    before_ = place_;
    place_ = pose.position;
  }

  [[nodiscard]] static constexpr std::size_t size() noexcept { return 1; }
  [[nodiscard]] const Eigen::Vector3d& place(std::size_t /*probe*/ = 0) const noexcept {
    return place_;
  }
  /// Velocity of the handle [m/s].
  void set_velocity(const Eigen::Vector3d& velocity) noexcept { velocity_ = velocity; }
  [[nodiscard]] const Eigen::Vector3d& velocity(std::size_t /*probe*/ = 0) const noexcept {
    return velocity_;
  }
  /// Motion since the last move.
  [[nodiscard]] Force motion() const noexcept { return place_ - before_; }
  [[nodiscard]] static Force at_port(std::size_t /*probe*/, const Eigen::Vector3d& force) noexcept {
    return force;
  }
  /// Force on the handle [N].
  [[nodiscard]] static const Eigen::Vector3d& force(const Force& at_port) noexcept {
    return at_port;
  }
  /// A force at the handle, or its rate, in the port's coordinates. @param size [N]
  [[nodiscard]] static constexpr double size_at_port(double size) noexcept { return size; }
  /// Steps of the encoders in the port's coordinates. @param step [m]  @param turn [rad]
  [[nodiscard]] static constexpr double step_at_port(double step, double /*turn*/) noexcept {
    return step;
  }
  /// Force on the handle [N].
  [[nodiscard]] static const Eigen::Vector3d& wrench(const Force& at_port) noexcept {
    return at_port;
  }
  /// Velocity of the handle [m/s].
  [[nodiscard]] const Eigen::Vector3d& twist() const noexcept { return velocity_; }
  /// Stiffness at the first probe. @param at_port of the port's coordinates
  [[nodiscard]] static constexpr double at_probe(double at_port) noexcept { return at_port; }
  /// Damping that pays for the port's motions.
  [[nodiscard]] double damping() const noexcept { return damping_; }
  /// Damping for springs of equal stiffness at the first probe, or at all probes [N s/m].
  [[nodiscard]] double probe_damping() const noexcept { return damping_; }
  [[nodiscard]] double tool_damping() const noexcept { return damping_; }
  /// Curvature at the port from `force` [N] and the curved paths of the probes.
  [[nodiscard]] static constexpr double bend(double /*force*/) noexcept { return 0.0; }

 private:
  double damping_;
  Eigen::Vector3d place_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d before_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d velocity_ = Eigen::Vector3d::Zero();
};

using PointTool = ToolOf<3>;

/// A rigid body with 1 to kMostProbes probes, on a device with force and torque.
template <>
class ToolOf<6> {
 public:
  using Force = AxisForces<6>;

  /// @param probes positions from the handle, in axes of the tool [m]; empty: the handle is the
  /// only probe
  ToolOf(const AxisDamping& damping, std::span<const Eigen::Vector3d> probes);

  void reset(const HandlePose& pose) noexcept;
  void move(const HandlePose& pose) noexcept;

  [[nodiscard]] std::size_t size() const noexcept { return size_; }
  [[nodiscard]] Eigen::Vector3d place(std::size_t probe = 0) const noexcept {
    return pose_.position + levers_[probe];
  }
  [[nodiscard]] const HandlePose& pose() const noexcept { return pose_; }
  /// Sets the motion of the handle. @param velocity [m/s] @param turn [rad/s], about the axes of S
  void set_velocity(const Eigen::Vector3d& velocity, const Eigen::Vector3d& turn) noexcept {
    velocity_ = velocity;
    turn_ = turn;
  }
  [[nodiscard]] Eigen::Vector3d velocity(std::size_t probe = 0) const noexcept {
    return velocity_ + turn_.cross(levers_[probe]);
  }
  /// Vector from the handle to a probe [m].
  [[nodiscard]] const Eigen::Vector3d& lever(std::size_t probe) const noexcept {
    return levers_[probe];
  }
  /// Motion since the last move: [m], then the angle about each axis [rad].
  [[nodiscard]] const Wrench& step() const noexcept { return step_; }
  /// The same in the port's coordinates.
  [[nodiscard]] Force motion() const noexcept { return axes_.scaled_motion(step_); }
  [[nodiscard]] Force at_port(std::size_t probe, const Eigen::Vector3d& force) const noexcept {
    return axes_.scaled_force(wrench_of(levers_[probe], force));
  }
  /// Wrench on the handle [N; N m].
  [[nodiscard]] Wrench wrench(const Force& at_port) const noexcept { return axes_.force(at_port); }
  [[nodiscard]] Eigen::Vector3d force(const Force& at_port) const noexcept {
    return wrench(at_port).head<3>();
  }
  [[nodiscard]] double size_at_port(double size) const noexcept {
    return size / std::sqrt(translation_);
  }
  [[nodiscard]] double step_at_port(double step, double turn) const noexcept {
    return std::max(step * std::sqrt(translation_), turn * std::sqrt(rotation_));
  }
  [[nodiscard]] double at_probe(double at_port) const noexcept { return at_port * probe_damping_; }
  /// Twist of the handle: [m/s], then [rad/s].
  [[nodiscard]] Wrench twist() const noexcept {
    Wrench twist;
    twist << velocity_, turn_;
    return twist;
  }
  /// Greatest curvature at the port. @param curvature of a potential, symmetric [N/m; N m/rad]
  [[nodiscard]] double slope(const WrenchCurvature& curvature) const noexcept {
    return axes_.slope(curvature);
  }
  /// @param written in the port's coordinates
  [[nodiscard]] ToolState state(const Force& written) const noexcept;
  [[nodiscard]] static constexpr double damping() noexcept { return 1.0; }
  /// Damping for a spring at the first probe, or for springs at all probes, from all axes that they
  /// move [N s/m].
  [[nodiscard]] double probe_damping() const noexcept { return probe_damping_; }
  [[nodiscard]] double tool_damping() const noexcept { return tool_damping_; }
  [[nodiscard]] double bend(double force) const noexcept { return longest_ * force / rotation_; }
  /// Bound of the error [J] in the work of a held torque while the axis of rotation changes. The
  /// measured rotation differs from the integral of the turn rate by at most the area between the
  /// path of rotations and its chord. A path with a larger area is longer, and damping dissipates
  /// the difference: the error stays below |torque|^2 |turn|^2 T / (48 b).
  /// @param held in the port's coordinates, where b = 1  @param dt T [s]
  [[nodiscard]] double turning_cost(const Force& held, double dt) const noexcept {
    return held.tail<3>().squaredNorm() * step_.tail<3>().squaredNorm() * dt / 48.0;
  }

 private:
  void place_probes() noexcept;

  DampedAxes axes_;
  std::array<Eigen::Vector3d, kMostProbes> probes_{};  // in axes of the tool
  std::array<Eigen::Vector3d, kMostProbes> levers_{};  // in S
  std::size_t size_ = 1;
  double translation_;    // [N s/m], damping of each axis
  double rotation_;       // [N m s/rad]
  double longest_ = 0.0;  // [m], longest lever
  double probe_damping_ = 0.0;
  double tool_damping_ = 0.0;
  HandlePose pose_;
  Eigen::Vector3d velocity_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d turn_ = Eigen::Vector3d::Zero();
  Wrench step_ = Wrench::Zero();
};

}  // namespace reckon::haptics
