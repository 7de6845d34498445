// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Pushes the bodies that a servo's tool touches and holds, and books the work at its port.
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "reckon/haptics/bodies/body_push.hpp"
#include "reckon/haptics/bodies/body_world.hpp"
#include "reckon/haptics/contact/static_contact.hpp"
#include "reckon/haptics/contact/tool.hpp"
#include "reckon/haptics/exchange/servo_types.hpp"
#include "reckon/haptics/passivity/energy_ledger.hpp"

namespace reckon::haptics {

/// Order of calls within a step: settle, place, grab, foresee, hold. Does nothing without bodies.
template <int axes>
class PressedBodiesOf {
 public:
  /// @param plan only read here  @param stiffness_cap [N/m], of walls
  PressedBodiesOf(std::shared_ptr<BodyWorld> world, const EffectPlan& plan,
                  const ServoConfig& config, std::size_t probes, double stiffness_cap);

  /// See ServoLoop.
  [[nodiscard]] double grab_stiffness() const noexcept;

  /// Advances the bodies to `now` and books the work of the pushes, even if the reading failed.
  /// @param frozen the bodies stand still
  void settle(std::chrono::nanoseconds now, bool frozen, EnergyLedger& ledger) noexcept;
  /// Call after the contacts have settled. If the port is in debt, the bodies return energy of the
  /// last period.
  void repay(EnergyLedger& ledger) noexcept;
  /// Passes the bodies that the tool may touch to the contacts. The hands of other peers pay for
  /// the way by which a copy was drawn against the tool, and are paid for the way back.
  /// @param period [s] until the next step
  void place(const ToolOf<axes>& tool, StaticContactOf<axes>& contacts, double period,
             EnergyLedger& ledger) noexcept;
  /// Passes all bodies to the contacts, before these restart.
  void place_all(StaticContactOf<axes>& contacts) const noexcept;
  /// Grabs touched bodies, by button or because they stick, and releases them. @param pressed
  /// buttons of the device
  void grab(const ToolOf<axes>& tool, StaticContactOf<axes>& contacts, std::uint32_t pressed,
            EnergyLedger& ledger) noexcept;
  /// Predicts the period [s] that begins. Call after the contacts have settled.
  void foresee(const ToolOf<axes>& tool, StaticContactOf<axes>& contacts, double period) noexcept;
  /// Hand and bodies get the share `springs` of the predicted springs, and the share `effects` of
  /// the contacts' effects. If the energy for a change within the period is short, the hand does
  /// not get the change, but the bodies do: their springs are conservative.
  void hold(const StaticContactOf<axes>& contacts, double springs, double effects) noexcept;
  /// Whether a probe touches a copy of another peer's body.
  [[nodiscard]] bool touches_copy(const StaticContactOf<axes>& contacts) const noexcept;
  /// States of the bodies; empty without a world.
  [[nodiscard]] std::span<const BodyState> bodies() const noexcept {
    return world_ ? world_->states() : std::span<const BodyState>();
  }
  /// Work on the bodies since the start, minus the returned energy [J].
  [[nodiscard]] double work() const noexcept { return work_; }

 private:
  struct Push {
    std::size_t number = 0;  // number of the push in the world
    std::size_t probe = 0;
    std::uint32_t object = 0;
    bool grips = false;
  };
  /// Work of a push on a body.
  struct Gift {
    std::size_t body = 0;
    double energy = 0.0;  // [J] > 0
  };
  /// Grab springs of one body.
  struct Hold {
    GrabSpring by_button, by_touch;
  };

  [[nodiscard]] HandReach reach_of(const ToolOf<axes>& tool,
                                   const StaticContactOf<axes>& contacts) const noexcept;
  void pay_for_draw(const StaticContactOf<axes>& contacts, std::size_t body,
                    EnergyLedger& ledger) noexcept;
  void press(std::size_t probe, std::uint32_t object, BodySpring spring) noexcept;
  void press_held(const Grab& grab, std::size_t probe, const Eigen::Vector3d& velocity) noexcept;
  void take(const ToolOf<axes>& tool, StaticContactOf<axes>& contacts, std::size_t probe,
            bool pressed) noexcept;

  std::shared_ptr<BodyWorld> world_;
  std::size_t hand_ = 0;
  HandReach reach_;         // reach at the last place()
  std::size_t placed_ = 0;  // number of bodies of the last place()
  double radius_ = 0.0;     // [m], radius of a probe
  double patch_ = 0.0;
  double pad_ = 0.0;  // [m], radius with which a grip resists rotation
  std::uint32_t buttons_ = 0;
  std::vector<Hold> holds_;             // by body
  std::vector<std::uint32_t> body_of_;  // by object of the plan; kNoBody: not a body
  std::array<bool, kMostProbes> by_{};  // the probe holds its body by button
  std::vector<Push> pushes_;
  bool foresaw_ = false;     // the last step had a push
  std::vector<Gift> gifts_;  // by push of the last period
  double work_ = 0.0;
  double owed_ = 0.0;  // [J], to the hands of other peers
};

}  // namespace reckon::haptics
