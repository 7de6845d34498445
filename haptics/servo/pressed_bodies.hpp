// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// What a servo does to the bodies that its tool touches and holds, and what that costs its port.
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "reckon/haptics/bodies/body_push.hpp"
#include "reckon/haptics/bodies/body_world.hpp"
#include "reckon/haptics/contact/static_contact.hpp"
#include "reckon/haptics/contact/tool.hpp"
#include "reckon/haptics/exchange/servo_types.hpp"
#include "reckon/haptics/passivity/energy_ledger.hpp"

namespace reckon::haptics {

/// The pushes of one servo. Order of calls within a step: settle, place, grab, foresee, hold. Does
/// nothing without bodies.
template <int axes>
class PressedBodiesOf {
 public:
  /// @param plan only read here  @param stiffness_cap [N/m], of walls
  PressedBodiesOf(std::shared_ptr<BodyWorld> world, const EffectPlan& plan,
                  const ServoConfig& config, std::size_t probes, double stiffness_cap);

  /// See ServoLoop.
  [[nodiscard]] double grab_stiffness() const noexcept;

  /// Brings the bodies to `now` and books the work that the pushes did, whether or not the handle
  /// can be read.
  /// @param frozen they stand still
  void settle(std::chrono::nanoseconds now, bool frozen, EnergyLedger& ledger) noexcept;
  /// After the contacts have settled: where the port is in debt, the bodies give back of what they
  /// got in the last period.
  void repay(EnergyLedger& ledger) noexcept;
  /// Tells the contacts where the bodies are that the tool may meet.
  /// @param period [s], until the next step
  void place(const ToolOf<axes>& tool, StaticContactOf<axes>& contacts, double period) noexcept;
  /// Where all of them are: before the contacts restart.
  void place_all(StaticContactOf<axes>& contacts) const noexcept;
  /// Takes hold of bodies that are touched, where the hand is told to or they stick to it, and lets
  /// them go. @param pressed the buttons of the device
  void grab(const ToolOf<axes>& tool, StaticContactOf<axes>& contacts, std::uint32_t pressed,
            EnergyLedger& ledger) noexcept;
  /// Foresees the period [s] that begins, after the contacts have settled.
  void foresee(const ToolOf<axes>& tool, StaticContactOf<axes>& contacts, double period) noexcept;
  /// The hand gets `springs` of the springs as they were foreseen, and `effects` of the effects
  /// that the contacts show, and so do the bodies. Where energy is short for a change within the
  /// period the hand does without it, the bodies do not: their springs are conservative.
  void hold(const StaticContactOf<axes>& contacts, double springs, double effects) noexcept;
  /// Where they are; none without a world.
  [[nodiscard]] std::span<const BodyState> bodies() const noexcept {
    return world_ ? world_->states() : std::span<const BodyState>();
  }
  /// [J], since the start, less what they gave back.
  [[nodiscard]] double work() const noexcept { return work_; }

 private:
  struct Push {
    std::size_t number = 0;  // of the world
    std::size_t probe = 0;
    std::uint32_t object = 0;
    bool grips = false;
  };
  /// What a body got of a push.
  struct Gift {
    std::size_t body = 0;
    double energy = 0.0;  // [J] > 0
  };
  /// What holds one body.
  struct Hold {
    GrabSpring by_button, by_touch;
  };

  [[nodiscard]] HandReach reach_of(const ToolOf<axes>& tool,
                                   const StaticContactOf<axes>& contacts) const noexcept;
  void press(const WallContact& walls, std::size_t probe, std::uint32_t object,
             BodySpring spring) noexcept;
  void press_held(const Grab& grab, std::size_t probe, const Eigen::Vector3d& velocity) noexcept;
  void take(const ToolOf<axes>& tool, StaticContactOf<axes>& contacts, std::size_t probe,
            bool pressed) noexcept;

  std::shared_ptr<BodyWorld> world_;
  std::size_t hand_ = 0;
  HandReach reach_;         // when the bodies were placed last
  std::size_t placed_ = 0;  // then
  double radius_ = 0.0;     // [m], of a probe
  double patch_ = 0.0;
  double pad_ = 0.0;  // [m], radius by which a grip resists turning
  std::uint32_t buttons_ = 0;
  std::vector<Hold> holds_;             // of the bodies
  std::vector<std::uint32_t> body_of_;  // of the plan's objects; kNoBody
  std::array<bool, kMostProbes> by_{};  // a probe holds its body by the button
  std::vector<Push> pushes_;
  bool foresaw_ = false;     // a push, in the last step
  std::vector<Gift> gifts_;  // of the last period
  double work_ = 0.0;
};

}  // namespace reckon::haptics
