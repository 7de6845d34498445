// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Common part of all servos: settings, limits, inputs and outputs. ServoLoop is the public
// interface.
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>

#include "reckon/haptics/bodies/body_world.hpp"
#include "reckon/haptics/contact/near_hands.hpp"
#include "reckon/haptics/devices/haptic_device.hpp"
#include "reckon/haptics/exchange/servo_types.hpp"
#include "reckon/haptics/exchange/triple_buffer.hpp"
#include "reckon/haptics/scene/effect_plan.hpp"
#include "reckon/haptics/servo/stop_switch.hpp"

namespace reckon::haptics {

/// A servo without its step.
class ServoCore {
 public:
  /// See ServoLoop.
  static constexpr double kSoonFelt = 0.2;

  virtual ~ServoCore() = default;
  ServoCore(const ServoCore&) = delete;
  ServoCore& operator=(const ServoCore&) = delete;

  virtual void step(std::chrono::nanoseconds now) noexcept = 0;
  [[nodiscard]] virtual bool has_near() noexcept = 0;
  [[nodiscard]] virtual double grab_stiffness() const noexcept = 0;
  [[nodiscard]] bool take_news(double moved) noexcept;

  [[nodiscard]] TripleBuffer<ContactSet>& contacts() noexcept { return contacts_; }
  [[nodiscard]] TripleBuffer<ServoSnapshot>& snapshots() noexcept { return snapshots_; }
  void trace(TraceRing* ring) noexcept { trace_ = ring; }

  [[nodiscard]] const EffectPlan& plan() const noexcept { return *plan_; }
  [[nodiscard]] const DeviceLimits& limits() const noexcept { return limits_; }
  [[nodiscard]] double static_stiffness_limit() const noexcept { return static_cap_; }
  [[nodiscard]] double force_rate_limit() const noexcept { return max_rate_; }
  [[nodiscard]] double power_limit() const noexcept { return max_power_; }
  [[nodiscard]] double force_limit() const noexcept { return step_.force_limit; }
  [[nodiscard]] double remote_stiffness_limit() const noexcept { return remote_cap_; }
  [[nodiscard]] double body_stiffness_limit() const noexcept { return body_cap_; }

 protected:
  ServoCore(HapticDevice& device, std::shared_ptr<const EffectPlan> plan, const ServoConfig& config,
            std::shared_ptr<BodyWorld> bodies);

  /// Sets the limits of stiffness, rate and power. @return the stiffness limit of walls [N/m]
  /// @param probe damping for a spring at the first probe [N s/m] @param tool damping for springs
  /// at all probes [N s/m] @param bend [1/s], see ToolOf
  double cap_for(double probe, double tool, double bend) noexcept;
  /// Scales the stiffness limits of hands and bodies in this step to this damping [N s/m], at most
  /// the one of cap_for().
  void use_damping(double damping) noexcept;
  void note_time() noexcept;
  /// While the software stop is pressed, the operator's switch counts as released.
  void obey_stop(DeviceSample& reading) noexcept;

  HapticDevice& device_;
  DeviceLimits limits_;
  ServoConfig config_;
  std::shared_ptr<const EffectPlan> plan_;
  std::shared_ptr<BodyWorld> bodies_;
  double period_;                             // [s], nominal
  double stiffness_per_damping_;              // [1/s]: stiffness limit per damping
  double static_cap_ = 0.0;                   // [N/m]
  double remote_cap_ = 0.0, body_cap_ = 0.0;  // [N/m]
  double max_rate_ = 0.0;                     // [N/s], growth and rotation of the force
  double max_power_ = 0.0;                    // [W], into a yielding hand

  TripleBuffer<ContactSet> contacts_;
  TripleBuffer<ServoSnapshot> snapshots_;
  TraceRing* trace_ = nullptr;

  StepContext step_;
  std::uint64_t count_ = 0;
  std::chrono::nanoseconds stepped_at_{0};
  double elapsed_ = 0.0;  // [s], since the last step
  ServoTally tally_;
  bool stopped_ = false;  // the stop is pressed in this step

 private:
  StopSwitch stop_;
  Eigen::Vector3d seen_at_ =
      Eigen::Vector3d::Zero();                   // [m, S], position of the probe at the last news
  std::chrono::nanoseconds seen_{0}, moved_{0};  // times of the last news and of the last motion
};

/// Makes the servo for the device's kind and axes. @throws std::invalid_argument as ServoLoop
[[nodiscard]] std::unique_ptr<ServoCore> make_servo(HapticDevice& device,
                                                    std::shared_ptr<const EffectPlan> plan,
                                                    const ServoConfig& config,
                                                    std::shared_ptr<BodyWorld> bodies);

}  // namespace reckon::haptics
