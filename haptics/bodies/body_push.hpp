// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The push of a hand on a body for one period: a spring that relaxes as the body moves. The force
// is predicted at the start of the period and held as predicted.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cstddef>
#include <span>

#include "reckon/haptics/bodies/body_slots.hpp"

namespace reckon::haptics {

/// The spring between a hand and a body at the start of a period. Frame S.
struct BodySpring {
  std::size_t body = 0;
  Eigen::Vector3d point = Eigen::Vector3d::Zero();   ///< [m], contact point on the body
  Eigen::Vector3d force = Eigen::Vector3d::Zero();   ///< [N], present force on the body
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();  ///< unit, out of the body
  double stiffness = 0.0;                            ///< [N/m]
  double friction = 0.0;  ///< greatest ratio of tangential to normal force; 0: smooth
  double gap = 0.0;       ///< [m], distance before they touch
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();  ///< [m/s], of the hand at the point
  std::size_t probe = 0;                               ///< number of the hand's probe
  double patch = 0.0;  ///< [m], radius of the contact patch that resists rotation; 0: a point
  /// A grip: it pulls as well as pushes, and does not slip.
  bool grips = false;
  double viscosity = 0.0;                          ///< [N s/m], of a grip
  Eigen::Vector3d drag = Eigen::Vector3d::Zero();  ///< [N], present viscous force on the body
  double turning = 0.0;                            ///< [N m s/rad], rotational viscosity of a grip
};

/// Greatest number of prediction steps of a period.
inline constexpr std::size_t kMostSubsteps = 16;

/// One push. During prediction, next() returns the spring's force of each step. hold() then sets
/// the share that the hand feels, and mean() returns that force over any part of the period.
class BodyPush {
 public:
  BodyPush() = default;
  /// @param at, turned present pose of the body
  BodyPush(std::size_t hand, const BodySpring& spring, const Eigen::Vector3d& at,
           const Eigen::Quaterniond& turned) noexcept;
  /// A constant force.
  BodyPush(std::size_t body, const Eigen::Vector3d& place, const Eigen::Vector3d& force) noexcept;

  [[nodiscard]] std::size_t hand() const noexcept { return hand_; }
  [[nodiscard]] std::size_t body() const noexcept { return body_; }
  /// Contact point in the body's axes, from its center of mass [m].
  [[nodiscard]] const Eigen::Vector3d& place() const noexcept { return place_; }
  [[nodiscard]] double stiffness() const noexcept { return stiffness_; }
  [[nodiscard]] std::size_t steps() const noexcept { return steps_; }
  /// See hold().
  [[nodiscard]] double share() const noexcept { return share_; }

  /// Takes the twist of the last period's push, if it is the same patch.
  void take_twist(const BodyPush& before) noexcept;
  /// Present torque of the patch on the body [N m], S: a stiff spring against rotation about the
  /// contact normal, which slips at 2/3 of friction times force times radius. A grip has viscosity
  /// against all rotation.
  /// @param turn_rate of the body [rad/s], S @param inertia least principal moment [kg m^2]
  /// @param share share of the force that is held, [0, 1]
  [[nodiscard]] Eigen::Vector3d torque(const Eigen::Vector3d& turn_rate, double inertia,
                                       double share) noexcept;

  /// Starts the prediction of `period` [s] in `steps` steps, 1 to kMostSubsteps.
  void begin(double period, std::size_t steps) noexcept;
  /// Present force of the spring [N]; during prediction it is recorded as the force of the next
  /// step.
  Eigen::Vector3d next() noexcept;
  /// Moves hand and body by dt [s]. @param velocity mean, of the body's point [m/s] @param
  /// turn_rate of the body [rad/s]
  void follow(const Eigen::Vector3d& velocity, const Eigen::Vector3d& turn_rate,
              const Eigen::Quaterniond& turned, double dt) noexcept;
  /// Restores the spring of the start of the period.
  void rewind() noexcept;
  /// Starts a new period with the present spring.
  void renew() noexcept;

  /// Mean force over the period minus the force at its start [N].
  [[nodiscard]] Eigen::Vector3d change() const noexcept;
  /// The body gets this share of the spring, [0, 1], plus `rest` [N].
  void hold(double share, const Eigen::Vector3d& rest) noexcept;
  /// Mean of the held force between two times since the start [s]. After the period, until a late
  /// step, the body still gives way, and the spring loses energy, because the hand's motion is
  /// unknown.
  [[nodiscard]] Eigen::Vector3d mean(double from, double to) const noexcept;

 private:
  // Force of the spring by components, even if it would pull.
  struct Tension {
    double across = 0.0;                               // [N], normal, into the body
    Eigen::Vector3d along = Eigen::Vector3d::Zero();   // [N], tangential
    Eigen::Vector3d normal = Eigen::Vector3d::Zero();  // unit, out of the body
    double twist = 0.0;                                // [rad], twist of the patch about the normal
    bool grips = false;                                // a grip: `along` is the whole force

    [[nodiscard]] Eigen::Vector3d force() const noexcept;
  };
  [[nodiscard]] Tension after(const Eigen::Vector3d& change,
                              const Eigen::Vector3d& normal) const noexcept;
  [[nodiscard]] Eigen::Vector3d held(const Eigen::Vector3d& force) const noexcept {
    return share_ * force + rest_;
  }

  std::size_t hand_ = static_cast<std::size_t>(-1);
  std::size_t body_ = 0;
  Eigen::Vector3d place_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d normal_ = Eigen::Vector3d::Zero();  // in the body's axes
  Eigen::Vector3d velocity_ = Eigen::Vector3d::Zero();
  std::size_t probe_ = 0;
  double patch_ = 0.0;
  bool grips_ = false;
  double viscosity_ = 0.0;
  double turning_ = 0.0;
  Eigen::Vector3d dragged_ = Eigen::Vector3d::Zero();  // [N], viscous force at the start
  Eigen::Vector3d drag_ = Eigen::Vector3d::Zero();     // present
  double stiffness_ = 0.0;
  double friction_ = 0.0;
  Tension begun_, tension_;                              // at the start, present
  Eigen::Vector3d first_ = Eigen::Vector3d::Zero();      // [N], at the start
  Eigen::Vector3d late_ = Eigen::Vector3d::Zero();       // [N], present, with loss
  std::array<Eigen::Vector3d, kMostSubsteps> forces_{};  // [N], of the spring, by step
  double share_ = 0.0;                                   // see hold()
  Eigen::Vector3d rest_ = Eigen::Vector3d::Zero();
  std::size_t steps_ = 0;
  std::size_t noted_ = 0;
  double step_ = 0.0;  // [s]
};

/// Slots of the pushed bodies.
[[nodiscard]] BodySet slots_of(std::span<const BodyPush> pushes, const BodySlots& slots) noexcept;
/// Greatest number of substeps, at least 1.
[[nodiscard]] std::size_t most_steps(std::span<const BodyPush> pushes) noexcept;

}  // namespace reckon::haptics
