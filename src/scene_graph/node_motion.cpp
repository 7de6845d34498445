// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/scene_graph/node_motion.hpp"

#include <cmath>
#include <numbers>

#include "reckon/pdu/seconds.hpp"

namespace reckon::peer {

bool NodeMotion::moves() const noexcept {
  return turn_rate != 0.0 || (swing_rate != 0.0 && !swing.isZero(0.0));
}

std::optional<std::string> fault_of(const NodeMotion& motion) {
  const bool finite = motion.turn_axis.allFinite() && motion.swing.allFinite() &&
                      std::isfinite(motion.turn_rate) && std::isfinite(motion.swing_rate) &&
                      std::isfinite(motion.swing_phase);
  if (!finite) return "its motion is not finite";
  if (motion.turn_rate != 0.0 && motion.turn_axis.norm() < 1e-6)
    return "its axis of rotation has no direction: write one, such as [0, 0, 1]";
  if (motion.swing_rate < 0.0) return "its swing rate is below 0 Hz: negate the swing instead";
  return std::nullopt;
}

MovedPose moved(const NodePose& rest, const NodeMotion& motion,
                std::chrono::nanoseconds time) noexcept {
  constexpr double kTurn = 2.0 * std::numbers::pi;
  const double t = pdu::to_seconds(time);
  MovedPose now{rest, {}};
  if (motion.turn_rate != 0.0) {
    const Eigen::Vector3d axis = motion.turn_axis.normalized();
    now.pose.orientation =
        rest.orientation * Eigen::AngleAxisd(std::remainder(motion.turn_rate * t, kTurn), axis);
    now.velocity.angular = rest.orientation * (motion.turn_rate * axis);
  }
  const double cycles = motion.swing_rate * t;
  const double phase = kTurn * (cycles - std::floor(cycles)) + motion.swing_phase;
  now.pose.position += std::sin(phase) * motion.swing;
  now.velocity.linear = (kTurn * motion.swing_rate * std::cos(phase)) * motion.swing;
  return now;
}

}  // namespace reckon::peer
