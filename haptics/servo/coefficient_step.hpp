// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The step of a servo whose device renders springs by itself: read, request walls, publish.
#pragma once

#include <chrono>
#include <memory>

#include "reckon/haptics/devices/coefficient_device.hpp"
#include "reckon/haptics/servo/motion_filter.hpp"
#include "reckon/haptics/servo/remote_walls.hpp"
#include "reckon/haptics/servo/safety.hpp"
#include "reckon/haptics/servo/servo_core.hpp"
#include "reckon/haptics/servo/spring_scene.hpp"

namespace reckon::haptics {

/// The servo of a device of kind `coefficients`. It requests the walls around the hand before the
/// hand is inside them, and the device renders what its books pay for. Remote hands and bodies are
/// RemoteWalls.
class CoefficientStep final : public ServoCore {
 public:
  /// As ServoLoop; @throws also as SpringScene
  CoefficientStep(CoefficientDevice& device, std::shared_ptr<const EffectPlan> plan,
                  const ServoConfig& config, std::shared_ptr<BodyWorld> bodies);

  void step(std::chrono::nanoseconds now) noexcept override;
  [[nodiscard]] bool has_near() noexcept override;
  [[nodiscard]] double grab_stiffness() const noexcept override { return 0.0; }

 private:
  bool sample(const DeviceSample& reading) noexcept;
  [[nodiscard]] SpringModel walls(double most_force) noexcept;
  void publish(bool enabled) noexcept;

  CoefficientDevice& springs_;
  SpringScene scene_;
  RemoteWalls others_;
  Safety safety_;
  MotionFilter motion_, scp_motion_;
  Eigen::Vector3d place_ = Eigen::Vector3d::Zero();  // [m], frame D
  Eigen::Vector3d asked_ = Eigen::Vector3d::Zero();  // [N], of the requested walls, frame D
  std::chrono::nanoseconds sampled_at_{0}, placed_at_{0};
  bool started_ = false;
  double port_min_ = 0.0;
};

}  // namespace reckon::haptics
