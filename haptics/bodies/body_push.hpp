// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// How a hand pushes a body for one period: by a spring that gives way within the period, foreseen
// when it begins, and held as it was foreseen.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cstddef>
#include <span>

#include "reckon/haptics/bodies/body_slots.hpp"

namespace reckon::haptics {

/// The spring between a hand and a body at the begin of a period. Frame S.
struct BodySpring {
  std::size_t body = 0;
  Eigen::Vector3d point = Eigen::Vector3d::Zero();   ///< [m], of the body, where it is touched
  Eigen::Vector3d force = Eigen::Vector3d::Zero();   ///< [N], on the body, now
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();  ///< unit, out of the body
  double stiffness = 0.0;                            ///< [N/m]
  double friction = 0.0;  ///< greatest force along the surface over that across it; 0: smooth
  double gap = 0.0;       ///< [m], between both, if they do not touch yet
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();  ///< [m/s], of the hand there
  std::size_t probe = 0;                               ///< of the hand
  double patch = 0.0;  ///< [m], radius of the patch that holds the body against turning; 0: a point
  /// It holds the body: it pulls as well as it pushes, and does not slip.
  bool grips = false;
  double viscosity = 0.0;                          ///< [N s/m], of one that grips
  Eigen::Vector3d drag = Eigen::Vector3d::Zero();  ///< [N], of that, on the body, now
  double turning = 0.0;  ///< [N m s/rad], of one that grips, against turning
};

/// Steps in which a period is foreseen, at most.
inline constexpr std::size_t kMostSubsteps = 16;

/// One push. While it is foreseen, next() gives the spring's force in each step; then hold() says
/// what of it the hand feels, and mean() gives that force over any part of the period.
class BodyPush {
 public:
  BodyPush() = default;
  /// @param at, turned of the body now
  BodyPush(std::size_t hand, const BodySpring& spring, const Eigen::Vector3d& at,
           const Eigen::Quaterniond& turned) noexcept;
  /// A force that stays as it is.
  BodyPush(std::size_t body, const Eigen::Vector3d& place, const Eigen::Vector3d& force) noexcept;

  [[nodiscard]] std::size_t hand() const noexcept { return hand_; }
  [[nodiscard]] std::size_t body() const noexcept { return body_; }
  /// In the body's axes, from its middle [m].
  [[nodiscard]] const Eigen::Vector3d& place() const noexcept { return place_; }
  [[nodiscard]] double stiffness() const noexcept { return stiffness_; }
  [[nodiscard]] std::size_t steps() const noexcept { return steps_; }
  /// See hold().
  [[nodiscard]] double share() const noexcept { return share_; }

  /// It goes on from the twist that it had in the period before, if it is the same patch.
  void take_twist(const BodyPush& before) noexcept;
  /// What its patch turns the body by now [N m], S: a stiff spring against turning about the
  /// contact normal, which slips at 2/3 of friction, force and radius. Of one that grips: viscosity
  /// against all turning.
  /// @param turn_rate of the body [rad/s], S  @param inertia its least [kg m^2]
  /// @param share of the force that is held, [0, 1]
  [[nodiscard]] Eigen::Vector3d torque(const Eigen::Vector3d& turn_rate, double inertia,
                                       double share) noexcept;

  /// Begins to foresee `period` [s] in `steps` steps, 1 to kMostSubsteps.
  void begin(double period, std::size_t steps) noexcept;
  /// Force of the spring now [N]; noted as that of the next step while it is foreseen.
  Eigen::Vector3d next() noexcept;
  /// The hand went on for dt [s], and the body: its point had this mean velocity [m/s], and it
  /// turned at this rate [rad/s].
  void follow(const Eigen::Vector3d& velocity, const Eigen::Vector3d& turn_rate,
              const Eigen::Quaterniond& turned, double dt) noexcept;
  /// The spring is again as at the begin of the period.
  void rewind() noexcept;
  /// Another period begins with the spring as it is.
  void renew() noexcept;

  /// Mean force over the period, less the force at its begin [N].
  [[nodiscard]] Eigen::Vector3d change() const noexcept;
  /// The body gets this share of the spring, [0, 1], and `rest` [N] besides.
  void hold(double share, const Eigen::Vector3d& rest) noexcept;
  /// Of the held force between two times since the begin [s]. After the period, until a late step,
  /// the body goes on to give way, and the spring loses energy: what the hand does is not known.
  [[nodiscard]] Eigen::Vector3d mean(double from, double to) const noexcept;

 private:
  // What the spring would be, also where it would pull.
  struct Tension {
    double across = 0.0;                               // [N], into the body
    Eigen::Vector3d along = Eigen::Vector3d::Zero();   // [N], the surface
    Eigen::Vector3d normal = Eigen::Vector3d::Zero();  // unit, out of the body
    double twist = 0.0;                                // [rad], of the patch, about the normal
    bool grips = false;                                // then all is along

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
  Eigen::Vector3d dragged_ = Eigen::Vector3d::Zero();  // [N], of viscosity, at the begin
  Eigen::Vector3d drag_ = Eigen::Vector3d::Zero();     // now
  double stiffness_ = 0.0;
  double friction_ = 0.0;
  Tension begun_, tension_;                              // at the begin, now
  Eigen::Vector3d first_ = Eigen::Vector3d::Zero();      // [N], at the begin
  Eigen::Vector3d late_ = Eigen::Vector3d::Zero();       // now, with loss
  std::array<Eigen::Vector3d, kMostSubsteps> forces_{};  // of the spring, in the steps
  double share_ = 0.0;                                   // see hold()
  Eigen::Vector3d rest_ = Eigen::Vector3d::Zero();
  std::size_t steps_ = 0;
  std::size_t noted_ = 0;
  double step_ = 0.0;  // [s]
};

/// Of the bodies that are pushed.
[[nodiscard]] BodySet slots_of(std::span<const BodyPush> pushes, const BodySlots& slots) noexcept;
/// Most substeps of any of them, 1 or more.
[[nodiscard]] std::size_t most_steps(std::span<const BodyPush> pushes) noexcept;

}  // namespace reckon::haptics
