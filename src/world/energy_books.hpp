// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The energy accounts between our entities and the entities that touch them, as received from the
// others: the energy that they gave to us, and the energy that they request. For an entity without
// a device also the energy that we gave, because it has no port with a ledger.
#pragma once

#include <algorithm>
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
struct ReceivedAccount {
  pdu::EntityId other;
  EntityNumber own = 0;
  double given = 0.0;        ///< [J], running total that the other reports as given to us
  double need = 0.0;         ///< [J], requested from us
  double spring_need = 0.0;  ///< [J], additional wish
  bool unanswered = false;   ///< received since we last gave
  double we_gave = 0.0;      ///< [J], running total; only of entities without a device
  std::chrono::nanoseconds heard{0};
};

/// The pairs, a fixed number. A new pair replaces the one that was silent for the longest, which
/// can lose energy but never create any. One thread; allocates only at construction.
class EnergyBooks {
 public:
  static constexpr std::size_t kPairs = 1024;
  EnergyBooks() : index_(kPairs) { pairs_.reserve(kPairs); }

  /// The pair; it is made empty if it is new.
  ReceivedAccount& pair(EntityNumber own, const pdu::EntityId& other,
                        std::chrono::nanoseconds now) noexcept {
    const std::uint32_t known = index_.find(key(own, other));
    if (known != KeyIndex::kNone) {
      pairs_[known].heard = now;
      return pairs_[known];
    }
    if (pairs_.size() == kPairs) {
      const auto oldest =
          std::min_element(pairs_.begin(), pairs_.end(),
                           [](const auto& a, const auto& b) { return a.heard < b.heard; });
      erase(static_cast<std::size_t>(oldest - pairs_.begin()));
    }
    index_.put(key(own, other), pairs_.size());
    ReceivedAccount& made = pairs_.emplace_back();
    made.own = own;
    made.other = other;
    made.heard = now;
    return made;
  }
  [[nodiscard]] const ReceivedAccount* find(EntityNumber own,
                                            const pdu::EntityId& other) const noexcept {
    const std::uint32_t place = index_.find(key(own, other));
    return place == KeyIndex::kNone ? nullptr : &pairs_[place];
  }
  /// Forgets all pairs of an entity of ours.
  void forget(EntityNumber own) noexcept {
    for (std::size_t i = 0; i < pairs_.size();) {
      if (pairs_[i].own == own) {
        erase(i);
      } else {
        ++i;
      }
    }
  }

  [[nodiscard]] std::span<ReceivedAccount> pairs() noexcept { return pairs_; }

 private:
  [[nodiscard]] static std::uint64_t key(EntityNumber own, const pdu::EntityId& other) noexcept {
    return std::uint64_t{own} << 48 | other.key();
  }
  void erase(std::size_t place) noexcept {
    index_.erase(key(pairs_[place].own, pairs_[place].other));
    if (place + 1 < pairs_.size()) {
      pairs_[place] = pairs_.back();
      index_.put(key(pairs_[place].own, pairs_[place].other), place);
    }
    pairs_.pop_back();
  }

  std::vector<ReceivedAccount> pairs_;  // dense
  KeyIndex index_;
};

/// The energy that an entity without a device may give: its power while it moves, saved for at most
/// kSaved. It counts as energy that its owner adds.
class PowerBudget {
 public:
  /// When full, the default of 50 mW equals a hand's full ledger.
  static constexpr double kSaved = 0.4;  // [s]

  /// @param power [W] >= 0
  explicit PowerBudget(double power) noexcept : power_(power) {}

  /// Advances the time.  @param dt [s] >= 0
  void advance(double dt, bool moves) noexcept {
    if (moves) level_ = std::min(level_ + power_ * dt, power_ * kSaved);
  }
  /// Takes at most `wanted` [J], and at most the available energy.
  double take(double wanted) noexcept {
    const double taken = std::clamp(wanted, 0.0, level_);
    level_ -= taken;
    return taken;
  }
  [[nodiscard]] double level() const noexcept { return level_; }

 private:
  double power_;
  double level_ = 0.0;  // [J]
};

}  // namespace reckon::peer
