// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A device on USB and the hand that holds it: a mass, motors about three joints, its own ledger,
// and faults common to such devices.
#pragma once

#include <Eigen/Core>
#include <chrono>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "reckon/tests/haptics/support/usb_shim.hpp"

namespace reckon::test {

struct HeldModelOptions {
  unsigned seed = 1;
  double mass = 0.15;                            ///< [kg]
  double damping = 2.0;                          ///< [N s/m], of the handle
  double joint_damping = 0;                      ///< [N m s/rad], of each joint, in addition
  double hand_stiffness = 200;                   ///< [N/m]
  double hand_damping = 3;                       ///< [N s/m]
  double out_at = 0;                             ///< [ms] in a frame, when it takes a transfer
  std::chrono::nanoseconds motion_step{50'000};  ///< of its motion; <= 0.1 ms
};

/// Energies are computed from its own motion, at a tenth of a millisecond or finer, and not while
/// it is led. All vectors are in frame D.
class HeldModel : public UsbModel {
 public:
  [[nodiscard]] std::chrono::nanoseconds now() const { return now_; }
  void pass(std::chrono::nanoseconds time) override;
  /// Called every 50 us of its time, whoever advances it: the code that runs beside the device's
  /// thread.
  void beside(std::function<void(std::chrono::nanoseconds)> call) { beside_ = std::move(call); }

  /// An unyielding hand holds the handle here, at rest, until it is released. This is not booked,
  /// and its time is cheap: a step may be a millisecond long.
  void lead(const Eigen::Vector3d& place);
  void let_go() {
    led_ = false;
    moved_ = {};
  }
  [[nodiscard]] bool is_led() const { return led_; }

  void carry(double share) { carried_ = share; }  ///< of its links' weight, by the hand
  void leave() { options_.hand_stiffness = options_.hand_damping = 0; }  ///< nobody holds it
  void gain(double damping) { options_.damping = damping; }  ///< [N s/m], negative: it is active

  // Faults from now on.
  void hang(std::chrono::nanoseconds time) { hangs_until_ = now_ + time; }  ///< no transfer ends
  void mute(std::chrono::nanoseconds time) { mute_until_ = now_ + time; }   ///< no reports
  void stall() { stalls_ = true; }              ///< the next transfer to it is refused
  void cut() { cuts_ = true; }                  ///< the next transfer to it ends early
  void damage(int count) { damaged_ = count; }  ///< of its next reports; some may look valid
  void split(bool on) { splits_ = on; }         ///< reports come in pieces

  // Its own ledger.
  [[nodiscard]] double port_work() const { return port_work_; }        ///< [J], of the motors
  [[nodiscard]] double damping_loss() const { return damping_loss_; }  ///< [J]
  [[nodiscard]] double lifted() const;  ///< [J], of its links since the start
  /// [J], largest part of its work that the rounding of its motors' torques may add beyond the
  /// driver's knowledge.
  [[nodiscard]] double rounding() const { return rounding_; }
  [[nodiscard]] const Eigen::Vector3d& position() const { return position_; }  ///< [m]
  [[nodiscard]] Eigen::Vector3d force() const;  ///< [N], of the motors

  void begin_out(std::span<const std::uint8_t> octets) override;
  std::optional<int> out_done() override;

 protected:
  struct Joints {
    Eigen::Vector3d angles;    // [rad]
    Eigen::Matrix3d jacobian;  // [m/rad]; zero: near a singular pose
  };
  /// @param hand the hand's goal [m] at a time [s]
  HeldModel(const HeldModelOptions& options, std::function<Eigen::Vector3d(double)> hand);
  /// Moves it to the hand; the last call of a constructor.
  void begin();

  [[nodiscard]] virtual std::optional<Joints> joints_at(const Eigen::Vector3d& position) const = 0;
  /// Of the motors, about the joints [N m].
  [[nodiscard]] virtual Eigen::Vector3d torques() const = 0;
  /// Half a step of each torque [N m].
  [[nodiscard]] virtual Eigen::Vector3d half_steps() const = 0;
  /// Energy of its links' weight [J].
  [[nodiscard]] virtual double height(const Eigen::Vector3d& /*angles*/) const { return 0; }
  virtual void run_line() = 0;
  /// Whether there is room for a transfer to it.
  [[nodiscard]] virtual bool has_room() const { return true; }
  /// Result of a transfer to it.
  virtual void take_transfer(std::span<const std::uint8_t> octets) = 0;

  std::chrono::nanoseconds now_{0};
  Eigen::Vector3d angles_ = Eigen::Vector3d::Zero();
  std::chrono::nanoseconds hangs_until_{0}, mute_until_{0};
  bool stalls_ = false, cuts_ = false, splits_ = false;
  int damaged_ = 0;

 private:
  void move(double h);
  [[nodiscard]] Eigen::Vector3d slowed(const Eigen::Vector3d& velocity, double h) const;
  [[nodiscard]] Eigen::Vector3d weight() const;

  HeldModelOptions options_;
  std::function<Eigen::Vector3d(double)> hand_;
  std::function<void(std::chrono::nanoseconds)> beside_;
  Eigen::Vector3d position_, velocity_ = Eigen::Vector3d::Zero();
  Eigen::Matrix3d jacobian_ = Eigen::Matrix3d::Identity();
  double carried_ = 1;
  bool led_ = false;
  std::chrono::nanoseconds moved_{0};  // remainder since its last motion
  double port_work_ = 0, damping_loss_ = 0, rounding_ = 0, first_height_ = 0;
  std::vector<std::uint8_t> out_;
  std::chrono::nanoseconds out_at_{0};  // when a transfer ends
};

}  // namespace reckon::test
