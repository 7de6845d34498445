// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Entities of ours that hands feel but no device moves: a post, a wall, a robot's tip. They have no
// port and no ledger. A resting one neither needs nor gives energy. A moving one gives energy from
// a stated power to the hands that it pushes; it is recorded as added by its owner.
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <span>

#include "reckon/peer/world/energy_books.hpp"
#include "reckon/peer/world/hand_port.hpp"
#include "reckon/peer/world/owned_entities.hpp"

namespace reckon::peer {

/// One such entity.
class PortlessBody {
 public:
  PortlessBody(EntityNumber number, double power) noexcept : number_(number), budget_(power) {}

  [[nodiscard]] EntityNumber number() const noexcept { return number_; }
  /// Accounts for its next update; valid until the next answer().
  [[nodiscard]] std::span<const EnergyAccount> accounts() const noexcept {
    return {accounts_.data(), account_count_};
  }
  /// Counts changes that hands nearby have to receive; see RemoteHand::version.
  [[nodiscard]] std::uint32_t version() const noexcept { return version_; }
  /// Whether a remote hand has stated lately that it presses this body.
  [[nodiscard]] bool is_pressed(std::chrono::nanoseconds now) const noexcept {
    return now - pressed_at_ < kPressed;
  }
  /// Whether it moved since the last answer().
  [[nodiscard]] bool moves() const noexcept { return moves_; }

  /// Gives the requested energy as far as it is available. Returns the energy given [J].
  double answer(const OwnedEntity& entity, EnergyBooks& books, std::chrono::nanoseconds now);

 private:
  /// A hand repeats its statement every 0.1 s, so ten statements were lost after this time.
  static constexpr std::chrono::seconds kPressed{1};

  void note_motion(const OwnedEntity& entity, std::chrono::nanoseconds now) noexcept;

  EntityNumber number_;
  PowerBudget budget_;
  EntityTruth last_;
  std::chrono::nanoseconds answered_{0};
  std::chrono::nanoseconds refreshed_{0};
  std::chrono::nanoseconds pressed_at_ = -kPressed;
  std::uint32_t version_ = 0;
  bool moves_ = false;
  std::array<EnergyAccount, kMostAccounts> accounts_{};
  std::size_t account_count_ = 0;
};

/// Enters the requests of our own hands to entities of ours, from their servos.
void note_own_needs(std::span<const HandPort> hands, const OwnedEntities& owned, EnergyBooks& books,
                    std::chrono::nanoseconds now) noexcept;

}  // namespace reckon::peer
