// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Simulates a hand without the gate: the same device and received models, directly coupled. Runs
// beside a servo, from its published data, and does not affect it.
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

/// Motion of a real hand, measured by its servo in one step, frame S.
struct HandMotion {
  std::chrono::nanoseconds time{0};                    ///< of the step
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< [m], position of the handle
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();  ///< [m/s]
};

/// A second hand beside a real one. Its force is the sum of each received model at its
/// dead-reckoned pose, and the whole spring and effects of each touched surface of the scene: no
/// energy is requested, nothing is softened, smoothed or ramped.
///
/// If it diverges (a force that is NaN or above the device's limit, a handle far from the real
/// one), it pauses for kAside and then restarts at the real hand.
///
///     twin.take(set);   // what is received
///     twin.step(real);  // each step of the real servo, in order
///
/// One thread, any; no clock: the same sets and steps give the same forces. Allocates only at
/// construction. A step takes some 2 us.
class UngatedTwin {
 public:
  /// Distance from the real hand beyond which the twin is lost [m].
  static constexpr double kFarthest = 0.1;
  /// Longest interval of two steps that is integrated; after a longer one it restarts.
  static constexpr std::chrono::milliseconds kLongestGap{100};
  static constexpr std::chrono::milliseconds kAside{500};

  /// @param device for the twin only, like the real one and with the same operator; outlives the
  /// twin
  /// @param plan not null; only read
  /// @param config of the real servo: pose and period of the device, radii of the probe
  UngatedTwin(SimulatedDevice& device, std::shared_ptr<const EffectPlan> plan,
              const ServoConfig& config);
  UngatedTwin(const UngatedTwin&) = delete;
  UngatedTwin& operator=(const UngatedTwin&) = delete;

  /// Sets the remote hands from the next step on.
  void take(const ContactSet& set) noexcept { contacts_ = set; }
  /// Advances the device to the time of this step of the real servo, and computes its next force. A
  /// step that is not later than the last is ignored.
  void step(const HandMotion& real) noexcept;

  /// Pauses the twin for kAside, as when it is lost.
  void stand_aside() noexcept;

  /// Whether it is active: not before the first step or during a pause.
  [[nodiscard]] bool feels() const noexcept { return started_ && now_ >= aside_until_; }
  /// Force on the hand, frame S [N]; zero while inactive.
  [[nodiscard]] const Eigen::Vector3d& force() const noexcept { return force_; }
  /// Motion of the handle at the last step.
  [[nodiscard]] HandMotion motion() const noexcept { return {now_, probe_, velocity_}; }
  /// Net work of the hand on the coupling and on the device's damping since the last (re)start [J];
  /// zero while inactive. A passive coupling to static objects keeps it >= 0.
  [[nodiscard]] double energy() const noexcept {
    return feels() ? device_.port_work() + device_.damping_loss() : 0.0;
  }
  /// Number of pauses.
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
  std::chrono::nanoseconds predicted_at_{0};  // does not advance while the simulation is frozen
  std::chrono::nanoseconds aside_until_{0};
  Eigen::Vector3d probe_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d velocity_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d force_ = Eigen::Vector3d::Zero();
  std::uint64_t resets_ = 0;
  bool started_ = false;
};

}  // namespace reckon::haptics
