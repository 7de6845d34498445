// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Hands and bodies of others as springs along the axes of a device that renders them by itself.
#pragma once

#include <cstddef>
#include <cstdint>

#include "reckon/haptics/contact/near_hands.hpp"
#include "reckon/haptics/exchange/servo_types.hpp"
#include "reckon/haptics/passivity/energy_ledger.hpp"
#include "reckon/haptics/passivity/spring_wall.hpp"

namespace reckon::haptics {

/// Each surface is shown as a spring to its nearest point: along an axis of the device a wall that
/// begins where that point is, of the surface's stiffness. The force is right where the hand was
/// read, and stays right as the hand goes deeper. A hand that slides drags a little until the next
/// model. Axes that a normal meets at a flat angle have no wall of it, nor has what is far away.
///
/// What others give of energy is not used: they do not push a hand that does not press. Friction
/// and dampers are not shown. Servo thread; no allocation.
class RemoteWalls {
 public:
  /// Least part of a normal along an axis that has a wall of it.
  static constexpr double kFlat = 0.3;
  /// Greatest distance of a surface that is told ahead [m].
  static constexpr double kAhead = 0.1;

  /// As ServoConfig::max_contacts.
  explicit RemoteWalls(std::size_t most) noexcept : hands_(most) {}

  /// A step, with the hand where it was read. @param news a set that came since the last one; null:
  /// none did
  void advance(const ContactSet* news, const StepContext& step, std::uint64_t count) noexcept;
  /// Adds their walls to those of the scene: of two of one side the hand meets the nearer one.
  /// @param place [m], frame D @param axes 1 or 2 @param most_force [N], of each wall
  void add(const ServoConfig& config, const Eigen::Vector3d& place, std::size_t axes,
           double most_force, SpringModel& model) const noexcept;
  /// Their accounts. @param share of the force asked for that is shown
  void publish(const StepContext& step, double share, AccountList& out) noexcept;

  [[nodiscard]] bool empty() const noexcept { return hands_.empty(); }
  [[nodiscard]] std::size_t left_out() const noexcept { return hands_.left_out(); }
  [[nodiscard]] bool touching() const noexcept;

 private:
  struct Sink final : EnergyLedger {};  // of gifts

  NearHands hands_;
  Sink gifts_;
};

}  // namespace reckon::haptics
