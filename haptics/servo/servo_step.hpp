// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The step of a servo: read, predict, contact, gate, safety, write, publish.
#pragma once

#include <Eigen/Core>
#include <chrono>
#include <cstdint>
#include <memory>

#include "reckon/haptics/contact/static_contact.hpp"
#include "reckon/haptics/passivity/energy_port.hpp"
#include "reckon/haptics/passivity/softening.hpp"
#include "reckon/haptics/servo/energy_extremes.hpp"
#include "reckon/haptics/servo/hand_springs.hpp"
#include "reckon/haptics/servo/handle_motion.hpp"
#include "reckon/haptics/servo/motion_filter.hpp"
#include "reckon/haptics/servo/pressed_bodies.hpp"
#include "reckon/haptics/servo/safety.hpp"
#include "reckon/haptics/servo/servo_core.hpp"

namespace reckon::haptics {

/// The servo of a device with `axes` axes, 3 or 6. Remote hands touch the first probe of its tool.
template <int axes>
class ServoStepOf final : public ServoCore {
 public:
  /// As ServoLoop.
  ServoStepOf(HapticDevice& device, std::shared_ptr<const EffectPlan> plan,
              const ServoConfig& config, std::shared_ptr<BodyWorld> bodies);

  void step(std::chrono::nanoseconds now) noexcept override;
  [[nodiscard]] bool has_near() noexcept override;
  [[nodiscard]] double grab_stiffness() const noexcept override {
    return pressed_.grab_stiffness();
  }

 private:
  using Force = AxisForces<axes>;  // in the port's coordinates
  using Load = PortLoadOf<axes>;

  void limit_sources();
  void reduce(double scale) noexcept;
  [[nodiscard]] std::size_t exchange(const Load& load) noexcept;  // number of contacts engaged
  void part_hands() noexcept;
  [[nodiscard]] bool at_rest() noexcept;
  [[nodiscard]] double sure_speed() const noexcept;  // [m/s], lower bound
  void note_limit(const Force& force, double scale) noexcept;
  void drop_force(const DeviceSample& reading, const HandlePose& pose) noexcept;
  void forfeit(const HandlePose& pose) noexcept;
  bool sample(const DeviceSample& reading) noexcept;
  void note_pose(const DeviceSample& reading) noexcept;
  void settle() noexcept;
  void push_bodies(double scale) noexcept;
  [[nodiscard]] Load load() noexcept;
  [[nodiscard]] Force hold(Load& load) noexcept;
  void shake(const Load& load, const Force& wish) noexcept;
  [[nodiscard]] Force keep_rate(const Load& load, const Force& held) noexcept;
  void soften(const Load& load, double held) noexcept;
  void write() noexcept;
  void note_bodies() noexcept;
  void publish(bool enabled) noexcept;
  [[nodiscard]] double newtons(const Force& force) const noexcept {
    return tool_.force(force).norm();
  }

  HandleMotion<axes> handle_;
  ToolOf<axes> tool_;
  StaticContactOf<axes> static_;
  EnergyPortOf<axes> port_;
  NearHands hands_;
  double resolution_;        // [m], resolution of the last reading
  double held_share_ = 1.0;  // share of the force that was held since the last reading
  Softening softening_;
  HandSprings<axes> springs_;
  PortHoldOf<axes> held_;     // shares of the load that the port holds
  double took_ = 0.0;         // [s], duration of the handle's last motion
  double limit_share_ = 1.0;  // share of the held force within the greatest force
  double port_rate_;          // max_rate_ in the port's coordinates
  Safety safety_;
  MotionFilter scp_motion_;
  std::uint64_t next_search_ = 0;  // step count_ of the next search for surfaces
  bool near_surface_ = true;
  PressedBodiesOf<axes> pressed_;
  std::uint32_t buttons_ = 0;  // of the last good reading
  double rested_ = 0.0;        // [s], time short of energy and at rest
  bool started_ = false;
  std::chrono::nanoseconds sampled_at_{0};  // last good reading
  Force written_ = Force::Zero();           // held since the last step
  EnergyExtremes extremes_;
};

}  // namespace reckon::haptics
