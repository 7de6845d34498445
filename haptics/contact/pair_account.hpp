// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Energy between us and the owner of one remote hand: what each says to have given, and what we saw
// that it can have given. Servo thread, SI units.
#pragma once

#include <cstdint>

#include "reckon/haptics/passivity/energy_port.hpp"
#include "reckon/pdu/codec/records.hpp"

namespace reckon::haptics {

/// Outlives the contact, so that a hand which leaves and comes back is not credited twice.
struct PairAccount {
  pdu::EntityId id;
  std::uint32_t epoch = 0;
  bool used = false;
  std::uint64_t last_step = 0;  ///< of the servo, when it was last in a contact set
  double given = 0.0;           ///< [J], running total from us
  double received = 0.0;        ///< [J], credited to us
  double stated = 0.0;          ///< [J], greatest total heard from the owner
  double seen = 0.0;            ///< [J], of it, what was credited or is lost; the rest waits
  /// [J], what the owner should have in store by what we saw: work that its surface did on our
  /// spring and our gifts to it, less what was credited from it. What it says to have given is
  /// credited up to this and to what the port believes of anybody; the rest is lost. Nor is a
  /// shortage shared with one who should have enough.
  double believed = 0.0;

  /// Begins for this hand, unless it goes on: what was given before we heard of it is lost.
  /// @param total [J], that its owner says to have given
  void open(const pdu::EntityId& whose, std::uint32_t life, double total) noexcept;
  /// Its owner says so. Totals only grow; loss and reordering can lose energy but not make any. A
  /// new epoch is a new life of the owner: its total starts anew.
  void hear(std::uint32_t life, double total) noexcept;
  /// Takes what waits, as far as the port receives it now; what is not believed is lost.
  void claim(EnergyPort& port) noexcept;
  /// The surface did so much work on our spring [J], or got it back.
  void see(double work) noexcept;
  /// Gives as much of `wanted` [J] as the port lets go. @return that
  double give(EnergyPort& port, double wanted) noexcept;
};

}  // namespace reckon::haptics
