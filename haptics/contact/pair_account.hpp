// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Energy exchanged with the owner of one remote hand: the totals that each side states, and a bound
// from the work that we observed. Servo thread, SI units.
#pragma once

#include <cstdint>

#include "reckon/haptics/passivity/energy_ledger.hpp"
#include "reckon/pdu/codec/records.hpp"

namespace reckon::haptics {

/// Kept after the contact, so that a hand that leaves and returns is not credited twice.
struct PairAccount {
  pdu::EntityId id;
  std::uint32_t epoch = 0;
  bool used = false;
  std::uint64_t last_step = 0;  ///< servo step at which it was last in a contact set
  double given = 0.0;           ///< [J], total that we gave
  double received = 0.0;        ///< [J], total that was credited to us
  double stated = 0.0;          ///< [J], greatest total that the owner stated
  double seen = 0.0;  ///< [J], part of `stated` that was credited or is lost; the rest is pending
  /// [J], energy that the owner should have by our observation: the work of its surface on our
  /// spring plus our gifts, minus the credits from it. Energy that it claims to have given is
  /// credited up to this, plus what the ledger accepts from anybody. The rest is lost. An owner
  /// that should have enough gets no share in a shortage.
  double believed = 0.0;

  /// Opens the account of this hand unless it is open. Energy given before is lost.
  /// @param total [J], given by its owner, as stated
  void open(const pdu::EntityId& whose, std::uint32_t life, double total) noexcept;
  /// Receives a total from the owner. Totals only grow, so that loss and reordering of updates can
  /// lose energy but not create any. With a new epoch of the owner the total restarts.
  void receive(std::uint32_t life, double total) noexcept;
  /// Credits pending energy, as far as the ledger accepts it now. Energy beyond the bound is lost.
  void claim(EnergyLedger& ledger) noexcept;
  /// Adds observed work [J] of the surface on our spring; negative if the spring gave it back.
  void see(double work) noexcept;
  /// Gives up to `wanted` [J], as far as the ledger allows. @return the energy given
  double give(EnergyLedger& ledger, double wanted) noexcept;
};

}  // namespace reckon::haptics
