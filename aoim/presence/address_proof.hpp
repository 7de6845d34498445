// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Binds announcements to the address that they are sent from, as TESLA does. The link of an
// announcement does not cover its content, so a receiver can replay it from another address. Its
// MAC covers address and content. The key of a slot is revealed in the next slot, so a MAC that
// arrived before that is the sender's own.
//
//   slot n      announcement with MAC, key n      pending, if it arrived before slot n can be over
//   slot n + 1  announcement that reveals key n   pending MACs are judged
#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <optional>

#include "reckon/aoim/presence/life_chain.hpp"
#include "reckon/aoim/presence/source_address.hpp"
#include "reckon/pdu/reckon/presence_pdu.hpp"

namespace reckon::aoim {

/// Digest of an announcement without its MAC, and of the address that it is sent from.
[[nodiscard]] ChainLink address_digest(pdu::Presence announced, const SourceAddress& source,
                                       KeyedHash keyed_hash) noexcept;
/// MAC of a digest. @param opened first link of the slot after `slot`
[[nodiscard]] pdu::AddressMac address_mac(const ChainLink& opened, std::uint32_t slot,
                                          const ChainLink& digest,
                                          const ProofFunctions& functions) noexcept;

/// Lower bound of a sender's clock, from its announcements: short by the shortest transit time of
/// the last 8 to 16 s. A value type.
class SlotClock {
 public:
  using Nanoseconds = std::chrono::nanoseconds;

  /// The sender had reached this time of its own at our time `now`; it may have been later.
  void raise(Nanoseconds reached, Nanoseconds now) noexcept;
  /// An announcement that was sent at `sent` of the sender's time arrived at `arrived` of ours.
  void note(Nanoseconds sent, Nanoseconds arrived) noexcept;
  /// Whether the slot may not be over at `now`.
  [[nodiscard]] bool is_running(std::uint32_t slot, Nanoseconds now) const noexcept;
  /// Whether the key of this slot is still secret at `now`, if the shortest transit took less than
  /// 100 ms.
  [[nodiscard]] bool is_secret(std::uint32_t slot, Nanoseconds now) const noexcept;

 private:
  static constexpr Nanoseconds kUnknown = Nanoseconds::min() / 2;
  Nanoseconds latest_ = kUnknown,
              before_ = kUnknown;  // greatest difference of the sender's time and ours
  Nanoseconds since_ = kUnknown;   // of `latest_`
};

/// Result of checking a revealed key.
struct Disclosure {
  std::optional<SourceAddress> proven;  ///< the address of the last genuine announcement
  SourceAddress refuted;                ///< an address that replayed a received announcement
  bool is_source_refuted = false;       ///< also the address that the peer is bound to
};

/// Pending MACs of one peer: one of the address that it is bound to, and up to three of others.
/// Of more addresses each has the same chance to be kept. A value type.
class AddressProof {
 public:
  /// Notes an announcement with a link that opens the last commitment.
  /// @param at_home whether it came from the address that the peer is bound to
  /// @return whether it came from elsewhere in its slot, so that the peer may have moved
  bool note(const pdu::Presence& heard, std::chrono::nanoseconds now, const SourceAddress& from,
            bool at_home, KeyedHash keyed_hash) noexcept;
  /// Judges the pending MACs of earlier slots by a link that opens the last commitment.
  /// @param bound address that the peer is bound to
  [[nodiscard]] Disclosure disclose(const pdu::Presence& heard, const SourceAddress& bound,
                                    const ProofFunctions& functions) noexcept;
  /// The peer may have left the address that it was bound to: drops the pending MAC of that.
  void forget_home() noexcept { pending_.front() = {}; }
  /// Whether the peer has proved an address in this epoch. One behind an address translator cannot.
  [[nodiscard]] bool is_proved() const noexcept { return proved_; }

 private:
  struct Pending {
    SourceAddress from;  // port 0: none
    std::uint32_t number = 0;
    bool in_time = false;
    ChainLink digest{};
    pdu::AddressMac mac{};
    std::chrono::nanoseconds sent{}, arrived{};
  };
  [[nodiscard]] Pending* place_for(const SourceAddress& from,
                                   std::chrono::nanoseconds now) noexcept;

  std::array<Pending, 4> pending_{};  // the first: of the address that it is bound to
  std::uint32_t crowd_ = 0;           // announcements from more addresses than have a place
  SlotClock clock_;
  bool proved_ = false;
};

}  // namespace reckon::aoim
