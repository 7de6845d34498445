// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Renders remote hands and bodies as springs along the axes of a coefficient device.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "reckon/haptics/contact/near_hands.hpp"
#include "reckon/haptics/exchange/servo_types.hpp"
#include "reckon/haptics/passivity/energy_ledger.hpp"
#include "reckon/haptics/passivity/spring_wall.hpp"

namespace reckon::haptics {

/// Each surface becomes a spring to its nearest point: a wall along an axis of the device that
/// begins at that point, with the surface's stiffness. The force is exact at the position of the
/// reading and along the normal. Sliding causes a slight drag until the next model. A surface gives
/// no wall along axes nearly perpendicular to its normal, or if it is far away.
///
/// Energy from others is not used: they do not push a hand that does not press. Friction and
/// dampers are not rendered. Servo thread; no allocation.
class RemoteWalls {
 public:
  /// Least component of a normal along an axis for a wall.
  static constexpr double kFlat = 0.3;
  /// Greatest distance of a surface that has a wall [m].
  static constexpr double kAhead = 0.1;

  /// As ServoConfig::max_contacts.
  explicit RemoteWalls(std::size_t most) noexcept : hands_(most) {}

  /// One step, with the hand at its reading. @param news set received since the last step; null:
  /// none
  void advance(const ContactSet* news, const StepContext& step, std::uint64_t count) noexcept {
    for (RemoteContact* remote : hands_.all()) remote->settle(step);
    if (news != nullptr) hands_.take(*news, step, count);
    hands_.advance(step, count, gifts_);
    for (RemoteContact* remote : hands_.all()) remote->ask_nothing();
  }
  /// Adds their walls to the scene's walls; of two on one side the nearer one counts.
  /// @param place [m], frame D @param axes 1 or 2 @param most_force [N], of each wall
  void add(const ServoConfig& config, const Eigen::Vector3d& place, std::size_t axes,
           double most_force, SpringModel& model) const noexcept {
    for (const RemoteContact* remote : hands_.all()) {
      const ContactParameters& theta = remote->spring().parameters();
      const ContactGeometry& at = remote->spring().geometry();
      if (!is_usable(theta) || !(at.depth > -kAhead)) continue;
      const Eigen::Vector3d normal = config.device_orientation.conjugate() * at.normal;
      const double stiffness = stiffness_of(theta, at.depth);
      if (!(stiffness > 0) || !std::isfinite(stiffness)) continue;
      for (std::size_t axis = 0; axis < axes; ++axis) {
        const auto i = static_cast<Eigen::Index>(axis);
        if (!(std::abs(normal[i]) >= kFlat)) continue;
        const bool is_below = normal[i] > 0;
        const double begins = place[i] + at.depth * normal[i];
        SpringWall& wall = model.wall(axis, is_below ? WallSide::below : WallSide::above);
        if (wall.stiffness > 0 && (is_below ? wall.at >= begins : wall.at <= begins)) continue;
        wall = {begins, stiffness, most_force};
      }
    }
  }
  /// Writes their accounts. @param share of the requested force that is rendered
  void publish(const StepContext& step, double share, AccountList& out) noexcept {
    out.count = 0;
    for (RemoteContact* remote : hands_.all()) {
      remote->shown(share, 0.0);
      out.contacts[out.count++] = remote->account(step, 0.0);
    }
  }

  [[nodiscard]] bool empty() const noexcept { return hands_.empty(); }
  [[nodiscard]] std::size_t left_out() const noexcept { return hands_.left_out(); }
  [[nodiscard]] bool touching() const noexcept {
    return std::ranges::any_of(hands_.all(), &RemoteContact::touching);
  }

 private:
  // Stiffness of the spring to the nearest point [N/m]: the initial slope outside, or force / depth
  // inside.
  static double stiffness_of(const ContactParameters& theta, double depth) noexcept {
    return depth > 0 ? normal_load(theta, depth).force / depth : theta.gain * slope_at(theta, 0.0);
  }

  struct Sink final : EnergyLedger {};  // discards energy from others

  NearHands hands_;
  Sink gifts_;
};

}  // namespace reckon::haptics
