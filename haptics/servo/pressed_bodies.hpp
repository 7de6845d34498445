// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// What a servo does to the bodies that its tool touches, and what that costs its port.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "reckon/haptics/bodies/body_push.hpp"
#include "reckon/haptics/bodies/body_world.hpp"
#include "reckon/haptics/contact/static_contact.hpp"
#include "reckon/haptics/contact/tool.hpp"
#include "reckon/haptics/passivity/energy_ledger.hpp"

namespace reckon::haptics {

/// The pushes of one servo. Order of calls within a step: settle, place, foresee, hold. Does
/// nothing without bodies.
template <int axes>
class PressedBodiesOf {
 public:
  /// @param patch [m], see ServoConfig::patch_radius
  PressedBodiesOf(std::shared_ptr<BodyWorld> world, std::size_t probes, double patch = 0.0);

  /// Brings the bodies to `now` and books the work that the pushes did, whether or not the handle
  /// can be read.
  /// @param frozen they stand still
  void settle(std::chrono::nanoseconds now, bool frozen, EnergyLedger& ledger) noexcept;
  /// Tells the contacts where the bodies are.
  void place(StaticContactOf<axes>& contacts) const noexcept;
  /// Foresees the period [s] that begins, after the contacts have settled.
  void foresee(const ToolOf<axes>& tool, StaticContactOf<axes>& contacts, double period) noexcept;
  /// Of what the contacts show the hand gets `share`, and so do the bodies. Where energy is short
  /// for a change within the period the hand does without it, the bodies do not: their springs are
  /// conservative.
  void hold(const StaticContactOf<axes>& contacts, double share) noexcept;
  /// [J], since the start, less what they gave back.
  [[nodiscard]] double work() const noexcept { return work_; }

 private:
  struct Push {
    std::size_t number = 0;  // of the world
    std::size_t probe = 0;
    std::uint32_t object = 0;
    double gain = 0.0;  // of the walls when it was pressed
  };

  void press(const WallContact& walls, std::size_t probe, std::uint32_t object,
             BodySpring spring) noexcept;

  std::shared_ptr<BodyWorld> world_;
  std::size_t hand_ = 0;
  double patch_ = 0.0;
  std::vector<Push> pushes_;
  double work_ = 0.0;
};

}  // namespace reckon::haptics
