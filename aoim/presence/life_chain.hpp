// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// How an epoch proves without a key that it is the same as before: each announcement opens the
// commitment of the one before. A receiver of all announcements cannot forge the next one.
//
//   link 4095 --H--> link 4094 --H--> .. --H--> link 0 --H--> anchor     drawn from a secret,
//                                                                        sent the other way round
//
// A second of the sender is a slot of 16 links, one for each announcement of that second. A chain
// has 256 slots. Each announcement also contains the anchor of the next chain, and a MAC whose key
// is revealed in the next slot, see address_proof.hpp.
#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <span>

#include "reckon/aoim/presence/source_address.hpp"
#include "reckon/pdu/reckon/presence_pdu.hpp"

namespace reckon::aoim {

using pdu::ChainLink;

/// A one-way function: nobody finds an argument for a value. `number` distinguishes its uses.
using OneWay = ChainLink (*)(const ChainLink& link, std::uint32_t number) noexcept;
/// A keyed hash function: nobody finds a value without the key.
using KeyedHash = ChainLink (*)(const ChainLink& key, std::span<const std::byte> octets) noexcept;

/// Functions of the proofs. A null `one_way`: no proofs; a null `keyed_hash`: no MACs.
struct ProofFunctions {
  OneWay one_way = nullptr;
  KeyedHash keyed_hash = nullptr;
};

/// Length of a slot; a key of one slot is revealed in the next one at the earliest.
inline constexpr std::chrono::seconds kSlot{1};
/// Links of one slot; further announcements of that slot repeat the last one.
inline constexpr std::uint32_t kSlotLinks = 16;
/// Links of one chain.
inline constexpr std::uint32_t kChainLength = 256 * kSlotLinks;

/// Slot of an announcement, counted from the first one of its epoch.
[[nodiscard]] constexpr std::uint32_t slot_of(std::uint32_t chain_number) noexcept {
  return chain_number / kSlotLinks;
}

/// Follows a link to an earlier one. One call of the function for each link in between.
/// @param number of `link`, in the same chain as `to`, which is not greater
[[nodiscard]] ChainLink follow_links(ChainLink link, std::uint32_t number, std::uint32_t to,
                                     OneWay one_way) noexcept;

/// Our own chain. About 4,100 calls of the function at construction, twice, and every 256 s; up to
/// 34 for each announcement.
class LifeChain {
 public:
  /// @param secret random, never sent
  LifeChain(const ProofFunctions& functions, const ChainLink& secret) noexcept;

  /// Fills in the proof of the next announcement, which is complete otherwise.
  /// @param source address it is sent from; port 0: unknown, then it has no MAC
  void sign(pdu::Presence& announced, const SourceAddress& source,
            std::chrono::nanoseconds now) noexcept;
  /// Time since the start of the slot, when the last announcement was signed.
  [[nodiscard]] std::chrono::nanoseconds slot_time() const noexcept { return time_ % kSlot; }

 private:
  using Nanoseconds = std::chrono::nanoseconds;
  using Tops = std::array<ChainLink, kChainLength / kSlotLinks>;  // last link of each slot
  void make(Tops& tops, std::uint32_t chain) const noexcept;
  void advance(Nanoseconds now) noexcept;
  [[nodiscard]] ChainLink link(std::uint32_t number) const noexcept;

  ProofFunctions functions_;
  ChainLink secret_;
  std::uint32_t number_ = 0, next_number_ = 0;  // of the last and the next announcement
  std::uint32_t chain_ = 0;
  Tops tops_{}, next_{};  // of this chain, and the one after it
  ChainLink next_anchor_{};
  Nanoseconds signed_ = Nanoseconds::min();  // the last announcement ..
  Nanoseconds time_{0};                      // .. since the first one
};

/// Result of judging the proof of an announcement.
enum class Opening : std::uint8_t {
  none,   ///< the epoch has offered no proof yet
  newer,  ///< it opens the last received commitment
  known,  ///< a link that was received already, or an earlier one
  wrong,  ///< not from this epoch
};

/// The last accepted announcement of an epoch. A value type.
class LifeTip {
 public:
  LifeTip() = default;
  LifeTip(const pdu::Presence& heard, std::chrono::nanoseconds now) noexcept
      : number_(heard.chain_number),
        link_(heard.chain_link),
        next_anchor_(heard.next_anchor),
        heard_(now) {}

  /// Whether it has offered a proof.
  [[nodiscard]] bool is_chained() const noexcept { return link_ != ChainLink{}; }
  /// Whether an announcement reveals the link of this one.
  [[nodiscard]] bool has_link_of(const pdu::Presence& heard) const noexcept {
    return is_chained() && heard.chain_number == number_ && heard.chain_link == link_;
  }
  /// Largest number of links since the last accepted one, if all announcements between were lost.
  [[nodiscard]] std::uint32_t farthest(std::chrono::nanoseconds now) const noexcept;
  /// Judges an announcement. It needs one call of the function for each link in between.
  /// @param most calls; an announcement farther ahead is wrong
  [[nodiscard]] Opening judge(const pdu::Presence& heard, OneWay one_way,
                              std::uint32_t most) const noexcept;

 private:
  std::uint32_t number_ = 0;
  ChainLink link_{}, next_anchor_{};
  std::chrono::nanoseconds heard_{0};
};

}  // namespace reckon::aoim
