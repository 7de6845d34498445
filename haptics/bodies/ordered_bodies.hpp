// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Carries out orders to bodies: changes of owner, and pushes of the program.
#pragma once

#include <cstddef>

#include "reckon/haptics/bodies/body_exchange.hpp"
#include "reckon/haptics/bodies/body_slots.hpp"
#include "reckon/haptics/bodies/carried_objects.hpp"
#include "reckon/haptics/bodies/copied_bodies.hpp"

namespace reckon::haptics {

/// Servo thread, between the steps of the solver; allocates nothing.
class OrderedBodies {
 public:
  /// All outlive this.
  OrderedBodies(BodySlots& slots, CarriedObjects& carried, CopiedBodies& copied)
      : slots_(slots), carried_(carried), copied_(copied) {}

  /// Whether an order would have an effect: its body exists, is in the right hands, and the numbers
  /// are usable.
  [[nodiscard]] bool admits(const BodyOrder& order) const noexcept;
  /// Carries out an order that admits() admits. @param slot of the body; BodySlots::kNone: there is
  /// none for it now, so that it stays asleep
  void carry_out(const BodyOrder& order, std::size_t slot) noexcept;

 private:
  BodySlots& slots_;
  CarriedObjects& carried_;
  CopiedBodies& copied_;
};

}  // namespace reckon::haptics
