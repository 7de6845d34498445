// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Decides which remote bodies may press which of our hands: a body that appears inside a hand
// exerts no force until it has been outside.
#pragma once

#include <algorithm>
#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>

#include "reckon/aoim/groups/peer_id.hpp"
#include "reckon/aoim/presence/source_address.hpp"
#include "reckon/peer/world/row_column.hpp"
#include "reckon/peer/world/row_owners.hpp"
#include "reckon/peer/world/state_table.hpp"

namespace reckon::peer {

/// An exception is a body of a peer that the hand pressed in the last kRemembered, at the same
/// address (with a key, at any address): a peer that was reconnected or restarted. Rows are added
/// and erased together with rows of the state table. One thread; allocates only at construction.
class ContactBeginnings {
 public:
  using Nanoseconds = std::chrono::nanoseconds;
  static constexpr std::size_t kHands = 8;
  /// Peers remembered for each hand; the one pressed longest ago makes room.
  static constexpr std::size_t kPeers = 32;
  static constexpr Nanoseconds kRemembered = std::chrono::seconds(12);

  /// @param capacity rows of the table
  explicit ContactBeginnings(std::size_t capacity) : outside_(capacity) {}

  void add_row() { outside_.push(0); }
  /// The last row takes its place.
  void erase_row(std::size_t place) noexcept { outside_.erase(place); }

  /// Call it for each hand when the row is checked, first right after it has a force model.
  /// @param hand 0 .. kHands - 1  @param depth [m] of the contact, <= 0 if the surfaces are apart
  /// @return whether it may press the hand
  [[nodiscard]] bool may_press(std::size_t place, const RemoteEntity& row, std::size_t hand,
                               double depth, const RowOwners& owners, Nanoseconds now) noexcept {
    const auto bit = static_cast<std::uint8_t>(1U << hand);
    if (!(depth > 0.0)) {
      outside_[place] = static_cast<std::uint8_t>(outside_[place] | bit);
      return true;
    }
    Hand& peers = pressed_[hand];
    const aoim::PeerId peer = row.id.simulation();
    const aoim::SourceAddress& from = owners.owner(place);
    if ((outside_[place] & bit) == 0) {
      const Pressed* before = find(peers, peer, from);
      if (before == nullptr || now - before->at > kRemembered) {
        ++held_back_;
        last_held_back_ = row.id;
        return false;
      }
      outside_[place] = static_cast<std::uint8_t>(outside_[place] | bit);
    }
    note_pressed(peers, peer, from, now);
    return true;
  }

  /// Checks after which a body was held back, and the last such body.
  [[nodiscard]] std::uint64_t held_back() const noexcept { return held_back_; }
  [[nodiscard]] const pdu::EntityId& last_held_back() const noexcept { return last_held_back_; }

 private:
  struct Pressed {
    aoim::PeerId peer;
    aoim::SourceAddress from;
    Nanoseconds at = Nanoseconds::min() / 2;
  };
  using Hand = std::array<Pressed, kPeers>;

  [[nodiscard]] static Pressed* find(Hand& hand, const aoim::PeerId& peer,
                                     const aoim::SourceAddress& from) noexcept {
    const auto found = std::ranges::find_if(hand, [&](const Pressed& one) {
      const bool sealed = one.from.boot != 0 && from.boot != 0;
      return one.peer == peer && (sealed || one.from.octets == from.octets);
    });
    return found == hand.end() ? nullptr : &*found;
  }
  static void note_pressed(Hand& hand, const aoim::PeerId& peer, const aoim::SourceAddress& from,
                           Nanoseconds now) noexcept {
    Pressed* one = find(hand, peer, from);
    if (one == nullptr) one = &*std::ranges::min_element(hand, {}, &Pressed::at);
    *one = {peer, from, now};
  }

  RowColumn<std::uint8_t> outside_;  // bit i: has been outside of hand i
  std::array<Hand, kHands> pressed_{};
  std::uint64_t held_back_ = 0;
  pdu::EntityId last_held_back_{};
};

}  // namespace reckon::peer
