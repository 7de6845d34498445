// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// What a hand would feel without the gate: the same device and received models, coupled raw. Runs
// beside a servo, from what it publishes, and touches nothing of it.
#pragma once

#include <Eigen/Core>
#include <chrono>
#include <cstdint>
#include <memory>

#include "reckon/haptics/contact/contact_solver.hpp"
#include "reckon/haptics/devices/simulated_device.hpp"
#include "reckon/haptics/exchange/servo_types.hpp"
#include "reckon/haptics/scene/effect_plan.hpp"

namespace reckon::haptics {

/// What the servo of a real hand measured in one step, frame S.
struct HandMotion {
  std::chrono::nanoseconds time{0};                    ///< of the step
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< [m], of the handle
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();  ///< [m/s]
};

/// A second hand at the side of a real one. Its force is each received model as it stands, at the
/// pose that plain dead reckoning gives, and the whole spring and the effects of each surface of
/// the scene that it touches: no energy is asked for, nothing is softened, followed or ramped.
///
/// Where that gets lost (a force that is no number or beyond the device's largest, a handle that is
/// far from the real one) it stands aside for kAside and then begins anew, at the real hand.
///
///     twin.take(set);   // what is received
///     twin.step(real);  // each step of the real servo, in order
///
/// One thread, any; no clock: the same sets and steps give the same forces. Allocates only at
/// construction. A step takes some 2 us.
class UngatedTwin {
 public:
  /// Farther from the real hand than this [m], along any way, the twin is lost.
  static constexpr double kFarthest = 0.1;
  /// Between two steps that are farther apart than this, nothing is integrated: it begins anew.
  static constexpr std::chrono::milliseconds kLongestGap{100};
  static constexpr std::chrono::milliseconds kAside{500};

  /// @param device of its own, like the real one and with the same operator; outlives the twin
  /// @param plan not null; only read
  /// @param config of the real servo: pose and period of the device, radii of the probe
  UngatedTwin(SimulatedDevice& device, std::shared_ptr<const EffectPlan> plan,
              const ServoConfig& config);
  UngatedTwin(const UngatedTwin&) = delete;
  UngatedTwin& operator=(const UngatedTwin&) = delete;

  /// From the next step on these are the remote hands.
  void take(const ContactSet& set) noexcept { contacts_ = set; }
  /// What the device does until the time of this step of the real servo, and the force from then
  /// on. A step that is not later than the last is left out.
  void step(const HandMotion& real) noexcept;

  /// It is lost: from the next step on it stands aside.
  void stand_aside() noexcept;

  /// Whether it feels now: not before the first step, nor while it stands aside.
  [[nodiscard]] bool feels() const noexcept { return started_ && now_ >= aside_until_; }
  /// On the hand, frame S [N]; zero where it does not feel.
  [[nodiscard]] const Eigen::Vector3d& force() const noexcept { return force_; }
  /// Of the handle, at the last step.
  [[nodiscard]] HandMotion motion() const noexcept { return {now_, probe_, velocity_}; }
  /// What the hand has given to the coupling and to the device's own damping less what it got back
  /// since the twin began (anew) [J]; zero where it does not feel. A passive coupling to what no
  /// hand moves keeps it at zero or above.
  [[nodiscard]] double energy() const noexcept {
    return feels() ? device_.port_work() + device_.damping_loss() : 0.0;
  }
  /// How often it got lost, or was told to stand aside.
  [[nodiscard]] std::uint64_t resets() const noexcept { return resets_; }

 private:
  void begin_anew(const HandMotion& real) noexcept;
  void sample() noexcept;
  [[nodiscard]] bool is_lost(const Eigen::Vector3d& force, const HandMotion& real) const noexcept;
  [[nodiscard]] Eigen::Vector3d surface_force() noexcept;
  [[nodiscard]] Eigen::Vector3d hand_force(const RemoteHand& hand) const noexcept;

  SimulatedDevice& device_;
  std::shared_ptr<const EffectPlan> plan_;
  ServoConfig config_;
  double largest_;  // [N]
  double period_;   // [s]
  ContactSolver solver_;
  ContactSet contacts_;
  std::chrono::nanoseconds now_{0};
  std::chrono::nanoseconds predicted_at_{0};  // stands while the simulation is frozen
  std::chrono::nanoseconds aside_until_{0};
  Eigen::Vector3d probe_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d velocity_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d force_ = Eigen::Vector3d::Zero();
  std::uint64_t resets_ = 0;
  bool started_ = false;
};

}  // namespace reckon::haptics
