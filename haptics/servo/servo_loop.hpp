// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The force loop of one device. Its own thread calls step() every period; tests call it directly.
#pragma once

#include <chrono>
#include <memory>

#include "reckon/haptics/contact/region_share.hpp"
#include "reckon/haptics/servo/servo_core.hpp"

namespace reckon::haptics {

/// The servo of one impedance device, of three axes or of six, or of a CoefficientDevice. Takes the
/// newest ContactSet, publishes a ServoSnapshot every step.
///
/// One energy port serves all contacts of the device. Walls may use at most 3/4 of the device's
/// guaranteed damping; the rest is for hands.
class ServoLoop {
 public:
  /// @param device outlives the loop; its limits are read once, here.
  /// @param plan not null; never modified, so that all servos of a process may share it
  /// @throws std::invalid_argument when a setting is out of range; the text names the setting and
  /// the reason.
  /// @param bodies bodies of the plan, if any; shared by the servos of one thread and one rate
  ServoLoop(HapticDevice& device, std::shared_ptr<const EffectPlan> plan, const ServoConfig& config,
            std::shared_ptr<BodyWorld> bodies = nullptr);
  /// The same with a plan that no other servo shares.
  ServoLoop(HapticDevice& device, EffectPlan plan, const ServoConfig& config);

  /// One servo period. @param now steady, never decreasing. Servo thread only; no allocation, no
  /// lock, no clock. About 0.2 us plus the device's own time, 0.35 us for each remote hand in
  /// reach, and the contact queries. Logarithmic in the number of objects out of reach.
  void step(std::chrono::nanoseconds now) noexcept { core_->step(now); }

  /// Whether a late step could be felt: there is a force, or a hand or surface is within kSoonFelt
  /// of the probe. Servo thread; surfaces are searched in one of 8 steps.
  [[nodiscard]] bool has_near() noexcept { return core_->has_near(); }
  /// More than the motion of a hand until the next search, at 2 m/s and 100 Hz [m].
  static constexpr double kSoonFelt = ServoCore::kSoonFelt;

  /// Whether the model loop needs the last steps: a hand or surface is near, or the hand has moved
  /// by more than `moved` [m], now or within the last 100 ms; or 10 ms have passed since the last
  /// news. Then it records the news as taken. Servo thread.
  [[nodiscard]] bool take_news(double moved) noexcept { return core_->take_news(moved); }

  /// The model loop writes the remote hands here.
  [[nodiscard]] TripleBuffer<ContactSet>& contacts() noexcept { return core_->contacts(); }
  /// The model loop reads the outcome here.
  [[nodiscard]] TripleBuffer<ServoSnapshot>& snapshots() noexcept { return core_->snapshots(); }

  /// Records every step from now on; nullptr stops. Call while no step runs.
  void trace(TraceRing* ring) noexcept { core_->trace(ring); }

  /// Stiffness limit of the static scene [N/m]; stiffer surfaces are softened to it.
  [[nodiscard]] double static_stiffness_limit() const noexcept {
    return core_->static_stiffness_limit();
  }
  /// Rate limit for growth and rotation of the force [N/s]. Its decrease is not limited.
  [[nodiscard]] double force_rate_limit() const noexcept { return core_->force_rate_limit(); }
  /// Most power [W] that the force puts into a yielding hand.
  [[nodiscard]] double power_limit() const noexcept { return core_->power_limit(); }
  /// Stiffness that the scene asks for [N/m].
  [[nodiscard]] double static_stiffness() const noexcept { return plan().max_stiffness(); }
  /// Stiffness of the scene's stiffest region, and its limit [N/m].
  [[nodiscard]] double region_stiffness() const noexcept { return plan().max_region_stiffness(); }
  [[nodiscard]] double region_stiffness_limit() const noexcept {
    return kRegionsOverWalls * static_stiffness_limit();
  }
  /// The static scene; any thread.
  [[nodiscard]] const EffectPlan& plan() const noexcept { return core_->plan(); }
  /// Stiffness limit of a remote hand [N/m]: half the limit of a wall, because two hands that press
  /// each other share the energy of one spring.
  [[nodiscard]] double remote_stiffness_limit() const noexcept {
    return core_->remote_stiffness_limit();
  }
  /// Stiffness limit of a body that no device moves [N/m].
  [[nodiscard]] double body_stiffness_limit() const noexcept {
    return core_->body_stiffness_limit();
  }
  /// Least stiffness with which its button holds a body [N/m]; 0: none.
  [[nodiscard]] double grab_stiffness() const noexcept { return core_->grab_stiffness(); }
  /// Guaranteed damping of the device [N s/m].
  [[nodiscard]] double damping() const noexcept { return core_->limits().damping; }
  /// Greatest force written to the device [N].
  [[nodiscard]] double force_limit() const noexcept { return core_->force_limit(); }

 private:
  std::unique_ptr<ServoCore> core_;
};

}  // namespace reckon::haptics
