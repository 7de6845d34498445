// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A body held by one probe: a spring with viscosity from a point of the probe to a point of the
// body, booked like the spring of a wall.
#pragma once

#include <Eigen/Core>
#include <cstddef>

#include "reckon/haptics/passivity/energy_port.hpp"
#include "reckon/haptics/scene/effect_plan.hpp"
#include "reckon/haptics/scene/grab_spring.hpp"

namespace reckon::haptics {

/// It starts unstretched, without a jump or an energy cost. If the ledger is short, its gain falls,
/// and rises within 100 ms as the ledger pays. At zero gain, as after a cut, the body is released.
/// Order of calls within a step: place, move, settle, load, shown, attenuate; they do nothing while
/// nothing is held. One thread; allocates nothing.
class Grab {
 public:
  /// Grabs a body. @param body its number among the moving objects
  /// @param spring with a stiffness and a viscosity that device and body can take
  /// @param probe [m, S]  @param motion of the body
  void take(std::size_t body, const GrabSpring& spring, const Eigen::Vector3d& probe,
            const ObjectMotion& motion) noexcept;
  /// Changes the stiffness [N/m] > 0 of the spring that holds a body, and books the change.
  void stiffen(double stiffness, EnergyLedger& ledger) noexcept;
  /// Releases the body; the energy of the spring is lost.
  void release(EnergyLedger& ledger) noexcept;
  [[nodiscard]] bool holds() const noexcept { return holds_; }
  [[nodiscard]] std::size_t body() const noexcept { return body_; }
  /// Whether the pull exceeds the limit of the spring.
  [[nodiscard]] bool tears() const noexcept { return holds_ && force_.norm() > spring_.most; }

  /// Sets the motion of the body.
  void place(const ObjectMotion& motion) noexcept { motion_ = motion; }
  /// Moves the probe, and books the stored or released energy. @return the change of the force [N]
  Eigen::Vector3d move(const Eigen::Vector3d& probe, EnergyLedger& ledger) noexcept;
  /// Lowers the gain for a debt, and raises it as the ledger pays. @param dt [s] of the sample
  void settle(double dt, EnergyLedger& ledger) noexcept;
  /// Sets the predicted difference between the mean force over the next sample, with viscosity, and
  /// the spring's present force [N]. For the next load().
  void foresee(const Eigen::Vector3d& change) noexcept { change_ = change; }
  /// Adds the forces to be held.
  void load(PortLoad& load) const noexcept;
  /// Takes the held share of the forces other than the spring's, [0, 1].
  void shown(double extra) noexcept { shown_ = extra; }
  /// Scales force and storage by `factor` in [0, 1].
  void attenuate(double factor, EnergyLedger& ledger) noexcept;

  /// Force on the hand [N, S], after shown().
  [[nodiscard]] Eigen::Vector3d force() const noexcept {
    return holds_ ? Eigen::Vector3d(spring_force() + shown_ * change_) : Eigen::Vector3d::Zero();
  }
  /// The spring's part of it.
  [[nodiscard]] Eigen::Vector3d spring_force() const noexcept { return gain_ * force_; }
  /// Force that the spring lacks because its gain is below 1 [N].
  [[nodiscard]] Eigen::Vector3d held_back() const noexcept {
    return holds_ ? Eigen::Vector3d((1.0 - gain_) * force_) : Eigen::Vector3d::Zero();
  }
  [[nodiscard]] double gain() const noexcept { return gain_; }
  /// Storage of the spring [J].
  [[nodiscard]] double stored() const noexcept { return gain_ * stored_; }
  [[nodiscard]] double stiffness() const noexcept { return gain_ * spring_.stiffness; }
  [[nodiscard]] double viscosity() const noexcept { return gain_ * spring_.viscosity; }
  /// Grip point on the body [m, S].
  [[nodiscard]] Eigen::Vector3d point() const noexcept {
    return motion_.position + motion_.orientation * place_;
  }
  /// Velocity of that point [m/s].
  [[nodiscard]] Eigen::Vector3d point_velocity() const noexcept {
    return motion_.velocity + motion_.turn_rate.cross(motion_.orientation * place_);
  }

 private:
  // Energy booked for the spring [J].
  [[nodiscard]] double booked() const noexcept { return gain_ * (stored_ - lent_); }
  void scale_gain(double factor, EnergyLedger& ledger) noexcept;

  bool holds_ = false;
  std::size_t body_ = 0;
  GrabSpring spring_;
  ObjectMotion motion_;
  Eigen::Vector3d place_ = Eigen::Vector3d::Zero();   // grip point in the body's axes [m]
  Eigen::Vector3d force_ = Eigen::Vector3d::Zero();   // of the spring at a gain of 1 [N]
  Eigen::Vector3d change_ = Eigen::Vector3d::Zero();  // [N]
  double stored_ = 0.0, lent_ = 0.0;                  // [J], at a gain of 1
  double gain_ = 1.0;
  double shown_ = 1.0;
};

}  // namespace reckon::haptics
