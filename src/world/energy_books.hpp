// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The energy accounts between entities of ours and those that touch them, as heard from the others:
// what they have given to us and what they ask for. For an entity that no device moves also what we
// gave: it has no port whose ledger would know.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "reckon/pdu/codec/records.hpp"
#include "reckon/peer/world/entity_description.hpp"
#include "reckon/peer/world/key_index.hpp"
#include "reckon/peer/world/owned_entity.hpp"

namespace reckon::peer {

/// One pair: an entity of ours, and one that touches it.
struct HeardAccount {
  pdu::EntityId other;
  EntityNumber own = 0;
  double given = 0.0;        ///< [J], running total that the other has given to us, as it says
  double need = 0.0;         ///< [J], what it asks of us
  double spring_need = 0.0;  ///< [J], what it would like beyond
  bool unanswered = false;   ///< it was heard since we last gave
  double we_gave = 0.0;      ///< [J], running total; entities without a device alone
  std::chrono::nanoseconds heard{0};
};

/// The pairs, a fixed number: of more the one that was silent longest is forgotten, which can lose
/// energy but never make any. One thread; allocates at construction alone.
class EnergyBooks {
 public:
  static constexpr std::size_t kPairs = 1024;
  EnergyBooks();

  /// The pair, made empty where it is new.
  HeardAccount& pair(EntityNumber own, const pdu::EntityId& other,
                     std::chrono::nanoseconds now) noexcept;
  [[nodiscard]] const HeardAccount* find(EntityNumber own,
                                         const pdu::EntityId& other) const noexcept;
  /// Forgets all pairs of an entity of ours.
  void forget(EntityNumber own) noexcept;

  [[nodiscard]] std::span<HeardAccount> pairs() noexcept { return pairs_; }

 private:
  [[nodiscard]] static std::uint64_t key(EntityNumber own, const pdu::EntityId& other) noexcept;
  void erase(std::size_t place) noexcept;

  std::vector<HeardAccount> pairs_;  // dense
  KeyIndex index_;
};

/// What an entity that moves without a device may give: so many watts while it moves, saved for
/// kSaved at most. What it gives is put in by its owner, and counted.
class PowerBudget {
 public:
  /// Full, the default of 50 mW has what a hand's full ledger has.
  static constexpr double kSaved = 0.4;  // [s]

  /// @param power [W] >= 0
  explicit PowerBudget(double power) noexcept : power_(power) {}

  /// Time passes. @param dt [s] >= 0
  void advance(double dt, bool moves) noexcept;
  /// At most `wanted` [J], and what there is.
  double take(double wanted) noexcept;
  [[nodiscard]] double level() const noexcept { return level_; }

 private:
  double power_;
  double level_ = 0.0;  // [J]
};

}  // namespace reckon::peer
